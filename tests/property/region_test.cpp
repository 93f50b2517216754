// SPDX-License-Identifier: MIT
#include "tests/laws/region.hpp"
#include "tests/support/gen.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class RegionProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(RegionProperty, Scalars);

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
