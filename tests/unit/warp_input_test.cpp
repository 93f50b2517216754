// SPDX-License-Identifier: MIT
//
// The map of what is bad, endless, far away or without extent.
#include "tests/laws/warp.hpp"
#include "tests/support/warp_cases.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

using namespace shadowmath;
using namespace shadowmath::test;

TEST(SimplePerspectiveMap, NamesAnyOptionThatIsNoNumber) {
    for (double WarpOptions<double>::*option :
         {&WarpOptions<double>::strength, &WarpOptions<double>::focus_metres, &WarpOptions<double>::coefficient}) {
        WarpOptions<double> options;
        options.*option = nan_;
        auto const map = simple_perspective_map(level_view(), overhead, town, town, options, gl_clip);
        EXPECT_TRUE(map.faults.has(Fault::not_finite));
        EXPECT_FALSE(map.visible);
    }
}

TEST(SimplePerspectiveMap, ByTheTrapezoidWarpsABodyOfHalfAMetreAndDividesByNoLength) {
    WarpOptions<double> options;
    options.rule = WarpRule::trapezoid;
    options.focus_metres = 4.1;
    Aabb<double> const patch{V3(-1, 0, -4.5), V3(1, 0, -4.0)}, point{V3(0, 0, -4.0), V3(0, 0, -4.0)};
    ShadowMap<double> const warped = simple_perspective_map(level_view(), overhead, patch, patch, options, gl_clip);
    EXPECT_GT(glm::length(V3(row(warped.clip_from_world, 3))), 0.0);
    auto const run =
        test::watched([&] { return simple_perspective_map(level_view(), overhead, point, point, options, gl_clip); });
    EXPECT_TRUE(run.calm_in_range());
    EXPECT_TRUE(run.result.visible);
}

// A side without an extent is as wide as a texel would be if the map were a square.
TEST(SimplePerspectiveMap, GivesALineATexelOfItsLengthAcross) {
    WarpOptions<double> options;
    options.strength = 0.0;
    options.margin_texels = 0.0;
    for (V3 const& along : {V3(4, 0, 0), V3(0, 0, -4)}) {
        Aabb<double> const line{glm::min(V3(1, 0, -12), V3(1, 0, -12) + along),
                                glm::max(V3(1, 0, -12), V3(1, 0, -12) + along)};
        ShadowMap<double> const map = simple_perspective_map(level_view(), overhead, line, line, options, gl_clip);
        ASSERT_TRUE(map.visible);
        double const x = glm::length(V3(row(map.clip_from_world, 0))), y = glm::length(V3(row(map.clip_from_world, 1)));
        EXPECT_NEAR(along.x != 0.0 ? y / x : x / y, 1024.0, 1e-3);
    }
}

TEST(SimplePerspectiveMap, SaysThatANearDistanceOfZeroIsNone) {
    ViewVolume<double> view = level_view();
    EXPECT_FALSE(simple_perspective_map(view, overhead, town, town, {}, gl_clip).faults.has(Fault::near_clamped));
    view.z_near = 0.0;
    ShadowMap<double> const map = simple_perspective_map(view, overhead, town, town, {}, gl_clip);
    EXPECT_TRUE(map.visible);
    EXPECT_TRUE(map.faults.has(Fault::near_clamped));
}

TEST(SimplePerspectiveMap, HasNothingToShowWithoutCastersOrReceiversAndSaysNoFault) {
    Aabb<double> const behind{V3(-5, 0, 50), V3(5, 1, 60)}, below{V3(-300, -20, -300), V3(300, -10, 300)};
    for (auto const& [casters, receivers] : {std::pair{Aabb<double>{}, town}, std::pair{town, Aabb<double>{}},
                                             std::pair{town, behind}, std::pair{below, flat_world}}) {
        ShadowMap<double> const map = simple_perspective_map(level_view(), overhead, casters, receivers, {}, gl_clip);
        EXPECT_FALSE(map.visible);
        EXPECT_FALSE(map.faults.any());
        EXPECT_TRUE(laws::harmless(map));
    }
}

TEST(SimplePerspectiveMap, ServesAPointALineAndAPlane) {
    for (V3 const& extent : {V3(0), V3(4, 0, 0), V3(0, 4, 0), V3(4, 0, 4), V3(0, 4, 4)}) {
        Aabb<double> const body{V3(1, 0.5, -12), V3(1, 0.5, -12) + extent};
        ShadowMap<double> const map =
            simple_perspective_map(level_view(), directional(V3(1, -2, 0)), body, body, {}, gl_clip);
        EXPECT_TRUE(map.visible);
        EXPECT_TRUE(laws::serves(map, body.lo, 0.0));
        EXPECT_TRUE(laws::serves(map, body.hi, 0.0));
    }
}

// Found by the fuzzer: a point's map is as wide as the point's own rounding, and a caster far above is rounded more.
TEST(SimplePerspectiveMap, OfAPointHoldsTheCasterHoweverFarAboveIt) {
    for (int turn = 0; turn < 60; ++turn) {
        V3 const travel = glm::normalize(V3(std::cos(0.1 * turn), -1.0 - 0.02 * turn, std::sin(0.1 * turn)));
        V3 const point(3.0 - 0.1 * turn, 0.5, -12.0 - turn);
        for (double const metres : {10.0, 1e3, 1e4}) {
            V3 const caster = point - travel * metres;
            ShadowMap<double> const map = simple_perspective_map(
                level_view(), directional(travel), merge({point, point}, caster), {point, point}, {}, gl_clip);
            ASSERT_TRUE(map.visible);
            EXPECT_TRUE(laws::serves(map, caster, 0.0)) << metres << " m above " << point.x << ", " << point.z;
        }
    }
}

TEST(SimplePerspectiveMap, MendsBoxesWithoutEndAndAViewWithoutEnd) {
    Aabb<float> const endless{glm::vec3(std::numeric_limits<float>::lowest()),
                              glm::vec3(std::numeric_limits<float>::max())};
    ViewVolume<float> view = perspective_view(
        pose_looking(glm::vec3(0, 1.7f, 0), glm::vec3(0, -0.1f, -1), glm::vec3(0, 1, 0)), 1.0f, 1.6f, 0.1f, 200.0f);
    Light<float> const sun = directional(glm::vec3(0.4f, -1.0f, 0.3f));
    ShadowMap<float> const whole = simple_perspective_map(view, sun, endless, endless, {}, gl_clip);
    EXPECT_TRUE(whole.visible);
    EXPECT_FALSE(whole.faults.any());
    EXPECT_TRUE(laws::serves(whole, glm::vec3(0, 0, -100), 0.0f));
    view.z_far = std::numeric_limits<float>::infinity();
    Aabb<float> const town_box{glm::vec3(-300, 0, -300), glm::vec3(300, 12, 300)};
    ShadowMap<float> const far = simple_perspective_map(view, sun, town_box, town_box, {}, gl_clip);
    EXPECT_TRUE(far.visible);
    EXPECT_TRUE(far.faults.has(Fault::far_clamped));
    EXPECT_TRUE(laws::serves(far, glm::vec3(0, 0, -290), 0.0f));
}

TEST(SimplePerspectiveMap, SaysWhenTheScalarIsTooSmallForThePlace) {
    Vec3<float> const away(3e6f, 0, 0);
    ViewVolume<float> const view =
        perspective_view(pose_looking(away + glm::vec3(0, 1.7f, 0), glm::vec3(0, -0.1f, -1), glm::vec3(0, 1, 0)), 1.0f,
                         1.6f, 0.1f, 50.0f);
    Aabb<float> const town_box{away + glm::vec3(-300, 0, -300), away + glm::vec3(300, 12, 300)};
    ShadowMap<float> const map =
        simple_perspective_map(view, directional(glm::vec3(0.4f, -1.0f, 0.3f)), town_box, town_box, {}, gl_clip);
    EXPECT_TRUE(map.faults.has(Fault::precision_lost));
    ViewVolume<double> const fine =
        perspective_view(pose_looking(V3(away) + V3(0, 1.7, 0), V3(0, -0.1, -1), V3(0, 1, 0)), 1.0, 1.6, 0.1, 50.0);
    Aabb<double> const fine_box{V3(town_box.lo), V3(town_box.hi)};
    EXPECT_FALSE(
        simple_perspective_map(fine, directional(V3(0.4, -1, 0.3)), fine_box, fine_box, {}, gl_clip).faults.any());
}

TEST(SimplePerspectiveMap, ClampsItsStrengthAndRefusesBadMaps) {
    WarpOptions<double> options;
    options.strength = 7.0;
    ShadowMap<double> const clamped = simple_perspective_map(level_view(), overhead, town, town, options, gl_clip);
    EXPECT_TRUE(clamped.faults.has(Fault::clamped_option));
    EXPECT_EQ(clamped.clip_from_world,
              simple_perspective_map(level_view(), overhead, town, town, {1024, 2.0, 2.0}, gl_clip).clip_from_world);
    options.strength = nan_;
    EXPECT_TRUE(
        simple_perspective_map(level_view(), overhead, town, town, options, gl_clip).faults.has(Fault::not_finite));
    options = {};
    options.map_size = 2;
    EXPECT_TRUE(
        simple_perspective_map(level_view(), overhead, town, town, options, gl_clip).faults.has(Fault::map_too_small));
}
