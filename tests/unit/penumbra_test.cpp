// SPDX-License-Identifier: MIT
#include "tests/laws/penumbra.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/light_box.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace shadowmath;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
Light<double> const overhead = directional(Vec3<double>(0, -1, 0));
Light<double> const lamp = spot(Vec3<double>(0, 8, 0), Vec3<double>(0, -1, 0), 0.5, 20.0);

}  // namespace

TEST(Penumbra, OfTheRealSunIsACentimetreForEachMetre) {
    double const radius = sun_radius(sun_angular_radius_radians<double>);
    EXPECT_NEAR(penumbra_metres(radius, gap_of_metres(overhead, Vec3<double>(0.0), 10.0)), 0.093, 1e-4);
}

TEST(Penumbra, OfALampFollowsSimilarTriangles) {
    // A lamp of radius 0.5 m at 8 m, an occluder at 6 m from it, 2 m over the floor: 1 m wide times 2 / 6.
    double const gap = gap_of_metres(lamp, Vec3<double>(0.0), 2.0);
    EXPECT_DOUBLE_EQ(gap, 2.0 / 6.0);
    EXPECT_DOUBLE_EQ(penumbra_metres(0.5, gap), 1.0 / 3.0);
    EXPECT_DOUBLE_EQ(metres_of_gap(lamp, Vec3<double>(0.0), gap), 2.0);
}

TEST(Penumbra, GoesToZeroAsTheOccluderComesDown) {
    for (Light<double> const& light : {overhead, lamp}) {
        EXPECT_LT(gap_of_metres(light, Vec3<double>(0.0), 1e-6), 1.1e-6);
        EXPECT_EQ(gap_of_metres(light, Vec3<double>(0.0), 0.0), 0.0);
        EXPECT_EQ(gap_of_metres(light, Vec3<double>(0.0), -3.0), 0.0);
    }
}

TEST(Penumbra, EndsAtTheLamp) {
    EXPECT_EQ(gap_of_metres(lamp, Vec3<double>(0.0), 8.0), widest_gap<double>);
    EXPECT_EQ(gap_of_metres(lamp, Vec3<double>(0.0), 9.0), widest_gap<double>);
    EXPECT_EQ(gap_of_metres(lamp, lamp.position, 1.0), widest_gap<double>);
    EXPECT_NEAR(metres_of_gap(lamp, Vec3<double>(0.0), widest_gap<double>), 8.0, 1e-5);
}

TEST(Penumbra, OfAMapIsItsTexelsAMetreTimesTheRadius) {
    // A box of 4 m by 8 m by 10 m: per metre of gap a radius of 0.1 is 0.025 and 0.0125 of the texture.
    LightBox<double> box;
    box.hi = Vec2<double>(3, 7);
    box.depth_hi = 10;
    ShadowMap<double> map;
    map.clip = gl_zero_to_one_clip;
    map.clip_from_world = clip_from_world(box, map.clip);
    map.visible = true;
    MapPenumbra<double> const penumbra = penumbra_for(map, overhead, 0.1);
    EXPECT_DOUBLE_EQ(penumbra.depth_of_gap, 0.1);
    Vec2<double> const texels = kernel_texels(penumbra, Vec4<double>(0.5, 0.5, 0.5, 1), 1000, 2.0);
    EXPECT_DOUBLE_EQ(texels.x, 50.0);
    EXPECT_DOUBLE_EQ(texels.y, 25.0);
}

TEST(Penumbra, OfBadNumbersIsHard) {
    ShadowMap<double> map;
    EXPECT_EQ(penumbra_for(map, overhead, not_a_number).rim_x, Vec4<double>(0.0));
    EXPECT_EQ(penumbra_for(map, overhead, -1.0).rim_x, Vec4<double>(0.0));
    EXPECT_EQ(sun_radius(not_a_number), 0.0);
    EXPECT_EQ(sun_radius(-1.0), 0.0);
    EXPECT_EQ(sun_radius(1e9), std::tan(1.5));
    map.clip_from_world[1][1] = not_a_number;
    EXPECT_EQ(penumbra_for(map, overhead, 0.1).rim_x, Vec4<double>(0.0));
    EXPECT_EQ(gap_of_metres(lamp, Vec3<double>(not_a_number), 1.0), 0.0);
    EXPECT_EQ(metres_of_gap(lamp, Vec3<double>(0.0), not_a_number), 0.0);
}

TEST(Penumbra, OfAMapHasNoKernelWithoutAMapAPlaceOrAGap) {
    MapPenumbra<double> penumbra;
    penumbra.rim_x = Vec4<double>(0.25, 0, 0, 0);
    penumbra.rim_y = Vec4<double>(0, 0.5, 0, 0);
    Vec4<double> const place(0.5, 0.5, 0.5, 1.0), behind(0.5, 0.5, 0.5, 0.0);
    double const nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(kernel_texels(penumbra, place, 100, 0.1), Vec2<double>(2.5, 5.0));
    EXPECT_EQ(kernel_texels(penumbra, place, 0, 0.1), Vec2<double>(0.0));
    EXPECT_EQ(kernel_texels(penumbra, behind, 100, 0.1), Vec2<double>(0.0));
    EXPECT_EQ(kernel_texels(penumbra, Vec4<double>(nan), 100, 0.1), Vec2<double>(0.0));
    EXPECT_EQ(kernel_texels(penumbra, place, -4, 0.1), Vec2<double>(0.0));
    EXPECT_EQ(kernel_texels(penumbra, Vec4<double>(0.5, 0.5, 0.5, -1.0), 100, 0.1), Vec2<double>(0.0));
    EXPECT_EQ(kernel_texels(penumbra, Vec4<double>(0.5, 0.5, nan, 1.0), 100, 0.1), Vec2<double>(0.0));
    EXPECT_EQ(kernel_texels(penumbra, place, 100, nan), Vec2<double>(0.0));
    EXPECT_EQ(kernel_texels(penumbra, place, 100, std::numeric_limits<double>::max()), Vec2<double>(0.0)) << "no end";
}

TEST(Penumbra, OfALightOfNoRadiusHasNoRimAndOfAMapOfOneTexelAKernel) {
    ShadowMap<double> map;
    map.clip_from_world = clip_from_world(LightBox<double>{}, gl_zero_to_one_clip);
    map.clip = gl_zero_to_one_clip;
    map.visible = true;
    for (double const radius : {0.0, -1.0}) {
        MapPenumbra<double> const hard = penumbra_for(map, overhead, radius);
        EXPECT_GT(hard.depth_of_gap, 0.0);
        EXPECT_EQ(hard.rim_x, Vec4<double>(0.0));
        EXPECT_EQ(hard.rim_y, Vec4<double>(0.0));
    }
    MapPenumbra<double> const soft = penumbra_for(map, overhead, 0.5);
    Vec4<double> const receiver(0.5, 0.5, 0.5, 1.0);
    EXPECT_GT(kernel_texels(soft, receiver, 1, 1.0).x, 0.0);
    auto const run = test::watched([&] { return kernel_texels(soft, Vec4<double>(0.5, 0.5, 0.5, 0.0), 64, 1.0); });
    EXPECT_EQ(run.result, Vec2<double>(0.0));
    EXPECT_TRUE(run.calm_in_range());
}

TEST(Penumbra, OfALampBeyondAllNumbersHasNoMetres) {
    float const most = std::numeric_limits<float>::max();
    Light<float> const far_lamp = spot(Vec3<float>(most), Vec3<float>(0, -1, 0), 0.5f, 10.0f);
    EXPECT_EQ(metres_of_gap(far_lamp, Vec3<float>(-most), 1.0f), 0.0f);
    Light<double> const sun = directional(Vec3<double>(0, -1, 0));
    ShadowMap<double> map;
    map.clip_from_world = clip_from_world(LightBox<double>{}, map.clip);
    map.visible = true;
    EXPECT_NE(penumbra_for(map, sun, 0.01).rim_x, Vec4<double>(0.0));
    EXPECT_EQ(penumbra_for(map, sun, std::numeric_limits<double>::infinity()).rim_x, Vec4<double>(0.0));
    EXPECT_EQ(penumbra_for(ShadowMap<double>{}, sun, 0.01).rim_x, Vec4<double>(0.0));
}
