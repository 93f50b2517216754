// SPDX-License-Identifier: MIT
//
// What the map serves, spends its depth on, and how it moves. Its centre, the papers and bad input: the files beside.
#include "tests/laws/warp.hpp"
#include "tests/support/warp_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace shadowmath;
using namespace shadowmath::test;

// The light sweeps over the sky, a twentieth of a degree a step, through both alignments with the view.
TEST(SimplePerspectiveMap, MovesLittleWhenTheLightTurnsLittleAtAnyStrength) {
    ViewVolume<double> view = level_view();
    view.pose = pose_looking(V3(3, 30, 2), V3(0.2, -0.8, -0.6), V3(0, 1, 0));
    double const step = 8.7e-4;
    for (WarpRule const rule : {WarpRule::by_strength, WarpRule::trapezoid, WarpRule::extended})
        for (double const strength : {0.5, 1.0, 2.0}) {
            WarpOptions<double> options;
            options.rule = rule;
            options.strength = strength;
            ShadowMap<double> before;
            double worst = 0.0;
            for (double angle = 0.3; angle < 2.8; angle += step) {
                Light<double> const light = directional(V3(0.1, -std::sin(angle), std::cos(angle)));
                ShadowMap<double> const map = simple_perspective_map(view, light, town, town, options, gl_clip);
                ASSERT_TRUE(map.visible);
                if (before.visible) worst = std::max(worst, laws::moved_texels(before, map, V3(6, 0, -12), 1024));
                before = map;
            }
            EXPECT_LT(worst, 40 * step * 1024) << int(rule) << ' ' << strength;
        }
}

TEST(SimplePerspectiveMap, IsExactlyUniformWhereLightAndViewAlign) {
    for (double const angle : {0.0, 1e-9, 0.01, 0.09}) {
        ViewVolume<double> view = level_view();
        view.pose = pose_looking(V3(0, 30, 0), V3(0, -std::cos(angle), -std::sin(angle)), V3(0, 0, -1));
        for (double const sign : {1.0, -1.0}) {
            ShadowMap<double> const map =
                simple_perspective_map(view, directional(V3(0, -sign, 0)), town, town, {}, gl_clip);
            ASSERT_TRUE(map.visible);
            EXPECT_EQ(row(map.clip_from_world, 3), V4(0, 0, 0, 1));
            EXPECT_TRUE(map.faults.has(Fault::warp_faded));
        }
    }
}

TEST(SimplePerspectiveMap, MovesLittleWhenTheCameraTurnsLittle) {
    // From level to straight down, through the fade: a step of a hundredth of a degree moves no point of the ground by
    // more than a camera would see it move itself, some pixels.
    double const step = 1.7453292519943295e-4;
    int const size = 1024;
    double worst = 0.0;
    ShadowMap<double> before;
    for (double pitch = 0.9; pitch < 1.57; pitch += step) {
        ViewVolume<double> view = level_view();
        view.pose =
            pose_looking(V3(3, 30, 2), V3(0.2 * std::cos(pitch), -std::sin(pitch), -std::cos(pitch)), V3(0, 1, 0));
        ShadowMap<double> const map = simple_perspective_map(view, overhead, town, town, {}, gl_clip);
        ASSERT_TRUE(map.visible);
        if (before.visible) worst = std::max(worst, laws::moved_texels(before, map, V3(3, 0, -4), size));
        before = map;
    }
    EXPECT_LT(worst, 40 * step * size);
    EXPECT_GT(worst, 0.0);
}

TEST(SimplePerspectiveMap, StandsStillForACameraThatTremblesLookingAlongTheLight) {
    double const tremble = 1e-5;
    ViewVolume<double> view = level_view();
    view.pose = pose_looking(V3(3, 30, 2), V3(0, -1, 0), V3(0.6, 0, -0.8));
    ShadowMap<double> const still = simple_perspective_map(view, overhead, town, town, {}, gl_clip);
    for (V3 const& shake : {V3(1, 0, 0), V3(-1, 0, 0), V3(0, 0, 1), V3(0, 0, -1), V3(0.7, 0, 0.7)}) {
        view.pose = pose_looking(V3(3, 30, 2), V3(0, -1, 0) + shake * tremble, V3(0.6, 0, -0.8));
        ShadowMap<double> const shaken = simple_perspective_map(view, overhead, town, town, {}, gl_clip);
        for (V3 const& p : {V3(3, 0, 2), V3(-5, 0, 10), V3(15, 0, -8)})
            EXPECT_LT(laws::moved_texels(still, shaken, p, 1024), 20 * tremble * 1024);
    }
}

TEST(SimplePerspectiveMap, HoldsEveryReceiverWithItsMarginAndItsCastersInEveryConvention) {
    ViewVolume<double> const view = level_view();
    for (V3 const& travel : {V3(0, -1, 0), V3(1, -0.3, 0.2), V3(0, -0.3, 1), V3(0, -0.3, -1), V3(0.1, -0.05, 0.4)})
        for (ClipSpace const clip : {gl_clip, gl_zero_to_one_clip, vulkan_clip, d3d_clip, reversed(vulkan_clip)}) {
            Light<double> const light = directional(travel);
            WarpOptions<double> const options;
            ShadowMap<double> const map = simple_perspective_map(view, light, town, town, options, clip);
            ASSERT_TRUE(map.visible);
            EXPECT_TRUE(laws::is_map_of(map.clip_from_world, light, clip));
            double const margin = 2 * options.margin_texels / options.map_size;
            int seen = 0;
            for (double x = -1; x <= 1; x += 0.25)
                for (double y = -1; y <= 1; y += 0.125)
                    for (double z = 0.1; z < 200.0; z *= 1.3) {
                        V3 const p = point_at(view, x * view.right, y * view.top, z);
                        if (!contains(town, p)) continue;
                        ++seen;
                        EXPECT_TRUE(laws::serves(map, p, margin));
                        V3 const caster = p - light.direction * ((12.0 - p.y) / -light.direction.y);
                        if (!contains(Aabb<double>{town.lo, town.hi + V3(0, 1e-9, 0)}, caster)) continue;
                        EXPECT_TRUE(laws::serves(map, caster, margin));
                        EXPECT_TRUE(laws::keeps_the_order(map, caster, p));
                    }
            EXPECT_GT(seen, 100);
        }
}

TEST(SimplePerspectiveMap, SpendsNoDepthOnCastersWhoseLightPassesTheMapBy) {
    // Casters up to 40 m: above the view, or on one side of it, where they shadow nothing that is seen.
    ViewVolume<double> const view = level_view(50.0);
    Aabb<double> const low{V3(-50, 0, -50), V3(50, 3, 0)};
    auto const depth_of_ground = [&](Light<double> const& light, Aabb<double> const& casters) {
        ShadowMap<double> const map = simple_perspective_map(view, light, casters, low, {}, gl_zero_to_one_clip);
        return 1.0 / glm::length(V3(row(map.clip_from_world, 2)));
    };
    double const near_only = depth_of_ground(overhead, low);
    EXPECT_GT(depth_of_ground(overhead, Aabb<double>{V3(-50, 0, -50), V3(50, 40, 0)}), 5.0 * near_only);
    for (V3 const& aside : {V3(200, 0, 0), V3(-200, 0, 0), V3(0, 0, 200), V3(0, 0, -200)}) {
        Aabb<double> const beside{low.lo + aside, low.hi + aside + V3(0, 37, 0)};
        EXPECT_FALSE(simple_perspective_map(view, overhead, beside, low, {}, gl_clip).visible);
    }
}

TEST(SimplePerspectiveMap, ServesOrthographicViewsUniformly) {
    ViewVolume<double> const view =
        orthographic_view(pose_looking(V3(0, 50, 0), V3(1, -1, 0), V3(0, 1, 0)), -20.0, 20.0, -20.0, 20.0, 1.0, 200.0);
    ShadowMap<double> const map = simple_perspective_map(view, overhead, town, town, {}, gl_clip);
    ASSERT_TRUE(map.visible);
    EXPECT_EQ(row(map.clip_from_world, 3), V4(0, 0, 0, 1));
    EXPECT_FALSE(map.faults.any());
}

TEST(SimplePerspectiveMap, GivesSpotsTheirPlainFit) {
    Light<double> const lamp = spot(V3(0, 10, -12), V3(0, -1, 0), 0.8, 30.0);
    WarpOptions<double> const options;
    ShadowMap<double> const map = simple_perspective_map(level_view(), lamp, town, town, options, gl_clip);
    ShadowMap<double> const plain =
        fit_spot(level_view(), lamp, town, town, options.map_size, options.margin_texels, gl_clip);
    EXPECT_TRUE(map.visible);
    EXPECT_FALSE(map.faults.any());
    EXPECT_EQ(map.clip_from_world, plain.clip_from_world);
}
