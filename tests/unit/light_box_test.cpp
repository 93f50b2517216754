// SPDX-License-Identifier: MIT
#include "tests/laws/light_box.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;

namespace {

LightBox<double> box_over_the_ground() {
    LightBox<double> box;  // the default axes: straight down, -z up in the map
    box.lo = {-4, -2};
    box.hi = {12, 6};
    box.depth_lo = -10;
    box.depth_hi = 30;
    return box;
}

}  // namespace

TEST(LightBox, LandsOnTheWholeMap) {
    glm::dmat4 const map = clip_from_world(box_over_the_ground(), gl_zero_to_one_clip);
    EXPECT_EQ(map * glm::dvec4(-4, 10, 2, 1), glm::dvec4(-1, -1, 0, 1));
    EXPECT_EQ(map * glm::dvec4(12, -30, -6, 1), glm::dvec4(1, 1, 1, 1));
    EXPECT_EQ(map * glm::dvec4(4, -10, -2, 1), glm::dvec4(0, 0, 0.5, 1));
}

TEST(LightBox, IsAMapOfItsLightInEveryConvention) {
    Light<double> const sun = directional(glm::dvec3(0, -1, 0));
    for (ClipSpace const clip : {gl_clip, vulkan_clip, reversed(d3d_clip)})
        EXPECT_TRUE(laws::is_map_of(clip_from_world(box_over_the_ground(), clip), sun, clip));
    EXPECT_FALSE(laws::is_map_of(clip_from_world(box_over_the_ground(), vulkan_clip), sun, reversed(vulkan_clip)))
        << "the law must see a wrong order of depth";
    Light<double> const another = directional(glm::dvec3(0.001, -1, 0));
    EXPECT_FALSE(laws::is_map_of(clip_from_world(box_over_the_ground(), gl_clip), another, gl_clip))
        << "the law must see another light";
}

TEST(LightBox, ATexelIsItsShareOfTheSides) {
    EXPECT_EQ(texel_metres(box_over_the_ground(), 8), glm::dvec2(2, 1));
}

TEST(LightBox, RebasedFarFromTheOriginKeepsFloatTexelsStill) {
    // 1e7 m from the origin a float knows metres; relative to an eye there it knows tenths of a millimetre.
    LightBox<double> box = box_over_the_ground();
    box.lo += 1e7;
    box.hi += 1e7;
    glm::dmat4 const exact = clip_from_world(box, vulkan_clip);
    glm::dvec3 const eye(1e7, 0, -1e7);
    glm::mat4 const relative(rebased(exact, eye));
    glm::vec4 const at = relative * glm::vec4(4, 0, -2, 1);
    glm::dvec4 const wanted = exact * glm::dvec4(eye + glm::dvec3(4, 0, -2), 1);
    // NDC offsets in double are known to eps * 1e7 / 8 m; in float to eps.
    EXPECT_NEAR(at.x, wanted.x, 5e-7);
    EXPECT_NEAR(at.y, wanted.y, 5e-7);
}

TEST(LightBox, WhoseMatrixWouldOverflowInOneConventionIsNowhereThere) {
    // Its depth is a denormal; as a fuzzer found it.
    LightBox<float> box;
    box.depth_lo = 5.6678e-41f;
    box.depth_hi = 3.5959e-39f;
    box.basis.depth = Vec3<float>(0, -1, 0);
    EXPECT_TRUE(all_finite(clip_from_world(box, gl_zero_to_one_clip)));
    EXPECT_NE(clip_from_world(box, gl_zero_to_one_clip), nowhere<float>());
    EXPECT_EQ(clip_from_world(box, gl_clip), nowhere<float>());
}

TEST(LightBox, WithoutExtentIsNowhereAndDividesNothingByZero) {
    for (int side = 0; side < 3; ++side) {
        LightBox<float> box;
        if (side < 2) box.hi[side] = box.lo[side];
        if (side == 2) box.depth_hi = box.depth_lo;
        auto const map = test::watched([&] { return clip_from_world(box, gl_clip); });
        EXPECT_EQ(map.result, nowhere<float>());
        EXPECT_TRUE(map.calm()) << side;
    }
}
