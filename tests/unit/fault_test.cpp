// SPDX-License-Identifier: MIT
#include "tests/laws/fault.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

using namespace shadowmath;

TEST(Faults, AreEmptyByDefault) {
    EXPECT_FALSE(Faults().any());
    EXPECT_STREQ(describe(Faults()), "no fault");
}

TEST(Faults, AddUpAtCompileTime) {
    constexpr Faults faults = Fault::zero_light | Fault::bad_pose;
    static_assert(faults.has(Fault::zero_light) && faults.has(Fault::bad_pose) && !faults.has(Fault::not_finite));
    static_assert(faults != Faults(Fault::zero_light) && laws::is_a_union(faults, Fault::empty_range));
    EXPECT_TRUE(faults.any());
    EXPECT_TRUE(faults != Faults(Fault::zero_light));
    EXPECT_FALSE(faults != faults);
}

TEST(Faults, HaveOneSentenceEach) {
    std::set<std::string> sentences;
    for (std::uint32_t bit = 1; bit != 0 && bit <= static_cast<std::uint32_t>(Fault::storage_too_small); bit <<= 1) {
        std::string const sentence = describe(static_cast<Fault>(bit));
        EXPECT_NE(sentence, "no fault") << "bit " << bit;
        sentences.insert(sentence);
    }
    EXPECT_EQ(sentences.size(), 17u) << "two faults share a sentence";
}

TEST(Faults, DescribeTheLowestAndSurviveUnknownBits) {
    EXPECT_STREQ(describe(Fault::zero_light | Fault::warp_faded), describe(Fault::zero_light));
    Faults unknown;
    unknown.bits = 1u << 31;
    EXPECT_STREQ(describe(unknown), "no fault");
    EXPECT_TRUE(laws::describes_the_lowest(unknown));
}
