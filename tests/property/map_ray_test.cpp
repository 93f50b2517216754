// SPDX-License-Identifier: MIT
#include "tests/laws/map_ray.hpp"
#include "tests/laws/stillness.hpp"
#include "tests/support/any_map.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class MapRayProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(MapRayProperty, Scalars);

// 200 m from the origin at most, texels of a millimetre at least, cones of 150 degrees: within 2^12 roundings.
TYPED_TEST(MapRayProperty, AnyMapSeesAlongItsLight) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const any = *any_map<T>();
        auto const point = *point_in(any.map);
        RC_PRE(projected(any.map.clip_from_world, point).in_front);
        RC_ASSERT(laws::sees_along_its_light(any.map, any.light, point, T(4096) * std::numeric_limits<T>::epsilon()));
    }));
}

// A thousandth of a metre moves by less than a thousandth of the map.
TYPED_TEST(MapRayProperty, AStepAlongTheRayKeepsItsTexelAndGoesDeeper) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const any = *any_map<T>();
        auto const point = *point_in(any.map);
        auto const ray = map_ray(any.map, point);
        RC_PRE(ray.ok);
        RC_ASSERT(
            laws::keeps_texel_and_gains_depth(any.map, ray, point, 1e-3L, std::is_same_v<T, float> ? 1e-5L : 1e-12L));
    }));
}

TYPED_TEST(MapRayProperty, IsHarmlessForAnyMatrixAtAll) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const map = *nasty_map<T>();
        auto const other = *nasty_map<T>();
        auto const light = *sun<T>();
        auto const point = *nasty_vec3<T>();
        auto const size = static_cast<int>(*below(5000));
        RC_ASSERT(laws::is_ray(map_ray(map, point)));
        RC_ASSERT(laws::is_angle(light_error_radians(map, light, point)));
        RC_ASSERT(laws::is_texel_shift(texel_shift(map, other, size, point)));
    }));
}
