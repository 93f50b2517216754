// SPDX-License-Identifier: MIT
//
// What tests/compile/ built, run: the program they are all linked into is the proof.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <set>

namespace shadowmath::compile {
int functions_between_hostile_macros() noexcept;
}

std::array<std::uint64_t, 6> fingerprint_with_left_handed_glm();
std::array<std::uint64_t, 6> fingerprint_with_right_handed_glm();

TEST(Compile, EveryFunctionStandsBetweenTheMacrosOfWindowsAndXlib) {
    EXPECT_GT(shadowmath::compile::functions_between_hostile_macros(), 3 * 50);
}

TEST(Compile, GlmsMacrosChangeNoBitOfAnyMap) {
    auto const left = fingerprint_with_left_handed_glm();
    EXPECT_EQ(left, fingerprint_with_right_handed_glm());
    EXPECT_EQ(std::set(left.begin(), left.end()).size(), left.size()) << "each technique gives a map of its own";
}
