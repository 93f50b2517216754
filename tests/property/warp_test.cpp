// SPDX-License-Identifier: MIT
#include "tests/laws/warp.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/seen_case.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class WarpProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(WarpProperty, Scalars);

TYPED_TEST(WarpProperty, AxesAreABasisForEveryViewAndEveryLight) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        Pose<T> const eye = *pose<T>(T(1));
        Light<T> const light = *sun<T>();
        RC_ASSERT(laws::is_a_basis_along_the_view(warp_axes(eye, light.direction), eye));
    }));
}

TYPED_TEST(WarpProperty, ServesWhatTheViewSeesAndTheCastersBetweenItAndTheLight) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        SeenCase<T> const scene = *seen_case<T>();
        Light<T> const light = *sun<T>();
        T const away = *log_uniform<T>(T(1e-3), T(100));
        T const strength = *uniform<T>(T(0), T(2));
        auto const rule = static_cast<WarpRule>(*below(3));
        T const distance = away * glm::length(scene.point - scene.view.pose.position);
        Vec3<T> const caster = scene.point - light.direction * distance;
        Aabb<T> const casters = merge(scene.receivers, caster);
        WarpOptions<T> options;
        options.strength = strength;
        options.rule = rule;
        options.focus_metres = distance;
        ShadowMap<T> const map =
            simple_perspective_map(scene.view, light, casters, scene.receivers, options, scene.clip);
        RC_ASSERT(laws::harmless(map));
        RC_ASSERT(map.visible);
        RC_ASSERT(laws::is_map_of(map.clip_from_world, light, scene.clip));
        RC_ASSERT(laws::serves(map, scene.point, T(2) * options.margin_texels / T(options.map_size)));
        RC_ASSERT(laws::serves(map, caster, T(2) * options.margin_texels / T(options.map_size)));
        RC_ASSERT(laws::keeps_the_order(map, caster, scene.point));
    }));
}

TYPED_TEST(WarpProperty, IsFiniteAndCalmForAnyInput) {
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
        bool const odd_rule = *one_in(3);
        if (odd_rule) options.focus_metres = options.coefficient = strength;
        if (odd) {
            options.margin_texels = margin;
            options.strength = strength;
        }
        ClipSpace const clip = *clip_space();
        auto const map =
            watched([&] { return simple_perspective_map(view, light, casters, receivers, options, clip); });
        RC_ASSERT(laws::harmless(map.result));
        RC_ASSERT(map.calm());
    }));
}
