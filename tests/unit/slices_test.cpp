// SPDX-License-Identifier: MIT
#include "tests/laws/slices.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

using namespace shadowmath;

namespace {

ViewVolume<float> some_view() {
    Pose<float> const pose = pose_looking(Vec3<float>(3, 2, 8), Vec3<float>(0.1f, -0.2f, -1), Vec3<float>(0, 1, 0));
    return perspective_view(pose, 1.0f, 1.5f, 0.1f, 60.0f);
}

void expect_nowhere(ViewVolume<float> const& view, LightBasis<float> const& basis, Splits<float> const& splits,
                    float border) {
    Mat4<float> boxes[max_splits], spheres[max_splits];
    boxes[splits.count] = spheres[splits.count] = Mat4<float>(7.0f);
    auto const boxed = test::watched([&] { return fit_slice_boxes(view, basis, splits, border, gl_clip, boxes); });
    auto const rounded =
        test::watched([&] { return fit_slice_spheres(view, basis, splits, 512, border * 512, gl_clip, spheres); });
    EXPECT_FALSE(boxed.result);
    EXPECT_FALSE(rounded.result);
    for (int i = 0; i < splits.count; ++i) {
        EXPECT_EQ(boxes[i], nowhere<float>());
        EXPECT_EQ(spheres[i], nowhere<float>());
    }
    EXPECT_EQ(boxes[splits.count], Mat4<float>(7.0f)) << "no more than was asked for";
    EXPECT_EQ(spheres[splits.count], Mat4<float>(7.0f));
}

}  // namespace

TEST(Slices, OfAGoodViewHoldTheirCornersInEveryConvention) {
    ViewVolume<float> const view = some_view();
    Light<float> const sun = directional(Vec3<float>(0.4f, -1, 0.3f));
    LightBasis<float> const basis = light_basis(sun.direction);
    Splits<float> const splits = practical_splits(0.1f, 60.0f, 4);
    for (ClipSpace const clip : {gl_clip, vulkan_clip, d3d_clip, reversed(d3d_clip), reversed(vulkan_clip)}) {
        Mat4<float> boxes[max_splits], spheres[max_splits];
        boxes[4] = spheres[4] = Mat4<float>(7.0f);
        ASSERT_TRUE(fit_slice_boxes(view, basis, splits, 0.01f, clip, boxes));
        ASSERT_TRUE(fit_slice_spheres(view, basis, splits, 512, 2.0f, clip, spheres));
        EXPECT_EQ(boxes[4], Mat4<float>(7.0f)) << "no more than was asked for";
        EXPECT_EQ(spheres[4], Mat4<float>(7.0f));
        for (int i = 0; i < 4; ++i) {
            ViewVolume<float> const part = slice(view, slice_range(splits, i));
            EXPECT_TRUE(laws::is_map_of(boxes[i], sun, clip));
            EXPECT_TRUE(laws::is_map_of(spheres[i], sun, clip));
            // As deep as the slice, whatever the sides.
            EXPECT_NEAR(glm::length(Vec3<float>(row(spheres[i], 2))) / glm::length(Vec3<float>(row(boxes[i], 2))), 1.0f,
                        1e-5f);
            EXPECT_TRUE(laws::holds_corners(boxes[i], clip, part, 0.02L));
            EXPECT_TRUE(laws::is_filled(boxes[i], clip, part, 0.01f));
            EXPECT_TRUE(laws::is_on_the_grid(spheres[i], basis, part, 512, 2.0f, clip));
        }
    }
}

// From 5e8 m away the rounding of an axis 1e12 long would leave a map no extent.
TEST(Slices, OfAViewThatIsCentredOnOneAxisAloneHoldTheirCorners) {
    LightBasis<float> const basis = light_basis(directional(Vec3<float>(0.4f, -1, 0.3f)).direction);
    Splits<float> const splits = practical_splits(0.1f, 60.0f, 4);
    for (int axis = 0; axis < 2; ++axis) {
        ViewVolume<float> view = some_view();
        (axis == 0 ? view.left : view.bottom) *= 0.2f;
        Mat4<float> spheres[max_splits];
        ASSERT_TRUE(fit_slice_spheres(view, basis, splits, 512, 2.0f, gl_clip, spheres));
        for (int i = 0; i < 4; ++i)
            EXPECT_TRUE(
                laws::is_on_the_grid(spheres[i], basis, slice(view, slice_range(splits, i)), 512, 2.0f, gl_clip));
    }
}

TEST(Slices, OfAnOrthographicViewThatIsCentredStandOnTheGrid) {
    LightBasis<float> const basis = light_basis(directional(Vec3<float>(0.4f, -1, 0.3f)).direction);
    ViewVolume<float> const view = orthographic_view(some_view().pose, -8.0f, 8.0f, -5.0f, 5.0f, 0.1f, 60.0f);
    Splits<float> const splits = uniform_splits(0.1f, 60.0f, 4);
    Mat4<float> spheres[max_splits];
    ASSERT_TRUE(fit_slice_spheres(view, basis, splits, 512, 2.0f, gl_clip, spheres));
    for (int i = 0; i < 4; ++i)
        EXPECT_TRUE(laws::is_on_the_grid(spheres[i], basis, slice(view, slice_range(splits, i)), 512, 2.0f, gl_clip));
}

TEST(Slices, AreMadeForAsManySplitsAsThereCanBe) {
    LightBasis<float> const basis;
    for (int const count : {1, max_splits}) {
        Splits<float> const splits = uniform_splits(0.1f, 60.0f, count);
        Mat4<float> maps[max_splits];
        EXPECT_TRUE(fit_slice_boxes(some_view(), basis, splits, 0.0f, gl_clip, maps));
        EXPECT_TRUE(fit_slice_spheres(some_view(), basis, splits, 512, 2.0f, gl_clip, maps));
    }
}

TEST(Slices, MayBeginAtTheEye) {
    LightBasis<float> const basis;
    Splits<float> splits = uniform_splits(0.1f, 60.0f, 4);
    splits.plane[0] = 0.0f;
    Mat4<float> maps[max_splits];
    EXPECT_TRUE(fit_slice_boxes(some_view(), basis, splits, 0.0f, gl_clip, maps));
    EXPECT_TRUE(fit_slice_spheres(some_view(), basis, splits, 512, 2.0f, gl_clip, maps));
}

// A coordinate of 2^51 texels can be counted no more: along either axis, in a view that is centred or not.
TEST(Slices, WhoseTexelsCannotBeCountedAreNowhere) {
    LightBasis<float> const basis = light_basis(directional(Vec3<float>(0.4f, -1, 0.3f)).direction);
    Splits<float> const splits = practical_splits(0.1f, 60.0f, 4);
    for (Vec3<float> const& axis : {basis.x, basis.y, -basis.x, -basis.y})
        for (float const left : {1.0f, 0.5f}) {
            ViewVolume<float> view = some_view();
            view.left *= left;
            Mat4<float> maps[max_splits];
            view.pose.position = axis * 1e9f;
            EXPECT_TRUE(fit_slice_spheres(view, basis, splits, 512, 2.0f, gl_clip, maps));
            view.pose.position = axis * 1e17f;
            EXPECT_FALSE(fit_slice_spheres(view, basis, splits, 512, 2.0f, gl_clip, maps));
            for (int i = 0; i < 4; ++i) EXPECT_EQ(maps[i], nowhere<float>());
        }
}

// What is far out along both axes at once, where counting in 32 bits would overflow.
TEST(Slices, FarOutAlongBothAxesStandOnTheGrid) {
    LightBasis<double> const basis = light_basis(directional(Vec3<double>(0.4, -1, 0.3)).direction);
    Splits<double> const splits = practical_splits(0.1, 60.0, 4);
    for (double const sign : {1.0, -1.0}) {
        Pose<double> const pose =
            pose_looking((basis.x + basis.y * sign) * 1e9, Vec3<double>(0.1, -0.2, -1), Vec3<double>(0, 1, 0));
        ViewVolume<double> const view = perspective_view(pose, 1.0, 1.5, 0.1, 60.0);
        Mat4<double> maps[max_splits];
        ASSERT_TRUE(fit_slice_spheres(view, basis, splits, 512, 2.0, gl_clip, maps));
        for (int i = 0; i < 4; ++i)
            EXPECT_TRUE(laws::is_on_the_grid(maps[i], basis, slice(view, slice_range(splits, i)), 512, 2.0, gl_clip));
    }
}

TEST(Slices, OfALightWithoutUnitAxesAreNowhere) {
    ViewVolume<float> view = some_view();
    Splits<float> const splits = uniform_splits(0.1f, 60.0f, 2);
    for (float const length : {2.5f, 1e12f, std::numeric_limits<float>::infinity()})
        for (int axis = 0; axis < 9; ++axis) {
            LightBasis<float> basis;
            (axis < 3 ? basis.x : axis < 6 ? basis.y : basis.depth)[axis % 3] = length;
            view.pose.position.x = 5.5994e8f;
            expect_nowhere(view, basis, splits, 0.0f);
        }
    Mat4<float> maps[max_splits];
    for (float const border : {0.0f, 0.49f})
        EXPECT_TRUE(fit_slice_boxes(some_view(), LightBasis<float>{}, splits, border, gl_clip, maps));
}

TEST(Slices, OfNoViewNoSplitsOrNoRoomAreNowhere) {
    LightBasis<float> const basis;
    Splits<float> const splits = uniform_splits(0.1f, 60.0f, 2);
    ViewVolume<float> crossed = some_view();
    std::swap(crossed.left, crossed.right);
    expect_nowhere(crossed, basis, splits, 0.0f);
    ViewVolume<float> upside_down = some_view();
    upside_down.top = upside_down.bottom;
    expect_nowhere(upside_down, basis, splits, 0.0f);
    ViewVolume<float> without_width = some_view();
    without_width.left = without_width.right;
    expect_nowhere(without_width, basis, splits, 0.0f);
    Splits<float> const four = uniform_splits(0.1f, 60.0f, 4);
    for (int k = 0; k < 4; ++k) {
        Splits<float> flat = four;
        flat.plane[k + 1] = flat.plane[k];
        expect_nowhere(some_view(), basis, flat, 0.0f);
    }
    ViewVolume<float> wide = some_view();
    wide.right = wide.top = 1e8f, wide.left = wide.bottom = -1e8f;
    Splits<float> const deep = uniform_splits(0.1f, 1e11f, 2);
    Mat4<float> balls[max_splits];
    EXPECT_FALSE(fit_slice_spheres(wide, basis, deep, 512, 2.0f, gl_clip, balls));
    EXPECT_EQ(balls[0], nowhere<float>());
    ViewVolume<float> beyond = some_view();
    beyond.pose.position.z = 0x1p61f;
    expect_nowhere(beyond, basis, splits, 0.0f);
    for (float const border : {-0.01f, 0.5f, std::numeric_limits<float>::quiet_NaN()}) {
        Mat4<float> maps[max_splits];
        EXPECT_FALSE(fit_slice_boxes(some_view(), basis, splits, border, gl_clip, maps));
        EXPECT_EQ(maps[1], nowhere<float>());
    }
    Mat4<float> maps[max_splits];
    EXPECT_FALSE(fit_slice_spheres(some_view(), basis, splits, 4, 2.0f, gl_clip, maps));
    EXPECT_EQ(maps[1], nowhere<float>());
    Splits<float> unordered = splits;
    unordered.plane[1] = unordered.plane[2];
    expect_nowhere(some_view(), basis, unordered, 0.0f);
    unordered = splits;
    unordered.plane[0] = -1;
    expect_nowhere(some_view(), basis, unordered, 0.0f);
    unordered = splits;
    unordered.plane[2] = std::numeric_limits<float>::infinity();
    expect_nowhere(some_view(), basis, unordered, 0.0f);
    unordered = splits;
    unordered.count = 0;
    EXPECT_FALSE(fit_slice_boxes(some_view(), basis, unordered, 0.0f, gl_clip, maps));
}
