// SPDX-License-Identifier: MIT
#include "tests/laws/moments.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/msm.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

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

TEST(Msm, TheCoefficientsSolveTheHankelSystem) {
    Vec4<double> const b = laws::Kernel{{0.1, 0.4, 0.7, 0.95}, {0.4, 0.3, 0.1, 0.2}}.mean<double>(msm_moments<double>);
    for (double const x : {-0.9, -0.3, 0.2, 0.7}) {
        Vec3<double> const c = detail::solve_hankel(b, x);
        EXPECT_NEAR(c.x + b.x * c.y + b.y * c.z, 1.0, 1e-9);
        EXPECT_NEAR(b.x * c.x + b.y * c.y + b.z * c.z, x, 1e-9);
        EXPECT_NEAR(b.y * c.x + b.z * c.y + b.w * c.z, x * x, 1e-9);
    }
}

// Such a distribution is the only one with its moments and an atom at the receiver, so nothing is lost by bounding it.
TEST(Msm, IsExactForTheReceiverAndTwoOtherDepths) {
    for (double const at_receiver : {0.2, 0.5, 0.8}) {
        double const other = (1 - at_receiver) / 2;
        for (auto const& depth : {std::vector<double>{0.0, 0.5, 1.0}, {0.1, 0.2, 0.9}, {0.3, 0.9, 1.0}})
            for (std::size_t i = 0; i < 3; ++i) {
                laws::Kernel kernel{depth, {other, other, other}};
                kernel.weight[i] = at_receiver;
                Vec4<double> const moments = kernel.mean<double>(msm_moments<double>);
                EXPECT_NEAR(msm_visibility(moments, depth[i], 0.0), kernel.lit(depth[i]), 1e-6)
                    << depth[0] << ' ' << depth[1] << ' ' << depth[2] << ": " << i;
                double const x = 2 * depth[i] - 1, low = 2 * depth[i == 0 ? 1 : 0] - 1,
                             high = 2 * depth[i == 2 ? 1 : 2] - 1;
                EXPECT_NEAR(detail::mass_before(moments, x, low, high), 1 - kernel.lit(depth[i]), 1e-9);
            }
    }
}

// There the quadratic is a line: two atoms have all moments but the last, and the third is without mass, endlessly far.
TEST(Msm, WhereOneAtomIsEndlesslyFarTheOtherTwoAreFound) {
    for (bool const mirrored : {false, true}) {
        laws::Kernel kernel{{0.0, 0.8, 1.0}, {0.1, 0.45, 0.45}};
        for (double& depth : kernel.depth) depth = mirrored ? 1 - depth : depth;
        Vec4<double> const b = kernel.mean<double>(msm_moments<double>);
        double const variance = b.y - b.x * b.x;
        double const lean = (b.z - 3 * b.x * b.y + 2 * b.x * b.x * b.x) / variance / 2;
        double const root = std::sqrt(lean * lean + variance), below = root - lean, above = root + lean;
        ASSERT_LT(mirrored ? below : above, variance) << "where the terms of the formula are small";
        auto const visible_at = [&](double z) { return msm_visibility(b, (z + 1) / 2, 0.0); };
        for (int i = -200; i <= 200; ++i) {
            double const moved = i * std::numeric_limits<double>::epsilon();
            ASSERT_NEAR(visible_at(b.x + above + moved), below / (below + above), 1e-3) << i;
            ASSERT_NEAR(visible_at(b.x - below + moved), 1.0, 1e-3) << i;
        }
    }
}

TEST(Msm, ABiasIsItsShareOfTheFixedDistribution) {
    // Masses 3/16, 5/8, 3/16 at z = -1, 0, 1.
    for (double const bias : {0.01, 0.05, 0.1}) {
        laws::Kernel const mixed{{0.3, 0.8, 0.0, 0.5, 1.0},
                                 {0.25 * (1 - bias), 0.75 * (1 - bias), bias * 3 / 16, bias * 5 / 8, bias * 3 / 16}};
        Vec4<double> const moments = edge(0.25).mean<double>(msm_moments<double>);
        Vec4<double> const moments_of_mixed = mixed.mean<double>(msm_moments<double>);
        for (double const depth : {0.1, 0.4, 0.6, 0.7, 0.9})
            EXPECT_NEAR(msm_visibility(moments, depth, bias), msm_visibility(moments_of_mixed, depth, 0.0), 1e-6)
                << bias << " at " << depth;
    }
}

TEST(Msm, AReceiverWithoutADepthIsLit) {
    Vec4<double> const moments = msm_moments(0.4);
    ASSERT_LT(msm_visibility(moments, 1.0, 0.0), 0.1);
    EXPECT_EQ(msm_visibility(moments, std::numeric_limits<double>::infinity(), 0.0), 1.0);
    EXPECT_EQ(msm_visibility(moments, std::numeric_limits<double>::quiet_NaN(), 0.0), 1.0);
}
