// SPDX-License-Identifier: MIT
#include "tests/laws/clip_space.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;

namespace {

// Scale and offset of texture_from_clip: diagonal, and last column.
void expect_texture_matrix(ClipSpace clip, glm::dvec3 const& scale, glm::dvec3 const& offset) {
    glm::dmat4 expected(1.0);
    for (int i = 0; i < 3; ++i) expected[i][i] = scale[i];
    expected[3] = glm::dvec4(offset, 1.0);
    EXPECT_EQ(texture_from_clip<double>(clip), expected);
}

}  // namespace

TEST(ClipSpace, TextureMatricesAreThoseOfTheApis) {
    expect_texture_matrix(gl_clip, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5});
    expect_texture_matrix(gl_zero_to_one_clip, {0.5, 0.5, 1.0}, {0.5, 0.5, 0.0});
    expect_texture_matrix(vulkan_clip, {0.5, 0.5, 1.0}, {0.5, 0.5, 0.0});
    for (ClipSpace const clip : {d3d_clip, metal_clip, webgpu_clip, vulkan_negative_viewport_clip})
        expect_texture_matrix(clip, {0.5, -0.5, 1.0}, {0.5, 0.5, 0.0});
}

TEST(ClipSpace, TheFirstTextureRowOfVulkanIsTheTopOfThePicture) {
    EXPECT_EQ(laws::texture_point(vulkan_clip, glm::dvec4(0, 1, 0, 1)).y, 0.0);
    EXPECT_EQ(laws::texture_point(d3d_clip, glm::dvec4(0, 1, 0, 1)).y, 0.0);
    EXPECT_EQ(laws::texture_point(gl_clip, glm::dvec4(0, 1, 0, 1)).y, 1.0);
}

TEST(ClipSpace, NearAndFarLandWhereTheApiWantsThem) {
    auto const depth = [](ClipSpace clip, float canonical) {
        return (clip_from_canonical<float>(clip) * glm::vec4(0, 0, canonical, 1)).z;
    };
    EXPECT_EQ(depth(gl_clip, 0), -1.0f);
    EXPECT_EQ(depth(gl_clip, 1), 1.0f);
    EXPECT_EQ(depth(vulkan_clip, 0), 0.0f);
    EXPECT_EQ(depth(vulkan_clip, 1), 1.0f);
    EXPECT_EQ(depth(reversed(vulkan_clip), 0), 1.0f);
    EXPECT_EQ(depth(reversed(vulkan_clip), 1), 0.0f);
}

TEST(ClipSpace, DepthEqualToTheMapIsLitInEveryOrder) {
    for (ClipSpace const clip : {gl_clip, vulkan_clip, reversed(d3d_clip)}) {
        EXPECT_TRUE(is_lit(0.25f, 0.25f, 0.0f, clip));
        EXPECT_TRUE(laws::is_lit_by_a_cleared_map(clip, 1.0f));
    }
    EXPECT_FALSE(is_lit(0.25f, 0.5f, 0.0f, vulkan_clip));
    EXPECT_FALSE(is_lit(0.5f, 0.25f, 0.0f, reversed(vulkan_clip)));
    EXPECT_TRUE(is_lit(0.5f, 0.25f, 0.25f, reversed(vulkan_clip))) << "a bias must favour light in reversed depth too";
}
