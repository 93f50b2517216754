// SPDX-License-Identifier: MIT
#include "tests/laws/slice.hpp"
#include "tests/support/gen.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class SliceProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SliceProperty, Scalars);

TYPED_TEST(SliceProperty, SlicesCoverTheViewForEveryBlend) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ViewVolume<T> const view = *view_volume<T>();
        int const count = 1 + static_cast<int>(*below(max_splits));
        T const lambda = *uniform<T>(T(0), T(1));
        bool const nasty_blend = *one_in(4);
        T const blend = nasty_blend ? *nasty<T>() : *uniform<T>(T(0), T(1));
        Splits<T> const splits = practical_splits(view.z_near, view.z_far, count, lambda);
        RC_ASSERT(laws::slices_cover(splits, blend));
        for (int i = 0; i < splits.count; ++i)
            RC_ASSERT(laws::is_a_part_of(slice(view, slice_range(splits, i, blend)), view));
    }));
}
