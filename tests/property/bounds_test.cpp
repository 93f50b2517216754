// SPDX-License-Identifier: MIT
#include "tests/laws/bounds.hpp"
#include "tests/support/gen.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class AabbProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(AabbProperty, Scalars);

TYPED_TEST(AabbProperty, BoxesAreSetsOfPoints) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Aabb<T> const a = *box<T>(T(10));
        Aabb<T> const b = *box<T>(T(10));
        Vec3<T> const point = *point_within<T>(T(15));
        RC_ASSERT(laws::merging_with_nothing_changes_nothing(a));
        RC_ASSERT(laws::merges(a, b, point));
        RC_ASSERT(laws::intersects(a, b, point));
        RC_ASSERT(laws::has_numbered_corners(a));
    }));
}

TYPED_TEST(AabbProperty, NoPointLiesInAnEmptyBoxHoweverNasty) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Aabb<T> const bad = *nasty_box<T>();
        Vec3<T> const point = *nasty_vec3<T>();
        RC_ASSERT(!(is_empty(bad) && contains(bad, point)));
        RC_ASSERT(!is_empty(bad) || is_empty(intersect(bad, Aabb<T>{point, point})));
    }));
}
