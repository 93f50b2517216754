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
        ViewVolume<T> const view = *any_view<T>();
        Light<T> const light = *any_sun<T>();
        Aabb<T> const casters = *nasty_box<T>();
        Aabb<T> const receivers = *nasty_box<T>();
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

// The conversions: of any distance of the centre behind the near end, by strength, by eta, by the focus of the
// trapezoid and by the growth of w. Each gives back the distance that it was made from.
TEST(WarpConversions, AgreeOnOneCentre) {
    EXPECT_TRUE(rc::check([] {
        auto const z_near = *log_uniform<double>(0.01, 100.0);
        auto const length = z_near * *log_uniform<double>(0.1, 1e4);
        auto const sine = *uniform<double>(0.15, 1.0);
        auto const share = *uniform<double>(0.01, 0.99);
        double const most = sine / z_near, best = optimal_inverse_centre(z_near, length, sine);
        auto const is = [](double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(b); };
        // Wimmer's a is (n + sqrt(n f)) / sine, with f the depth that the tilted body reaches.
        double const f = z_near + length * sine;
        RC_ASSERT(is(1 / best, (z_near + std::sqrt(z_near * f)) / sine));
        RC_ASSERT(is(lloyd_inverse_centre(0.0, z_near, length, sine), best));
        RC_ASSERT(is(lloyd_inverse_centre(1.0, z_near, length, sine), most));
        RC_ASSERT(lloyd_inverse_centre(-1.0, z_near, length, sine) <= 1e-12 * most);
        double const a = 1 / (most * share);
        // 80 % of the map up to a focus: y / (y + a) of its whole at `length`, so 0.8 = y (length + a) / (length (y +
        // a)).
        double const focus = 0.8 * length * a / (length + a - 0.8 * length);
        RC_ASSERT(is(trapezoid_inverse_centre(length, focus), 1 / a));
        // w = 1 + g y from the eye is 1 + (y - y_near) / a from the near end, over its value there.
        double const y_near = a * *uniform<double>(-0.1, 0.9), growth = 1 / (a - y_near);
        RC_PRE(1 + growth * y_near > 0.16);
        RC_ASSERT(is(extended_inverse_centre(growth * sine, sine, y_near), 1 / a));
    }));
}
