// SPDX-License-Identifier: MIT
#include <shadowmath/lanes.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;

namespace {

// Register or array, every operation lane by lane.
template <class T>
void expect_four_numbers() {
    using Lanes = detail::Lanes<T>;
    T const a[4] = {T(1.5), T(-2), T(0.25), T(7)}, b[4] = {T(3), T(-2), T(8), T(-0.5)};
    Lanes const x = Lanes::of(a[0], a[1], a[2], a[3]), y = Lanes::of(b[0], b[1], b[2], b[3]);
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ((x + y)[i], a[i] + b[i]);
        EXPECT_EQ((x - y)[i], a[i] - b[i]);
        EXPECT_EQ((x * y)[i], a[i] * b[i]);
        EXPECT_EQ((x / y)[i], a[i] / b[i]);
        EXPECT_EQ(least(x, y)[i], a[i] < b[i] ? a[i] : b[i]);
        EXPECT_EQ(largest(x, y)[i], a[i] > b[i] ? a[i] : b[i]);
        EXPECT_EQ(detail::all_four(T(3))[i], T(3));
    }
}

}  // namespace

TEST(Lanes, AreFourNumbersOfAnyType) {
    expect_four_numbers<float>();
    expect_four_numbers<double>();
    expect_four_numbers<long double>();
}
