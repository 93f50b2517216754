// SPDX-License-Identifier: MIT
#include "tests/laws/view_volume.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/projections.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class ViewVolumeProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ViewVolumeProperty, Scalars);

TYPED_TEST(ViewVolumeProperty, PosesAreOrthonormalForEveryFiniteInput) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Vec3<T> const position = *point_within<T>(T(10));
        bool const nasty_axes = *one_in(2);
        Vec3<T> const forward = nasty_axes ? *nasty_vec3<T>() : *direction<T>();
        Vec3<T> const rough_up = nasty_axes ? *nasty_vec3<T>() : *direction<T>();
        RC_ASSERT(laws::is_orthonormal(pose_looking(position, forward, rough_up)));
    }));
}

TYPED_TEST(ViewVolumeProperty, PosesAreOrthonormalWhenUpIsAlmostForward) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Vec3<T> const forward = *direction<T>();
        Vec3<T> const aside = *direction<T>();
        T const tilt = *log_uniform<T>(std::numeric_limits<T>::epsilon(), T(0.1));
        RC_ASSERT(laws::is_orthonormal(pose_looking(Vec3<T>(T(0)), forward, forward + aside * tilt)));
    }));
}

TYPED_TEST(ViewVolumeProperty, ASlightlyBentPoseIsMendedAndKeepsItsForwardAxis) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Pose<T> const straight = *pose<T>(T(10));
        Vec3<T> const bend_right = *point_within<T>(T(2e-4));
        Vec3<T> const bend_up = *point_within<T>(T(2e-4));
        Pose<T> bent = straight;
        bent.right += bend_right;
        bent.up += bend_up;
        Pose<T> const mended = orthonormalized(bent);
        RC_ASSERT(laws::is_orthonormal(mended));
        RC_ASSERT(glm::length(mended.forward - bent.forward) <= T(4) * std::numeric_limits<T>::epsilon());
        RC_ASSERT(glm::length(mended.up - bent.up) <= T(2e-3));
    }));
}

TYPED_TEST(ViewVolumeProperty, CornersAreAccurate) {
    EXPECT_TRUE(rc::check([] {
        auto const view = *view_volume<TypeParam>();
        RC_ASSERT(laws::has_accurate_corners(view));
        RC_ASSERT(watched([&view] { return corners(view); }).calm_in_range());
    }));
}

TYPED_TEST(ViewVolumeProperty, TheEyesMatrixFillsTheClipVolumeInEveryConvention) {
    EXPECT_TRUE(rc::check([] {
        auto view = *view_volume<TypeParam>();
        bool const at_origin = *one_in(2);
        if (at_origin) view.pose.position = Vec3<TypeParam>(TypeParam(0));
        ClipSpace const clip = *clip_space();
        RC_ASSERT(laws::fills_the_clip_volume(view, clip));
        RC_ASSERT(watched([&view, clip] { return clip_from_world(view, clip); }).calm_in_range());
    }));
}

TYPED_TEST(ViewVolumeProperty, TheSameSidesAreReadFromEveryProjection) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const view = *view_volume<T>();
        bool const flat = view.kind == ViewKind::orthographic;
        Depth const depth = all_depths[*below(flat ? 3 : 5)];
        Hand const hand = *one_in(2) ? Hand::left : Hand::right;
        bool const y_flipped = *one_in(2);
        Mat4<T> const clip_from_view = projection_of(view, hand, depth, y_flipped);
        RC_ASSERT(laws::has_the_sides_of(read_back(view, clip_from_view), view));
    }));
}

TYPED_TEST(ViewVolumeProperty, PointsAreAtTheDepthTheyWereAskedFor) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const view = *view_volume<T>();
        T const depth = *uniform<T>(view.z_near, view.z_far);
        Vec3<T> const point = point_at(view, view.right, view.bottom, depth);
        // Sums of three products, three times over: 16 roundings of what they sum.
        T const reach = glm::length(point) + glm::length(view.pose.position) + glm::length(point - view.pose.position);
        RC_ASSERT(std::abs(eye_depth(view, point) - depth) <= T(16) * std::numeric_limits<T>::epsilon() * reach);
    }));
}

TYPED_TEST(ViewVolumeProperty, AnythingAtAllIsJudgedWithoutATrap) {
    EXPECT_TRUE(rc::check([] {
        auto const view = *nasty_view_volume<TypeParam>();
        RC_ASSERT(watched([&view] { return faults_of(view); }).calm());
    }));
}
