// SPDX-License-Identifier: MIT
#include "tests/laws/fit_sphere.hpp"
#include "tests/support/gen.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class FitSphereProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(FitSphereProperty, Scalars);

TYPED_TEST(FitSphereProperty, ContainsEveryCornerOfTheSlice) {
    EXPECT_TRUE(rc::check([] {
        auto const slice = *view_volume<TypeParam>();
        RC_ASSERT(laws::holds_every_corner(slice));
    }));
}

TYPED_TEST(FitSphereProperty, IsTheSmallest) {
    EXPECT_TRUE(rc::check([] {
        auto const slice = *view_volume<TypeParam>();
        RC_ASSERT(laws::no_other_centre_needs_less(slice));
    }));
}

TYPED_TEST(FitSphereProperty, HasTheSameRadiusWhereverTheCameraStands) {
    EXPECT_TRUE(rc::check([] {
        auto const slice = *view_volume<TypeParam>();
        auto const other = *pose<TypeParam>(world_radius<TypeParam>);
        RC_ASSERT(laws::has_the_same_radius_from(slice, other));
    }));
}

TYPED_TEST(FitSphereProperty, IsFiniteForAnyNumbersAtAll) {
    EXPECT_TRUE(rc::check([] {
        auto const slice = *nasty_view_volume<TypeParam>();
        RC_ASSERT(laws::is_finite_or_nothing(slice));
    }));
}
