// SPDX-License-Identifier: MIT
//
// What can be wrong with the camera and the light, and what is promised for it: one test for each kind, over every
// technique that it reaches.
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

TEST(BadView, NoneOfItIsInTheGoodInputOfTheseTests) {
    expect_visible(Input<float>{});
    expect_visible(Input<double>{});
}

TEST(BadView, NaNAndInfinityAnywhereInTheViewMakeNothingVisible) {
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

TEST(BadView, NaNAndInfinityInALightMakeNothingVisible) {
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

TEST(BadView, ALightAlongTheUpAxisOrTheViewIsNoFault) {
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

TEST(BadView, ATinyLightDirectionIsNormalizedAndAZeroOneIsAFault) {
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

TEST(BadView, ANearDistanceOfZeroLeavesUniformSplitsExactAndLogarithmicOnesFinite) {
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

TEST(BadView, ANegativeOrCrossedRangeIsEmptyAndNeverSwapped) {
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

TEST(BadView, AnInfiniteFarDistanceIsCutToTheShadowDistance) {
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

TEST(BadView, RangesOfABillionKeepTheirFarCorners) {
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

TEST(BadView, AnImpossibleFieldOfViewIsABadFrustum) {
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

TEST(BadView, OffCentreAndOrthographicViewsAreNoneOfIt) {
    Input<double> in;
    in.view.left = -0.1;
    expect_visible(in);
    in.view = orthographic_view(in.view.pose, -6.0, 9.0, -4.0, 4.0, 0.5, 50.0);
    for (Made<double> const& one : every_map(in))
        if (one.technique != "view-dependent map") {
            EXPECT_TRUE(one.map.visible) << one.technique << ": " << describe(one.map.faults);
        }
}

TEST(BadView, AReversedInfiniteOrJitteredProjectionOfTheEyeIsNoneOfItAndGivesTheSameMaps) {
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

TEST(BadView, ALampInTheCornerOfABoxIsNoFault) {
    Input<double> in;
    for (glm::dvec3 const& corner : {in.casters.lo, in.casters.hi, in.receivers.hi, in.view.pose.position}) {
        in.lamp = spot(corner, glm::dvec3(-0.1, -1, -0.2), 0.7, 40.0);
        for (Made<double> const& one : every_map(in))
            EXPECT_FALSE(one.map.faults.has(Fault::not_finite)) << one.technique;
    }
}

TEST(BadView, FarFromTheOriginMapsStayMapsOfTheirLight) {
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
TEST(BadView, FlushingDenormalsToZeroChangesNothingButDenormals) {
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

TEST(BadView, AProjectionWithoutSidesIsABadFrustum) {
    for (glm::dmat4 const& singular : {glm::dmat4(0.0), glm::dmat4(nan_value), glm::dmat4(infinity)}) {
        Input<double> in;
        in.view = view_from_projection(in.view.pose, singular, 0.1, 60.0);
        expect_none_visible(in, Fault::bad_frustum);
    }
}

TEST(BadView, ALightFromBelowIsADirectionLikeAnyOther) {
    Input<double> in;
    for (glm::dvec3 const& travel : {glm::dvec3(0, 1, 0), glm::dvec3(0.3, 0.8, -0.1)}) {
        in.sun = directional(travel);
        EXPECT_TRUE(faces_away(in.sun, glm::dvec3(0), glm::dvec3(0, 1, 0)));
        for (Made<double> const& one : every_map(in))
            EXPECT_TRUE(one.map.visible || one.technique.find("cascade") == std::string::npos) << one.technique;
    }
}

TEST(BadView, TheAngleOfASpotIsBroughtIntoItsRangeAndARangeOfZeroIsNothing) {
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

TEST(BadView, ABentPoseIsMendedAndABrokenOneIsAFault) {
    Input<double> in;
    in.view.pose.right *= 1.0004;
    expect_visible(in);
    in.view.pose.right *= 1.1;
    expect_none_visible(in, Fault::bad_pose);
    in.view.pose.right = in.view.pose.up;
    expect_none_visible(in, Fault::bad_pose);
}
