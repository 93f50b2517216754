// SPDX-License-Identifier: MIT
#include "tests/laws/choose_maps.hpp"
#include "tests/support/street.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/choose_maps.hpp>
#include <shadowmath/footprint.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace shadowmath;
using test::Street;
using test::street_view;
using test::V2;
using test::V3;

namespace {

Light<double> const& morning = test::street_morning;
Aabb<double> const& town = test::street_town;

// Mean footprint of the samples, each where by_map looks it up.
double mean_footprint(Street const& street, std::vector<ShadowMap<double>> const& maps, int map_size) {
    double sum = 0.0;
    int count = 0;
    for (auto const& sample : street.samples) {
        if (faces_away(morning, sample.point, sample.normal)) continue;
        LookUp<double> const at = by_map(maps.data(), int(maps.size()), map_size, 2.0, sample.point);
        if (at.first < 0) return footprint_limit<double>;
        sum += footprint(clip_from_world(street.view, ClipSpace{}), V2(1920, 1080),
                         maps[std::size_t(at.first)].clip_from_world, double(map_size), sample.point, sample.normal)
                   .major;
        ++count;
    }
    return sum / count;
}

std::vector<ShadowMap<double>> maps_of(ChosenMaps<double> const& chosen) {
    std::vector<ShadowMap<double>> maps;
    for (auto const& made : chosen) maps.push_back(made.map);
    return maps;
}

}  // namespace

TEST(ChooseMaps, EveryTileIsInAMapFromItsNearestToItsFarthestDepth) {
    Street const street;
    for (V3 const travel : {V3(0.8, -0.5, 0.4), V3(0, -1, 0), V3(0.4, -0.05, -1), V3(-0.4, -0.1, 1), V3(1, -0.05, 0)})
        for (int const count : {1, 2, 3, 4}) {
            MapLimits<double> limits;
            limits.maps = count;
            limits.clip = count % 2 == 0 ? vulkan_clip : reversed(d3d_clip);
            Light<double> const light = directional(travel);
            ChosenMaps<double> const chosen = street.chosen(limits, light);
            ASSERT_GT(chosen.count, 0);
            EXPECT_LE(chosen.count, count);
            EXPECT_TRUE(laws::are_maps_of(chosen, light, limits.clip));
            ViewVolume<double> const& view = street.view;
            for (int i = 0; i < street.width * street.height; ++i) {
                auto const tile = std::size_t(i);
                for (int step = 0; step < 5 && street.nearest[tile] <= street.farthest[tile]; ++step)
                    for (double const x : {0.0, 0.5, 1.0})
                        for (double const y : {0.0, 0.5, 1.0}) {
                            double const side_x =
                                view.left + (view.right - view.left) * (i % street.width + x) / street.width;
                            double const side_y =
                                view.bottom + (view.top - view.bottom) * (i / street.width + y) / street.height;
                            double const depth =
                                street.nearest[tile] + (street.farthest[tile] - street.nearest[tile]) * step / 4;
                            EXPECT_GE(laws::server_of(chosen, limits, point_at(view, side_x, side_y, depth), 1e-9), 0);
                        }
            }
        }
}

TEST(ChooseMaps, EveryPointOfTheBoxesInViewIsInAMap) {
    Street const street;
    for (V3 const travel : {V3(0.8, -0.5, 0.4), V3(0, -1, 0), V3(0.4, -0.05, -1), V3(1, -0.05, 0)}) {
        MapLimits<double> const limits;
        Light<double> const light = directional(travel);
        ChosenMaps<double> const chosen = street.chosen_from_boxes(limits, light);
        ASSERT_GT(chosen.count, 0);
        EXPECT_TRUE(laws::are_maps_of(chosen, light, limits.clip));
        int asked = 0;
        for (int x = 0; x <= 12; ++x)
            for (int y = 0; y <= 12; ++y)
                for (int z = 0; z <= 40; ++z) {
                    ViewVolume<double> const& view = street.view;
                    V3 const p = point_at(view, view.left + (view.right - view.left) * x / 12,
                                          view.bottom + (view.top - view.bottom) * y / 12,
                                          view.z_near * std::pow(view.z_far / view.z_near, z / 40.0));
                    bool received = false;
                    for (auto const& box : street.boxes) received = received || contains(box, p);
                    if (!received) continue;
                    ++asked;
                    EXPECT_GE(laws::server_of(chosen, limits, p, 1e-9), 0) << p.x << ' ' << p.y << ' ' << p.z;
                }
        EXPECT_GT(asked, 300);
    }
}

// Whatever casts on a point lies on the way to the light: with the point itself it must be in the map that serves it.
TEST(ChooseMaps, EveryCasterOnTheWayToTheLightIsInTheMapThatServes) {
    Street const street;
    MapLimits<double> limits;
    limits.clip = gl_zero_to_one_clip;
    ChosenMaps<double> const chosen = street.chosen(limits);
    for (auto const& sample : street.samples) {
        if (faces_away(morning, sample.point, sample.normal)) continue;
        int const k = laws::server_of(chosen, limits, sample.point, 1e-9);
        ASSERT_GE(k, 0);
        for (double const metres : {0.5, 5.0, 20.0, 35.0}) {
            V3 const caster = sample.point - morning.direction * metres;
            if (!contains(town, caster)) continue;
            EXPECT_TRUE(laws::holds(chosen.at[std::size_t(k)].map.clip_from_world, limits.clip, caster, -1e-9));
        }
    }
}

TEST(ChooseMaps, TheFootprintThatItSearchesByIsThatOfTheMapsDrawn) {
    Street const street;
    MapLimits<double> limits;
    limits.maps = 1;
    limits.margin_texels = 0.0;
    ChosenMaps<double> const chosen = street.chosen(limits);
    ASSERT_EQ(chosen.count, 1);
    LightSampler<double> const sampler = light_sampler(street.view, morning, limits.eye_pixels, V2(40, 25));
    double worst = 0.0;
    for (auto const& sample : street.samples) {
        LightSample<double> const seen = light_sample(sampler, sample);
        if (!seen.usable || seen.weight == 0.0) continue;
        worst = std::max(worst, footprint(clip_from_world(street.view, ClipSpace{}), limits.eye_pixels,
                                          chosen.at[0].map.clip_from_world, 1024.0, sample.point, sample.normal)
                                    .major);
    }
    // The search looks at every one of these few samples.
    EXPECT_NEAR(chosen.at[0].worst, worst, 1e-6 * worst);
}

TEST(ChooseMaps, IsFinerThanAnyCascadesOfAsManyTexels) {
    Street const street;
    double const mine = mean_footprint(street, maps_of(street.chosen()), 1024);
    double const from_boxes = mean_footprint(street, maps_of(street.chosen_from_boxes()), 1024);
    double least = footprint_limit<double>;
    for (CascadeFit const fit : {CascadeFit::stable, CascadeFit::tight, CascadeFit::rectangle, CascadeFit::warped})
        for (double const lambda : {0.3, 0.5, 0.7, 0.9}) {
            CascadeOptions<double> options;
            options.map_size = 1024;
            options.fit = fit;
            options.lambda = lambda;
            auto const cascades = fit_cascades(street.view, morning, town, town, options);
            std::vector<ShadowMap<double>> maps;
            for (auto const& cascade : cascades) maps.push_back(cascade.map);
            least = std::min(least, mean_footprint(street, maps, 1024));
        }
    EXPECT_LT(mine, 0.6 * least);
    EXPECT_LT(from_boxes, least);
}

TEST(ChooseMaps, MoreMapsCostLess) {
    Street const street;
    double last = std::numeric_limits<double>::max();
    for (int const count : {1, 2, 3, 4}) {
        MapLimits<double> limits;
        limits.maps = count;
        ChosenMaps<double> const chosen = street.chosen(limits);
        EXPECT_LT(chosen.price, last);
        EXPECT_LE(chosen.price, chosen.one_map * 1.05);
        last = chosen.price;
    }
}

TEST(ChooseMaps, TheSameInputsGiveTheSameMapsWithoutTheHeap) {
    Street const street;
    auto const once = test::watched([&] { return street.chosen(); });
    EXPECT_TRUE(once.calm());
    EXPECT_TRUE(laws::same(once.result, street.chosen()));
    auto const boxes = test::watched([&] { return street.chosen_from_boxes(); });
    EXPECT_TRUE(boxes.calm());
    EXPECT_TRUE(laws::same(boxes.result, street.chosen_from_boxes()));
    // By depth alone 7 cuts in two for each of seven parts, freely 21; then 54 moves of up to four parts, twice.
    EXPECT_LE(once.result.tried, 1 + 14 * 7 + 1 + 42 * 7 + 2 * 54 * 4);
}

TEST(ChooseMaps, WithoutSamplesTheTilesWeighAlike) {
    Street street;
    street.samples.clear();
    MapLimits<double> const limits;
    for (V3 const travel : {morning.direction, V3(0, 1, 0)}) {
        ChosenMaps<double> const chosen = street.chosen(limits, directional(travel));
        ASSERT_GT(chosen.count, 0);
        for (int i = 0; i < street.width * street.height; ++i) {
            auto const tile = std::size_t(i);
            if (!(street.nearest[tile] <= street.farthest[tile])) continue;
            ViewVolume<double> const& view = street.view;
            V3 const point = point_at(view, Street::side_of(i % street.width, street.width, view.left, view.right),
                                      Street::side_of(i / street.width, street.height, view.bottom, view.top),
                                      street.farthest[tile]);
            EXPECT_GE(laws::server_of(chosen, limits, point, 1e-9), 0);
        }
    }
}

TEST(ChooseMaps, SaysWhatItHasChosen) {
    Street const street;
    ChosenMaps<double> const chosen = street.chosen();
    int samples = 0;
    for (auto const& made : chosen) {
        EXPECT_GT(std::string(describe(made.shape)).size(), 20u);
        EXPECT_LT(made.part.lo.z, made.part.hi.z);
        samples += made.samples;
    }
    EXPECT_GT(samples, 100);
    EXPECT_LE(samples, max_search_samples);
    for (MapShape const shape : {MapShape::rectangle, MapShape::warp, MapShape::lopsided})
        EXPECT_GT(std::string(describe(shape)).size(), 20u);
    EXPECT_STREQ(describe(static_cast<MapShape>(99)), "no map");
}

TEST(ChooseMaps, OfMoreSamplesThanASearchHoldsItLooksAtSomeFromEverywhere) {
    Street const few, many(street_view(), 40, 25, 1);
    ChosenMaps<double> const chosen = many.chosen();
    int looked_at = 0;
    for (auto const& made : chosen) looked_at += made.samples;
    EXPECT_GT(many.samples.size(), std::size_t(10 * max_search_samples));
    EXPECT_LE(looked_at, max_search_samples);
    EXPECT_GT(looked_at, max_search_samples / 2);
    EXPECT_LT(mean_footprint(few, maps_of(chosen), 1024), 1.25 * mean_footprint(few, maps_of(few.chosen()), 1024));
}

// Four maps for sixteen like tiles: where one comes to serve none, the others serve all.
TEST(ChooseMaps, EverySampleCountsInAMapThatIsThere) {
    ViewVolume<double> const flat =
        orthographic_view(pose_looking(V3(0, 10, 0), V3(0, -1, 0), V3(0, 0, -1)), -20.0, 20.0, -20.0, 20.0, 0.0, 50.0);
    MapSearch<double> static work;
    std::vector<double> const depth(16, 10.0);
    SurfacePoint<double> const* const none = nullptr;
    ChosenMaps<double> const ground =
        choose_maps(flat, morning, town, none, 0, {depth.data(), depth.data(), 4, 4}, MapLimits<double>{}, work);
    ASSERT_GT(ground.count, 0);
    EXPECT_TRUE(laws::are_maps_of(ground, morning, gl_clip));
    int samples = 0;
    for (ChosenMap<double> const& chosen : ground) samples += chosen.samples;
    EXPECT_EQ(samples, 16);
}
