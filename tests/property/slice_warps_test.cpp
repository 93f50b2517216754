// SPDX-License-Identifier: MIT
#include "tests/laws/slice_warps.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/seen_case.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class SliceWarpsProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SliceWarpsProperty, Scalars);

TYPED_TEST(SliceWarpsProperty, ServeWhatEachSliceSeesAndTheCastersBetweenItAndTheLight) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        SeenCase<T> const scene = *seen_case<T>();
        Light<T> const light = *sun<T>();
        T const away = *log_uniform<T>(T(1e-3), T(100));
        T const strength = *uniform<T>(T(0), T(2));
        T const blend = *uniform<T>(T(0), T(1));
        auto const count = static_cast<int>(1 + *below(6));
        T const distance = away * glm::length(scene.point - scene.view.pose.position);
        Vec3<T> const caster = scene.point - light.direction * distance;
        Aabb<T> const casters = merge(scene.receivers, caster);
        WarpOptions<T> options;
        options.strength = strength;
        Splits<T> const splits = practical_splits(scene.view.z_near, scene.view.z_far, count);
        ShadowMap<T> maps[max_splits];
        unsigned const visible =
            fit_slice_warps(scene.view, light, splits, blend, casters, scene.receivers, options, scene.clip, maps);
        T const depth = eye_depth(scene.view, scene.point), margin = T(2) * options.margin_texels / T(options.map_size);
        int serving = 0;
        for (int i = 0; i < splits.count; ++i) {
            RC_ASSERT(laws::harmless(maps[i]));
            RC_ASSERT((visible >> i & 1u) == (maps[i].visible ? 1u : 0u));
            SliceRange<T> const range = slice_range(splits, i, blend);
            if (depth < range.begin || depth > range.end) continue;
            ++serving;
            RC_ASSERT(maps[i].visible);
            // Where depth is a hundred thousand times what w grows over, -1..1 leaves none of it in a float: the twin's
            // neither.
            ShadowMap<T> const twin =
                simple_perspective_map(slice(scene.view, range), light, casters, scene.receivers, options, scene.clip);
            RC_ASSERT(laws::is_map_of(maps[i].clip_from_world, light, scene.clip) ||
                      !laws::is_map_of(twin.clip_from_world, light, scene.clip));
            RC_ASSERT(laws::serves(maps[i], scene.point, margin));
            RC_ASSERT(laws::serves(maps[i], caster, margin));
            RC_ASSERT(laws::keeps_the_order(maps[i], caster, scene.point));
        }
        RC_ASSERT(serving > 0);
    }));
}

TYPED_TEST(SliceWarpsProperty, AreThoseThatAreMadeOneByOne) {
    using T = TypeParam;
    int compared = 0;
    EXPECT_TRUE(rc::check([&compared] {
        SeenCase<T> const scene = *seen_case<T>();
        Light<T> const light = *sun<T>();
        T const away = *log_uniform<T>(T(1e-3), T(10));
        T const strength = *uniform<T>(T(0), T(2));
        T const blend = *uniform<T>(T(0), T(1));
        auto const count = static_cast<int>(1 + *below(6));
        T const distance = away * glm::length(scene.point - scene.view.pose.position);
        Aabb<T> const casters = merge(scene.receivers, scene.point - light.direction * distance);
        WarpOptions<T> options;
        options.strength = strength;
        Splits<T> const splits = practical_splits(scene.view.z_near, scene.view.z_far, count);
        ShadowMap<T> maps[max_splits];
        unsigned const visible =
            fit_slice_warps(scene.view, light, splits, blend, casters, scene.receivers, options, scene.clip, maps);
        long double const metres = laws::scene_rounding(scene.view, splits.plane[splits.count]);
        for (int i = 0; i < splits.count; ++i) {
            ViewVolume<T> const part = slice(scene.view, slice_range(splits, i, blend));
            ShadowMap<long double> const twin =
                laws::exact_warp(part, light, casters, scene.receivers, options, scene.clip);
            // Ours is larger by rounding, and may see what the twin just misses.
            if (twin.visible) RC_ASSERT((visible >> i & 1u) == 1u);
            if (!twin.visible || !maps[i].visible) continue;
            laws::Apart const found = laws::apart(maps[i], twin, part, light, scene.receivers, metres);
            if (!(found.allowed < 0.1L)) continue;
            RC_ASSERT(found.across <= found.allowed);
            ++compared;
        }
    }));
    EXPECT_GT(compared, 60);
}

TYPED_TEST(SliceWarpsProperty, AreFiniteAndCalmForAnyInput) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ViewVolume<T> const view = *nasty_view_volume<T>();
        Vec3<T> const travel = *nasty_vec3<T>();
        Aabb<T> const casters = *nasty_box<T>();
        Aabb<T> const receivers = *nasty_box<T>();
        Light<T> light = directional(travel);
        bool const raw = *one_in(3);
        if (raw) light.direction = travel;
        WarpOptions<T> options;
        bool const odd = *one_in(3);
        T const margin = *nasty<T>();
        T const strength = *nasty<T>();
        options.rule = static_cast<WarpRule>(*below(3));
        if (odd) {
            options.margin_texels = margin;
            options.strength = strength;
        }
        T const blend = *nasty<T>();
        ClipSpace const clip = *clip_space();
        Splits<T> splits = practical_splits(T(0.1), T(100), 4);
        bool const of_view = *one_in(2);
        if (of_view) splits = practical_splits(view.z_near, view.z_far, 5);
        bool const odd_plane = *one_in(4);
        if (odd_plane) splits.plane[4] = *nasty<T>();
        ShadowMap<T> maps[max_splits];
        auto const made = watched(
            [&] { return fit_slice_warps(view, light, splits, blend, casters, receivers, options, clip, maps); });
        RC_ASSERT(made.calm());
        for (int i = 0; i < splits.count; ++i) RC_ASSERT(laws::harmless(maps[i]));
    }));
}
