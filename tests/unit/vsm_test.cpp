// SPDX-License-Identifier: MIT
#include "tests/laws/moments.hpp"

#include <shadowmath/vsm.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace shadowmath;

namespace {

// A lit floor at 0.8 behind an occluder at 0.3 that covers `share` of the kernel.
laws::Kernel edge(double share) {
    return {{0.3, 0.8}, {share, 1 - share}};
}

}  // namespace

TEST(Vsm, IsExactOnTheFartherOfTwoDepths) {
    // Cantelli's bound is reached by two atoms, of which the receiver's is one.
    for (double share : {0.1, 0.5, 0.9}) {
        Vec2<double> const moments = edge(share).mean<double>(vsm_moments<double>);
        EXPECT_NEAR(vsm_visibility(moments, 0.8, 0.0), 1 - share, 1e-12);
        EXPECT_GT(vsm_visibility(moments, 0.9, 0.0), 0.01) << "behind both it lets light through";
    }
}

TEST(Evsm, LetsFarLessLightThroughBehindTwoOccluders) {
    Vec4<double> const moments =
        edge(0.5).mean<double>([](double depth) { return evsm_moments(depth, EvsmExponents<double>{}); });
    Vec2<double> const plain = edge(0.5).mean<double>(vsm_moments<double>);
    EXPECT_GT(vsm_visibility(plain, 0.9, 0.0), 0.3);
    EXPECT_LT(evsm_visibility(moments, 0.9, EvsmExponents<double>{}, 0.0), 0.001);
}

TEST(Evsm, OfTheLargestExponentsStaysInsideFloatAndHalf) {
    for (float depth : {0.0f, 0.5f, 1.0f}) {
        Vec4<float> const wide = evsm_moments(depth, EvsmExponents<float>{1e9f, 1e9f});
        EXPECT_TRUE(all_finite(wide));
        EXPECT_LT(std::max(wide.y, wide.w), 0.1f * std::numeric_limits<float>::max());
        Vec4<float> const half =
            evsm_moments(depth, EvsmExponents<float>{largest_exponent_half, largest_exponent_half});
        EXPECT_LE(std::max(half.y, half.w), 65504.0f);
    }
}

TEST(Evsm, OfAReceiverThatIsNoNumberIsLit) {
    EvsmExponents<double> const exponents;
    Vec4<double> const moments = evsm_moments(0.2, exponents);
    double const nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(evsm_visibility(moments, nan, exponents, 1e-4), 1.0);
    EXPECT_EQ(evsm_warp(nan, exponents), evsm_warp(1.0, exponents)) << "as far away as can be stored";
    EXPECT_EQ(evsm_bound(moments, Vec2<double>(nan, -1.0), exponents, 1e-4), 1.0);
    EXPECT_EQ(evsm_bound(Vec4<double>(nan), evsm_warp(0.5, exponents), exponents, 1e-4), 1.0);
}

TEST(Vsm, OfOneDepthIsDarkAsSoonAsTheLeastDeviationIsBehind) {
    // One deviation behind the occluder half of the light is let through.
    EXPECT_NEAR(vsm_visibility(vsm_moments(0.5), 0.51, 0.01), 0.5, 1e-12);
    EXPECT_NEAR(vsm_visibility(vsm_moments(0.5), 0.51, 7.0), 0.5, 1e-12) << "a hundredth at most";
    EXPECT_EQ(vsm_visibility(vsm_moments(0.5), 0.51, -1.0), 0.0);
}

TEST(Evsm, TakesTheLeastDeviationForOneOfDepth) {
    EvsmExponents<double> const exponents{4.0, 0.0};
    double const depth = 0.51, warp = std::exp(4 * (2 * depth - 1)), before = warp - 1;
    double const spread = 0.01 * 2 * 4 * warp;  // d/dz of exp(4 (2 z - 1))
    EXPECT_NEAR(evsm_visibility(evsm_moments(0.5, exponents), depth, exponents, 0.01),
                spread * spread / (spread * spread + before * before), 1e-12);
}

TEST(Evsm, MomentsAreAWarpAndItsSquare) {
    EvsmExponents<double> const exponents{2.0, 0.5};
    double const z = 2 * 0.7 - 1, growing = std::exp(2.0 * z), falling = -std::exp(-0.5 * z);
    Vec4<double> const moments = evsm_moments(0.7, exponents);
    EXPECT_NEAR(moments.x, growing, 1e-14);
    EXPECT_NEAR(moments.y, growing * growing, 1e-14);
    EXPECT_NEAR(moments.z, falling, 1e-14);
    EXPECT_NEAR(moments.w, falling * falling, 1e-14);
}

TEST(Evsm, OfAnExponentThatIsNoneWarpsNothing) {
    for (double const bad : {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
        EXPECT_EQ(evsm_warp(0.7, EvsmExponents<double>{bad, bad}), Vec2<double>(1.0, -1.0)) << bad;
}

TEST(Evsm, TakesTheLeastDeviationForOneOfDepthInTheFallingWarpToo) {
    EvsmExponents<double> const exponents{0.0, 4.0};
    double const depth = 0.51, warp = std::exp(-4 * (2 * depth - 1)), before = 1 - warp;
    double const spread = 0.01 * 2 * 4 * warp;  // d/dz of exp(-4 (2 z - 1))
    EXPECT_NEAR(evsm_visibility(evsm_moments(0.5, exponents), depth, exponents, 0.01),
                spread * spread / (spread * spread + before * before), 1e-12);
}

TEST(Vsm, OfADepthWithoutAnEndIsLit) {
    double const inf = std::numeric_limits<double>::infinity();
    EXPECT_EQ(vsm_visibility(vsm_moments(0.2), inf, 1e-4), 1.0);
    EXPECT_EQ(vsm_visibility(Vec2<double>(inf, 0.1), 0.9, 1e-4), 1.0);
}
