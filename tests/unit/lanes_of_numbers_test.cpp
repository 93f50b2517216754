// SPDX-License-Identifier: MIT
//
// The words of lanes for a single number, so that a formula can be written once for one and for sixteen.
#include <shadowmath/irregular/lanes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

using namespace shadowmath;

TEST(LanesOfNumbers, MeanOfOneWhatTheyMeanOfSixteen) {
    for (double const a : {-3.0, 0.5, 8.0})
        for (double const b : {-2.0, 0.25, 5.0})
            for (double const c : {-7.0, 0.0, 1.5}) {
                auto const all = [](double value) { return PlainLanes<double>::all(value); };
                EXPECT_EQ(detail::fused(a, b, c), a * b + c);
                EXPECT_EQ(fused(all(a), all(b), all(c)).lane[5], a * b + c);
                EXPECT_EQ(detail::absolute(a), absolute(all(a)).lane[5]);
                EXPECT_EQ(detail::with_sign_of(a, b), with_sign_of(all(a), all(b)).lane[5]);
                EXPECT_EQ(detail::with_sign_of(a, b), std::copysign(a, b));
            }
}

TEST(LanesOfNumbers, TheBestOfDoublesAreArrays) {
    EXPECT_TRUE((std::is_same_v<BestLanes<double>, PlainLanes<double>>));
    EXPECT_TRUE((std::is_same_v<BestLanes<long double>, PlainLanes<long double>>));
}
