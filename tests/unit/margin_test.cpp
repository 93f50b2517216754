// SPDX-License-Identifier: MIT
#include <shadowmath/margin.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace shadowmath;

TEST(Margin, LeavesTheBodyAndOneTexelToEitherSide) {
    EXPECT_FALSE(faults_of_margin(3, 0.0f).any());
    EXPECT_TRUE(faults_of_margin(2, 0.0f).has(Fault::map_too_small));
    EXPECT_FALSE(faults_of_margin(7, 2.0f).any());
    EXPECT_TRUE(faults_of_margin(6, 2.0f).has(Fault::map_too_small));
    EXPECT_TRUE(faults_of_margin(3, 0.5f).has(Fault::map_too_small));
    EXPECT_FALSE(faults_of_margin(4, 0.5f).any());
    EXPECT_EQ(usable_texels(512, 2.0), 508.0);
    EXPECT_EQ(usable_texels(64, 0.5), 63.0);
    EXPECT_EQ(usable_texels(64, 31.75), 1.0);
    EXPECT_EQ(usable_texels(64, -std::numeric_limits<double>::infinity()), 1.0);
}

TEST(Margin, ANegativeOneCountsAsNone) {
    EXPECT_EQ(faults_of_margin(64, -1.0), Faults(Fault::clamped_option));
    EXPECT_EQ(usable_texels(64, -1.0), 64.0);
}

TEST(Margin, AtLeastOneTexelIsLeftWhateverIsGiven) {
    for (float const margin : {1e9f, std::numeric_limits<float>::max(), std::numeric_limits<float>::quiet_NaN(), 32.0f})
        for (int const map_size : {-5, 0, 1, 64, 1 << 30}) EXPECT_GE(usable_texels(map_size, margin), 1.0f);
    EXPECT_TRUE(faults_of_margin(64, std::numeric_limits<float>::infinity()).has(Fault::not_finite));
}
