// SPDX-License-Identifier: MIT
#include "tests/laws/finite.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class FiniteProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(FiniteProperty, Scalars);

TYPED_TEST(FiniteProperty, AgreesWithTheDefinitionOnAnyBitPattern) {
    EXPECT_TRUE(rc::check([] {
        TypeParam const value = *nasty<TypeParam>();
        RC_ASSERT(laws::tells_numbers_apart(value));
    }));
}

TYPED_TEST(FiniteProperty, NormalizesEveryFiniteVector) {
    EXPECT_TRUE(rc::check([] {
        Vec3<TypeParam> const v = *nasty_vec3<TypeParam>();
        RC_PRE(all_finite(v));
        RC_ASSERT(laws::normalizes(v));
        RC_ASSERT(watched([&v] { return safe_normalize(v); }).calm());
    }));
}

TYPED_TEST(FiniteProperty, TheHypotenuseOfFiniteSidesIsRightToAnUlp) {
    EXPECT_TRUE(rc::check([] {
        TypeParam const a = *nasty<TypeParam>(), b = *nasty<TypeParam>();
        RC_PRE(all_finite(&a, 1) && all_finite(&b, 1));
        RC_ASSERT(laws::is_hypotenuse(detail::hypotenuse(a, b), a, b));
    }));
}
