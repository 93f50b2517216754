// SPDX-License-Identifier: MIT
//
// What tests/compile/ built, run: the program they are all linked into is the proof.
#include <shadowmath/bounds.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <set>

namespace shadowmath::compile {
int functions_between_hostile_macros() noexcept;
}

int readme_example(glm::vec3 eye, glm::vec3 forward, glm::vec3 up, float fov_y_radians, float aspect,
                   glm::vec3 sun_travel, shadowmath::Aabb<float> const& caster_bounds,
                   shadowmath::Aabb<float> const& receiver_bounds);
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

TEST(Compile, TheTwelveLinesOfTheReadmeDrawFourMaps) {
    shadowmath::Aabb<float> const world{glm::vec3(-300, 0, -300), glm::vec3(300, 20, 300)};
    EXPECT_EQ(readme_example(glm::vec3(0, 2, 0), glm::vec3(0, 0, -1), glm::vec3(0, 1, 0), 1.0f, 1.6f,
                             glm::vec3(0.3f, -1.0f, 0.2f), world, world),
              4);
}
