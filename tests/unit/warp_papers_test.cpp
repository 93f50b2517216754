// SPDX-License-Identifier: MIT
//
// The map against the papers and their closed forms: Wimmer's, Stamminger's, Martin's, Lloyd's, Gusev's.
#include "tests/laws/warp.hpp"
#include "tests/support/warp_cases.hpp"

#include <shadowmath/aliasing.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace shadowmath;
using namespace shadowmath::test;

// Wimmer's construction, step by step: light space, the centre behind the near end, a frustum, a fit.
TEST(SimplePerspectiveMap, IsWimmersMapUpToTheFit) {
    ViewVolume<double> const view = level_view();
    for (V3 const& travel : {V3(0, -1, 0), V3(0, -1, -0.5), V3(0, -1, 0.5), V3(0, -0.6, -0.8)}) {
        WarpOptions<double> options;
        options.margin_texels = 0.0;
        Light<double> const light = directional(travel);
        ShadowMap<double> const map = simple_perspective_map(view, light, flat_world, flat_world, options, gl_clip);
        V3 const v = view.pose.forward, L = light.direction, Y = -L, X = glm::normalize(glm::cross(v, Y)),
                 Z = glm::cross(X, Y);
        double nearest = inf, farthest = -inf, z0 = inf;
        for_each_vertex(visible_body(view, flat_world), [&](V3 const& p) {
            nearest = std::min(nearest, -glm::dot(Z, p));
            farthest = std::max(farthest, -glm::dot(Z, p));
            z0 = std::min(z0, glm::dot(v, p));
        });
        double const sine = glm::length(glm::cross(v, L)), d = farthest - nearest, z1 = z0 + d * sine;
        double const n_opt = d / (std::sqrt(z1 / z0) - 1);
        auto const wimmer = [&](V3 const& world) {
            V3 const p = world - view.pose.position;
            double const w = -glm::dot(Z, p) - nearest + n_opt, F = n_opt + d;
            return V2(n_opt * glm::dot(X, p) / w, ((F + n_opt) * w - 2 * F * n_opt) / (F - n_opt) / w);
        };
        // One scale along x fits all points, and v' agrees as it is.
        double scale = 0.0;
        for (V3 const& p : {V3(1, 0, -4), V3(-3, 0, -20), V3(10, 0, -50), V3(-40, 0, -150)}) {
            V2 const theirs = wimmer(p);
            V3 const ours = ndc(map.clip_from_world, p);
            EXPECT_NEAR(ours.y, theirs.y, 1e-9);
            if (scale == 0.0) scale = ours.x / theirs.x;
            EXPECT_NEAR(ours.x, theirs.x * scale, 1e-9);
        }
    }
}

TEST(SimplePerspectiveMap, AtStrengthTwoHasTexelsAsWideAsPixels) {
    WarpOptions<double> options;
    options.strength = 2.0;
    ShadowMap<double> const map =
        simple_perspective_map(level_view(), overhead, flat_world, flat_world, options, gl_clip);
    // w is eye depth, in units of the nearest.
    double const unit = row(map.clip_from_world, 3) == V4(0.0) ? 0.0 : (map.clip_from_world * V4(0, 0, -10, 1)).w / 10;
    for (V3 const& p : {V3(0, 0, -4), V3(5, 0, -40), V3(-50, 0, -190)})
        EXPECT_NEAR((map.clip_from_world * V4(p, 1.0)).w, unit * -p.z, 1e-9 * -p.z);
    double const n = first_ground(level_view());
    for (double z = n; z < 200; z *= 1.5)
        EXPECT_NEAR(error_along(map, z) / closed_form::warped_along(z, n, 200.0, n), 1.0, 0.01);
}

TEST(SimplePerspectiveMap, IsStammingersWhicheverSideTheLightIsOn) {
    // From ahead, from behind the viewer, level with the view: his depth turns around between the first two.
    for (V3 const& travel : {V3(0.1, -0.5, 1), V3(0.1, -0.5, -1), V3(1, -0.5, 0)}) {
        Light<double> const light = directional(travel);
        for (double const strength : {1.5, 2.0}) {
            ShadowMap<double> const map =
                simple_perspective_map(level_view(), light, town, town, {1024, 2.0, strength}, gl_clip);
            ASSERT_TRUE(map.visible);
            EXPECT_TRUE(laws::is_map_of(map.clip_from_world, light, gl_clip));
            for (V3 const& p : {V3(0, 0, -5), V3(3, 1, -50), V3(-20, 0, -150)}) {
                EXPECT_TRUE(laws::serves(map, p, 0.0));
                EXPECT_TRUE(laws::keeps_the_order(map, p - light.direction * 10.0, p));
            }
        }
    }
}

TEST(SimplePerspectiveMap, IsTheSameByAnyRuleThatComesToTheSameCentre) {
    WarpOptions<double> options;
    ShadowMap<double> const best =
        simple_perspective_map(level_view(), overhead, flat_world, flat_world, options, gl_clip);
    double const n = first_ground(level_view()), length = 200.0 - n, a = closed_form::best_centre(n, 200.0);
    WarpOptions<double> trapezoid = options, extended = options;
    trapezoid.rule = WarpRule::trapezoid;
    trapezoid.focus_metres = n + 0.8 / (0.2 / a + 1 / length);
    extended.rule = WarpRule::extended;
    extended.coefficient = 1 / (a - n);
    for (WarpOptions<double> const& other : {trapezoid, extended}) {
        ShadowMap<double> const map =
            simple_perspective_map(level_view(), overhead, flat_world, flat_world, other, gl_clip);
        for (V3 const& p : {V3(0, 0, -4), V3(5, 0, -40), V3(-50, 0, -190)})
            EXPECT_LT(laws::moved_texels(best, map, p, 1024), 1e-6);
    }
}

TEST(SimplePerspectiveMap, ByTheTrapezoidGivesFourFifthsOfTheMapToTheGroundUpToTheFocus) {
    ViewVolume<double> view = level_view();
    view.pose = pose_looking(V3(0, 12, 0), V3(0, -0.6, -0.8), V3(0, 1, 0));
    WarpOptions<double> options;
    options.margin_texels = 0.0;
    options.rule = WarpRule::trapezoid;
    options.focus_metres = 40.0;
    ShadowMap<double> const map = simple_perspective_map(view, overhead, flat_world, flat_world, options, gl_clip);
    ASSERT_TRUE(map.visible);
    // Ground at 40 m of eye depth: 0.6 * 12 + 0.8 * ahead = 40.
    EXPECT_NEAR(ndc(map.clip_from_world, V3(0, 0, -(40.0 - 7.2) / 0.8)).y, -1.0 + 2.0 * 0.8, 1e-9);
}

TEST(SimplePerspectiveMap, IsByNoRuleStrongerThanStammingers) {
    Light<double> const light = directional(V3(0, -0.6, 0.8));
    auto const growth = [&](WarpOptions<double> const& options) {
        ShadowMap<double> const map = simple_perspective_map(level_view(), light, town, town, options, gl_clip);
        EXPECT_TRUE(map.visible);
        glm::dmat4 const& m = map.clip_from_world;
        return (m * V4(0, 0, -100, 1)).w / (m * V4(0, 0, -5, 1)).w;
    };
    WarpOptions<double> strongest, trapezoid, extended;
    strongest.strength = trapezoid.strength = extended.strength = 2.0;
    trapezoid.rule = WarpRule::trapezoid;
    trapezoid.focus_metres = 0.0;
    extended.rule = WarpRule::extended;
    extended.coefficient = 1e6;
    EXPECT_NEAR(growth(trapezoid) / growth(strongest), 1.0, 1e-9);
    EXPECT_NEAR(growth(extended) / growth(strongest), 1.0, 1e-9);
}

TEST(SimplePerspectiveMap, HasTheLeastWorstErrorTheSameAtBothEnds) {
    for (double const z_far : {20.0, 200.0, 2000.0}) {
        ViewVolume<double> const view = level_view(z_far);
        WarpOptions<double> options;
        options.margin_texels = 0.0;
        ShadowMap<double> const map = simple_perspective_map(view, overhead, flat_world, flat_world, options, gl_clip);
        ASSERT_TRUE(map.visible);
        double const n = first_ground(view), alpha = z_far / n;
        // The body's far end is z_far: the ground at the far plane, in the middle of the picture.
        EXPECT_NEAR(error_along(map, n), std::sqrt(alpha) - 1 / std::sqrt(alpha), 1e-9 * alpha);
        EXPECT_NEAR(error_along(map, z_far), std::sqrt(alpha) - 1 / std::sqrt(alpha), 1e-9 * alpha);
        for (double z = n; z < z_far; z *= 1.1)
            EXPECT_NEAR(
                error_along(map, z) / closed_form::warped_along(z, n, z_far, closed_form::best_centre(n, z_far)), 1.0,
                1e-9);
    }
}

TEST(SimplePerspectiveMap, AtStrengthZeroIsTheUniformMap) {
    WarpOptions<double> options;
    options.strength = 0.0;
    options.margin_texels = 0.0;
    ViewVolume<double> const view = level_view();
    ShadowMap<double> const map = simple_perspective_map(view, overhead, flat_world, flat_world, options, gl_clip);
    ASSERT_TRUE(map.visible);
    EXPECT_TRUE(map.faults.has(Fault::warp_faded));
    EXPECT_EQ(row(map.clip_from_world, 3), V4(0, 0, 0, 1));
    double const n = first_ground(view);
    EXPECT_NEAR(error_along(map, n), view.z_far / n - 1.0, 1e-9 * view.z_far);
    EXPECT_NEAR(error_along(map, view.z_far), closed_form::uniform_along(view.z_far, n, view.z_far), 1e-9);
}

TEST(SimplePerspectiveMap, GrowsStrongerWithItsStrength) {
    double before = inf;
    for (double const strength : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        WarpOptions<double> options;
        options.strength = strength;
        ViewVolume<double> const view = level_view();
        ShadowMap<double> const map = simple_perspective_map(view, overhead, flat_world, flat_world, options, gl_clip);
        double const here = error_along(map, first_ground(view));
        EXPECT_LT(here, before);
        before = here;
    }
}
