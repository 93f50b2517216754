// SPDX-License-Identifier: MIT
//
// What a map of a few tiles or boxes must hold and no more, and the figures that it comes with.
#include "tests/laws/choose_maps.hpp"
#include "tests/support/few_tiles.hpp"

#include <shadowmath/choose_maps.hpp>
#include <shadowmath/footprint.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

// How far from the middle the farthest of the points is in the map, of its half width less the margin.
double reach_of(ShadowMap<double> const& map, std::vector<V3> const& points) {
    double farthest = 0.0;
    for (V3 const& point : points) {
        glm::dvec4 const at = map.clip_from_world * glm::dvec4(point, 1.0);
        farthest = std::fmax(farthest, std::fmax(std::abs(at.x), std::abs(at.y)) / at.w);
    }
    return farthest / (1.0 - 2.0 * 2.0 / 1024.0);
}

}  // namespace

TEST(ChooseMapsParts, AShapeIsNamedByWhereItsTexelsGrow) {
    auto const shape = [](V3 x, V3 y, V3 w, double w_least) {
        Quad<double> quad;
        quad.x = x, quad.y = y, quad.w = w, quad.w_least = w_least;
        return detail::shape_of(quad);
    };
    V3 const even(0, 0, 1);
    EXPECT_EQ(shape(V3(2, 0, 5), V3(0, 3, -9), even, 1.0), MapShape::rectangle);
    EXPECT_EQ(shape(V3(2, 2, 1), V3(-5, 5, 2), even, 1.0), MapShape::rectangle) << "at an angle";
    EXPECT_EQ(shape(V3(2, 0.15, 0), V3(0, 3, 0), even, 0.96), MapShape::rectangle) << "nearly at right angles";
    EXPECT_EQ(shape(V3(2, 0.3, 0), V3(0, 3, 0), even, 1.0), MapShape::lopsided) << "sheared";
    EXPECT_EQ(shape(V3(2, -0.3, 7), V3(0, 3, -7), even, 1.0), MapShape::lopsided);
    EXPECT_EQ(shape(V3(0.02, 0.003, 0), V3(0, 0.03, 0), even, 1.0), MapShape::lopsided) << "however large it is";
    EXPECT_EQ(shape(V3(0.02, 0, 0), V3(0.003, 0.02, 0), even, 1.0), MapShape::lopsided);
    // w grows along y alone, or along x, or along neither.
    EXPECT_EQ(shape(V3(2, 0, 0), V3(0, 3, 0), V3(0, 0.1, 1), 0.9), MapShape::warp);
    EXPECT_EQ(shape(V3(2, 0, 0), V3(0, 3, 0), V3(0.1, 0, 1), 0.5), MapShape::warp);
    EXPECT_EQ(shape(V3(2, 0, 0), V3(0, 2, 0), V3(0.1, 0.015, 1), 0.5), MapShape::warp);
    EXPECT_EQ(shape(V3(2, 0, 0), V3(0, 2, 0), V3(0.1, 0.03, 1), 0.5), MapShape::lopsided);
    EXPECT_EQ(shape(V3(2, 0, 0), V3(0, 2, 0), V3(-0.03, 0.1, 1), 0.5), MapShape::lopsided);
    EXPECT_EQ(shape(V3(2, 2, 0), V3(-2, 2, 0), V3(0.1, 0.1, 1), 0.5), MapShape::warp) << "along its own x";
    EXPECT_EQ(shape(V3(2, 2, 0), V3(-2, 2, 0), V3(0.1, 0, 1), 0.5), MapShape::lopsided) << "along neither";
}

// Whichever tile is the only one: all of it, from its nearest to its farthest depth, and nothing more.
TEST(ChooseMapsParts, AMapOfOneTileIsAsLargeAsThatTile) {
    for (bool const flat : {false, true})
        for (bool const with_sample : {false, true})
            for (int i = 0; i < 20; ++i) {
                FewTiles tiles(view_of_tiles(flat), 5, 4);
                double const from = i % 3 == 0 ? 10.0 : 0.1, to = i % 2 == 0 ? 40.0 : 1000.0;
                tiles.see(i, from, to);
                std::vector<SurfacePoint<double>> samples;
                if (with_sample) samples.push_back({tiles.at(i, 0.4, 0.7, 15.0), V3(0, 1, 0)});
                auto const chosen = tiles.chosen(limits_of(1), samples);
                ASSERT_EQ(chosen.count, 1);
                EXPECT_TRUE(laws::are_maps_of(chosen, sun_of_tiles, gl_clip));
                std::vector<V3> corners;
                for (double const u : {0.0, 1.0})
                    for (double const v : {0.0, 1.0})
                        for (double const depth : {std::fmax(from, 0.5), std::fmin(to, 90.0)})
                            corners.push_back(tiles.at(i, u, v, depth));
                for (V3 const& corner : corners) EXPECT_GE(laws::server_of(chosen, limits_of(1), corner, 1e-9), 0) << i;
                EXPECT_GT(reach_of(chosen.at[0].map, corners), 0.999) << i << " touches a side";
                // Each side: the map holds none of the next tile's far corners wholly, but for slack.
                glm::dmat4 const& m = chosen.at[0].map.clip_from_world;
                double lo_x = 1e9, hi_x = -1e9, lo_y = 1e9, hi_y = -1e9;
                for (V3 const& corner : corners) {
                    V3 const at = test::ndc(m, corner);
                    lo_x = std::fmin(lo_x, at.x), hi_x = std::fmax(hi_x, at.x);
                    lo_y = std::fmin(lo_y, at.y), hi_y = std::fmax(hi_y, at.y);
                }
                EXPECT_LT(lo_x, -0.95) << i;
                EXPECT_GT(hi_x, 0.95) << i;
                EXPECT_LT(lo_y, -0.95) << i;
                EXPECT_GT(hi_y, 0.95) << i;
                EXPECT_EQ(chosen.at[0].samples, 1);
            }
}

TEST(ChooseMapsParts, AMapOfOneBoxIsAsLargeAsWhatIsSeenOfIt) {
    int met = 0;
    for (bool const flat : {false, true})
        for (int i = 0; i < 20; ++i) {
            ViewVolume<double> const view = view_of_tiles(flat);
            V3 const middle = point_at(view, (flat ? 9.0 : 0.4) * std::sin(double(i)),
                                       (flat ? 4.0 : 0.2) * std::cos(double(i)), 30.0 + i);
            // A small one, wholly in view.
            Aabb<double> const box{middle - V3(0.5, 0.3, 0.4), middle + V3(0.5, 0.3, 0.4)};
            Aabb<double> const none{V3(1), V3(0)},
                behind{view.pose.position + V3(0, 30, 30), view.pose.position + V3(9, 40, 40)};
            Aabb<double> const boxes[] = {none, box, behind};
            auto const chosen = choose_maps(view, sun_of_tiles, everywhere, boxes, 3, limits_of(1), search_of_tiles());
            if (chosen.count == 0) continue;  // no ray of the guess meets it
            ++met;
            EXPECT_TRUE(laws::are_maps_of(chosen, sun_of_tiles, gl_clip));
            std::vector<V3> points;
            for (V3 const& corner : corners(box)) points.push_back(corner);
            for (V3 const& corner : points) EXPECT_GE(laws::server_of(chosen, limits_of(1), corner, 1e-6), 0) << i;
            EXPECT_GT(reach_of(chosen.at[0].map, points), 0.98);
        }
    EXPECT_GT(met, 10);
}

// The map's sides are the view's where boxes go on beyond it.
TEST(ChooseMapsParts, ABoxAroundTheViewIsCutToIt) {
    for (bool const flat : {false, true}) {
        ViewVolume<double> const view = view_of_tiles(flat);
        auto const chosen =
            choose_maps(view, sun_of_tiles, everywhere, &everywhere, 1, limits_of(1), search_of_tiles());
        ASSERT_EQ(chosen.count, 1);
        std::vector<V3> points;
        for (V3 const& corner : corners(view)) points.push_back(corner);
        for (V3 const& corner : points) EXPECT_GE(laws::server_of(chosen, limits_of(1), corner, 1e-6), 0);
        EXPECT_GT(reach_of(chosen.at[0].map, points), 0.999);
        double lo_x = 1e9, hi_x = -1e9, lo_y = 1e9, hi_y = -1e9;
        for (V3 const& corner : points) {
            V3 const at = test::ndc(chosen.at[0].map.clip_from_world, corner);
            lo_x = std::fmin(lo_x, at.x), hi_x = std::fmax(hi_x, at.x);
            lo_y = std::fmin(lo_y, at.y), hi_y = std::fmax(hi_y, at.y);
        }
        EXPECT_TRUE(lo_x < -0.99 && hi_x > 0.99 && lo_y < -0.99 && hi_y > 0.99);
        EXPECT_NEAR(chosen.one_map, chosen.price, 0.3 * chosen.price) << "it is searched by what it must hold";
    }
}

TEST(ChooseMapsParts, ItsFiguresAreThoseOfTheMapsDrawn) {
    for (bool const flat : {false, true}) {
        double one_map = 0.0;
        for (int const maps : {1, 2, 3, 4}) {
            FewTiles const tiles = hills(flat);
            auto const samples = middles(tiles);
            MapLimits<double> const limits = limits_of(maps);
            auto const chosen = tiles.chosen(limits, samples);
            ASSERT_GT(chosen.count, 0);
            LightSampler<double> const sampler = light_sampler(tiles.view, sun_of_tiles, limits.eye_pixels, V2(6, 4));
            double price = 0.0, weight = 0.0;
            std::vector<double> sum(4), worst(4);
            std::vector<int> count(4);
            for (auto const& surface : samples) {
                LightSample<double> const sample = light_sample(sampler, surface);
                if (!sample.usable || !(sample.weight > 0.0)) continue;
                int const k = laws::server_of(chosen, limits, surface.point, 1e-9);
                ASSERT_GE(k, 0);
                double const major =
                    footprint(clip_from_world(tiles.view, ClipSpace{}), limits.eye_pixels,
                              chosen.at[unsigned(k)].map.clip_from_world, 1024.0, surface.point, surface.normal)
                        .major;
                price += sample.weight * price_of(major), weight += sample.weight;
                sum[unsigned(k)] += major, worst[unsigned(k)] = std::fmax(worst[unsigned(k)], major);
                ++count[unsigned(k)];
            }
            EXPECT_NEAR(chosen.price, price / weight, 1e-3 * chosen.price);
            if (one_map == 0.0) one_map = chosen.price;
            EXPECT_NEAR(chosen.one_map, one_map, 1e-9 * one_map) << "what the first of these came to";
            for (unsigned k = 0; k < unsigned(chosen.count); ++k) {
                auto const& made = chosen.at[k];
                EXPECT_EQ(made.samples, count[k]);
                EXPECT_NEAR(made.mean, sum[k] / count[k], 1e-3 * made.mean);
                EXPECT_NEAR(made.worst, worst[k], 1e-3 * made.worst);
                EXPECT_GE(made.growth, 1.0 - 1e-9);
                EXPECT_LE(made.growth, 4.0 + 1e-9);
            }
        }
    }
}

TEST(ChooseMapsParts, ManyTilesAreHeldByFewMapsWhole) {
    for (bool const flat : {false, true})
        for (int const maps : {1, 2, 4}) {
            FewTiles const tiles = hills(flat);
            for (bool const with_samples : {false, true}) {
                auto const chosen =
                    tiles.chosen(limits_of(maps), with_samples ? middles(tiles) : std::vector<SurfacePoint<double>>{});
                ASSERT_GT(chosen.count, 0);
                for (int i = 0; i < 24; ++i)
                    for (double const u : {0.0, 1.0})
                        for (double const v : {0.0, 1.0})
                            for (double const depth : {tiles.nearest[std::size_t(i)], tiles.farthest[std::size_t(i)]})
                                EXPECT_TRUE(tiles.nearest[std::size_t(i)] > tiles.farthest[std::size_t(i)] ||
                                            laws::server_of(chosen, limits_of(maps), tiles.at(i, u, v, depth), 1e-9) >=
                                                0)
                                    << i;
            }
        }
}

TEST(ChooseMapsParts, CastersUpToTheLightAndReceiversDownToTheLastAreBetweenItsEnds) {
    FewTiles tiles(view_of_tiles(false), 5, 4);
    tiles.see(7, 20.0, 30.0);
    for (ClipSpace const clip : {gl_clip, vulkan_clip, reversed(d3d_clip)}) {
        MapLimits<double> limits = limits_of(1);
        limits.clip = clip;
        auto const chosen = tiles.chosen(limits);
        ASSERT_EQ(chosen.count, 1);
        double deepest = -1e9;
        for (double const u : {0.0, 1.0})
            for (double const v : {0.0, 1.0})
                for (double const depth : {20.0, 30.0}) {
                    V3 const point = tiles.at(7, u, v, depth);
                    auto const at =
                        test::ndc(canonical_from_clip<double>(clip) * chosen.at[0].map.clip_from_world, point);
                    deepest = std::fmax(deepest, at.z);
                    EXPECT_GE(at.z, -1.0);
                    V3 const caster = point - sun_of_tiles.direction * 60.0;
                    EXPECT_TRUE(laws::holds(chosen.at[0].map.clip_from_world, clip, caster, -1e-9));
                }
        // No receiver is beyond its end, and a thousandth of their range is all that is left.
        EXPECT_LT(deepest, 1.0);
        EXPECT_GT(deepest, 0.99);
    }
}

// So that depths are not spent on what lies beyond.
TEST(ChooseMapsParts, TheMapEndsALittleBehindTheLastReceiver) {
    for (bool const flat : {false, true}) {
        FewTiles tiles(view_of_tiles(flat), 5, 4);
        tiles.see(7, 20.0, 30.0);
        double first = 1e9, last = -1e9;
        Aabb<double> casters;
        V3 const eye = tiles.view.pose.position, along = glm::normalize(sun_of_tiles.direction);
        for (double const u : {0.0, 1.0})
            for (double const v : {0.0, 1.0})
                for (double const depth : {20.0 * (1.0 - 1e-5), 30.0 * (1.0 + 1e-5)}) {
                    V3 const point = tiles.at(7, u, v, depth);
                    first = std::fmin(first, glm::dot(along, point - eye));
                    last = std::fmax(last, glm::dot(along, point - eye));
                    casters.lo = glm::min(casters.lo, point), casters.hi = glm::max(casters.hi, point);
                }
        MapLimits<double> limits = limits_of(1);
        limits.clip = gl_zero_to_one_clip;
        auto const chosen = choose_maps<double>(tiles.view, sun_of_tiles, casters, nullptr, 0, tiles.depths(), limits,
                                                search_of_tiles());
        ASSERT_EQ(chosen.count, 1);
        glm::dmat4 const& m = chosen.at[0].map.clip_from_world;
        // Where depth is 1, metres beyond the eye: of a map of the sun it grows evenly along the light.
        double const here = test::ndc(m, eye + along * last).z, there = test::ndc(m, eye + along * (last + 1.0)).z;
        double const end = last + (1.0 - here) / (there - here);
        EXPECT_GT(end, last);
        EXPECT_LT(end, last + 0.01 * (last - first));
    }
}
