// SPDX-License-Identifier: MIT
#include "tests/laws/hfts.hpp"

#include <gtest/gtest.h>

#include <limits>

using namespace shadowmath;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
using Exact = ExactShadow<double>;
using Soft = SoftShadow<double>;

}  // namespace

TEST(Hfts, IsExactInContact) {
    EXPECT_EQ(hybrid_visibility(Exact{0.25, 0.0}, Soft{0.9, 0.0, true}, 1.0), 0.25);
    EXPECT_EQ(hybrid_visibility(Exact{0.25, 0.0}, Soft{1.0, 0.0, false}, 1.0), 0.25) << "PCSS missed the contact";
    EXPECT_EQ(hybrid_visibility(Exact{0.25, 0.0}, Soft{0.9, 7.0, true}, 1.0), 0.25) << "and something is far above";
}

TEST(Hfts, IsSoftFromTheSoftGapOn) {
    EXPECT_EQ(hybrid_visibility(Exact{0.0, 2.0}, Soft{0.6, 2.5, true}, 2.0), 0.6);
    EXPECT_EQ(hybrid_visibility(Exact{1.0, 0.0}, Soft{0.6, 2.5, true}, 2.0), 0.6) << "the outer half of a penumbra";
    EXPECT_EQ(hybrid_visibility(Exact{0.0, 2.0}, Soft{0.6, 0.0, false}, 2.0), 0.6) << "PCSS missed it, and has no gap";
    for (double const none : {0.0, -0.5})
        EXPECT_EQ(hybrid_visibility(Exact{0.5, 2.0}, Soft{none, 2.5, true}, 2.0), 0.0);
}

TEST(Hfts, MixesInProportionToTheGapOfTheNearestOccluder) {
    EXPECT_DOUBLE_EQ(hybrid_visibility(Exact{0.0, 1.0}, Soft{0.8, 1.0, true}, 4.0), 0.2);
    EXPECT_DOUBLE_EQ(hybrid_visibility(Exact{0.0, 3.0}, Soft{0.8, 1.0, true}, 4.0), 0.2);
    EXPECT_DOUBLE_EQ(hybrid_visibility(Exact{0.0, 1.0}, Soft{0.8, 3.0, true}, 4.0), 0.2);
}

TEST(Hfts, WithoutAnOccluderIsNeverDarkened) {
    for (double soft_gap : {-1.0, 0.0, 1.0, 1e30})
        EXPECT_EQ(hybrid_visibility(Exact{}, Soft{0.3, 0.0, false}, soft_gap), 1.0);
}

TEST(Hfts, OfBadNumbersIsExactOrLit) {
    EXPECT_EQ(hybrid_visibility(Exact{not_a_number, 1.0}, Soft{0.5, 1.0, true}, 1.0), 1.0);
    EXPECT_EQ(hybrid_visibility(Exact{0.25, not_a_number}, Soft{0.5, 1.0, true}, 1.0), 0.25);
    EXPECT_EQ(hybrid_visibility(Exact{0.25, 1.0}, Soft{not_a_number, 1.0, true}, 1.0), 0.25);
    EXPECT_EQ(hybrid_visibility(Exact{0.25, 1.0}, Soft{0.5, not_a_number, true}, 1.0), 0.25);
    EXPECT_EQ(hybrid_visibility(Exact{0.25, 1.0}, Soft{0.5, 1.0, true}, not_a_number), 0.25);
    EXPECT_EQ(hybrid_visibility(Exact{-7.0, 0.0}, Soft{0.5, 1.0, true}, 1.0), 0.0);
    EXPECT_EQ(hybrid_visibility(Exact{7.0, 0.0}, Soft{7.0, 1.0, true}, 1.0), 1.0);
}
