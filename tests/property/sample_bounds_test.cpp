// SPDX-License-Identifier: MIT
#include "tests/laws/sample_bounds.hpp"
#include "tests/support/sampled_scene.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
class SampleBoundsProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SampleBoundsProperty, Scalars);

TYPED_TEST(SampleBoundsProperty, ASampleLiesWhereTheViewHasIt) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ViewVolume<T> const view = *view_volume<T>();
        Light<T> const light = *sun<T>();
        int const width = static_cast<int>(1 + *below(4000));
        int const height = static_cast<int>(1 + *below(4000));
        int const x = static_cast<int>(*below(static_cast<std::uint64_t>(width)));
        int const y = static_cast<int>(*below(static_cast<std::uint64_t>(height)));
        T const depth = *log_uniform<T>(view.z_near, view.z_far);
        auto const rays = sample_rays(view, light, width, height);
        RC_ASSERT(rays.usable);
        RC_ASSERT(laws::lies_where_the_view_has_it(rays, view, x, y, width, height, depth));
    }));
}

TYPED_TEST(SampleBoundsProperty, TheBoxOfItsSplitHoldsEverySample) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        SampledScene<T> const scene = *sampled_scene<T>(T(100));
        int const count = static_cast<int>(1 + *below(6));
        SampleSplits const kind = *below(2) == 0 ? SampleSplits::even : SampleSplits::adaptive;
        T const blend = *uniform<T>(T(0), T(0.5));
        auto const result = sampled(scene, count, kind, blend);
        for_each_sample(
            scene, [&](int x, int y, T depth) { RC_ASSERT(laws::is_held(result.bounds, result.rays, x, y, depth)); });
    }));
}

TYPED_TEST(SampleBoundsProperty, OrderAndGroupingOfSamplesNeverMatter) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        SampledScene<T> const scene = *sampled_scene<T>(T(100));
        auto const whole = sampled(scene, 4, SampleSplits::adaptive);
        auto const none = no_bounds(sample_splits(whole.depths, 4, SampleSplits::adaptive));
        std::uint64_t const parts = 1 + *below(5);
        std::vector<SampleBounds<T>> part(parts, none);
        for (int y = scene.height - 1; y >= 0; --y)
            for (int x = 0; x < scene.width; ++x) {
                std::uint64_t const to = *below(parts);
                add(part[to], whole.rays, x, y, scene.depth[static_cast<std::size_t>(y * scene.width + x)]);
            }
        auto merged = part.back();
        for (std::size_t i = 0; i + 1 < parts; ++i) add(merged, part[i]);
        RC_ASSERT(laws::same(whole.bounds, merged));
    }));
}

}  // namespace
