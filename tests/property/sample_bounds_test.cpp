// SPDX-License-Identifier: MIT
#include "tests/laws/sample_bounds.hpp"
#include "tests/support/sampled_scene.hpp"
#include "tests/support/tolerance.hpp"

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

// Tiles of four by four pixels, of which the bounds know the nearest and the farthest depth alone.
TYPED_TEST(SampleBoundsProperty, TheBoxesOfATileHoldWhateverItsPixelsShow) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        constexpr int side = 4;
        ViewVolume<T> const view = *sampled_view<T>(T(100));
        Light<T> const light = *sun<T>();
        auto const tile_rays = sample_rays(view, light, 3, 2);
        auto const rays = sample_rays(view, light, 3 * side, 2 * side);
        auto bounds = no_bounds(logarithmic_splits(view.z_near, view.z_far, static_cast<int>(1 + *below(6))));
        std::vector<std::pair<Vec3<T>, T>> seen;
        for (int tile = 0; tile < 6; ++tile) {
            T nearest = std::numeric_limits<T>::max(), farthest = T(0);
            for (int pixel = 0; pixel < side * side; ++pixel) {
                T const depth = *log_uniform<T>(view.z_near, view.z_far);
                nearest = depth < nearest ? depth : nearest;
                farthest = depth > farthest ? depth : farthest;
                int const x = tile % 3 * side + pixel % side, y = tile / 3 * side + pixel / side;
                seen.emplace_back(from_eye(rays, x, y, depth), depth);
            }
            add_tile(bounds, tile_rays, tile % 3, tile / 3, nearest, farthest);
        }
        for (auto const& [point, depth] : seen)
            for (int i = 0; i < bounds.count; ++i) {
                if (!is_served(bounds.range[i], depth)) continue;
                Vec3<T> const lost(tolerance(glm::length(point), 16));
                Aabb<T> const box{bounds.box[i].lo - lost, bounds.box[i].hi + lost};
                RC_ASSERT(box.lo.x <= point.x && box.lo.y <= point.y && box.lo.z <= point.z);
                RC_ASSERT(box.hi.x >= point.x && box.hi.y >= point.y && box.hi.z >= point.z);
            }
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
