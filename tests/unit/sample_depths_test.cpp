// SPDX-License-Identifier: MIT
#include "tests/laws/sample_depths.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;

template <class T>
class SampleDepthsOf : public ::testing::Test {};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(SampleDepthsOf, Scalars);

namespace {

template <class T>
constexpr double rounding = 64 * double(std::numeric_limits<T>::epsilon());

// A sample every percent of depth.
template <class T>
void add_every_percent(SampleDepths<T>& depths, T from, T to) {
    for (T depth = from; depth < to; depth *= T(1.01)) add(depths, depth);
}

}  // namespace

TYPED_TEST(SampleDepthsOf, EvenSplitsAreLogarithmicBetweenTheFirstAndTheLastSample) {
    using T = TypeParam;
    auto depths = no_depths(T(0.1), T(2000));
    add(depths, T(1));
    add(depths, T(1000));
    auto const splits = sample_splits(depths, 3, SampleSplits::even);
    ASSERT_EQ(splits.count, 3);
    EXPECT_FALSE(splits.faults.any());
    EXPECT_EQ(splits.plane[0], T(0.1));
    EXPECT_NEAR(double(splits.plane[1]), 10, 10 * rounding<T>);
    EXPECT_NEAR(double(splits.plane[2]), 100, 100 * rounding<T>);
    EXPECT_EQ(splits.plane[3], T(2000));
}

TYPED_TEST(SampleDepthsOf, EvenSplitsAreThoseOfSplitsHpp) {
    using T = TypeParam;
    auto depths = no_depths(T(0.25), T(512));
    add(depths, T(0.5));
    add(depths, T(300));
    for (int count = 1; count <= max_splits; ++count) {
        auto const splits = sample_splits(depths, count, SampleSplits::even);
        auto const logarithmic = logarithmic_splits(T(0.5), T(300), count);
        ASSERT_EQ(splits.count, count);
        for (int i = 1; i < count; ++i)
            EXPECT_NEAR(double(splits.plane[i] / logarithmic.plane[i]), 1, rounding<T>) << i << " of " << count;
    }
}

TYPED_TEST(SampleDepthsOf, AdaptiveSplitsLeaveAGapOut) {
    using T = TypeParam;
    auto depths = no_depths(T(0.1), T(2000));
    add_every_percent(depths, T(1), T(4));
    add_every_percent(depths, T(300), T(1200));
    // Two octaves on either side of the gap. Even splits are 2.56 octaves each, and one and a half lie in the gap.
    auto const two = sample_splits(depths, 2, SampleSplits::adaptive);
    ASSERT_EQ(two.count, 2);
    EXPECT_EQ(two.plane[1], T(300));
    auto const four = sample_splits(depths, 4, SampleSplits::adaptive);
    ASSERT_EQ(four.count, 4);
    EXPECT_NEAR(double(four.plane[1]), 2, 2.0 / 16);
    EXPECT_EQ(four.plane[2], T(300));
    EXPECT_NEAR(double(four.plane[3]), 600, 600.0 / 16);
}

TYPED_TEST(SampleDepthsOf, AWallThatFacesTheEyeGetsOneSplit) {
    using T = TypeParam;
    auto depths = no_depths(T(0.1), T(100));
    for (int i = 0; i < 50; ++i) add(depths, T(7) + T(i) / T(1000));
    for (SampleSplits const kind : {SampleSplits::even, SampleSplits::adaptive}) {
        auto const splits = sample_splits(depths, 4, kind);
        EXPECT_EQ(splits.count, 1);
        EXPECT_EQ(splits.plane[0], T(0.1));
        EXPECT_EQ(splits.plane[1], T(100));
    }
}

TYPED_TEST(SampleDepthsOf, AnEmptyScreenHasNoSplitAndNoFault) {
    using T = TypeParam;
    auto depths = no_depths(T(0.1), T(100));
    add(depths, T(100));                              // the far distance itself is sky
    add(depths, T(0));                                // before the near one
    add(depths, std::numeric_limits<T>::infinity());  // cleared, reversed
    add(depths, std::numeric_limits<T>::quiet_NaN());
    EXPECT_EQ(depths.counted, 0u);
    EXPECT_EQ(depths.outside, 2u);
    EXPECT_EQ(depths.not_finite, 2u);
    for (SampleSplits const kind : {SampleSplits::even, SampleSplits::adaptive}) {
        auto const splits = sample_splits(depths, 4, kind);
        EXPECT_EQ(splits.count, 0);
        EXPECT_FALSE(splits.faults.any());
    }
}

TYPED_TEST(SampleDepthsOf, NaNSamplesAreCountedAndChangeNothing) {
    using T = TypeParam;
    std::vector<T> const samples{T(3), T(40), T(5)};
    auto const clean = laws::depths_of(samples, T(1), T(100));
    auto soiled = clean;
    add(soiled, std::numeric_limits<T>::quiet_NaN());
    add(soiled, -std::numeric_limits<T>::infinity());
    EXPECT_EQ(soiled.not_finite, 2u);
    auto twice = soiled;
    add(twice, soiled);
    EXPECT_EQ(twice.not_finite, 4u);
    EXPECT_EQ(twice.counted, 6u);
    twice.outside = 5;
    add(twice, twice);
    EXPECT_EQ(twice.outside, 10u);
    soiled.not_finite = 0;
    EXPECT_TRUE(laws::same(clean, soiled));
}

TYPED_TEST(SampleDepthsOf, ARangeThatIsNoneIsAFault) {
    using T = TypeParam;
    T const nan = std::numeric_limits<T>::quiet_NaN(), infinity = std::numeric_limits<T>::infinity();
    for (auto const& [z_near, z_far] : {std::pair{T(1), T(1)},
                                        {T(-1), T(1)},
                                        {T(2), T(1)},
                                        {nan, T(1)},
                                        {T(1), nan},
                                        {T(1), infinity},
                                        {T(1), T(1e30)}}) {
        auto depths = no_depths(z_near, z_far);
        EXPECT_TRUE(depths.faults.any());
        add(depths, T(1));
        EXPECT_EQ(depths.counted, 0u);
        EXPECT_EQ(sample_splits(depths, 4, SampleSplits::even).count, 0);
        EXPECT_EQ(sample_splits(depths, 4, SampleSplits::even).faults, depths.faults);
    }
}

TYPED_TEST(SampleDepthsOf, AnEndThatIsNoNumberIsNamedAlone) {
    using T = TypeParam;
    T const nan = std::numeric_limits<T>::quiet_NaN();
    EXPECT_EQ(no_depths(nan, T(10)).faults, Faults(Fault::not_finite));
    EXPECT_EQ(no_depths(T(1), nan).faults, Faults(Fault::not_finite));
}

TYPED_TEST(SampleDepthsOf, FaultsOfAPartAreThoseOfTheWhole) {
    using T = TypeParam;
    SampleDepths<T> whole = no_depths(T(1), T(10));
    add(whole, no_depths(T(10), T(1)));
    EXPECT_EQ(whole.faults, Faults(Fault::empty_range));
}

TYPED_TEST(SampleDepthsOf, OptionsOutsideTheirRangeAreClampedAndSaid) {
    using T = TypeParam;
    auto const depths = laws::depths_of<T>({T(1), T(2), T(90)}, T(0), T(100));
    EXPECT_EQ(sample_splits(depths, 17, SampleSplits::even).count, max_splits);
    EXPECT_TRUE(sample_splits(depths, 17, SampleSplits::even).faults.has(Fault::count_clamped));
    EXPECT_EQ(sample_splits(depths, -1, SampleSplits::adaptive).count, 0);
    for (T const ratio : {T(1), T(-3), T(1e9), std::numeric_limits<T>::quiet_NaN()}) {
        auto const splits = sample_splits(depths, 4, SampleSplits::even, ratio);
        EXPECT_TRUE(splits.faults.has(Fault::clamped_option));
        EXPECT_TRUE(laws::is_ordered(splits, depths, 4));
    }
}

TYPED_TEST(SampleDepthsOf, ASampleAtTheEyeDoesNotStarveTheOthers) {
    using T = TypeParam;
    auto const depths = laws::depths_of<T>({T(0), T(1e-30L), T(10), T(20)}, T(0), T(100));
    for (SampleSplits const kind : {SampleSplits::even, SampleSplits::adaptive}) {
        auto const splits = sample_splits(depths, 3, kind);
        EXPECT_TRUE(laws::is_ordered(splits, depths, 3));
        EXPECT_GE(splits.count, 2);
    }
    auto const at_the_eye = laws::depths_of<T>({T(0), T(0)}, T(0), T(100));
    EXPECT_EQ(sample_splits(at_the_eye, 3, SampleSplits::even).count, 1);
    EXPECT_EQ(sample_splits(at_the_eye, 3, SampleSplits::adaptive).count, 1);
}

TYPED_TEST(SampleDepthsOf, AMinusZeroAtANearDistanceOfZeroIsInTheFirstBin) {
    using T = TypeParam;
    auto depths = no_depths(T(0), T(100));
    add(depths, -T(0));
    EXPECT_EQ(depths.counted, 1);
    EXPECT_EQ(depths.lo[0], T(0));
}

TEST(EvenCover, EndsWhereTheLastSplitReachesTheLastDepth) {
    auto const cover = detail::even_cover(1.0, 8.0, 2.0, 10);
    EXPECT_EQ(cover.count, 3);
    EXPECT_TRUE(cover.complete);
    EXPECT_EQ(detail::even_cover(8.0, 8.0, 2.0, 10).count, 1);
}
