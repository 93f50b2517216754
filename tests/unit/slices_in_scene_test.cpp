// SPDX-License-Identifier: MIT
#include "tests/laws/slices_in_scene.hpp"

#include <gtest/gtest.h>

#include <limits>

using namespace shadowmath;

namespace {

ViewVolume<float> some_view() {
    Pose<float> const pose = pose_looking(Vec3<float>(3, 2, 8), Vec3<float>(0.1f, -0.2f, -1), Vec3<float>(0, 1, 0));
    return perspective_view(pose, 1.0f, 1.5f, 0.1f, 60.0f);
}

LightBasis<float> const basis = light_basis(directional(Vec3<float>(0.4f, -1, 0.3f)).direction);
Aabb<float> const scene{Vec3<float>(-100, -1, -100), Vec3<float>(100, 12, 100)};

}  // namespace

TEST(SlicesInScene, OfAnyNumberAreWrittenAndNoMore) {
    for (int count = 1; count < max_splits; ++count) {
        Splits<float> const splits = practical_splits(0.1f, 60.0f, count);
        Mat4<float> maps[max_splits];
        Aabb<float> boxes[max_splits];
        Aabb<float> const kept{Vec3<float>(7), Vec3<float>(7)};
        maps[count] = Mat4<float>(7.0f);
        boxes[count] = kept;
        EXPECT_EQ(fit_slice_focus(some_view(), basis, splits, scene, 0.01f, gl_clip, maps), (1u << count) - 1u);
        bound_slices(some_view(), basis, splits, scene, boxes);
        EXPECT_EQ(maps[count], Mat4<float>(7.0f)) << count;
        EXPECT_EQ(boxes[count].lo, kept.lo) << count;
        for (int i = 0; i < count; ++i) EXPECT_FALSE(is_empty(boxes[i])) << count;
    }
}

TEST(SlicesInScene, TakeABorderOfNothingUpToNearlyHalf) {
    Splits<float> const splits = practical_splits(0.1f, 60.0f, 4);
    Mat4<float> maps[max_splits];
    for (float const border : {0.0f, 0.49f})
        EXPECT_EQ(fit_slice_focus(some_view(), basis, splits, scene, border, gl_clip, maps), 15u) << border;
    for (float const border : {-0.01f, 0.5f, std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_EQ(fit_slice_focus(some_view(), basis, splits, scene, border, gl_clip, maps), 0u) << border;
        for (int i = 0; i < 4; ++i) EXPECT_EQ(maps[i], nowhere<float>());
    }
}
