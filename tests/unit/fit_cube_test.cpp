// SPDX-License-Identifier: MIT
#include "tests/laws/fit_crop.hpp"

#include <shadowmath/fit_cube.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace shadowmath;

namespace {

using V3 = glm::dvec3;

V3 const lamp(0, 5, -20);
Aabb<double> const hall{V3(-30, 0, -60), V3(30, 12, 30)};

ViewVolume<double> hall_view(V3 const& forward) {
    return perspective_view(pose_looking(V3(0, 2, 0), forward, V3(0, 1, 0)), 1.0, 1.6, 0.1, 100.0);
}

}  // namespace

TEST(FaceToward, IsTheFaceWhoseAxisIsNearest) {
    for (int face = 0; face < cube_faces; ++face) {
        V3 const axis = face_light(lamp, 10.0, face).direction;
        EXPECT_EQ(face_toward(lamp, lamp + axis), face);
        EXPECT_EQ(face_toward(lamp, lamp + axis * 3.0 + V3(0.9, -0.8, 0.7)), face);
        EXPECT_EQ(axis[face / 2], face % 2 == 0 ? 1.0 : -1.0);
    }
    EXPECT_EQ(face_toward(lamp, lamp), 0);
    EXPECT_EQ(face_toward(lamp, lamp + V3(1, 1, 1)), 0);
    EXPECT_EQ(face_toward(lamp, lamp + V3(0, -2, 2)), 3) << "of two that are alike the earlier axis";
}

TEST(FitCube, ServesEachReceiverInTheMapOfItsFace) {
    ViewVolume<double> const view = hall_view(V3(0, 0, -1));
    CubeMaps<double> const maps = fit_cube(view, lamp, 25.0, hall, hall, 512, 2.0, gl_clip);
    EXPECT_FALSE(maps.faults.any());
    int served = 0;
    for (double x = -20; x <= 20; x += 2.5)
        for (double y = 0; y <= 12; y += 1.5)
            for (double z = -44; z <= 4; z += 3) {
                V3 const point(x, y, z);
                int const face = face_toward(lamp, point);
                if (!laws::is_seen(view, point) || glm::length(point - lamp) > 25) continue;
                EXPECT_TRUE(laws::serves(maps.face[static_cast<std::size_t>(face)], 512, 2.0, point, 1e-9));
                ++served;
            }
    EXPECT_GT(served, 300);
    for (std::size_t i = 0; i < 6; ++i)
        if (maps.face[i].visible) {
            EXPECT_TRUE(laws::is_map_of(maps.face[i].clip_from_world, face_light(lamp, 25.0, int(i)), gl_clip, 256));
        }
}

TEST(FitCube, SkipsTheFacesThatTheViewDoesNotReach) {
    // Straight at the lamp all six have something in view; from beside it, looking away, only the face on that side.
    EXPECT_GE(fit_cube(hall_view(V3(0, 0, -1)), lamp, 25.0, hall, hall, 512, 2.0, gl_clip).visible_count, 5);
    ViewVolume<double> away = hall_view(V3(0, 0, -1));
    away.pose.position = V3(0, 5, -27);
    CubeMaps<double> const maps = fit_cube(away, lamp, 25.0, hall, hall, 512, 2.0, gl_clip);
    EXPECT_TRUE(maps.face[5].visible);
    EXPECT_FALSE(maps.face[4].visible);
    EXPECT_EQ(fit_cube(hall_view(V3(0, 0, 1)), lamp, 15.0, hall, hall, 512, 2.0, gl_clip).visible_count, 0);
}

TEST(FitCube, SkipsTheFacesWithoutCasters) {
    Aabb<double> const table{V3(-1, 0, -21), V3(1, 1, -19)}, floor{V3(-30, -1, -60), V3(30, 0, 30)};
    CubeMaps<double> const maps = fit_cube(hall_view(V3(0, 0, -1)), lamp, 25.0, table, floor, 512, 2.0, gl_clip);
    EXPECT_EQ(maps.visible_count, 1);
    EXPECT_TRUE(maps.face[3].visible);
    // Its near plane is above the table's top, four metres below the lamp.
    EXPECT_NEAR(maps.face[3].w_min, 4.0, 0.01);
}

TEST(FitCube, HandsOnThatReceiversAreNotFinite) {
    Aabb<double> endless = hall;
    endless.hi.x = std::numeric_limits<double>::infinity();
    CubeMaps<double> const maps = fit_cube(hall_view(V3(0, 0, -1)), lamp, 25.0, hall, endless, 512, 2.0, gl_clip);
    EXPECT_EQ(maps.visible_count, 0);
    EXPECT_TRUE(maps.faults.has(Fault::not_finite));
}

TEST(FitCube, RefusesALampWithoutRange) {
    for (double const range : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        CubeMaps<double> const maps = fit_cube(hall_view(V3(0, 0, -1)), lamp, range, hall, hall, 512, 2.0, gl_clip);
        EXPECT_EQ(maps.visible_count, 0);
        EXPECT_TRUE(maps.faults.any());
        for (auto const& face : maps.face) EXPECT_TRUE(laws::harmless(face));
    }
}
