// SPDX-License-Identifier: MIT
#include "tests/laws/hfts.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

TEST(HftsProperty, LiesBetweenTheTwoAnswers) {
    EXPECT_TRUE(rc::check([] {
        auto const hard = static_cast<double>(*below(33)) / 32;
        auto const soft = *uniform<double>(0.0, 1.0);
        auto const traced = *log_uniform<double>(1e-6, 1e3);
        auto const searched = *log_uniform<double>(1e-6, 1e3);
        auto const soft_gap = *log_uniform<double>(1e-3, 1e2);
        ExactShadow<double> const exact{hard, traced};
        SoftShadow<double> const shadow{soft, searched, true};
        RC_ASSERT(laws::is_between(hybrid_visibility(exact, shadow, soft_gap), hard, soft, 1e-15));
        RC_ASSERT(watched([&] { return hybrid_visibility(exact, shadow, soft_gap); }).calm_in_range());
    }));
}

TEST(HftsProperty, SoftnessGrowsWithTheGapFromZeroToOne) {
    EXPECT_TRUE(rc::check([] {
        auto const gap = *log_uniform<double>(1e-6, 1e3);
        auto const more = *log_uniform<double>(1.0, 10.0);
        auto const soft_gap = *log_uniform<double>(1e-3, 1e2);
        RC_ASSERT(softness(0.0, soft_gap) == 0.0);
        RC_ASSERT(softness(soft_gap, soft_gap) == 1.0);
        RC_ASSERT(softness(gap * more, soft_gap) >= softness(gap, soft_gap));
        // Proportional, so nothing jumps at either end.
        RC_ASSERT(gap >= soft_gap || softness(gap, soft_gap) == gap / soft_gap);
    }));
}

TEST(HftsProperty, OfAnythingAtAllIsAShareOfLight) {
    EXPECT_TRUE(rc::check([] {
        auto const a = *nasty<float>();
        auto const b = *nasty<float>();
        auto const c = *nasty<float>();
        auto const d = *nasty<float>();
        auto const blocked = *one_in(2);
        float const share = hybrid_visibility(ExactShadow<float>{a, b}, SoftShadow<float>{c, d, blocked}, a);
        RC_ASSERT(all_finite(&share, 1) && share >= 0.0f && share <= 1.0f);
        float const mixed = softness(b, d);
        RC_ASSERT(all_finite(&mixed, 1) && mixed >= 0.0f && mixed <= 1.0f);
    }));
}
