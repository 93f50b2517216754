// SPDX-License-Identifier: MIT
#include "tests/laws/finite.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;

template <class T>
class Finite : public ::testing::Test {};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(Finite, Scalars);

TYPED_TEST(Finite, KnowsTheEdgesOfTheRange) {
    using T = TypeParam;
    using Limits = std::numeric_limits<T>;
    for (T const value : {T(0), -T(0), T(1), Limits::denorm_min(), -Limits::denorm_min(), Limits::min(), Limits::max(),
                          Limits::lowest(), Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()})
        EXPECT_TRUE(laws::tells_numbers_apart(value)) << value;
}

TYPED_TEST(Finite, SeesOneBadNumberAtEveryPlaceOfAVectorAndAMatrix) {
    using T = TypeParam;
    EXPECT_TRUE(all_finite(Mat4<T>(T(1))));
    for (int column = 0; column < 4; ++column)
        for (int r = 0; r < 4; ++r)
            for (T const bad : {std::numeric_limits<T>::quiet_NaN(), -std::numeric_limits<T>::infinity()}) {
                Mat4<T> m(T(1));
                m[column][r] = bad;
                EXPECT_FALSE(all_finite(m)) << column << " " << r;
                EXPECT_FALSE(all_finite(m[column]));
                EXPECT_EQ(all_finite(Vec3<T>(m[column])), r >= 3);
                EXPECT_EQ(all_finite(Vec2<T>(m[column])), r >= 2);
            }
}

TYPED_TEST(Finite, ZeroHasNoDirection) {
    using T = TypeParam;
    EXPECT_TRUE(laws::normalizes(Vec3<T>(T(0))));
    EXPECT_TRUE(laws::normalizes(Vec3<T>(-T(0), T(0), -T(0))));
}

TYPED_TEST(Finite, NormalizesVectorsOfTheSmallestAndTheLargestNumbers) {
    using T = TypeParam;
    using Limits = std::numeric_limits<T>;
    if constexpr (std::is_same_v<T, long double>) {
        // Its own square would overflow in the law.
        EXPECT_TRUE(laws::normalizes(Vec3<T>(T(3), T(4), T(12))));
    } else {
        for (T const size :
             {Limits::denorm_min(), Limits::min(), T(1e-30), T(1e30), Limits::max() / T(4), Limits::max()}) {
            EXPECT_TRUE(laws::normalizes(Vec3<T>(size, -size, size))) << size;
            EXPECT_TRUE(laws::normalizes(Vec3<T>(size, T(0), T(0)))) << size;
        }
        EXPECT_EQ(safe_normalize(Vec3<T>(T(3), T(0), T(4))).length, T(5));
    }
}

TYPED_TEST(Finite, AHypotenuseOfTheSmallestAndTheLargestSidesIsRightToAnUlp) {
    using T = TypeParam;
    using Limits = std::numeric_limits<T>;
    EXPECT_EQ(detail::hypotenuse(T(3), T(-4)), T(5));
    EXPECT_EQ(detail::hypotenuse(T(0), T(0)), T(0));
    if constexpr (!std::is_same_v<T, long double>)
        for (T const size : {Limits::denorm_min(), Limits::min(), T(1e-20), T(1e20), Limits::max() / T(2)})
            for (T const share : {T(0), T(1e-7), T(0.3), T(1)}) {
                T const other = size * share;
                EXPECT_TRUE(laws::is_hypotenuse(detail::hypotenuse(size, other), size, other)) << size << " " << other;
                EXPECT_TRUE(laws::is_hypotenuse(detail::hypotenuse(-other, size), -other, size)) << size;
            }
}

TYPED_TEST(Finite, LooksAtAsManyNumbersAsItIsToldTo) {
    using T = TypeParam;
    T const numbers[] = {T(1), T(2), std::numeric_limits<T>::quiet_NaN()};
    EXPECT_TRUE(all_finite(numbers, 0));
    EXPECT_TRUE(all_finite(numbers, 2));
    EXPECT_FALSE(all_finite(numbers, 3));
}
