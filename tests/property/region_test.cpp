// SPDX-License-Identifier: MIT
#include "tests/laws/region.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class RegionProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(RegionProperty, Scalars);

namespace {

template <class T>
std::array<T, 8> weights() {
    std::array<T, 8> weight;
    for (T& share : weight) share = *log_uniform<T>(T(1e-4), T(1));
    return weight;
}

}  // namespace

TYPED_TEST(RegionProperty, FillsTheMap) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        T const x = *centred<T>(T(10));
        T const y = *centred<T>(T(10));
        T const width = *log_uniform<T>(T(1e-3), T(10));
        T const height = *log_uniform<T>(T(1e-3), T(10));
        RC_ASSERT(laws::fills_the_map(Region<T>{Vec2<T>(x, y), Vec2<T>(x + width, y + height)}));
    }));
}

TYPED_TEST(RegionProperty, BoundsLoseNoPointInFrontOfAnyView) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ViewVolume<T> const view = *view_volume<T>();
        Aabb<T> const body = *box<T>(world_radius<T>);
        T const w_min = view.kind == ViewKind::perspective ? view.z_near : T(0.5);
        std::array<T, 8> const weight = weights<T>();
        Mat4<T> const clip = clip_from_world(view, ClipSpace{});
        RC_ASSERT(laws::loses_no_point_in_front(clip, corners(body), w_min, weight));
    }));
}

TYPED_TEST(RegionProperty, BoundsOfAnyMatrixAndAnyBoxAreFiniteOrEmptyAndCalm) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        Mat4<T> matrix;
        for (int i = 0; i < 4; ++i) {
            Vec3<T> const three = *nasty_vec3<T>();
            T const fourth = *nasty<T>();
            matrix[i] = Vec4<T>(three, fourth);
        }
        bool const usual = *one_in(2);
        if (usual) {
            ViewVolume<T> const view = *view_volume<T>();
            matrix = clip_from_world(view, ClipSpace{});
        }
        Aabb<T> const body = *nasty_box<T>();
        T const w_min = *nasty<T>();
        auto const bounds = watched([&] { return projected_bounds(matrix, corners(body), w_min); });
        RC_ASSERT(bounds.calm());
        RC_ASSERT(all_finite(bounds.result));
    }));
}
