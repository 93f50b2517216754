// SPDX-License-Identifier: MIT
#include "tests/laws/projected_bounds.hpp"
#include "tests/support/any_map.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class ProjectedBoundsProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ProjectedBoundsProperty, Scalars);

namespace {

template <class T>
std::array<T, 8> weights() {
    std::array<T, 8> weight;
    for (T& share : weight) share = *log_uniform<T>(T(1e-4), T(1));
    return weight;
}

}  // namespace

TYPED_TEST(ProjectedBoundsProperty, LoseNoPointInFrontOfAnyView) {
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

TYPED_TEST(ProjectedBoundsProperty, OfAnyMatrixAndAnyBoxAreFiniteOrEmptyAndCalm) {
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

TYPED_TEST(ProjectedBoundsProperty, OfManyBoxesAreThoseOfEachMerged) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        bool const flat = *one_in(2);
        ViewVolume<T> const view = *view_volume<T>();
        AnyMap<T> const map = *any_directional_map<T>();
        Mat4<T> const clip = flat ? map.map.clip_from_world : clip_from_world(view, ClipSpace{});
        T const w_min = flat || view.kind != ViewKind::perspective ? T(0.1) : view.z_near;
        auto const count = static_cast<int>(*below(70));
        T const radius = *log_uniform<T>(T(0.1), T(100));
        std::vector<Aabb<T>> boxes;
        std::vector<T> columns[6];
        for (int i = 0; i < count; ++i) {
            Vec3<T> const centre = *point_within<T>(world_radius<T>);
            Aabb<T> const drawn = *box<T>(radius);
            bool const odd = *one_in(40);
            boxes.push_back(odd ? *nasty_box<T>() : Aabb<T>{drawn.lo + centre, drawn.hi + centre});
            // Sizes of 1e30 make a tolerance that nothing can miss.
            if (all_finite(boxes.back()) && detail::largest_of(boxes.back()) > T(1e9)) boxes.back() = Aabb<T>{};
            for (int axis = 0; axis < 3; ++axis) {
                columns[axis].push_back(boxes.back().lo[axis]);
                columns[axis + 3].push_back(boxes.back().hi[axis]);
            }
        }
        BoxArrays<T> const arrays{columns[0].data(), columns[1].data(), columns[2].data(),
                                  columns[3].data(), columns[4].data(), columns[5].data()};
        Aabb<T> const together = projected_bounds(clip, arrays, count, w_min);
        RC_ASSERT(laws::are_the_merged_bounds(clip, boxes.data(), count, w_min, together));
    }));
}
