// SPDX-License-Identifier: MIT
//
// The map of what is bad, endless, far away or without extent.
#include "tests/laws/vdsm.hpp"
#include "tests/support/vdsm_cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

using namespace shadowmath;
using namespace shadowmath::test;

TEST(Vdsm, RefusesAPlaneThroughTheLightOrTheEyeOrWithoutNormal) {
    auto const faults = [](ShadowPlane<double> const& plane, Light<double> const& light) {
        ShadowMap<double> const map = view_dependent_map(walker(), light, plane, town, town, {}, gl_clip);
        EXPECT_FALSE(map.visible);
        EXPECT_TRUE(laws::harmless(map));
        return map.faults;
    };
    EXPECT_TRUE(faults(ground, directional(V3(1, 0, 0))).has(Fault::invalid_plane));
    EXPECT_TRUE(faults(ground, directional(V3(1, -0.049, 0))).has(Fault::invalid_plane));
    EXPECT_TRUE(faults(ground, spot(V3(3, 0, 3), V3(0, -1, 0), 0.5, 20.0)).has(Fault::invalid_plane));
    EXPECT_TRUE(faults(plane_through(walker().pose.position, V3(0, 1, 0)), morning).has(Fault::invalid_plane));
    EXPECT_TRUE(faults(ShadowPlane<double>{V3(0.0), 1.0}, morning).has(Fault::invalid_plane));
    EXPECT_TRUE(faults(ShadowPlane<double>{V3(nan_), 1.0}, morning).has(Fault::not_finite));
    EXPECT_TRUE(faults(ShadowPlane<double>{V3(0, 1, 0), inf}, morning).has(Fault::not_finite));
}

TEST(Vdsm, RefusesAPlaneThatPassesTheEyeCloserThanATenThousandthOfTheView) {
    for (double const height : {0.019, 0.021, -0.019, -0.021}) {
        ShadowPlane<double> const plane{V3(0, 1, 0), height - walker().pose.position.y};
        EXPECT_EQ(
            view_dependent_map(walker(), morning, plane, town, town, {}, gl_clip).faults.has(Fault::invalid_plane),
            std::abs(height) < 0.02)
            << height;
    }
}

TEST(Vdsm, GivesAReceiverThatIsAPointATexelOfTheScreen) {
    V3 const here(1, 0, -9), aside(1.001, 0, -9.002);
    Aabb<double> const point{here, here};
    VdsmOptions<double> options;
    options.margin_texels = 0.0;
    ViewVolume<double> const view = walker();
    ShadowMap<double> const map = view_dependent_map(view, morning, ground, town, point, options, gl_clip);
    ASSERT_TRUE(map.visible);
    glm::dmat4 const screen = clip_from_world(view, gl_clip);
    V3 const of_map = ndc(map.clip_from_world, aside) - ndc(map.clip_from_world, here);
    V3 const of_screen = ndc(screen, aside) - ndc(screen, here);
    EXPECT_NEAR(of_map.x / of_screen.x, options.map_size, 1e-3);
    EXPECT_NEAR(of_map.y / of_screen.y, options.map_size, 1e-3);
}

TEST(Vdsm, HasNothingToShowWithoutCastersOrReceiversAndSaysNoFault) {
    Aabb<double> const behind{V3(-5, 0, 50), V3(5, 1, 60)}, below{V3(-300, -20, -300), V3(300, -10, 300)};
    for (auto const& [casters, receivers] : {std::pair{Aabb<double>{}, town}, std::pair{town, Aabb<double>{}},
                                             std::pair{town, behind}, std::pair{below, level_ground}}) {
        ShadowMap<double> const map = view_dependent_map(walker(), morning, ground, casters, receivers, {}, gl_clip);
        EXPECT_FALSE(map.visible);
        EXPECT_FALSE(map.faults.any());
        EXPECT_TRUE(laws::harmless(map));
    }
}

TEST(Vdsm, MendsBoxesWithoutEndAViewWithoutEndAndANearDistanceOfZero) {
    Aabb<float> const endless{glm::vec3(std::numeric_limits<float>::lowest()),
                              glm::vec3(std::numeric_limits<float>::max())};
    ShadowPlane<float> const floor{glm::vec3(0, 1, 0), 0.0f};
    Light<float> const sun = directional(glm::vec3(0.4f, -1.0f, 0.3f));
    ViewVolume<float> view = perspective_view(
        pose_looking(glm::vec3(0, 1.7f, 0), glm::vec3(0, -0.1f, -1), glm::vec3(0, 1, 0)), 1.0f, 1.6f, 0.1f, 200.0f);
    ShadowMap<float> const whole = view_dependent_map(view, sun, floor, endless, endless, {}, gl_clip);
    EXPECT_TRUE(whole.visible);
    EXPECT_FALSE(whole.faults.any());
    EXPECT_TRUE(laws::serves(whole, glm::vec3(0, 0, -20), 0.0f));
    view.z_near = 0.0f;
    Aabb<float> const town_box{glm::vec3(-300, 0, -300), glm::vec3(300, 12, 300)};
    ShadowMap<float> const close = view_dependent_map(view, sun, floor, town_box, town_box, {}, gl_clip);
    EXPECT_TRUE(close.visible);
    EXPECT_TRUE(close.faults.has(Fault::near_clamped));
    view.z_near = 0.1f;
    view.z_far = std::numeric_limits<float>::infinity();
    ShadowMap<float> const far = view_dependent_map(view, sun, floor, town_box, town_box, {}, gl_clip);
    EXPECT_TRUE(far.visible);
    EXPECT_TRUE(far.faults.has(Fault::far_clamped));
    EXPECT_TRUE(laws::serves(far, glm::vec3(0, 0, -290), 0.0f));
}

TEST(Vdsm, RefusesMapsWithoutRoomAndBadOptions) {
    VdsmOptions<double> options;
    options.map_size = 6;
    EXPECT_TRUE(
        view_dependent_map(walker(), morning, ground, town, town, options, gl_clip).faults.has(Fault::map_too_small));
    options.map_size = 1024;
    options.margin_texels = 1e9;
    EXPECT_TRUE(
        view_dependent_map(walker(), morning, ground, town, town, options, gl_clip).faults.has(Fault::map_too_small));
    options.margin_texels = 2.0;
    options.reach = 0.0;
    ShadowMap<double> const clamped = view_dependent_map(walker(), morning, ground, town, town, options, gl_clip);
    EXPECT_TRUE(clamped.visible);
    EXPECT_TRUE(clamped.faults.has(Fault::clamped_option));
    options.reach = nan_;
    EXPECT_TRUE(
        view_dependent_map(walker(), morning, ground, town, town, options, gl_clip).faults.has(Fault::not_finite));
}

TEST(Vdsm, NamesAnyOptionThatIsNoNumberAndAnyThatIsOutOfRange) {
    for (double VdsmOptions<double>::*option :
         {&VdsmOptions<double>::reach, &VdsmOptions<double>::w_min, &VdsmOptions<double>::least_sine}) {
        VdsmOptions<double> options;
        options.*option = nan_;
        EXPECT_TRUE(
            view_dependent_map(walker(), morning, ground, town, town, options, gl_clip).faults.has(Fault::not_finite));
        options.*option = -1.0;
        ShadowMap<double> const map = view_dependent_map(walker(), morning, ground, town, town, options, gl_clip);
        EXPECT_TRUE(map.faults.has(Fault::clamped_option));
        EXPECT_TRUE(map.visible);
    }
    ShadowPlane<double> const beyond{V3(0, 1, 0), 1e13};
    EXPECT_TRUE(
        view_dependent_map(walker(), morning, beyond, town, town, {}, gl_clip).faults.has(Fault::invalid_plane));
    EXPECT_FALSE(receiver_valid(ShadowMap<double>{}, V3(0.0))) << "no map, no answer";
}

TEST(Vdsm, NamesCastersAndReceiversThatAreNotFiniteEachAlone) {
    Aabb<double> const endless{V3(-300, 0, -300), V3(300, inf, 300)};
    for (bool const casters : {true, false}) {
        auto const map = view_dependent_map(walker(), morning, ground, casters ? endless : town,
                                            casters ? town : endless, {}, gl_clip);
        EXPECT_TRUE(map.faults.has(Fault::not_finite)) << casters;
    }
}

TEST(Vdsm, SaysThatPrecisionIsLostBeyondWhatAFloatCanMultiply) {
    ViewVolume<double> far_away = walker();
    far_away.pose.position.x = 1e13;
    ShadowMap<double> const map = view_dependent_map(far_away, morning, ground, town, town, {}, gl_clip);
    EXPECT_FALSE(map.visible);
    EXPECT_TRUE(map.faults.has(Fault::precision_lost));
    for (int axis = 0; axis < 3; ++axis) {
        V3 place(0, 9, 0);
        place[axis] = 1e13;
        Light<double> const lamp = spot(place, V3(0, -1, 0), 0.5, 20.0);
        EXPECT_TRUE(
            view_dependent_map(walker(), lamp, ground, town, town, {}, gl_clip).faults.has(Fault::precision_lost));
    }
    Light<double> const endless = spot(V3(0, 9, 0), V3(0, -1, 0), 0.5, 1e13);
    EXPECT_TRUE(
        view_dependent_map(walker(), endless, ground, town, town, {}, gl_clip).faults.has(Fault::precision_lost));
}
