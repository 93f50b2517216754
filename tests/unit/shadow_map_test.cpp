// SPDX-License-Identifier: MIT
#include "tests/laws/shadow_map.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;

namespace {

// Looks straight down on the square [-1, 1]^2 of the ground, from height 1 to height 0.
ShadowMap<double> map_of_the_ground(ClipSpace clip) {
    ShadowMap<double> map;
    glm::dmat4 const canonical =
        from_rows(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, -1, 0), glm::dvec4(0, -1, 0, 1), glm::dvec4(0, 0, 0, 1));
    map.clip_from_world = clip_from_canonical<double>(clip) * canonical;
    map.clip = clip;
    map.visible = true;
    return map;
}

}  // namespace

TEST(ShadowMap, ServesNothingByDefault) {
    ShadowMap<float> const map;
    EXPECT_FALSE(map.visible);
    EXPECT_TRUE(laws::harmless(map));
    for (ClipSpace const clip : {gl_clip, vulkan_clip, reversed(d3d_clip)})
        for (glm::vec3 const& point : {glm::vec3(0), glm::vec3(1e30f), glm::vec3(-1, 2, -3)})
            EXPECT_FALSE(laws::holds(map.clip_from_world, clip, point, 0.0f));
}

TEST(ShadowMap, IsReadWhereItWasWritten) {
    for (ClipSpace const clip : {gl_clip, vulkan_clip, d3d_clip, reversed(vulkan_clip)}) {
        ShadowMap<double> const map = map_of_the_ground(clip);
        glm::dvec4 const at = texture_from_world(map) * glm::dvec4(0.5, 0.25, -0.5, 1);
        EXPECT_EQ(at.x, 0.75);
        EXPECT_EQ(at.y, clip.texture_v == YAxis::up ? 0.75 : 0.25);
        EXPECT_EQ(at.z, clip.depth == DepthOrder::one_to_zero ? 0.25 : 0.75);
        EXPECT_EQ(at.w, 1.0);
    }
}

TEST(ShadowMap, TheLawsSeeWhatIsInsideAndWhatIsNot) {
    ShadowMap<double> const map = map_of_the_ground(vulkan_clip);
    auto const held = [&map](glm::dvec3 const& point, double margin) {
        return laws::holds(map.clip_from_world, map.clip, point, margin);
    };
    EXPECT_TRUE(held({1, 0, 1}, 0));
    EXPECT_FALSE(held({1, 0, 1}, 0.01));
    EXPECT_FALSE(held({1.005, 0, 1}, 0));
    EXPECT_TRUE(held({1.005, 0, 1}, -0.01));
    EXPECT_FALSE(held({0, -0.1, 0}, 0)) << "below the far end";
    EXPECT_FALSE(held({0, 1.1, 0}, 0)) << "before the near end";
}

TEST(ShadowMap, TheLawsSeeEachWayToBreakAMap) {
    Light<double> const sun = directional(glm::dvec3(0, -1, 0));
    glm::dmat4 const good = map_of_the_ground(gl_clip).clip_from_world;
    EXPECT_TRUE(laws::is_map_of(good, sun, gl_clip));
    for (int r = 0; r < 4; ++r) {
        glm::dmat4 sheared = good;  // the light's own direction enters another row, or leaves the depth row
        sheared[1][r] += r == 2 ? 2.0 : 1e-10;
        EXPECT_FALSE(laws::is_map_of(sheared, sun, gl_clip)) << "row " << r;
        glm::dmat4 empty = good;
        for (int column = 0; column < 4; ++column) empty[column][r] = 0;
        EXPECT_FALSE(laws::is_map_of(empty, sun, gl_clip)) << "row " << r;
    }
    EXPECT_FALSE(laws::is_map_of(nowhere<double>(), sun, gl_clip));
}
