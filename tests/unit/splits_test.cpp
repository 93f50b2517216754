// SPDX-License-Identifier: MIT
#include "tests/laws/splits.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

using namespace shadowmath;

namespace {

template <class T>
std::vector<T> planes(Splits<T> const& splits) {
    return {splits.plane, splits.plane + splits.count + 1};
}

void expect_planes(Splits<double> const& splits, std::vector<double> const& wanted) {
    ASSERT_EQ(splits.count + 1, static_cast<int>(wanted.size()));
    for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(splits.plane[i], wanted[i], 4e-16 * wanted[i]) << i;
    EXPECT_FALSE(splits.faults.any());
}

}  // namespace

TEST(Splits, AreThoseOfTheChapterAtFullPrecision) {
    expect_planes(practical_splits(1.0, 1000.0, 4),
                  {1, 128.186706625951745, 266.061388300841897, 464.038970501946140, 1000});
    expect_planes(logarithmic_splits(1.0, 1000.0, 3), {1, 10, 100, 1000});
    expect_planes(practical_splits(1.0, 1000.0, 3), {1, 172, 383.5, 1000});
    expect_planes(uniform_splits(1.0, 1000.0, 3), {1, 334, 667, 1000});
}

TEST(Splits, OfTheLogarithmOccupyLessThanTheyEndAt) {
    Splits<double> const splits = logarithmic_splits(1.0, 1000.0, 3);
    EXPECT_NEAR((splits.plane[1] - splits.plane[0]) / 999, 0.00900900900900901, 1e-16);
    EXPECT_NEAR((splits.plane[2] - splits.plane[1]) / 999, 0.0900900900900901, 1e-15);
}

TEST(Splits, LambdaWeightsTheLogarithm) {
    EXPECT_LT(practical_splits(1.0, 1000.0, 3, 0.9).plane[1], practical_splits(1.0, 1000.0, 3, 0.1).plane[1]);
    EXPECT_NEAR(practical_splits(1.0, 1000.0, 3, 0.75).plane[1], 0.75 * 10 + 0.25 * 334, 1e-13);
}

TEST(Splits, OneSplitIsTheWholeRange) {
    EXPECT_EQ(planes(practical_splits(0.5f, 80.0f, 1)), (std::vector<float>{0.5f, 80.0f}));
    EXPECT_FALSE(practical_splits(0.5f, 80.0f, 1).faults.any());
}

TEST(Splits, NoneAskedForNoneGiven) {
    EXPECT_EQ(practical_splits(0.5f, 80.0f, 0).count, 0);
    EXPECT_FALSE(practical_splits(0.5f, 80.0f, 0).faults.any());
}

TEST(Splits, EndExactlyAtFarWhateverThePowerRoundsTo) {
    for (int count = 1; count <= max_splits; ++count)
        for (float far_end = 1.1f; far_end < 1e6f; far_end *= 1.37f)
            EXPECT_TRUE(laws::is_ordered(logarithmic_splits(0.3f, far_end, count), 0.3f, far_end, count));
}

TEST(Splits, ARangeOfThreeNumbersHoldsTwoSplits) {
    float const a = 1.0f, b = std::nextafter(a, 2.0f), c = std::nextafter(b, 2.0f);
    Splits<float> const splits = practical_splits(a, c, 8);
    EXPECT_TRUE(laws::is_ordered(splits, a, c, 8));
    EXPECT_EQ(splits.count, 2);
    EXPECT_TRUE(splits.faults.has(Fault::count_clamped));
}

TEST(Splits, AreOrderedInTheNarrowestRanges) {
    float const a = 1.0f;
    float b = a;
    for (int numbers = 1; numbers <= 9; ++numbers) {
        b = std::nextafter(b, 2.0f);
        for (float const lambda : {0.0f, 0.3f, 0.5f, 1.0f})
            EXPECT_TRUE(laws::is_ordered(practical_splits(a, b, 4, lambda), a, b, 4)) << numbers << ' ' << lambda;
    }
}

TEST(Splits, AreOfTheNearestLambdaAndSaySoWhereItIsOutsideItsRange) {
    for (int const count : {3, 4}) {
        double const nan = std::numeric_limits<double>::quiet_NaN();
        for (auto const& [asked, used] : {std::pair{1.5, 1.0}, std::pair{-0.5, 0.0}, std::pair{nan, 0.5}}) {
            Splits<double> const splits = practical_splits(1.0, 100.0, count, asked);
            EXPECT_EQ(planes(splits), planes(practical_splits(1.0, 100.0, count, used))) << asked;
            EXPECT_TRUE(splits.faults.has(Fault::clamped_option));
        }
        EXPECT_TRUE(pinned_splits(1.0, 100.0, count, 2.0, 1.5).faults.has(Fault::clamped_option));
    }
}

TEST(Splits, SayWhereNoRatioOfDistancesExists) {
    for (int const count : {3, 4}) {
        EXPECT_TRUE(practical_splits(0x1p-70, 1.0, count).faults.has(Fault::near_clamped));
        EXPECT_FALSE(practical_splits(0x1p-60, 1.0, count).faults.has(Fault::near_clamped));
        EXPECT_FALSE(practical_splits(0x1p-70, 1.0, count, 0.0).faults.has(Fault::near_clamped));
        EXPECT_NEAR(logarithmic_splits(0.0, 1.0, count).plane[count - 1], std::pow(0x1p-20, 1.0 / count), 1e-15);
    }
}

TEST(Splits, AreTheCallersOwnWhenExplicit) {
    double const inner[] = {5, 20, 60};
    EXPECT_EQ(planes(explicit_splits(1.0, 100.0, inner, 4)), (std::vector<double>{1, 5, 20, 60, 100}));
    double const unordered[] = {5, 5, 0.5, 200, 60};
    Splits<double> const mended = explicit_splits(1.0, 100.0, unordered, 6);
    EXPECT_EQ(planes(mended), (std::vector<double>{1, 5, 60, 100}));
    EXPECT_TRUE(mended.faults.has(Fault::count_clamped));
    double const more[] = {5, 20, 60, std::numeric_limits<double>::quiet_NaN(), 70};
    EXPECT_EQ(planes(explicit_splits(1.0, 100.0, more, 4)), (std::vector<double>{1, 5, 20, 60, 100}));
}

TEST(Splits, BeginWithTheOneThatIsPinned) {
    Splits<double> const splits = pinned_splits(0.1, 200.0, 4, 2.5);
    EXPECT_EQ(splits.count, 4);
    EXPECT_EQ(splits.plane[1], 2.5);
    Splits<double> const behind = practical_splits(2.5, 200.0, 3);
    for (int i = 0; i <= 3; ++i) EXPECT_EQ(splits.plane[i + 1], behind.plane[i]);
    for (double const outside : {0.05, 0.1, 200.0, 500.0}) {
        EXPECT_TRUE(pinned_splits(0.1, 200.0, 4, outside).faults.has(Fault::clamped_option)) << outside;
        EXPECT_EQ(planes(pinned_splits(0.1, 200.0, 4, outside)), planes(practical_splits(0.1, 200.0, 4))) << outside;
    }
}

TEST(Splits, LambdaIsAHalfWhereNoFirstSplitCouldTellIt) {
    EXPECT_EQ(lambda_for_first_split(1.0, 10.0, 1, 3.0), 0.5) << "one split has no inner plane";
    EXPECT_EQ(lambda_for_first_split(10.0, 1.0, 3, 3.0), 0.5);
    EXPECT_EQ(lambda_for_first_split(1.0, 10.0, 3, std::numeric_limits<double>::infinity()), 0.5);
}

TEST(Splits, LambdaIsTheNearestWhereNonePutsTheFirstPlaneThere) {
    EXPECT_EQ(lambda_for_first_split(1.0, 100.0, 4, 90.0), 0.0);
    EXPECT_EQ(lambda_for_first_split(1.0, 100.0, 4, 1.01), 1.0);
}

TEST(Splits, LambdaIsAHalfWhereUniformAndLogarithmicAreAlike) {
    double const next = std::nextafter(std::nextafter(1.0, 2.0), 2.0);
    EXPECT_EQ(lambda_for_first_split(1.0, next, 2, 1.0), 0.5);
}

TEST(Splits, PinnedOfBadNumbersAreThoseOfPracticalOnes) {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(pinned_splits(nan, 10.0, 4, 2.0).faults.has(Fault::not_finite));
    EXPECT_TRUE(pinned_splits(1.0, nan, 4, 2.0).faults.has(Fault::not_finite));
    EXPECT_TRUE(pinned_splits(1.0, 10.0, 4, nan).faults.has(Fault::clamped_option));
    EXPECT_EQ(pinned_splits(1.0, 10.0, 4, 0.5).count, 4);
    EXPECT_EQ(pinned_splits(1.0, 10.0, 1, 2.0).count, 1);
}
