// SPDX-License-Identifier: MIT
//
// Which samples, tiles and boxes a choice looks at, and what stops at its door.
#include "tests/laws/choose_maps.hpp"
#include "tests/support/few_tiles.hpp"

#include <shadowmath/choose_maps.hpp>

#include <gtest/gtest.h>

#include <vector>

using namespace shadowmath;
using namespace shadowmath::test;

// One of each so many in turn, not always the same one; those that count for nothing are none of them.
TEST(ChooseMapsTaken, SamplesAreTakenEvenlyFromAllThatCount) {
    ViewVolume<double> const view = view_of_tiles(false);
    LightSampler<double> const sampler = light_sampler(view, sun_of_tiles, V2(1920, 1080), V2(40, 25));
    // Of a surface that the eye sees and the light does not.
    V3 const away = glm::normalize(glm::normalize(sun_of_tiles.direction) - view.pose.forward * 2.0);
    for (int const asked : {0, 1, 9, 1023, 1024, 1025, 2048, 2049, 5000}) {
        std::vector<SurfacePoint<double>> samples;
        for (int i = 0; i < asked; ++i) {
            samples.push_back({point_at(view, 0.0, 0.0, 1.0 + 0.01 * i), V3(0, 1, 0)});
            if (i % 3 == 0) samples.push_back({point_at(view, 0.0, 0.0, -5.0), V3(0, 1, 0)});
            if (i % 5 == 0) samples.push_back({point_at(view, 0.0, 0.0, 7.0), away});
        }
        detail::take_samples(search_of_tiles(), sampler, samples.data(), int(samples.size()));
        int const stride = (asked + 1023) / 1024;
        int wanted = 0;
        std::vector<int> places;
        for (int i = 0; i < asked; ++i) {
            if (i % stride != i / stride * 7 % stride) continue;
            ASSERT_LT(wanted, search_of_tiles().count);
            EXPECT_NEAR(search_of_tiles().sample[unsigned(wanted)].seen.z, 1.0 + 0.01 * i, 1e-9) << asked;
            EXPECT_EQ(search_of_tiles().sample[unsigned(wanted++)].weight, 1.0);
            places.push_back(i % stride);
        }
        EXPECT_EQ(search_of_tiles().count, wanted) << asked;
        EXPECT_LE(search_of_tiles().count, max_search_samples);
        EXPECT_TRUE(stride <= 2 || places[0] != places[1]);
    }
}

TEST(ChooseMapsTaken, TilesWithoutSamplesAreTakenAtTheirMiddles) {
    for (bool const flat : {false, true}) {
        FewTiles tiles(view_of_tiles(flat), 7, 5);
        // As in the comment of DepthTiles; and what lies beyond the view, or is no number.
        double const depths[][2] = {{10, 12},  {10, 10}, {12, 10}, {nan_, 12}, {10, nan_}, {-inf, 12}, {10, inf},
                                    {0.1, 40}, {60, 99}, {90, 99}, {91, 99},   {0.1, 0.5}, {0.1, 0.4}, {-5, 3}};
        double const middles[] = {11, 10, 0, 0, 0, 0, 0, 20.05, 79.5, 90, 0, 0.5, 0, 0.5};
        for (int i = 0; i < 35; ++i) tiles.see(i, depths[i % 14][0], depths[i % 14][1]);
        LightSampler<double> const sampler = light_sampler(tiles.view, sun_of_tiles, V2(1920, 1080), V2(7, 5));
        detail::take_tiles(search_of_tiles(), sampler, sun_of_tiles, tiles.depths());
        int taken = 0;
        for (int i = 0; i < 35; ++i) {
            double const depth = middles[i % 14];
            if (depth == 0.0) continue;
            ASSERT_LT(taken, search_of_tiles().count);
            LightSample<double> const& sample = search_of_tiles().sample[unsigned(taken++)];
            V3 const point = tiles.at(i, 0.5, 0.5, depth), from_eye = point - tiles.view.pose.position;
            EXPECT_NEAR(sample.seen.z, depth, 1e-9) << i;
            EXPECT_NEAR(sample.place.x, glm::dot(sampler.basis.x, from_eye), 1e-9) << i;
            EXPECT_NEAR(sample.place.y, glm::dot(sampler.basis.y, from_eye), 1e-9) << i;
            EXPECT_EQ(sample.weight, 1.0);
        }
        EXPECT_EQ(search_of_tiles().count, taken);
    }
}

TEST(ChooseMapsTaken, OfMoreTilesThanASearchHoldsOneOfEachFewIsTaken) {
    for (int const width : {32, 33, 64, 100}) {
        FewTiles tiles(view_of_tiles(false), width, 32);
        for (int i = 0; i < width * 32; ++i) tiles.see(i, 5.0 + 0.01 * i, 5.0 + 0.01 * i);
        LightSampler<double> const sampler = light_sampler(tiles.view, sun_of_tiles, V2(1920, 1080), V2(width, 32));
        detail::take_tiles(search_of_tiles(), sampler, sun_of_tiles, tiles.depths());
        int const stride = (width * 32 + 1023) / 1024;
        int taken = 0;
        for (int i = 0; i < width * 32; ++i) {
            if (i % stride != i / stride * 7 % stride) continue;
            ASSERT_LT(taken, search_of_tiles().count);
            EXPECT_NEAR(search_of_tiles().sample[unsigned(taken++)].seen.z, 5.0 + 0.01 * i, 1e-9);
        }
        EXPECT_EQ(search_of_tiles().count, taken);
        EXPECT_LE(taken, max_search_samples);
    }
}

TEST(ChooseMapsTaken, ADoorIsShutForWhatIsNoSunAndNoPicture) {
    auto const door = [](Light<double> const& light, V2 const& pixels, double margin = 2.0) {
        MapLimits<double> limits;
        limits.eye_pixels = pixels;
        limits.margin_texels = margin;
        return detail::door_of_choice(view_of_tiles(false), light, everywhere, limits);
    };
    V2 const picture(9, 5);
    EXPECT_FALSE(door(sun_of_tiles, picture).stop);
    EXPECT_FALSE(door(sun_of_tiles, picture).faults.any());
    EXPECT_FALSE(door(sun_of_tiles, V2(1e-3, 1e-3)).stop);
    Light<double> const lamp = spot(V3(0, 9, 0), V3(0, -1, 0), 0.5, 30.0);
    for (auto const& shut : {door(lamp, picture), door(sun_of_tiles, V2(0, 5)), door(sun_of_tiles, V2(9, 0)),
                             door(sun_of_tiles, V2(-9, 5)), door(sun_of_tiles, V2(9, -5)),
                             door(sun_of_tiles, V2(nan_, 5)), door(sun_of_tiles, V2(9, inf))}) {
        EXPECT_TRUE(shut.stop);
        EXPECT_TRUE(shut.faults.has(Fault::clamped_option));
    }
    EXPECT_TRUE(door(sun_of_tiles, picture, nan_).stop);
    EXPECT_FALSE(door(sun_of_tiles, picture, nan_).faults.has(Fault::clamped_option));
}

TEST(ChooseMapsTaken, TilesOfWhichADepthIsNoNumberAreNone) {
    for (bool const flat : {false, true}) {
        FewTiles const tiles = hills(flat);
        auto const samples = middles(tiles);
        auto const clean = tiles.chosen(limits_of(2), samples);
        double const odd[][2] = {{-inf, 12.0}, {10.0, inf}, {-inf, inf}, {nan_, 12.0}, {10.0, nan_}, {-9.0, -5.0}};
        for (auto const& depths : odd) {
            FewTiles spoilt = tiles;
            spoilt.see(3, depths[0], depths[1]);
            EXPECT_TRUE(laws::same(spoilt.chosen(limits_of(2), samples), clean)) << depths[0] << ' ' << depths[1];
        }
    }
}

TEST(ChooseMapsTaken, BoxesBeyondTheLastOrWithoutAnEndAreNone) {
    ViewVolume<double> const view = view_of_tiles(false);
    V3 const middle = point_at(view, 0.0, 0.0, 30.0);
    Aabb<double> const small{middle - 4.0, middle + 4.0};
    auto const of = [&](std::vector<Aabb<double>> const& boxes, int count) {
        return choose_maps(view, sun_of_tiles, everywhere, boxes.data(), count, limits_of(2), search_of_tiles());
    };
    auto const clean = of({small}, 1);
    ASSERT_GT(clean.count, 0);
    EXPECT_TRUE(laws::same(of({small, everywhere}, 1), clean)) << "there are no more";
    Aabb<double> endless = small, beginningless = small;
    endless.hi.x = inf;
    beginningless.lo.y = -inf;
    EXPECT_TRUE(laws::same(of({endless, small, beginningless}, 3), clean));
}

TEST(ChooseMapsTaken, WhatTheDoorHasMendedIsSaid) {
    FewTiles tiles = hills(false);
    tiles.view.z_far = inf;
    auto const chosen = tiles.chosen(limits_of(2), middles(tiles));
    EXPECT_GT(chosen.count, 0);
    EXPECT_TRUE(chosen.faults.has(Fault::far_clamped));
    Aabb<double> const box{V3(-50, 0, -50), V3(50, 1, 50)};
    auto const of_box = choose_maps(tiles.view, sun_of_tiles, everywhere, &box, 1, limits_of(9), search_of_tiles());
    EXPECT_TRUE(of_box.faults.has(Fault::far_clamped));
    EXPECT_TRUE(of_box.faults.has(Fault::count_clamped));
}
