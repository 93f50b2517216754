// SPDX-License-Identifier: MIT
#include "tests/laws/fit_focus.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/seen_case.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
class FitFocusProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(FitFocusProperty, Scalars);

TYPED_TEST(FitFocusProperty, HoldsWhatIsSeenInShadowAndTheCasterOfThatShadow) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        SeenCase<T> const scene = *seen_case<T>();
        Light<T> const light = *sun<T>();
        T const away = *log_uniform<T>(T(1e-3), T(100));
        Vec3<T> const caster =
            scene.point - light.direction * (away * glm::length(scene.point - scene.view.pose.position));
        Vec3<T> const half = glm::abs(*point_within<T>(away));
        Aabb<T> const casters{caster - half, caster + half};
        Focus<T> const focus = focus_of(scene.view, light, casters, scene.receivers);
        // Roundings of the point and its caster, as far out as they lie.
        T const noise =
            T(64) * std::numeric_limits<T>::epsilon() *
            (glm::length(scene.view.pose.position) + glm::length(scene.point) + glm::length(caster) + scene.view.z_far);
        RC_ASSERT(laws::focuses(focus, light.direction, scene.point, caster, noise));
    }));
}

TYPED_TEST(FitFocusProperty, StaysWithinTheBoxOfTheSlice) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        SeenCase<T> const scene = *seen_case<T>();
        Light<T> const light = *sun<T>();
        T const margin = *uniform<T>(T(0), T(8));
        auto const basis = light_basis(light.direction);
        auto const everything = corners(scene.view);
        auto const outer = fit_box(basis, everything, 1024, margin);
        Focus<T> const focus = focus_of(scene.view, light, scene.receivers, scene.receivers);
        RC_ASSERT(focus.visible);
        auto const inner = fit_focus(basis, focus, 1024, margin);
        // A flat focus is widened to a texel of its largest extent, which is less than the slice's.
        T const across = std::max(outer.hi.x - outer.lo.x, outer.hi.y - outer.lo.y);
        T const texel = std::max(across, outer.depth_hi - outer.depth_lo) / T(1024 - 16);
        T const noise = T(4) * T(laws::light_rounding(everything)) * T(4);
        RC_ASSERT(laws::is_within(inner, outer, noise + texel));
        RC_ASSERT(laws::holds_body_and_margin(inner, focus.receivers, 1024, margin));
        auto const rectangle = fit_rectangle(basis, focus.receivers, 1024, margin);
        RC_ASSERT(area(rectangle) <= area(inner));
    }));
}

TYPED_TEST(FitFocusProperty, IsFiniteAndCalmForAnyInput) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ViewVolume<T> const view = *any_view<T>();
        Light<T> const light = *any_sun<T>();
        Aabb<T> const casters = *nasty_box<T>();
        Aabb<T> const receivers = *nasty_box<T>();
        auto const run = watched([&] { return focus_of(view, light, casters, receivers); });
        RC_ASSERT(run.calm());
        auto const basis = light_basis(light.direction);
        RC_ASSERT(laws::is_a_box(fit_focus(basis, run.result, 512, T(2))));
    }));
}

}  // namespace
