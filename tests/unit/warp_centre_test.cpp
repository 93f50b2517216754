// SPDX-License-Identifier: MIT
//
// What a warp is made of, without a map: matrices, axes, and the rules that place its centre. The maps: warp_test.cpp.
#include "tests/laws/warp.hpp"
#include "tests/support/warp_cases.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/aliasing.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace shadowmath;
using namespace shadowmath::test;

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

TEST(LloydsEta, EndsThreeTenthsOfTheWayFromTheEdgeToARightAngle) {
    double const half = 0.5, right_angle = std::acos(0.0), last = half + 0.3 * (right_angle - half);
    EXPECT_NEAR(lloyd_eta(half + 0.1, half), -0.2 * (1 - std::sin(right_angle * 0.1 / (last - half))), 1e-14);
    EXPECT_LT(lloyd_eta(last * 0.99, half), 0.0);
    EXPECT_EQ(lloyd_eta(last * 1.01, half), 0.0);
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
