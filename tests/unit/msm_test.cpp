// SPDX-License-Identifier: MIT
#include "tests/laws/moments.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/msm.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace shadowmath;

namespace {

// A lit floor at 0.8 behind an occluder at 0.3 that covers `share` of the kernel.
laws::Kernel edge(double share) {
    return {{0.3, 0.8}, {share, 1 - share}};
}

}  // namespace

TEST(Msm, IsExactForAnEdgeWhateverTheReceiver) {
    for (double share : {0.1, 0.5, 0.9}) {
        Vec4<double> const moments = edge(share).mean<double>(msm_moments<double>);
        EXPECT_NEAR(msm_visibility(moments, 0.1, 1e-10), 1.0, 1e-6);
        EXPECT_NEAR(msm_visibility(moments, 0.6, 1e-10), 1 - share, 1e-6);
        EXPECT_NEAR(msm_visibility(moments, 0.95, 1e-10), 0.0, 1e-6);
    }
}

TEST(Msm, OfTheBiasAloneIsItsDistribution) {
    // Masses 3/16, 5/8, 3/16 at z = -1, 0, 1: halfway between the atoms the bound is on the safe side of both steps.
    Vec4<double> const moments(0, 0.375, 0, 0.375);
    EXPECT_GE(msm_visibility(moments, 0.25, 0.0), 13.0 / 16);
    EXPECT_GE(msm_visibility(moments, 0.75, 0.0), 3.0 / 16);
    EXPECT_NEAR(msm_visibility(moments, 0.5, 0.0), 13.0 / 16, 1e-9);
}

TEST(Msm, PacksEachMomentIntoItsWholeRange) {
    Vec4<double> lo(1.0), hi(0.0);
    for (int i = 0; i <= 1000; ++i) {
        Vec4<double> const packed = msm_packed(msm_moments(i / 1000.0));
        lo = glm::min(lo, packed);
        hi = glm::max(hi, packed);
    }
    for (int k = 0; k < 4; ++k) {
        EXPECT_NEAR(lo[k], 0.0, 1e-4);
        EXPECT_NEAR(hi[k], 1.0, 1e-4);
    }
}

TEST(Msm, OfATexelThatWasNeverWrittenDividesNothingByZero) {
    for (Vec4<float> const& moments :
         {Vec4<float>(0), Vec4<float>(1), Vec4<float>(0, 1, 0, 1), Vec4<float>(-1, 1, -1, 1)})
        for (float const depth : {0.0f, 0.25f, 0.5f, 1.0f})
            for (float const bias : {0.0f, 3e-6f}) {
                auto const share = test::watched([&] { return msm_visibility(moments, depth, bias); });
                EXPECT_TRUE(share.result >= 0.0f && share.result <= 1.0f);
                EXPECT_TRUE(share.calm()) << moments.x << " " << moments.y << " at " << depth;
            }
    // Systems that are singular to the last bit.
    for (Vec4<float> const& moments : {Vec4<float>(0), Vec4<float>(0, 1, 0, 1)}) {
        auto const solved = test::watched([&] { return detail::solve_hankel(moments, 0.5f); });
        EXPECT_TRUE(all_finite(solved.result));
        EXPECT_TRUE(solved.calm());
    }
}

// An atom at x itself and two others: what lies before x is the lower one, be x between them or at the upper one.
TEST(Msm, MassBeforeAnAtomIsThatOfTheLowerOnes) {
    auto const moments_of = [](double low, double high, double share_of_low) {
        Vec4<double> sum(0.0);
        double of_low = share_of_low, of_high = 1 - share_of_low;
        for (int k = 0; k < 4; ++k) {
            of_low *= low;
            of_high *= high;
            sum[k] = of_low + of_high;
        }
        return sum;
    };
    Vec4<double> const moments = moments_of(-0.5, 0.5, 0.25);
    EXPECT_NEAR(detail::mass_before(moments, 0.5, -0.5, 0.5), 0.25, 1e-15);
    EXPECT_NEAR(detail::mass_before(moments, 0.25, -0.5, 0.5), 0.25, 1e-15);
    EXPECT_NEAR(detail::mass_before(moments, 0.75, -0.5, 0.5), 1.0, 1e-15);
    EXPECT_EQ(detail::mass_before(moments, -0.5, -0.5, 0.5), 0.0);
}

TEST(Msm, ABiasOutsideItsRangeIsTheNearestOne) {
    Vec4<double> const moments = msm_moments(0.4);
    double const least = msm_visibility(moments, 0.6, 0.0);
    EXPECT_EQ(msm_visibility(moments, 0.6, -1.0), least);
    EXPECT_EQ(msm_visibility(moments, 0.6, std::numeric_limits<double>::quiet_NaN()), least);
    EXPECT_EQ(msm_visibility(moments, 0.6, 7.0), msm_visibility(moments, 0.6, 0.1));
}

TEST(Msm, DividesByNothingToNothing) {
    EXPECT_EQ(detail::quotient_or_zero(3.0, 0.0), 0.0);
    EXPECT_EQ(detail::quotient_or_zero(3.0, 2.0), 1.5);
}
