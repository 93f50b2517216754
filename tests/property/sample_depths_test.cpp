// SPDX-License-Identifier: MIT
#include "tests/laws/sample_depths.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
struct Seen {
    T z_near = T(0), z_far = T(1);
    std::vector<T> samples;  // ascending, in range, within 15 octaves of z_far
};

// In clusters, as surfaces are.
template <class T>
Seen<T> drawn_samples(std::uint64_t most) {
    Seen<T> seen;
    seen.z_far = *log_uniform<T>(T(1), T(1e5));
    T const farthest = seen.z_far * T(0.999), nearest = seen.z_far / T(1 << 14);
    bool const from_the_eye = *one_in(4);
    seen.z_near = from_the_eye ? T(0) : nearest / T(2);
    std::uint64_t const clusters = 1 + *below(5);
    for (std::uint64_t c = 0; c < clusters; ++c) {
        T const at = *log_uniform<T>(nearest, farthest);
        T const extent = *log_uniform<T>(T(1.0001), T(3));
        std::uint64_t const count = 1 + *below(most / clusters);
        for (std::uint64_t i = 0; i < count; ++i) {
            T const sample = at * *uniform<T>(T(1), extent);
            seen.samples.push_back(sample < farthest ? sample : farthest);
        }
    }
    std::sort(seen.samples.begin(), seen.samples.end());
    return seen;
}

SampleSplits drawn_kind() {
    bool const even = *one_in(2);
    return even ? SampleSplits::even : SampleSplits::adaptive;
}

template <class T>
class SampleDepthsProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SampleDepthsProperty, Scalars);

TYPED_TEST(SampleDepthsProperty, OrderAndGroupingOfSamplesNeverMatter) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Seen<T> const seen = drawn_samples<T>(200);
        auto const whole = laws::depths_of(seen.samples, seen.z_near, seen.z_far);
        std::uint64_t const parts = 1 + *below(7);
        std::vector<SampleDepths<T>> part(parts, no_depths(seen.z_near, seen.z_far));
        for (auto sample = seen.samples.rbegin(); sample != seen.samples.rend(); ++sample) {
            std::uint64_t const to = *below(parts);
            add(part[to], *sample);
        }
        auto merged = part.back();
        for (std::size_t i = 0; i + 1 < parts; ++i) add(merged, part[i]);
        RC_ASSERT(laws::same(whole, merged));
        RC_ASSERT(laws::is_in_order(whole));
        RC_ASSERT(whole.counted == seen.samples.size());
    }));
}

TYPED_TEST(SampleDepthsProperty, SplitsCoverTheViewAndAreOrdered) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Seen<T> const seen = drawn_samples<T>(100);
        auto const depths = laws::depths_of(seen.samples, seen.z_near, seen.z_far);
        int const count = static_cast<int>(*below(20));
        SampleSplits const kind = drawn_kind();
        RC_ASSERT(laws::is_ordered(sample_splits(depths, count, kind), depths, count));
    }));
}

// A bin is at most a 32nd of its first depth wide, and one may be cut off on either side of a split.
TYPED_TEST(SampleDepthsProperty, NoOtherPlacingOfAsManySplitsIsBetterThanTheAdaptiveOneByMoreThanABin) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Seen<T> const seen = drawn_samples<T>(40);
        auto const depths = laws::depths_of(seen.samples, seen.z_near, seen.z_far);
        int const count = static_cast<int>(1 + *below(6));
        auto const adaptive = sample_splits(depths, count, SampleSplits::adaptive, T(1.0001));
        auto const even = sample_splits(depths, count, SampleSplits::even, T(1.0001));
        long double const worst = laws::worst_ratio(adaptive, seen.samples, T(0));
        long double const least = laws::least_worst_ratio(seen.samples, count);
        constexpr long double bin = 33.0L / 32;
        RC_ASSERT(worst <= std::fmax(least, 1.0001L) * bin * (1 + 1e-6L));
        RC_ASSERT(worst <= std::fmax(laws::worst_ratio(even, seen.samples, T(0)), 1.0001L) * bin * (1 + 1e-6L));
    }));
}

// Each split from z to r z, r the m-th root of last over first, to the roundings of m products.
TYPED_TEST(SampleDepthsProperty, EvenSplitsAreNeverDeeperThanTheRootOfTheWhole) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Seen<T> const seen = drawn_samples<T>(100);
        auto const depths = laws::depths_of(seen.samples, seen.z_near, seen.z_far);
        int const count = static_cast<int>(1 + *below(max_splits));
        auto const splits = sample_splits(depths, count, SampleSplits::even, T(1.0001));
        long double const whole = static_cast<long double>(seen.samples.back()) / seen.samples.front();
        long double const root = std::fmax(std::pow(whole, 1.0L / count), 1.0001L);
        long double const rounding = 4 * count * static_cast<long double>(std::numeric_limits<T>::epsilon());
        RC_ASSERT(laws::worst_ratio(splits, seen.samples, T(0)) <= root * (1 + rounding));
    }));
}

TYPED_TEST(SampleDepthsProperty, AWorldTwiceAsLargeIsSplitAtTwiceTheDepths) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Seen<T> const seen = drawn_samples<T>(100);
        auto const depths = laws::depths_of(seen.samples, seen.z_near, seen.z_far);
        auto doubled = no_depths(T(2) * seen.z_near, T(2) * seen.z_far);
        for (T const sample : seen.samples) add(doubled, T(2) * sample);
        int const count = static_cast<int>(1 + *below(max_splits));
        SampleSplits const kind = drawn_kind();
        auto const once = sample_splits(depths, count, kind), twice = sample_splits(doubled, count, kind);
        RC_ASSERT(once.count == twice.count);
        for (int i = 0; i <= once.count; ++i) RC_ASSERT(twice.plane[i] == T(2) * once.plane[i]);
    }));
}

TYPED_TEST(SampleDepthsProperty, NoInputMakesANaNAnAllocationOrATrap) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        T const z_near = *nasty<T>();
        T const z_far = *nasty<T>();
        T const ratio = *nasty<T>();
        std::uint64_t const samples = *below(40);
        auto depths = no_depths(z_near, z_far);
        for (std::uint64_t i = 0; i < samples; ++i) {
            T const sample = *nasty<T>();
            add(depths, sample);
        }
        int const count = static_cast<int>(*below(40)) - 5;
        SampleSplits const kind = drawn_kind();
        auto const run = watched([&] { return sample_splits(depths, count, kind, ratio); });
        RC_ASSERT(run.allocations == 0u);
        RC_ASSERT(depths.counted + depths.outside + depths.not_finite == samples);
        RC_ASSERT(laws::is_ordered(run.result, depths, count));
    }));
}

}  // namespace
