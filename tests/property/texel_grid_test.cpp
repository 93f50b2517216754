// SPDX-License-Identifier: MIT
#include "tests/laws/texel_grid.hpp"
#include "tests/support/gen.hpp"

#include <shadowmath/fit_sphere.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class TexelGridProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(TexelGridProperty, Scalars);

TYPED_TEST(TexelGridProperty, HoldsSphereAndMargin) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const light = *sun<T>();
        auto const margin = *uniform<T>(T(0), T(8));
        int const size = 19 + static_cast<int>(*below(8000));
        Sphere<T> sphere;
        sphere.center = *point_within<T>(T(100));
        sphere.radius = *log_uniform<T>(T(1), T(1e4));
        auto const grid = texel_grid(light_basis(light.direction), sphere, size, margin);
        RC_ASSERT(laws::holds_sphere_and_margin(grid, sphere, margin));
    }));
}

// Far away too, where the reach of the type ends before: the fault says so.
TYPED_TEST(TexelGridProperty, APointKeepsItsPlaceInItsTexelWhateverTheCameraDoes) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const light = *sun<T>();
        auto view = *view_volume<T>();
        auto const clip = *clip_space();
        auto const basis = light_basis(light.direction);
        auto const before = texel_grid(basis, bounding_sphere(view), 1024, T(2));
        view.pose = *pose<T>(world_radius<T>);
        auto const after = texel_grid(basis, bounding_sphere(view), 1024, T(2));
        auto const aside = *point_within<T>(T(1));
        auto const point = view.pose.position + aside;
        RC_PRE(before.visible && after.visible);
        RC_ASSERT(before.texel_metres == after.texel_metres);
        if (before.faults.any() || after.faults.any()) return;
        RC_ASSERT(laws::keeps_its_place_in_the_texel(before, after, clip, point));
    }));
}

TYPED_TEST(TexelGridProperty, IsHarmlessForAnyNumbersAtAll) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        LightBasis<T> basis;
        basis.x = *nasty_vec3<T>();
        bool const good_axes = *one_in(2);
        if (good_axes) basis = LightBasis<T>{};
        Sphere<T> sphere;
        sphere.center = *nasty_vec3<T>();
        sphere.radius = *nasty<T>();
        auto const margin = *nasty<T>();
        auto const lo = *nasty<T>();
        auto const hi = *nasty<T>();
        auto const clip = *clip_space();
        int const size = static_cast<int>(*below(1u << 31));
        RC_ASSERT(laws::is_harmless(texel_grid(basis, sphere, size, margin), lo, hi, clip));
    }));
}

TYPED_TEST(TexelGridProperty, AHeldSizeIsEnoughAndNoMoreThanAQuarterTooMuchForAnyNumbers) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const odd = *nasty<T>();
        auto const good = *log_uniform<T>(T(1e-3), T(1e3));
        auto const needed = *one_in(3) ? odd : good;
        auto const last = *one_in(3) ? *nasty<T>() : good * *uniform<T>(T(0.5), T(2));
        auto const held = held_size(needed, last);
        if (!all_finite(&needed, 1)) return;
        RC_ASSERT(all_finite(&held, 1) && held >= needed);
        RC_ASSERT(!(needed > T(0)) || held <= needed * T(1.2500001));
        // Once held, it stays.
        RC_ASSERT(held_size(needed, held) == held);
    }));
}
