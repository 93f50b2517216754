// SPDX-License-Identifier: MIT
#include "tests/laws/light.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class LightProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(LightProperty, Scalars);

TYPED_TEST(LightProperty, TheBasisIsOrthonormalForEveryDirection) {
    EXPECT_TRUE(rc::check([] {
        auto const travel = *direction<TypeParam>();
        auto const made = watched([&travel] { return light_basis(travel); });
        RC_ASSERT(made.calm_in_range());
        RC_ASSERT(laws::is_orthonormal(made.result));
    }));
}

TYPED_TEST(LightProperty, TheBasisFollowsTheLightContinuously) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Vec3<T> const travel = *direction<T>();
        Vec3<T> const aside = *point_within<T>(T(1e-3));
        Vec3<T> const turned = safe_normalize(travel + aside).direction;
        // Closer than its own turn to the declared direction, +y, no bound is promised.
        T const off_axis = std::hypot(travel.x, travel.z);
        RC_PRE(travel.y < T(0) || off_axis > T(4) * glm::length(aside));
        RC_ASSERT(laws::follows_the_light(travel, turned));
    }));
}

TYPED_TEST(LightProperty, OneHomogeneousPointStandsForEveryRay) {
    EXPECT_TRUE(rc::check([] {
        auto const sun_light = *sun<TypeParam>();
        auto const lamp = *spot_light<TypeParam>();
        RC_ASSERT(laws::is_where_its_rays_meet(sun_light));
        RC_ASSERT(laws::is_where_its_rays_meet(lamp));
    }));
}

TYPED_TEST(LightProperty, AnythingAtAllMakesALightThatIsUsableOrSaysWhy) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Vec3<T> const position = *nasty_vec3<T>();
        Vec3<T> const axis = *nasty_vec3<T>();
        T const half_angle_radians = *nasty<T>();
        T const range = *nasty<T>();
        auto const sun_light = watched([&] { return directional(axis); });
        auto const lamp = watched([&] { return spot(position, axis, half_angle_radians, range); });
        RC_ASSERT(sun_light.calm() && lamp.calm());
        RC_ASSERT(laws::is_usable_or_says_why(sun_light.result));
        RC_ASSERT(laws::is_usable_or_says_why(lamp.result));
        RC_ASSERT(all_finite(toward(lamp.result, position)));
    }));
}
