// SPDX-License-Identifier: MIT
#include "tests/laws/fit_focus.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace shadowmath;

namespace {

using V3 = glm::dvec3;

Light<double> const overhead = directional(V3(0, -1, 0));
LightBasis<double> const axes = light_basis(V3(0, -1, 0));
Aabb<double> const world{V3(-500, 0, -500), V3(500, 40, 500)};
Aabb<double> const ground{V3(-500, -1, -500), V3(500, 0, 500)};

ViewVolume<double> level_slice(double begin = 5.0, double end = 40.0) {
    return perspective_view(pose_looking(V3(0, 2, 0), V3(0, 0, -1), V3(0, 1, 0)), 1.0, 1.6, begin, end);
}

Aabb<double> bounds_of_body(ConvexBody<double> const& body) {
    Aabb<double> box;
    for_each_vertex(body, [&](V3 const& v) { box = merge(box, v); });
    return box;
}

}  // namespace

TEST(FitFocus, HoldsOnlyTheGroundThatACasterCanShadow) {
    // A column of two by two metres, twenty metres ahead.
    Aabb<double> const column{V3(-1, 0, -21), V3(1, 9, -19)};
    Focus<double> const focus = focus_of(level_slice(), overhead, column, ground);
    ASSERT_TRUE(focus.visible);
    Aabb<double> const seen = bounds_of_body(focus.receivers);
    EXPECT_NEAR(seen.lo.x, -1, 1e-9);
    EXPECT_NEAR(seen.hi.x, 1, 1e-9);
    EXPECT_NEAR(seen.lo.z, -21, 1e-9);
    EXPECT_NEAR(seen.hi.z, -19, 1e-9);
    EXPECT_NEAR(focus.depth.lo, -9, 1e-9);
    EXPECT_NEAR(focus.first_receiver, 0, 1e-9);
    LightBox<double> const box = fit_focus(axes, focus, 1024, 0.0);
    EXPECT_NEAR(area(box), 4.0, 1e-9);
}

TEST(FitFocus, CullsWhatCastsBesideTheSlice) {
    Focus<double> const focus = focus_of(level_slice(), directional(V3(1, -1, 0)), world, ground);
    ASSERT_TRUE(focus.visible);
    EXPECT_TRUE(may_meet(focus.casters, Aabb<double>{V3(-11, 10, -21), V3(-9, 12, -19)}));
    // Behind the eye, and low beside the view where its shadow falls short.
    EXPECT_FALSE(may_meet(focus.casters, Aabb<double>{V3(-11, 10, 3), V3(-9, 12, 5)}));
    EXPECT_FALSE(may_meet(focus.casters, Aabb<double>{V3(-40, 0, -21), V3(-39, 2, -19)}));
}

TEST(FitFocus, IsNoDeeperThanTheCastersWhoseShadowsFallOnIt) {
    // Light at 45 degrees: what shadows (2, 0) and is not before x = -10 is 12 m up.
    Aabb<double> const patch{V3(0, 0, -21), V3(2, 0, -19)}, hall{V3(-10, 0, -500), V3(500, 40, 500)};
    Focus<double> const focus = focus_of(level_slice(), directional(V3(1, -1, 0)), hall, patch);
    ASSERT_TRUE(focus.visible);
    EXPECT_TRUE(focus.depth.visible);
    EXPECT_NEAR(focus.depth.lo, (-10 - 12) / std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(focus.depth.hi, 2 / std::sqrt(2.0), 2e-6);
}

TEST(FitFocus, ReachesCastersHighAboveASliceAroundTheOrigin) {
    // From 10 m before the origin to 10 m behind it, 20 m wide and high.
    ViewVolume<double> const slice =
        orthographic_view(pose_looking(V3(0, 0, 20), V3(0, 0, -1), V3(0, 1, 0)), -10.0, 10.0, -10.0, 10.0, 10.0, 30.0);
    Aabb<double> const tower{V3(-1, 0, -1), V3(1, 500, 1)}, floor{V3(-50, -1, -50), V3(50, 0, 50)};
    EXPECT_NEAR(focus_of(slice, overhead, tower, floor).depth.lo, -500, 1e-6);
}

TEST(FitFocus, CountsACasterThatOnlyTouchesTheLightOfItsReceivers) {
    Aabb<double> const column{V3(-1, 0, -21), V3(1, 9, -19)};
    Focus<double> const focus = focus_of(level_slice(), overhead, column, ground);
    EXPECT_TRUE(may_meet(focus.casters, Aabb<double>{V3(1, 5, -20), V3(3, 6, -19.5)}));
    EXPECT_FALSE(may_meet(focus.casters, Aabb<double>{V3(1.001, 5, -20), V3(3, 6, -19.5)}));
}

// In millimetres as in kilometres: room for rounding is a share of the scene.
TEST(FitFocus, IsTheSameInAnyUnit) {
    auto const of = [](float unit) {
        auto const box = [unit](glm::vec3 lo, glm::vec3 hi) { return Aabb<float>{lo * unit, hi * unit}; };
        ViewVolume<float> const slice =
            perspective_view(pose_looking(glm::vec3(0, 2, 0) * unit, glm::vec3(0, 0, -1), glm::vec3(0, 1, 0)), 1.0f,
                             1.6f, 5.0f * unit, 40.0f * unit);
        return focus_of(slice, directional(glm::vec3(1, -2, 0.5f)), box(glm::vec3(-30, 0, -60), glm::vec3(30, 12, 10)),
                        box(glm::vec3(-30, 0, -60), glm::vec3(30, 3, 10)));
    };
    Focus<float> const metres = of(1.0f);
    ASSERT_TRUE(metres.visible);
    for (float const unit : {1.0f / 1024, 1024.0f}) {
        Focus<float> const scaled = of(unit);
        ASSERT_TRUE(scaled.visible);
        float const depth = metres.depth.hi - metres.depth.lo;
        EXPECT_NEAR((scaled.depth.hi - scaled.depth.lo) / unit / depth, 1.0f, 1e-5f) << unit;
        EXPECT_NEAR(scaled.first_receiver / unit, metres.first_receiver, 1e-5f * depth) << unit;
    }
}

TEST(FitFocus, InAxesThatAreNoneIsTheBoxOfNothing) {
    Focus<double> const focus = focus_of(level_slice(), overhead, world, ground);
    ASSERT_TRUE(focus.visible);
    LightBasis<double> none = axes;
    none.x = V3(0);
    EXPECT_EQ(fit_focus(none, focus, 1024, 0.0).lo, glm::dvec2(-1));
    EXPECT_EQ(fit_focus(none, focus, 1024, 0.0).depth_hi, 1.0);
}

TEST(FitFocus, IsPaddedForFilterAndSun) {
    Aabb<double> const aside{V3(-1, 5, 3.2 - 8), V3(1, 6, 3.5 - 8)};
    auto const culls = [&](SweepPadding<double> const& padding) {
        return !may_meet(focus_of(level_slice(), overhead, world, ground, padding).casters, aside);
    };
    // Ground begins where the lower edge of the view meets it, or with the slice: at 5 m; the box ends at 4.8.
    EXPECT_TRUE(culls({}));
    EXPECT_TRUE(culls({0.15, 0.0}));
    EXPECT_FALSE(culls({0.25, 0.0}));
    EXPECT_FALSE(culls({0.0, 0.05}));
}

TEST(FitFocus, SeesNothingWhereNothingCastsAndSaysSo) {
    Aabb<double> const below{V3(-500, -20, -500), V3(500, -10, 500)}, beside{V3(100, 0, -30), V3(120, 9, -10)};
    for (Aabb<double> const& casters : {below, beside, Aabb<double>{}})
        EXPECT_FALSE(focus_of(level_slice(), overhead, casters, ground).visible);
    EXPECT_FALSE(focus_of(level_slice(), overhead, world, Aabb<double>{V3(-5, 0, 50), V3(5, 1, 60)}).visible);
    EXPECT_FALSE(focus_of(level_slice(), spot(V3(0, 9, -20), V3(0, -1, 0), 0.5, 20.0), world, ground).visible);
    EXPECT_FALSE(focus_of(level_slice(5.0, std::numeric_limits<double>::infinity()), overhead, world, ground).visible);
    EXPECT_EQ(fit_focus(axes, Focus<double>{}, 1024, 0.0).lo, glm::dvec2(-1));
}

TEST(FitFocus, ServesAFlatGroundThatIsCasterAndReceiver) {
    Aabb<double> const flat{V3(-500, 0, -500), V3(500, 0, 500)};
    EXPECT_TRUE(focus_of(level_slice(), overhead, flat, flat).visible);
    EXPECT_TRUE(focus_of(level_slice(), directional(V3(0.3, -0.1, 0.8)), flat, flat).visible);
}

TEST(FitFocus, MendsBoxesWithoutEnd) {
    float const most = std::numeric_limits<float>::max();
    Aabb<float> const endless{glm::vec3(-most), glm::vec3(most)};
    ViewVolume<float> const view = perspective_view(
        pose_looking(glm::vec3(5, 6, 7), glm::vec3(1, 2, 3), glm::vec3(0, 1, 0)), 1.0f, 1.5f, 0.1f, 100.0f);
    auto const focus =
        test::watched([&] { return focus_of(view, directional(glm::vec3(1, -2, 1)), endless, endless); });
    EXPECT_TRUE(focus.calm());
    ASSERT_TRUE(focus.result.visible);
    for (glm::vec3 const& corner : corners(view)) EXPECT_TRUE(laws::may_contain(focus.result.receivers, corner, 1e-3f));
}

TEST(FitFocus, RefusesAViewThatReachesBeyondATrillionMetres) {
    auto const is_visible = [](ViewVolume<double> const& slice) {
        return focus_of(slice, overhead, world, ground).visible;
    };
    Pose<double> const pose = level_slice().pose;
    ViewVolume<double> const flat = orthographic_view(pose, -20.0, 20.0, -20.0, 20.0, 5.0, 40.0);
    EXPECT_TRUE(is_visible(level_slice()));
    EXPECT_TRUE(is_visible(flat));
    for (double const far_out : {1e11, 1e13}) {
        ViewVolume<double> slices[] = {level_slice(), level_slice(), level_slice(), level_slice(),
                                       flat,          flat,          flat,          flat};
        for (int i = 0; i < 8; i += 4) {
            slices[i].left = slices[i + 2].bottom = -far_out;
            slices[i + 1].right = slices[i + 3].top = far_out;
        }
        // At 40 m a side of 1e11 is 4e12 m away in perspective, and 1e11 m in an orthographic view.
        for (int i = 0; i < 8; ++i) EXPECT_EQ(is_visible(slices[i]), i >= 4 && far_out < 1e12) << i << ' ' << far_out;
    }
}

TEST(FitFocus, HasDepthWhereWhatIsSeenAndWhatCastsIsOnePlane) {
    Aabb<double> const floor{V3(-500, 0, -500), V3(500, 0, 500)};
    Focus<double> const focus = focus_of(level_slice(), overhead, floor, floor);
    ASSERT_TRUE(focus.visible);
    EXPECT_GE(focus.depth.hi - focus.depth.lo, 0.9e-6);
}
