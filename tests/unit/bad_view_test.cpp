// SPDX-License-Identifier: MIT
//
// What can be wrong with the camera and the light, and what is promised for it: one test for each kind, over every
// technique that it reaches. The names carry the row of this table; bad_scene_test.cpp holds the others.
//
//    1 NaN or infinity in any input          15 boxes as large as the type allows
//    2 light along up, or along the view     16 a world of 100 to 100 000 km
//    3 a light direction of no length        17 denormals, flushed or not
//    4 near = 0                              18 a projection that is singular
//    5 near < 0, near >= far                 19 casters behind the eye, or across w = 0
//    6 far = infinity                        20 a shadow plane through the eye or along the light
//    7 far / near up to 10^9                 21 a light from below
//    8 field of view or aspect impossible    22 a spot of angle 0 or a right angle, of radius 0, on a vertex
//    9 off-centre, orthographic, reversed,   23 a map of 0, 1 or 2^17 texels
//      infinite projections: no fault        24 a tile outside its atlas
//   10 0, 1 or any number of splits          25 options without measure
//   11 lambda outside [0, 1]                 26 a bent pose, a scaled view matrix
//   12 no casters                            27 triangles that are degenerate, edge-on, huge
//   13 no receivers                          28 aliasing, unaligned arrays, lengths off by one
//   14 casters of one point, line, plane
#include "tests/laws/splits.hpp"
#include "tests/laws/view_volume.hpp"
#include "tests/support/every_map.hpp"

#include <gtest/gtest.h>

#include <utility>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

using namespace shadowmath;
using namespace shadowmath::test;

TEST(BadInput, NoneOfItIsInTheGoodInputOfTheseTests) {
    expect_visible(Input<float>{});
    expect_visible(Input<double>{});
}

TEST(BadInput, Row01NaNAndInfinityAnywhereInTheViewMakeNothingVisible) {
    for (double const bad : {nan_value, infinity, -infinity})
        for (int field = 0; field < 17; ++field) {
            Input<double> in;
            Pose<double>& pose = in.view.pose;
            glm::dvec3* const vectors[] = {&pose.position, &pose.right, &pose.up, &pose.forward};
            double* const scalars[] = {&in.view.left, &in.view.right, &in.view.bottom, &in.view.top, &in.view.z_near};
            (field < 12 ? (*vectors[field / 3])[field % 3] : *scalars[field - 12]) = bad;
            expect_none_visible(in, field >= 12 && field < 16 ? Fault::bad_frustum : Fault::not_finite);
        }
}

TEST(BadInput, Row01NaNAndInfinityInALightMakeNothingVisible) {
    for (double const bad : {nan_value, infinity, -infinity})
        for (int axis = 0; axis < 3; ++axis) {
            Input<double> in;
            glm::dvec3 travel(0.4, -1, 0.3);
            travel[axis] = bad;
            in.sun = directional(travel);
            in.lamp = spot(glm::dvec3(0, 9, 0), travel, 0.7, 40.0);
            expect_none_visible(in, Fault::not_finite);
            in.sun = Light<double>{};
            in.sun.direction[axis] = bad;  // made by hand, around the door
            in.lamp = in.sun;
            expect_none_visible(in, Fault::not_finite);
        }
}

TEST(BadInput, Row02ALightAlongTheUpAxisOrTheViewIsNoFault) {
    Input<double> in;
    for (glm::dvec3 const& travel : {glm::dvec3(0, -1, 0), glm::dvec3(1e-9, -1, 0), in.view.pose.forward}) {
        in.sun = directional(travel);
        for (Made<double> const& one : every_map(in)) {
            if (one.light.kind == LightKind::spot) continue;
            // A light in the view's direction is above the horizon here, but grazes what a plane may take.
            EXPECT_TRUE(one.map.visible) << one.technique << ": " << describe(one.map.faults);
            EXPECT_TRUE(laws::is_map_of(one.map.clip_from_world, one.light, in.clip, 256)) << one.technique;
        }
    }
}

// The one direction is straight up, where no sun shines. A turn by 1e-3 turns the axes by as much, or by what its angle
// to that direction multiplies it with: at 1e-2 from it a hundredfold.
TEST(BadInput, Row02TheAxesOfALightAreOrthonormalAndTurnWithItButAtOneDirection) {
    std::vector<glm::dvec3> directions;
    for (int axis = 0; axis < 3; ++axis)
        for (double const sign : {-1.0, 1.0})
            for (double const off : {0.0, 1e-8, 1e-6, 1e-3, 0.3}) {
                glm::dvec3 direction(off, off * 0.5, -off);
                direction[axis] = sign;
                directions.push_back(glm::normalize(direction));
            }
    for (glm::dvec3 const& direction : directions) {
        LightBasis<float> const rough = light_basis(directional(glm::vec3(direction)).direction);
        glm::mat3 const axes(rough.x, rough.y, rough.depth);
        glm::mat3 const square = glm::transpose(axes) * axes;
        for (int i = 0; i < 9; ++i) EXPECT_NEAR(square[i / 3][i % 3], i % 4 == 0 ? 1.0f : 0.0f, 1e-6f);
        if (direction.y > 1 - 1e-4) continue;
        for (glm::dvec3 const& turn : {glm::dvec3(1e-3, 0, 0), glm::dvec3(0, 1e-3, 0), glm::dvec3(0, 0, 1e-3)}) {
            LightBasis<double> const here = light_basis(direction);
            LightBasis<double> const there = light_basis(glm::normalize(direction + turn));
            double const most = 1e-3 * (direction.y > 0.9 ? 100 : 4);
            EXPECT_LE(glm::length(here.x - there.x) + glm::length(here.y - there.y), most);
        }
    }
}

TEST(BadInput, Row02AWarpGoesOutGentlyAsTheLightTurnsIntoTheView) {
    Input<double> in;
    auto const fade_at = [&in](double radians) {
        glm::dvec3 const travel = in.view.pose.forward * std::cos(radians) + in.view.pose.up * std::sin(radians);
        return warp_axes(in.view.pose, travel).fade;
    };
    EXPECT_EQ(fade_at(0.0), 0.0);
    EXPECT_EQ(fade_at(0.09), 0.0);
    EXPECT_EQ(fade_at(0.55), 1.0);
    for (double radians = 0; radians < 0.6; radians += 1e-3) {
        EXPECT_GE(fade_at(radians + 1e-3), fade_at(radians));
        EXPECT_LE(fade_at(radians + 1e-3), fade_at(radians) + 4e-3);
    }
}

TEST(BadInput, Row03ATinyLightDirectionIsNormalizedAndAZeroOneIsAFault) {
    for (float const length : {1e-30f, 1e-38f, 1e30f, 3e38f}) {
        Light<float> const light = directional(glm::vec3(0, -length, 0));
        EXPECT_FALSE(light.faults.any()) << length;
        EXPECT_EQ(light.direction, glm::vec3(0, -1, 0));
    }
    Input<double> in;
    in.sun = directional(glm::dvec3(0));
    in.lamp = spot(glm::dvec3(0, 9, 0), glm::dvec3(0), 0.7, 40.0);
    expect_none_visible(in, Fault::zero_light);
}

TEST(BadInput, Row04ANearDistanceOfZeroLeavesUniformSplitsExactAndLogarithmicOnesFinite) {
    Splits<double> const uniform = uniform_splits(0.0, 100.0, 4);
    EXPECT_FALSE(uniform.faults.any());
    EXPECT_EQ(uniform.plane[1], 25.0);
    Splits<double> const practical = practical_splits(0.0, 100.0, 4);
    EXPECT_EQ(practical.faults, Faults(Fault::near_clamped));
    EXPECT_TRUE(laws::is_ordered(practical, 0.0, 100.0, 4));
    Input<double> in;
    in.view.z_near = 0;
    every_map(in);
}

TEST(BadInput, Row05ANegativeOrCrossedRangeIsEmptyAndNeverSwapped) {
    for (auto const& [z_near, z_far] : {std::pair(-1.0, 10.0), std::pair(10.0, 10.0), std::pair(20.0, 10.0)}) {
        Splits<double> const splits = practical_splits(z_near, z_far, 4);
        EXPECT_EQ(splits.count, 0);
        EXPECT_EQ(splits.faults, Faults(Fault::empty_range));
        Input<double> in;
        in.view.z_near = z_near;
        in.view.z_far = z_far;
        expect_none_visible(in, Fault::empty_range);
    }
}

TEST(BadInput, Row06AnInfiniteFarDistanceIsCutToTheShadowDistance) {
    Input<double> in;
    in.view.z_far = infinity;
    in.cascades.shadow_distance = 80;
    Cascades<double> const cascades = fit_cascades(in.view, in.sun, in.casters, in.receivers, in.cascades);
    ASSERT_EQ(cascades.count, 4);
    EXPECT_EQ(cascades.at[3].range.end, 80.0);
    EXPECT_FALSE(cascades.faults.any()) << describe(cascades.faults);
    in.cascades.shadow_distance = 0;
    EXPECT_TRUE(fit_cascades(in.view, in.sun, in.casters, in.receivers, in.cascades).faults.has(Fault::far_clamped));
    every_map(in);
}

TEST(BadInput, Row07RangesOfABillionKeepTheirFarCorners) {
    Input<double> in;
    in.view.z_near = 1e-3;
    in.view.z_far = 1e6;
    in.casters = in.receivers = {glm::dvec3(-2e6, -2e6, -2e6), glm::dvec3(2e6, 5, 2e6)};
    EXPECT_TRUE(laws::has_accurate_corners(in.view));
    for (Made<double> const& one : every_map(in))
        EXPECT_TRUE(one.map.visible || one.technique == "view-dependent map") << one.technique;
    Input<float> rough;
    rough.view.z_near = 1e-3f;
    rough.view.z_far = 1e6f;
    EXPECT_TRUE(laws::has_accurate_corners(rough.view));
    every_map(rough);
}

TEST(BadInput, Row08AnImpossibleFieldOfViewIsABadFrustum) {
    for (auto const& [fov, aspect] :
         {std::pair(0.0, 1.5), std::pair(-1.0, 1.5), std::pair(3.2, 1.5), std::pair(nan_value, 1.5),
          std::pair(1.0, 0.0), std::pair(1.0, -1.0), std::pair(1.0, nan_value)}) {
        Input<double> in;
        in.view = perspective_view(in.view.pose, fov, aspect, 0.1, 60.0);
        expect_none_visible(in, Fault::bad_frustum);
    }
    Input<double> crossed;
    std::swap(crossed.view.left, crossed.view.right);
    expect_none_visible(crossed, Fault::bad_frustum);
}

TEST(BadInput, Row09OffCentreAndOrthographicViewsAreNoneOfIt) {
    Input<double> in;
    in.view.left = -0.1;
    expect_visible(in);
    in.view = orthographic_view(in.view.pose, -6.0, 9.0, -4.0, 4.0, 0.5, 50.0);
    for (Made<double> const& one : every_map(in))
        if (one.technique != "view-dependent map") {
            EXPECT_TRUE(one.map.visible) << one.technique << ": " << describe(one.map.faults);
        }
}

TEST(BadInput, Row09AReversedInfiniteOrJitteredProjectionOfTheEyeIsNoneOfItAndGivesTheSameMaps) {
    Input<double> in;
    in.view.left *= 0.9;  // off-centre, as jitter and stereo are
    std::vector<Made<double>> const wanted = every_map(in);
    Pose<double> const origin;  // looks along -z, as clip_from_view takes it
    for (ClipSpace const clip : {gl_clip, vulkan_clip, d3d_clip, reversed(d3d_clip), reversed(vulkan_clip)})
        for (double const z_far : {60.0, infinity}) {
            ViewVolume<double> eye = in.view;
            eye.pose = origin;
            eye.z_far = z_far;
            Input<double> read = in;
            read.view = view_from_projection(in.view.pose, clip_from_world(eye, clip), 0.1, 60.0);
            std::vector<Made<double>> const made = every_map(read);
            ASSERT_EQ(made.size(), wanted.size());
            for (std::size_t i = 0; i < made.size(); ++i)
                for (int column = 0; column < 4; ++column)
                    // The sides are read to 2 ulp; a map multiplies that by what it crops, hundreds at most.
                    EXPECT_LE(glm::length(made[i].map.clip_from_world[column] - wanted[i].map.clip_from_world[column]),
                              1e-11 * (1 + glm::length(wanted[i].map.clip_from_world[column])))
                        << made[i].technique;
        }
}

TEST(BadInput, Row22ALampInTheCornerOfABoxIsNoFault) {
    Input<double> in;
    for (glm::dvec3 const& corner : {in.casters.lo, in.casters.hi, in.receivers.hi, in.view.pose.position}) {
        in.lamp = spot(corner, glm::dvec3(-0.1, -1, -0.2), 0.7, 40.0);
        for (Made<double> const& one : every_map(in))
            EXPECT_FALSE(one.map.faults.has(Fault::not_finite)) << one.technique;
    }
}

TEST(BadInput, Row16AThousandKilometresOutADoubleLosesAFewBillionthsOfATexel) {
    Light<double> const sun = directional(glm::dvec3(0.4, -1, 0.3));
    using Wide = long double;
    for (int step = 0; step < 100; ++step) {
        Vec3<double> const centre(1e6 + step * 0.37, 120.0, -1e6 + step * 0.11);
        TexelGrid<double> const grid = texel_grid(light_basis(sun.direction), {centre, 51.2}, 2048, 0.0);
        ASSERT_TRUE(grid.visible && !grid.faults.any());
        // Texels of 5 cm, so that the offset is 3e4: its last bit is 4e-9 texels. The place of the centre by the
        // matrix, and by the axes in long double.
        Vec4<Wide> const at =
            Mat4<Wide>(clip_from_world(grid, 0.0, 1.0, gl_zero_to_one_clip)) * Vec4<Wide>(Vec3<Wide>(centre), 1);
        Wide const by_axes = glm::dot(Vec3<Wide>(grid.basis.x), Vec3<Wide>(centre)) / grid.texel_metres - grid.x;
        EXPECT_NEAR(static_cast<double>((at.x + 1) / 2 * grid.map_size - by_axes), 0.0, 5e-9);
    }
}

TEST(BadInput, Row16FarFromTheOriginMapsStayMapsOfTheirLight) {
    for (double const metres : {1e5, 1e6, 1e7}) {
        Input<double> in;
        glm::dvec3 const away(metres, 0, -metres);
        in.view.pose.position += away;
        in.lamp.position += away;
        for (Aabb<double>* const box : {&in.casters, &in.receivers}) *box = {box->lo + away, box->hi + away};
        expect_visible(in);
    }
    for (float const metres : {1e8f, 1e20f, 1e38f}) {
        Input<float> in;
        in.view.pose.position += glm::vec3(metres);
        every_map(in);
    }
}

#if defined(__SSE2__)
TEST(BadInput, Row17FlushingDenormalsToZeroChangesNothingButDenormals) {
    Input<double> in;
    in.sun = directional(glm::dvec3(1e-310, -1, 5e-324));
    in.casters.lo.x = -1e-310;
    std::vector<Made<double>> const with = every_map(in);
    unsigned const before = _mm_getcsr();
    _mm_setcsr(before | 0x8040u);  // flush to zero, and denormals are zero
    std::vector<Made<double>> const without = every_map(in);
    _mm_setcsr(before);
    ASSERT_EQ(with.size(), without.size());
    for (std::size_t i = 0; i < with.size(); ++i) {
        // Where a light goes along an axis to the last denormal, the focus may cut its body's edges in another order.
        double const roundings = with[i].technique == "focus cascade" ? 4 * std::numeric_limits<double>::epsilon() : 0;
        for (int column = 0; column < 4; ++column) {
            glm::dvec4 const& a = with[i].map.clip_from_world[column];
            glm::dvec4 const& b = without[i].map.clip_from_world[column];
            for (int r = 0; r < 4; ++r)
                EXPECT_LE(std::abs(a[r] - b[r]), std::numeric_limits<double>::min() + roundings * (1 + glm::length(a)))
                    << with[i].technique << " " << column << " " << r;
        }
    }
}
#endif

TEST(BadInput, Row18AProjectionWithoutSidesIsABadFrustum) {
    for (glm::dmat4 const& singular : {glm::dmat4(0.0), glm::dmat4(nan_value), glm::dmat4(infinity)}) {
        Input<double> in;
        in.view = view_from_projection(in.view.pose, singular, 0.1, 60.0);
        expect_none_visible(in, Fault::bad_frustum);
    }
}

TEST(BadInput, Row21ALightFromBelowIsADirectionLikeAnyOther) {
    Input<double> in;
    for (glm::dvec3 const& travel : {glm::dvec3(0, 1, 0), glm::dvec3(0.3, 0.8, -0.1)}) {
        in.sun = directional(travel);
        EXPECT_TRUE(faces_away(in.sun, glm::dvec3(0), glm::dvec3(0, 1, 0)));
        for (Made<double> const& one : every_map(in))
            EXPECT_TRUE(one.map.visible || one.technique.find("cascade") == std::string::npos) << one.technique;
    }
}

TEST(BadInput, Row22TheAngleOfASpotIsBroughtIntoItsRangeAndARangeOfZeroIsNothing) {
    for (double const angle : {0.0, -1.0, 1.5707963, 3.0, 1e30}) {
        Light<double> const lamp = spot(glm::dvec3(0, 9, 0), glm::dvec3(0, -1, 0), angle, 40.0);
        EXPECT_EQ(lamp.faults, Faults(Fault::cone_clamped)) << angle;
        EXPECT_FALSE(unusable(lamp));
        Input<double> in;
        in.lamp = lamp;
        every_map(in);
    }
    Input<double> in;
    for (double const range : {0.0, -1.0}) {
        in.lamp = spot(glm::dvec3(0, 9, 0), glm::dvec3(0, -1, 0), 0.5, range);
        EXPECT_TRUE(in.lamp.faults.has(Fault::empty_range));
        EXPECT_FALSE(every_map(in).back().map.visible);
    }
}

TEST(BadInput, Row26ABentPoseIsMendedAndABrokenOneIsAFault) {
    Input<double> in;
    in.view.pose.right *= 1.0004;
    expect_visible(in);
    in.view.pose.right *= 1.1;
    expect_none_visible(in, Fault::bad_pose);
    in.view.pose.right = in.view.pose.up;
    expect_none_visible(in, Fault::bad_pose);
}
