// SPDX-License-Identifier: MIT
#include <shadowmath/reach.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace shadowmath;

template <class T>
class Reach : public ::testing::Test {
public:
    template <class Bits>
    static bool top_bit(Bits bits) {
        return (bits >> (8 * sizeof bits - 1)) != 0;
    }
};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(Reach, Scalars);

TYPED_TEST(Reach, EndsBeforeTwoToTheSixtiethAndHoldsNoInfinityAndNoNaN) {
    using T = TypeParam;
    T const end = T(0x1p60L), infinity = std::numeric_limits<T>::infinity();
    for (T const inside : {T(0), T(1), std::numeric_limits<T>::denorm_min(), std::nextafter(end, T(0))})
        EXPECT_FALSE(this->top_bit(detail::beyond_reach(inside))) << inside;
    for (T const outside : {end, std::numeric_limits<T>::max(), infinity, std::numeric_limits<T>::quiet_NaN()})
        EXPECT_TRUE(this->top_bit(detail::beyond_reach(outside))) << outside;
}

TYPED_TEST(Reach, FromOneNumberToAnotherHoldsBothAndNothingElse) {
    using T = TypeParam;
    T const lo = T(0.5), hi = T(3);
    for (T const inside : {lo, T(1), hi}) EXPECT_FALSE(this->top_bit(detail::beyond(inside, lo, hi))) << inside;
    for (T const outside : {T(0), T(-1), std::nextafter(lo, T(0)), std::nextafter(hi, T(4)),
                            std::numeric_limits<T>::infinity(), std::numeric_limits<T>::quiet_NaN()})
        EXPECT_TRUE(this->top_bit(detail::beyond(outside, lo, hi))) << outside;
}

TYPED_TEST(Reach, OrderIsThatOfTheNumbersWithNaNAboveAll) {
    using T = TypeParam;
    T const rising[] = {T(0), std::numeric_limits<T>::denorm_min(), T(0.5),
                        T(1), std::numeric_limits<T>::max(),        std::numeric_limits<T>::infinity()};
    for (std::size_t i = 1; i < std::size(rising); ++i)
        EXPECT_LT(detail::order_of(rising[i - 1]), detail::order_of(rising[i]));
    EXPECT_EQ(detail::order_of(-T(0)), detail::order_of(T(0)));
    EXPECT_LT(detail::order_of(T(-1)), detail::order_of(T(0)));
    EXPECT_GE(detail::order_of(std::numeric_limits<T>::quiet_NaN()),
              detail::order_of(std::numeric_limits<T>::infinity()));
}

TYPED_TEST(Reach, AxesAreUnitToAThousandth) {
    using T = TypeParam;
    EXPECT_TRUE(detail::has_unit_axes(LightBasis<T>{}));
    for (Vec3<T> LightBasis<T>::*axis : {&LightBasis<T>::x, &LightBasis<T>::y, &LightBasis<T>::depth}) {
        for (T const length : {T(0), T(0.99), T(1.01), T(2.5), std::numeric_limits<T>::quiet_NaN()}) {
            LightBasis<T> basis;
            basis.*axis *= length;
            EXPECT_FALSE(detail::has_unit_axes(basis)) << length;
        }
        LightBasis<T> basis;
        basis.*axis *= T(1.0004L);
        EXPECT_TRUE(detail::has_unit_axes(basis));
    }
}

TYPED_TEST(Reach, TheLargerOfTwoIsTheOneThatIsANumber) {
    using T = TypeParam;
    T const nan = std::numeric_limits<T>::quiet_NaN();
    EXPECT_EQ(detail::larger(T(2), T(1)), T(2));
    EXPECT_EQ(detail::larger(T(1), T(2)), T(2));
    EXPECT_EQ(detail::larger(nan, T(1)), T(1));
    EXPECT_EQ(detail::larger(T(1), nan), T(1));
}
