// SPDX-License-Identifier: MIT
#include "tests/laws/map_ray.hpp"
#include "tests/support/every_map.hpp"

#include <shadowmath/light_box.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class MapRayOf : public ::testing::Test {};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(MapRayOf, Scalars);

TYPED_TEST(MapRayOf, EveryTechniqueSeesAlongItsLight) {
    using T = TypeParam;
    T const tolerance = T(512) * std::numeric_limits<T>::epsilon();
    for (ClipSpace const clip : {gl_clip, vulkan_clip, reversed(d3d_clip)}) {
        Input<T> in;
        in.clip = clip;
        int seen = 0;
        for (Made<T> const& one : every_map(in))
            for (Vec3<T> const& point : {Vec3<T>(T(1), T(0), T(3)), Vec3<T>(T(-2), T(1), T(-4))}) {
                if (!one.map.visible || !projected(one.map.clip_from_world, point).in_front) continue;
                ++seen;
                EXPECT_TRUE(laws::sees_along_its_light(one.map, one.light, point, tolerance))
                    << one.technique << ": " << double(light_error_radians(one.map, one.light, point));
            }
        EXPECT_GT(seen, 20);
    }
}

TYPED_TEST(MapRayOf, ASunThatMovedIsOffByItsAngle) {
    using T = TypeParam;
    Input<T> in;
    for (T const degrees : {T(0.1), T(1), T(30), T(90), T(179)}) {
        T const radians = degrees * T(3.14159265358979323846264338327950288L / 180);
        LightBasis<T> const basis = light_basis(in.sun.direction);
        Light<T> const moved = directional(in.sun.direction * std::cos(radians) + basis.x * std::sin(radians));
        for (Made<T> const& one : every_map(in)) {
            if (one.light.kind != LightKind::directional) continue;
            EXPECT_NEAR(double(light_error_radians(one.map, moved, Vec3<T>(T(0), T(0), T(2)))), double(radians), 1e-5)
                << one.technique;
        }
    }
}

TYPED_TEST(MapRayOf, DepthThatRunsBackwardsIsHalfATurn) {
    using T = TypeParam;
    Input<T> in;
    in.clip = gl_zero_to_one_clip;
    ShadowMap<T> map = every_map(in).front().map;
    Vec3<T> const point(T(0), T(0), T(2));
    EXPECT_LE(light_error_radians(map, in.sun, point), T(1e-5));
    map.clip = reversed(map.clip);
    EXPECT_GE(light_error_radians(map, in.sun, point), T(3.1415));
    map.clip_from_world = clip_from_canonical<T>(map.clip) * map.clip_from_world;
    EXPECT_LE(light_error_radians(map, in.sun, point), T(1e-5));
}

TYPED_TEST(MapRayOf, WhatIsNoMapHasNoRay) {
    using T = TypeParam;
    Input<T> const in;
    ShadowMap<T> map;
    map.visible = true;
    Vec3<T> const point(T(1), T(2), T(3));
    T const pi = T(3.14159265358979323846264338327950288L);
    EXPECT_FALSE(map_ray(map, point).ok) << "nowhere";
    EXPECT_EQ(light_error_radians(map, in.sun, point), pi);
    map.clip_from_world = Mat4<T>(T(0));
    EXPECT_FALSE(map_ray(map, point).ok) << "all zeros";
    map.clip_from_world = Mat4<T>(T(1));
    EXPECT_TRUE(map_ray(map, point).ok);
    map.clip_from_world[2] = Vec4<T>(T(0));
    EXPECT_FALSE(map_ray(map, point).ok) << "depth is the same along the ray";
    map.clip_from_world = Mat4<T>(T(1));
    map.clip_from_world[1] = map.clip_from_world[0];
    EXPECT_FALSE(map_ray(map, point).ok) << "x and y are one";
    map.clip_from_world = Mat4<T>(T(1));
    map.clip_from_world[3][3] = T(-1);
    EXPECT_FALSE(map_ray(map, point).ok) << "w is negative";
    map.clip_from_world[0][0] = std::numeric_limits<T>::quiet_NaN();
    EXPECT_FALSE(map_ray(map, point).ok);
    map.clip_from_world = Mat4<T>(T(1));
    EXPECT_FALSE(map_ray(map, Vec3<T>(std::numeric_limits<T>::infinity())).ok);
    EXPECT_EQ(light_error_radians(map, directional(Vec3<T>(T(0))), point), pi) << "no light";
    EXPECT_EQ(light_error_radians(map, spot(point, Vec3<T>(T(0), T(0), T(1)), T(0.5), T(10)), point), pi)
        << "the lamp is the point";
}

TEST(MapRay, OfAMapWithoutDepthIsNone) {
    ShadowMap<double> map;
    map.clip_from_world = Mat4<double>(1.0);
    map.visible = true;
    EXPECT_TRUE(map_ray(map, Vec3<double>(0.0)).ok);
    map.clip_from_world[2][2] = 0.0;
    EXPECT_FALSE(map_ray(map, Vec3<double>(0.0)).ok) << "all depths are stored as one";
}

TEST(MapRay, AtTheLampItselfThereIsNoLightAndHalfAMetreBeforeItThereIs) {
    Light<double> const lamp = spot(Vec3<double>(0.0), Vec3<double>(0, -1, 0), 0.5, 10.0);
    ShadowMap<double> map;
    map.visible = true;
    map.clip_from_world = clip_from_world(LightBox<double>{}, map.clip);  // any: along y, as the lamp
    double const pi = 3.14159265358979323846;
    EXPECT_NEAR(light_error_radians(map, lamp, Vec3<double>(0.0)), pi, 1e-15);
    EXPECT_NEAR(light_error_radians(map, lamp, Vec3<double>(0, -0.5, 0)), 0.0, 1e-15);
}
