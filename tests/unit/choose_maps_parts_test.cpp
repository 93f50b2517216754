// SPDX-License-Identifier: MIT
//
// The parts of a choice one by one, on scenes of a few tiles, boxes and samples: what is looked at, what a map must
// hold and no more, and the figures that it comes with.
#include "tests/laws/choose_maps.hpp"
#include "tests/support/town.hpp"

#include <shadowmath/choose_maps.hpp>
#include <shadowmath/footprint.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

using namespace shadowmath;
using test::V2;
using test::V3;

namespace {

Light<double> const morning = directional(V3(0.8, -0.5, 0.4));
Aabb<double> const everywhere{V3(-300), V3(300)};

ViewVolume<double> view_of(bool flat) {
    auto const pose = pose_looking(V3(3, 20, 5), V3(0.4, -0.6, -1), V3(0, 1, 0));
    ViewVolume<double> view =
        flat ? orthographic_view(pose, -12.0, 20.0, -9.0, 7.0, 0.5, 90.0) : perspective_view(pose, 0.9, 1.6, 0.5, 90.0);
    view.left *= 0.8;
    return view;
}

MapSearch<double>& search() {
    static auto const work = std::make_unique<MapSearch<double>>();
    return *work;
}

// Tiles of which nothing is seen until they are given depths.
struct Tiles {
    ViewVolume<double> view;
    int width, height;
    std::vector<double> nearest, farthest;

    Tiles(ViewVolume<double> const& of, int across, int upward)
        : view(of), width(across), height(upward), nearest(std::size_t(across * upward), 1.0),
          farthest(std::size_t(across * upward), 0.0) {}

    void see(int tile, double from, double to) {
        nearest[std::size_t(tile)] = from;
        farthest[std::size_t(tile)] = to;
    }
    [[nodiscard]] DepthTiles<double> depths() const { return {nearest.data(), farthest.data(), width, height}; }
    // A place of a tile, from 0 to 1 across and upward.
    [[nodiscard]] V3 at(int tile, double u, double v, double depth) const {
        double const x = (tile % width + u) / width, y = (tile / width + v) / height;
        return point_at(view, view.left + (view.right - view.left) * x, view.bottom + (view.top - view.bottom) * y,
                        depth);
    }
    [[nodiscard]] ChosenMaps<double> chosen(MapLimits<double> const& limits,
                                            std::vector<SurfacePoint<double>> const& samples = {}) const {
        return choose_maps(view, morning, everywhere, samples.data(), int(samples.size()), depths(), limits, search());
    }
};

MapLimits<double> limits_of(int maps) {
    MapLimits<double> limits;
    limits.maps = maps;
    return limits;
}

// How far from the middle the farthest of the points is in the map, of its half width less the margin.
double reach_of(ShadowMap<double> const& map, std::vector<V3> const& points) {
    double farthest = 0.0;
    for (V3 const& point : points) {
        glm::dvec4 const at = map.clip_from_world * glm::dvec4(point, 1.0);
        farthest = std::fmax(farthest, std::fmax(std::abs(at.x), std::abs(at.y)) / at.w);
    }
    return farthest / (1.0 - 2.0 * 2.0 / 1024.0);
}

// Samples of a tile's middle, at a depth between its two.
std::vector<SurfacePoint<double>> middles(Tiles const& tiles) {
    std::vector<SurfacePoint<double>> samples;
    for (int i = 0; i < tiles.width * tiles.height; ++i) {
        double const from = tiles.nearest[std::size_t(i)], to = tiles.farthest[std::size_t(i)];
        if (from <= to) samples.push_back({tiles.at(i, 0.5, 0.5, 0.3 * from + 0.7 * to), V3(0, 1, 0)});
    }
    return samples;
}

Tiles hills(bool flat) {
    Tiles tiles(view_of(flat), 6, 4);
    for (int i = 0; i < 24; ++i)
        if (i % 7 != 3) tiles.see(i, 10.0 + i % 6 + i / 6 * 12, 11.0 + i % 6 + i / 6 * 13);
    return tiles;
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

// One of each so many in turn, not always the same one; those that count for nothing are none of them.
TEST(ChooseMapsParts, SamplesAreTakenEvenlyFromAllThatCount) {
    ViewVolume<double> const view = view_of(false);
    LightSampler<double> const sampler = light_sampler(view, morning, V2(1920, 1080), V2(40, 25));
    // Of a surface that the eye sees and the light does not.
    V3 const away = glm::normalize(glm::normalize(morning.direction) - view.pose.forward * 2.0);
    for (int const asked : {0, 1, 9, 1023, 1024, 1025, 2048, 2049, 5000}) {
        std::vector<SurfacePoint<double>> samples;
        for (int i = 0; i < asked; ++i) {
            samples.push_back({point_at(view, 0.0, 0.0, 1.0 + 0.01 * i), V3(0, 1, 0)});
            if (i % 3 == 0) samples.push_back({point_at(view, 0.0, 0.0, -5.0), V3(0, 1, 0)});
            if (i % 5 == 0) samples.push_back({point_at(view, 0.0, 0.0, 7.0), away});
        }
        detail::take_samples(search(), sampler, samples.data(), int(samples.size()));
        int const stride = (asked + 1023) / 1024;
        int wanted = 0;
        std::vector<int> places;
        for (int i = 0; i < asked; ++i) {
            if (i % stride != i / stride * 7 % stride) continue;
            ASSERT_LT(wanted, search().count);
            EXPECT_NEAR(search().sample[unsigned(wanted)].seen.z, 1.0 + 0.01 * i, 1e-9) << asked;
            EXPECT_EQ(search().sample[unsigned(wanted++)].weight, 1.0);
            places.push_back(i % stride);
        }
        EXPECT_EQ(search().count, wanted) << asked;
        EXPECT_LE(search().count, max_search_samples);
        EXPECT_TRUE(stride <= 2 || places[0] != places[1]);
    }
}

TEST(ChooseMapsParts, TilesWithoutSamplesAreTakenAtTheirMiddles) {
    for (bool const flat : {false, true}) {
        Tiles tiles(view_of(flat), 7, 5);
        // As in the comment of DepthTiles; and what lies beyond the view, or is no number.
        double const inf = test::inf, nan = test::nan_;
        double const depths[][2] = {{10, 12},  {10, 10}, {12, 10}, {nan, 12}, {10, nan},  {-inf, 12}, {10, inf},
                                    {0.1, 40}, {60, 99}, {90, 99}, {91, 99},  {0.1, 0.5}, {0.1, 0.4}, {-5, 3}};
        double const middles[] = {11, 10, 0, 0, 0, 0, 0, 20.05, 79.5, 90, 0, 0.5, 0, 0.5};
        for (int i = 0; i < 35; ++i) tiles.see(i, depths[i % 14][0], depths[i % 14][1]);
        LightSampler<double> const sampler = light_sampler(tiles.view, morning, V2(1920, 1080), V2(7, 5));
        detail::take_tiles(search(), sampler, morning, tiles.depths());
        int taken = 0;
        for (int i = 0; i < 35; ++i) {
            double const depth = middles[i % 14];
            if (depth == 0.0) continue;
            ASSERT_LT(taken, search().count);
            LightSample<double> const& sample = search().sample[unsigned(taken++)];
            V3 const point = tiles.at(i, 0.5, 0.5, depth), from_eye = point - tiles.view.pose.position;
            EXPECT_NEAR(sample.seen.z, depth, 1e-9) << i;
            EXPECT_NEAR(sample.place.x, glm::dot(sampler.basis.x, from_eye), 1e-9) << i;
            EXPECT_NEAR(sample.place.y, glm::dot(sampler.basis.y, from_eye), 1e-9) << i;
            EXPECT_EQ(sample.weight, 1.0);
        }
        EXPECT_EQ(search().count, taken);
    }
}

TEST(ChooseMapsParts, OfMoreTilesThanASearchHoldsOneOfEachFewIsTaken) {
    for (int const width : {32, 33, 64, 100}) {
        Tiles tiles(view_of(false), width, 32);
        for (int i = 0; i < width * 32; ++i) tiles.see(i, 5.0 + 0.01 * i, 5.0 + 0.01 * i);
        LightSampler<double> const sampler = light_sampler(tiles.view, morning, V2(1920, 1080), V2(width, 32));
        detail::take_tiles(search(), sampler, morning, tiles.depths());
        int const stride = (width * 32 + 1023) / 1024;
        int taken = 0;
        for (int i = 0; i < width * 32; ++i) {
            if (i % stride != i / stride * 7 % stride) continue;
            ASSERT_LT(taken, search().count);
            EXPECT_NEAR(search().sample[unsigned(taken++)].seen.z, 5.0 + 0.01 * i, 1e-9);
        }
        EXPECT_EQ(search().count, taken);
        EXPECT_LE(taken, max_search_samples);
    }
}

// Whichever tile is the only one: all of it, from its nearest to its farthest depth, and nothing more.
TEST(ChooseMapsParts, AMapOfOneTileIsAsLargeAsThatTile) {
    for (bool const flat : {false, true})
        for (bool const with_sample : {false, true})
            for (int i = 0; i < 20; ++i) {
                Tiles tiles(view_of(flat), 5, 4);
                double const from = i % 3 == 0 ? 10.0 : 0.1, to = i % 2 == 0 ? 40.0 : 1000.0;
                tiles.see(i, from, to);
                std::vector<SurfacePoint<double>> samples;
                if (with_sample) samples.push_back({tiles.at(i, 0.4, 0.7, 15.0), V3(0, 1, 0)});
                auto const chosen = tiles.chosen(limits_of(1), samples);
                ASSERT_EQ(chosen.count, 1);
                EXPECT_TRUE(laws::are_maps_of(chosen, morning, gl_clip));
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
    for (bool const flat : {false, true})
        for (int i = 0; i < 20; ++i) {
            ViewVolume<double> const view = view_of(flat);
            V3 const middle = point_at(view, (flat ? 9.0 : 0.4) * std::sin(double(i)),
                                       (flat ? 4.0 : 0.2) * std::cos(double(i)), 30.0 + i);
            // A small one, wholly in view.
            Aabb<double> const box{middle - V3(0.5, 0.3, 0.4), middle + V3(0.5, 0.3, 0.4)};
            Aabb<double> const none{V3(1), V3(0)},
                behind{view.pose.position + V3(0, 30, 30), view.pose.position + V3(9, 40, 40)};
            Aabb<double> const boxes[] = {none, box, behind};
            auto const chosen = choose_maps(view, morning, everywhere, boxes, 3, limits_of(1), search());
            if (chosen.count == 0) continue;  // no ray of the guess meets it
            EXPECT_TRUE(laws::are_maps_of(chosen, morning, gl_clip));
            std::vector<V3> points;
            for (V3 const& corner : corners(box)) points.push_back(corner);
            for (V3 const& corner : points) EXPECT_GE(laws::server_of(chosen, limits_of(1), corner, 1e-6), 0) << i;
            EXPECT_GT(reach_of(chosen.at[0].map, points), 0.98);
        }
}

// The map's sides are the view's where boxes go on beyond it.
TEST(ChooseMapsParts, ABoxAroundTheViewIsCutToIt) {
    for (bool const flat : {false, true}) {
        ViewVolume<double> const view = view_of(flat);
        auto const chosen = choose_maps(view, morning, everywhere, &everywhere, 1, limits_of(1), search());
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
            Tiles const tiles = hills(flat);
            auto const samples = middles(tiles);
            MapLimits<double> const limits = limits_of(maps);
            auto const chosen = tiles.chosen(limits, samples);
            ASSERT_GT(chosen.count, 0);
            LightSampler<double> const sampler = light_sampler(tiles.view, morning, limits.eye_pixels, V2(6, 4));
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
            Tiles const tiles = hills(flat);
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
    Tiles tiles(view_of(false), 5, 4);
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
                    V3 const caster = point - morning.direction * 60.0;
                    EXPECT_TRUE(laws::holds(chosen.at[0].map.clip_from_world, clip, caster, -1e-9));
                }
        // No receiver is beyond its end, and a thousandth of their range is all that is left.
        EXPECT_LT(deepest, 1.0);
        EXPECT_GT(deepest, 0.99);
    }
}

TEST(ChooseMapsParts, ADoorIsShutForWhatIsNoSunAndNoPicture) {
    auto const door = [](Light<double> const& light, V2 const& pixels, double margin = 2.0) {
        MapLimits<double> limits;
        limits.eye_pixels = pixels;
        limits.margin_texels = margin;
        return detail::door_of_choice(view_of(false), light, everywhere, limits);
    };
    V2 const picture(9, 5);
    EXPECT_FALSE(door(morning, picture).stop);
    EXPECT_FALSE(door(morning, picture).faults.any());
    EXPECT_FALSE(door(morning, V2(1e-3, 1e-3)).stop);
    Light<double> const lamp = spot(V3(0, 9, 0), V3(0, -1, 0), 0.5, 30.0);
    for (auto const& shut :
         {door(lamp, picture), door(morning, V2(0, 5)), door(morning, V2(9, 0)), door(morning, V2(-9, 5)),
          door(morning, V2(9, -5)), door(morning, V2(test::nan_, 5)), door(morning, V2(9, test::inf))}) {
        EXPECT_TRUE(shut.stop);
        EXPECT_TRUE(shut.faults.has(Fault::clamped_option));
    }
    EXPECT_TRUE(door(morning, picture, test::nan_).stop);
    EXPECT_FALSE(door(morning, picture, test::nan_).faults.has(Fault::clamped_option));
}

// So that depths are not spent on what lies beyond.
TEST(ChooseMapsParts, TheMapEndsALittleBehindTheLastReceiver) {
    for (bool const flat : {false, true}) {
        Tiles tiles(view_of(flat), 5, 4);
        tiles.see(7, 20.0, 30.0);
        double first = 1e9, last = -1e9;
        Aabb<double> casters;
        V3 const eye = tiles.view.pose.position, along = glm::normalize(morning.direction);
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
        auto const chosen =
            choose_maps<double>(tiles.view, morning, casters, nullptr, 0, tiles.depths(), limits, search());
        ASSERT_EQ(chosen.count, 1);
        glm::dmat4 const& m = chosen.at[0].map.clip_from_world;
        // Where depth is 1, metres beyond the eye: of a map of the sun it grows evenly along the light.
        double const here = test::ndc(m, eye + along * last).z, there = test::ndc(m, eye + along * (last + 1.0)).z;
        double const end = last + (1.0 - here) / (there - here);
        EXPECT_GT(end, last);
        EXPECT_LT(end, last + 0.01 * (last - first));
    }
}

TEST(ChooseMapsParts, TilesOfWhichADepthIsNoNumberAreNone) {
    for (bool const flat : {false, true}) {
        Tiles const tiles = hills(flat);
        auto const samples = middles(tiles);
        auto const clean = tiles.chosen(limits_of(2), samples);
        double const inf = test::inf, nan = test::nan_;
        double const odd[][2] = {{-inf, 12.0}, {10.0, inf}, {-inf, inf}, {nan, 12.0}, {10.0, nan}, {-9.0, -5.0}};
        for (auto const& depths : odd) {
            Tiles spoilt = tiles;
            spoilt.see(3, depths[0], depths[1]);
            EXPECT_TRUE(laws::same(spoilt.chosen(limits_of(2), samples), clean)) << depths[0] << ' ' << depths[1];
        }
    }
}

TEST(ChooseMapsParts, BoxesBeyondTheLastOrWithoutAnEndAreNone) {
    ViewVolume<double> const view = view_of(false);
    V3 const middle = point_at(view, 0.0, 0.0, 30.0);
    Aabb<double> const small{middle - 4.0, middle + 4.0};
    auto const of = [&](std::vector<Aabb<double>> const& boxes, int count) {
        return choose_maps(view, morning, everywhere, boxes.data(), count, limits_of(2), search());
    };
    auto const clean = of({small}, 1);
    ASSERT_GT(clean.count, 0);
    EXPECT_TRUE(laws::same(of({small, everywhere}, 1), clean)) << "there are no more";
    Aabb<double> endless = small, beginningless = small;
    endless.hi.x = test::inf;
    beginningless.lo.y = -test::inf;
    EXPECT_TRUE(laws::same(of({endless, small, beginningless}, 3), clean));
}

TEST(ChooseMapsParts, WhatTheDoorHasMendedIsSaid) {
    Tiles tiles = hills(false);
    tiles.view.z_far = test::inf;
    auto const chosen = tiles.chosen(limits_of(2), middles(tiles));
    EXPECT_GT(chosen.count, 0);
    EXPECT_TRUE(chosen.faults.has(Fault::far_clamped));
    Aabb<double> const box{V3(-50, 0, -50), V3(50, 1, 50)};
    auto const of_box = choose_maps(tiles.view, morning, everywhere, &box, 1, limits_of(9), search());
    EXPECT_TRUE(of_box.faults.has(Fault::far_clamped));
    EXPECT_TRUE(of_box.faults.has(Fault::count_clamped));
}
