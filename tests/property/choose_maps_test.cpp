// SPDX-License-Identifier: MIT
#include "tests/laws/choose_maps.hpp"
#include "tests/laws/quad_map.hpp"
#include "tests/support/sampled_scene.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <vector>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
class ChooseMapsProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ChooseMapsProperty, Scalars);

template <class T>
MapSearch<T>& search() {
    static MapSearch<T> work;
    return work;
}

TYPED_TEST(ChooseMapsProperty, EveryDepthOfThePictureIsInAMap) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        SampledScene<T> const scene = *sampled_scene<T>(T(100));
        MapLimits<T> limits;
        limits.maps = static_cast<int>(1 + *below(4));
        limits.map_size = static_cast<int>(64 + *below(4000));
        limits.clip = *clip_space();
        std::vector<SurfacePoint<T>> samples;
        auto const side = [](int i, int count, T lo, T hi) { return lo + (hi - lo) * (T(i) + T(0.5)) / T(count); };
        ViewVolume<T> const& view = scene.view;
        for_each_sample(scene, [&](int x, int y, T depth) {
            samples.push_back({point_at(view, side(x, scene.width, view.left, view.right),
                                        side(y, scene.height, view.bottom, view.top), depth),
                               -scene.light.direction});
        });
        Aabb<T> const everything{Vec3<T>(T(-1e6)), Vec3<T>(T(1e6))};
        DepthTiles<T> const tiles{scene.depth.data(), scene.depth.data(), scene.width, scene.height};
        ChosenMaps<T> const chosen = choose_maps(view, scene.light, everything, samples.data(),
                                                 static_cast<int>(samples.size()), tiles, limits, search<T>());
        RC_ASSERT(samples.empty() || chosen.count > 0);
        if (chosen.faults.has(Fault::precision_lost)) return;
        for (auto const& sample : samples) {
            // A texel: what the matrix' own rounding may come to without precision_lost.
            RC_ASSERT(laws::server_of(chosen, limits, sample.point, T(2) / T(limits.map_size)) >= 0);
        }
    }));
}

TYPED_TEST(ChooseMapsProperty, IsCalmForAnyInput) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ViewVolume<T> const view = *nasty_view_volume<T>();
        Vec3<T> const travel = *nasty_vec3<T>();
        Aabb<T> const casters = *nasty_box<T>();
        Light<T> const light = directional(travel);
        std::vector<T> depths;
        std::vector<SurfacePoint<T>> samples;
        std::vector<Aabb<T>> boxes;
        for (int i = 0; i < 6; ++i) {
            depths.push_back(*nasty<T>());
            Vec3<T> const point = *nasty_vec3<T>();
            Vec3<T> const normal = *nasty_vec3<T>();
            samples.push_back({point, normal});
            boxes.push_back(*nasty_box<T>());
        }
        MapLimits<T> limits;
        limits.eye_pixels = Vec2<T>(*nasty<T>(), T(100));
        limits.maps = static_cast<int>(*below(7)) - 1;
        limits.map_size = static_cast<int>(*below(2000)) - 10;
        auto const seen = watched([&] {
            return choose_maps(view, light, casters, samples.data(), 6,
                               DepthTiles<T>{depths.data(), depths.data(), 3, 2}, limits, search<T>());
        });
        RC_ASSERT(seen.allocations == 0);
        auto const bounded =
            watched([&] { return choose_maps(view, light, casters, boxes.data(), 6, limits, search<T>()); });
        RC_ASSERT(bounded.allocations == 0);
        for (auto const* chosen : {&seen.result, &bounded.result}) {
            RC_ASSERT(chosen->count >= 0 && chosen->count <= max_chosen_maps);
            for (ChosenMap<T> const& made : *chosen) RC_ASSERT(laws::harmless(made.map));
        }
    }));
}

}  // namespace
