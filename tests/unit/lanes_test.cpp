// SPDX-License-Identifier: MIT
#include "tests/support/watched.hpp"

#include <shadowmath/lanes.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace shadowmath;
using shadowmath::test::watched;

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
        EXPECT_EQ(where_at_most(x, y, x + y, x - y)[i], a[i] <= b[i] ? a[i] + b[i] : a[i] - b[i]);
        EXPECT_EQ(root(x * x)[i], a[i] < T(0) ? -a[i] : a[i]);
    }
}

template <class T>
void expect_reach_of_each_lane() {
    using Lanes = detail::Lanes<T>;
    T const infinity = std::numeric_limits<T>::infinity(), nan = std::numeric_limits<T>::quiet_NaN();
    auto const beyond = [](bool parts, int lane, T value) {
        T of[4] = {T(0), T(-1), T(1.5), T(-0.25)};
        of[lane] = value;
        detail::BeyondReach<T> reach;
        parts ? reach.look_at_parts(Lanes::of(of[0], of[1], of[2], of[3]))
              : reach.look_at(Lanes::of(of[0], of[1], of[2], of[3]));
        return reach.any();
    };
    EXPECT_FALSE(detail::BeyondReach<T>{}.any());
    for (int lane = 0; lane < 4; ++lane)
        for (T const sign : {T(1), T(-1)}) {
            for (T const outside : {T(0x1p60L), std::numeric_limits<T>::max(), infinity, nan}) {
                EXPECT_TRUE(beyond(false, lane, sign * outside)) << lane << ' ' << outside;
                EXPECT_TRUE(beyond(true, lane, sign * outside)) << lane << ' ' << outside;
            }
            for (T const inside : {T(0), std::numeric_limits<T>::denorm_min(), T(1.99)}) {
                EXPECT_FALSE(beyond(false, lane, sign * inside)) << lane << ' ' << inside;
                EXPECT_FALSE(beyond(true, lane, sign * inside)) << lane << ' ' << inside;
            }
            EXPECT_FALSE(beyond(false, lane, sign * T(0x1.fp59L)));
            EXPECT_TRUE(beyond(true, lane, sign * T(2)));
        }
}

// Whatever it was before.
template <class T>
void expect_to_be_brought_between() {
    T const infinity = std::numeric_limits<T>::infinity(), nan = std::numeric_limits<T>::quiet_NaN();
    auto const brought = [](T a, T b, T c, T d) {
        auto const by = watched([&] { return between(detail::Lanes<T>::of(a, b, c, d), T(0.5), T(1e18L)); });
        EXPECT_EQ(by.raised, 0);
        return by.result;
    };
    auto const numbers = brought(T(0.25), T(0.75), T(-3), T(2e18L));
    EXPECT_EQ(numbers[0], T(0.5));
    EXPECT_EQ(numbers[1], T(0.75));
    EXPECT_EQ(numbers[2], T(0.5));
    EXPECT_EQ(numbers[3], T(1e18L));
    auto const none = brought(nan, infinity, -infinity, -T(0));
    EXPECT_EQ(none[0], T(1e18L));
    EXPECT_EQ(none[1], T(1e18L));
    EXPECT_EQ(none[2], T(0.5));
    EXPECT_EQ(none[3], T(0.5));
}

template <class T>
void expect_moves() {
    using Lanes = detail::Lanes<T>;
    Lanes const four = Lanes::of(T(1), T(2), T(3), T(4));
    for (int i = 0; i < 4; ++i) EXPECT_EQ(moved_up(four, T(5))[i], T(i + 2));
    Lanes rows[4];
    for (int i = 0; i < 4; ++i) rows[i] = Lanes::of(T(4 * i), T(4 * i + 1), T(4 * i + 2), T(4 * i + 3));
    detail::transpose(rows);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) EXPECT_EQ(rows[i][j], T(4 * j + i));
}

}  // namespace

TEST(Lanes, AreBroughtBetweenBoundsWhateverTheyWere) {
    expect_to_be_brought_between<float>();
    expect_to_be_brought_between<double>();
    expect_to_be_brought_between<long double>();
}

TEST(Lanes, TellWhichOfThemIsBeyondReach) {
    expect_reach_of_each_lane<float>();
    expect_reach_of_each_lane<double>();
    expect_reach_of_each_lane<long double>();
}

TEST(Lanes, MoveUpAndChangePlaces) {
    expect_moves<float>();
    expect_moves<double>();
    expect_moves<long double>();
}

TEST(Lanes, AreFourNumbersOfAnyType) {
    expect_four_numbers<float>();
    expect_four_numbers<double>();
    expect_four_numbers<long double>();
}
