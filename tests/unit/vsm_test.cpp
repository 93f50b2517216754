// SPDX-License-Identifier: MIT
#include "tests/laws/moments.hpp"

#include <shadowmath/vsm.hpp>

#include <gtest/gtest.h>

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
    EXPECT_EQ(evsm_bound(moments, Vec2<double>(nan, -1.0), exponents, 1e-4), 1.0);
    EXPECT_EQ(evsm_bound(Vec4<double>(nan), evsm_warp(0.5, exponents), exponents, 1e-4), 1.0);
}
