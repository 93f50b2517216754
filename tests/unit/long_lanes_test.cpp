// SPDX-License-Identifier: MIT
//
// Compiled twice: for the oldest processor, where a register holds four, and for this one.
#include <shadowmath/long_lanes.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;

namespace {

template <class T>
using Long = detail::LongLanes<T>;
template <class T>
constexpr int lane_count = 4 * Long<T>::fours;

template <class T>
T lane(Long<T> const& lanes, int i) {
    T values[lane_count<T>];
    std::memcpy(values, &lanes, sizeof values);
    return values[i];
}

template <class T>
Long<T> counted(T first, T step) {
    T values[lane_count<T>];
    for (int i = 0; i < lane_count<T>; ++i) values[i] = first + step * T(i);
    return detail::long_at<Long<T>>(values);
}

template <class T>
void expect_lane_by_lane() {
    Long<T> const x = counted<T>(T(-1), T(0.75)), y = counted<T>(T(3), T(-0.5));
    for (int i = 0; i < lane_count<T>; ++i) {
        T const a = lane<T>(x, i), b = lane<T>(y, i);
        EXPECT_EQ(a, T(-1) + T(0.75) * T(i));
        EXPECT_EQ(lane<T>(x + y, i), a + b);
        EXPECT_EQ(lane<T>(x - y, i), a - b);
        EXPECT_EQ(lane<T>(x * y, i), a * b);
        EXPECT_EQ(lane<T>(least(x, y), i), a < b ? a : b);
        EXPECT_EQ(lane<T>(largest(x, y), i), a > b ? a : b);
        EXPECT_EQ(lane<T>(where_at_most(x, y, y, x), i), a <= b ? b : a);
        EXPECT_EQ(lane<T>(where_at_most(x, x, y, x), i), b) << "alike is at most";
        EXPECT_EQ(lane<T>(Long<T>::all(T(7)), i), T(7));
    }
}

template <class T>
void expect_fours_and_numbers_to_be_spread() {
    auto const four = detail::Lanes<T>::of(T(2), T(3), T(5), T(7));
    for (int i = 0; i < lane_count<T>; ++i) EXPECT_EQ(lane<T>(detail::repeated<Long<T>>(four), i), four[i % 4]);
    for (int first = 0; first < 4; first += Long<T>::fours)
        for (int i = 0; i < lane_count<T>; ++i)
            EXPECT_EQ(lane<T>(detail::spread<Long<T>>(four, first), i), four[first + i / 4]);
}

template <class T>
void expect_fours_to_be_joined() {
    detail::Lanes<T> four[4];
    for (int i = 0; i < 4; ++i) four[i] = detail::Lanes<T>::of(T(4 * i), T(4 * i + 1), T(4 * i + 2), T(4 * i + 3));
    auto const last = detail::Lanes<T>::of(T(-1), T(-2), T(-3), T(-4));
    Long<T> const joined = detail::joined<Long<T>>(four), ended = detail::with_last(joined, last);
    for (int i = 0; i < lane_count<T>; ++i) {
        int const from_last = i - (lane_count<T> - 4);
        EXPECT_EQ(lane<T>(joined, i), T(i));
        EXPECT_EQ(lane<T>(ended, i), from_last < 0 ? T(i) : last[from_last]);
    }
}

}  // namespace

TEST(LongLanes, JoinFours) {
    expect_fours_to_be_joined<float>();
    expect_fours_to_be_joined<double>();
}

TEST(LongLanes, ComputeLaneByLane) {
    expect_lane_by_lane<float>();
    expect_lane_by_lane<double>();
}

TEST(LongLanes, RepeatAFourAndSpreadItsNumbers) {
    expect_fours_and_numbers_to_be_spread<float>();
    expect_fours_and_numbers_to_be_spread<double>();
}
