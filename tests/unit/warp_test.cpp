// SPDX-License-Identifier: MIT
#include "tests/laws/warp.hpp"
#include "tests/support/tolerance.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/aliasing.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace shadowmath;

namespace {

using V2 = glm::dvec2;
using V3 = glm::dvec3;
using V4 = glm::dvec4;

double const inf = std::numeric_limits<double>::infinity();
double const nan_ = std::numeric_limits<double>::quiet_NaN();

Aabb<double> const flat_world{V3(-3000, 0, -3000), V3(3000, 0, 3000)};
Aabb<double> const town{V3(-300, 0, -300), V3(300, 12, 300)};
Light<double> const overhead = directional(V3(0, -1, 0));

ViewVolume<double> level_view(double z_far = 200.0) {
    return perspective_view(pose_looking(V3(0, 1.7, 0), V3(0, 0, -1), V3(0, 1, 0)), 1.0, 1.6, 0.1, z_far);
}

V3 ndc(glm::dmat4 const& m, V3 const& p) {
    V4 const at = m * V4(p, 1.0);
    return V3(at) / at.w;
}

// d(map share) / dz / z on the ground below the view axis: the error along the view, by the exact derivative.
double error_along(ShadowMap<double> const& map, double z) {
    glm::dmat4 const& m = map.clip_from_world;
    V4 const at = m * V4(0, 0, -z, 1), slope = m * V4(0, 0, -1, 0);
    double const ndc_per_metre = (slope.y * at.w - at.y * slope.w) / (at.w * at.w);
    return 1.0 / (z * std::abs(ndc_per_metre) / 2.0);
}

// Eye depth at which the lower edge of the level view meets the ground.
double first_ground(ViewVolume<double> const& view) {
    return view.pose.position.y / -view.bottom;
}

}  // namespace

TEST(PrintedWarp, LeavesHalfOfTheMapEmpty) {
    glm::dmat4 const warp = printed_simple_warp(0.5, 1.5, 0.2, 1.0);
    EXPECT_NEAR(ndc(warp, V3(0, 0.2, 0)).y, 0.0, 1e-15);
    EXPECT_NEAR(ndc(warp, V3(0, 1.0, 0)).y, 1.0, 1e-15);
}

TEST(PrintedWarp, CutsCastersNearTheViewerUnlessHIsTwo) {
    EXPECT_GT(ndc(printed_simple_warp(0.5, 1.5, 0.2, 1.0), V3(0, 0.2, 0.9)).z, 1.0);
    EXPECT_LE(ndc(printed_simple_warp(0.5, 2.0, 0.2, 1.0), V3(0, 0.2, 1.0)).z, 1.0 + 1e-15);
}

TEST(PrintedWarp, IsTheTransposeOfTheRowsInTheListing) {
    double const w = 0.5, h = 0.75, zn = 0.2, zf = 1.0;
    glm::dmat4 const warp = printed_simple_warp(w, h, zn, zf);
    // A row of the listing is a column here.
    double const listing[4][4] = {
        {2 * zn / w, 0, 0, 0}, {0, zf / (zf - zn), 0, 1}, {0, 0, 2 * zn / h, 0}, {0, zn * zf / (zn - zf), 0, 0}};
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) EXPECT_NEAR(warp[c][r], listing[c][r], 1e-15);
}

TEST(CorrectedWarp, FillsTheMapFromNearToFarAndKeepsDepthInside) {
    glm::dmat4 const warp = corrected_simple_warp(0.5, 0.2, 1.0);
    EXPECT_NEAR(ndc(warp, V3(0, 0.2, 0)).y, -1.0, 1e-15);
    EXPECT_NEAR(ndc(warp, V3(0, 1.0, 0)).y, 1.0, 1e-15);
    for (double y = 0.2; y < 1.0; y += 0.05) {
        EXPECT_LE(ndc(warp, V3(0, y, 1.0)).z, 1.0 + 1e-15);
        EXPECT_LT(ndc(warp, V3(0, y, 0.3)).z, ndc(warp, V3(0, y, 0.4)).z);
    }
}

TEST(CorrectedWarp, DividesByTheWayAlongTheViewAndKeepsTheAxesApart) {
    double const w = 0.5, zn = 0.2, zf = 1.0, y = 0.6;
    V3 const at = ndc(corrected_simple_warp(w, zn, zf), V3(0.3, y, 0.7));
    EXPECT_NEAR(at.x, 2 * zn * 0.3 / w / y, 1e-14);
    EXPECT_NEAR(at.y, ((zf + zn) - 2 * zf * zn / y) / (zf - zn), 1e-14);
    EXPECT_NEAR(at.z, zn * 0.7 / y, 1e-14);
}

TEST(CorrectedWarp, FillsTheWidthWithTheSidesOfTheView) {
    double const k = 0.7, zn = 0.2;
    glm::dmat4 const warp = corrected_simple_warp(2 * k * zn, zn, 1.0);
    for (double y = zn; y <= 1.0; y += 0.1) EXPECT_NEAR(ndc(warp, V3(k * y, y, 0)).x, 1.0, 1e-15);
}

TEST(SimpleWarps, AreTheIdentityForParametersOutOfRange) {
    for (double const bad : {0.0, -1.0, nan_, inf}) {
        EXPECT_EQ(printed_simple_warp(bad, 1.0, 0.1, 1.0), glm::dmat4(1.0));
        EXPECT_EQ(printed_simple_warp(1.0, bad, 0.1, 1.0), glm::dmat4(1.0));
        EXPECT_EQ(printed_simple_warp(1.0, 1.0, bad, 1.0), glm::dmat4(1.0));
        EXPECT_EQ(printed_simple_warp(1.0, 1.0, 0.1, bad), glm::dmat4(1.0));
        EXPECT_EQ(corrected_simple_warp(1.0, bad, 1.0), glm::dmat4(1.0));
        EXPECT_EQ(corrected_simple_warp(bad, 0.1, 1.0), glm::dmat4(1.0));
        EXPECT_EQ(corrected_simple_warp(1.0, 0.1, bad), glm::dmat4(1.0));
    }
    EXPECT_EQ(corrected_simple_warp(1.0, 1.0, 1.0), glm::dmat4(1.0));
    // Numbers that are good alone and too much together.
    EXPECT_EQ(printed_simple_warp(1e-300, 1.0, 1e20, 1e30), glm::dmat4(1.0));
    EXPECT_EQ(corrected_simple_warp(1e-300, 1e20, 1e30), glm::dmat4(1.0));
}

TEST(SimpleWarps, DivideByNoParameterThatIsZero) {
    for (auto const& run : {test::watched([] { return printed_simple_warp(0.0, 1.0, 0.1, 1.0); }),
                            test::watched([] { return printed_simple_warp(1.0, 0.0, 0.1, 1.0); }),
                            test::watched([] { return printed_simple_warp(1.0, 1.0, 0.5, 0.5); }),
                            test::watched([] { return corrected_simple_warp(0.0, 0.1, 1.0); }),
                            test::watched([] { return corrected_simple_warp(1.0, 0.5, 0.5); })}) {
        EXPECT_TRUE(run.calm_in_range());
        EXPECT_EQ(run.result, glm::dmat4(1.0));
    }
}

// Symmetrically in the sine: half of the warp half way.
TEST(WarpAxes, FadeTheWarpOutFromThirtyDegreesToSix) {
    auto const fade = [](double sine) {
        double const angle = std::asin(sine);
        return warp_axes(pose_looking(V3(0), V3(0, -std::cos(angle), -sine), V3(0, 0, -1)), overhead.direction).fade;
    };
    EXPECT_EQ(fade(1.0), 1.0);
    EXPECT_EQ(fade(0.5001), 1.0);
    EXPECT_EQ(fade(0.0999), 0.0);
    EXPECT_NEAR(fade(0.3), 0.5, 1e-12);
    for (double off = 0.01; off < 0.2; off += 0.01) {
        EXPECT_NEAR(fade(0.3 - off) + fade(0.3 + off), 1.0, 1e-12);
        EXPECT_GT(fade(0.3 + off), fade(0.29 + off));
    }
}

TEST(WarpAxes, RunAlongTheViewAsTheLightSeesItHoweverItIsRolled) {
    V3 const forward = glm::normalize(V3(0.3, -0.8, -0.6)), travel = overhead.direction;
    for (V3 const& up : {V3(0, 1, 0), V3(1, 0.2, 0.3), V3(-1, 0, 0.5)}) {
        WarpAxes<double> const axes = warp_axes(pose_looking(V3(0), forward, up), travel);
        ASSERT_EQ(axes.fade, 1.0);
        EXPECT_NEAR(glm::dot(axes.basis.y, glm::normalize(V3(forward.x, 0, forward.z))), 1.0, 1e-14);
    }
}

TEST(WarpAxes, OfAViewThatIsNoneAreThoseOfTheLightAlone) {
    Pose<double> none;
    none.forward = none.up = none.right = V3(0.0);
    WarpAxes<double> const axes = warp_axes(none, overhead.direction);
    EXPECT_EQ(axes.basis.x, light_basis(overhead.direction).x);
    EXPECT_EQ(axes.basis.y, light_basis(overhead.direction).y);
}

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

TEST(OptimalCentre, IsNearPlusTheGeometricMeanForALightOverhead) {
    for (double const f : {1.5, 10.0, 1000.0, 1e6})
        EXPECT_NEAR(1.0 / optimal_inverse_centre(1.0, f - 1.0, 1.0), 1.0 + std::sqrt(f), 1e-9 * std::sqrt(f));
    EXPECT_NEAR(1.0 / optimal_inverse_centre(2.0, 48.0, 1.0), closed_form::best_centre(2.0, 50.0), 1e-12);
}

TEST(OptimalCentre, IsTheNearDistanceOfLightSpacePerspectiveMaps) {
    // n_opt = (n + sqrt(n (n + d sin))) / sin, and d / (sqrt(1 + d sin / n) - 1).
    for (double const sine : {0.05, 0.5, 0.9}) {
        double const a = 1.0 / optimal_inverse_centre(3.0, 70.0, sine);
        EXPECT_NEAR(a, (3.0 + std::sqrt(3.0 * (3.0 + 70.0 * sine))) / sine, 1e-9);
        EXPECT_NEAR(a, 70.0 / (std::sqrt(1.0 + 70.0 * sine / 3.0) - 1.0), 1e-6);
    }
    EXPECT_EQ(optimal_inverse_centre(3.0, 70.0, 0.0), 0.0);
}

TEST(LloydsEta, RunsFromUniformOverTheOptimumToStamminger) {
    for (double const sine : {0.05, 0.5, 1.0})
        for (double const length : {0.1, 10.0, 1e4}) {
            double const n = 2.0, optimum = optimal_inverse_centre(n, length, sine);
            EXPECT_EQ(lloyd_inverse_centre(-1.0, n, length, sine), 0.0);
            EXPECT_NEAR(lloyd_inverse_centre(0.0, n, length, sine) / optimum, 1.0, 1e-12);
            EXPECT_NEAR(lloyd_inverse_centre(1.0, n, length, sine), sine / n, 1e-12);
            // His own two formulae, for a over the length of the body.
            double const alpha = 1.0 + length * sine / n, root = std::sqrt(alpha);
            for (double eta = -0.9; eta < 1.0; eta += 0.1) {
                double const printed = eta < 0 ? (1 + root - eta * (alpha - 1)) / ((alpha - 1) * (eta + 1))
                                               : 1 / ((root - 1) * (eta * root + 1));
                EXPECT_NEAR(lloyd_inverse_centre(eta, n, length, sine) * printed * length, 1.0, 1e-9);
                EXPECT_LT(lloyd_inverse_centre(eta - 0.1, n, length, sine), lloyd_inverse_centre(eta, n, length, sine));
            }
        }
}

TEST(LloydsEta, FallsOffContinuouslyTowardALightInThePicture) {
    double const half_fov = 0.5;
    EXPECT_EQ(lloyd_eta(half_fov / 3 - 1e-9, half_fov), -1.0);
    EXPECT_NEAR(lloyd_eta(half_fov, half_fov), -0.2, 1e-12);
    EXPECT_NEAR(lloyd_eta(1.5, half_fov), 0.0, 1e-12);
    EXPECT_NEAR(lloyd_eta(3.1, half_fov), -1.0, 1e-12);
    for (double angle = 0.0; angle < 3.14; angle += 1e-3)
        EXPECT_NEAR(lloyd_eta(angle, half_fov), lloyd_eta(angle + 1e-3, half_fov), 6e-3) << angle;
}

TEST(TrapezoidCentre, PutsTheFocusAtEightyPercent) {
    for (double const focus : {1.0, 5.0, 20.0}) {
        double const length = 100.0, inverse = trapezoid_inverse_centre(length, focus);
        // The projective map of [0, length] to [0, 1] with w = 1 + y / a.
        auto const place = [&](double y) { return y / (1 + y * inverse) / (length / (1 + length * inverse)); };
        EXPECT_NEAR(place(focus), 0.8, 1e-12);
        // Martin and Tan: lambda d (1 + xi) / (lambda (1 - xi) - 2 d), xi = -0.6.
        EXPECT_NEAR(1 / inverse, length * focus * 0.4 / (length * 1.6 - 2 * focus), 1e-9);
    }
    EXPECT_EQ(trapezoid_inverse_centre(100.0, 80.0), 0.0);
    EXPECT_EQ(trapezoid_inverse_centre(100.0, 90.0), 0.0);
}

TEST(ExtendedCentre, IsGusevsGrowthMeasuredFromTheNearEnd) {
    // w = 1 + g y and w' = 1 + (y - y_near) / a differ by a factor.
    double const y_near = 3.0, g = 0.05 / 0.5, inverse = extended_inverse_centre(0.05, 0.5, y_near);
    for (double const y : {3.0, 10.0, 200.0})
        EXPECT_NEAR((1 + g * y) / (1 + g * y_near), 1 + (y - y_near) * inverse, 1e-12);
    EXPECT_DOUBLE_EQ(extended_inverse_centre(0.05, 0.5, 0.0), g) << "from the eye on";
    // Behind the eye, where w would pass through 0 at y = -10.
    double const kept = extended_inverse_centre(0.05, 0.5, -50.0);
    EXPECT_NEAR(1 / kept, 50.0 * 0.15 / 0.85, 1e-9);
}

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

TEST(LloydsEta, EndsThreeTenthsOfTheWayFromTheEdgeToARightAngle) {
    double const half = 0.5, right_angle = std::acos(0.0), last = half + 0.3 * (right_angle - half);
    EXPECT_NEAR(lloyd_eta(half + 0.1, half), -0.2 * (1 - std::sin(right_angle * 0.1 / (last - half))), 1e-14);
    EXPECT_LT(lloyd_eta(last * 0.99, half), 0.0);
    EXPECT_EQ(lloyd_eta(last * 1.01, half), 0.0);
}
