// SPDX-License-Identifier: MIT
//
// What can be wrong with everything but the camera and the light (boxes, planes, counts, sizes, options), and what is
// promised for it: one test for each kind, over every technique that it reaches.
#include "tests/support/every_map.hpp"

#include <gtest/gtest.h>

#include <utility>

using namespace shadowmath;
using namespace shadowmath::test;

TEST(BadScene, NaNInABoxMakesNothingVisibleAndNothingWorse) {
    for (int axis = 0; axis < 3; ++axis)
        for (bool const in_casters : {false, true}) {
            Input<double> in;
            (in_casters ? in.casters : in.receivers).hi[axis] = nan_value;
            for (Made<double> const& one : every_map(in)) EXPECT_FALSE(one.map.visible) << one.technique;
        }
}

TEST(BadScene, NaNAndInfinityInAPlaneOrAnOptionPoisonNothing) {
    for (double const bad : {nan_value, infinity, -infinity})
        for (int field = 0; field < 9; ++field) {
            Input<double> in;
            double* const numbers[] = {&in.plane.normal.x,
                                       &in.plane.normal.y,
                                       &in.plane.offset,
                                       &in.margin_texels,
                                       &in.cascades.lambda,
                                       &in.cascades.blend,
                                       &in.cascades.first_split_end,
                                       &in.cascades.shadow_distance,
                                       &in.view.pose.right.x};
            *numbers[field] = bad;
            for (Made<double> const& one : every_map(in))
                EXPECT_TRUE(one.map.visible || one.map.faults.any()) << one.technique << ", field " << field;
        }
}

TEST(BadScene, AnyNumberOfSplitsIsGivenAsFarAsThereIsRoom) {
    EXPECT_EQ(practical_splits(1.0, 100.0, 0).count, 0);
    EXPECT_EQ(practical_splits(1.0, 100.0, 1).count, 1);
    for (int const asked : {max_splits + 1, 1000, std::numeric_limits<int>::max()}) {
        Splits<double> const splits = practical_splits(1.0, 100.0, asked);
        EXPECT_EQ(splits.count, max_splits);
        EXPECT_EQ(splits.faults, Faults(Fault::count_clamped));
    }
    EXPECT_EQ(practical_splits(1.0, 100.0, -3).count, 0);
    for (int const count : {-1, 0, 1, 17, 1 << 30}) {
        Input<double> in;
        in.cascades.count = count;
        every_map(in);
    }
}

TEST(BadScene, LambdaIsBroughtIntoItsRange) {
    for (auto const& [lambda, as_if] : {std::pair(-0.5, 0.0), std::pair(7.0, 1.0), std::pair(nan_value, 0.5)}) {
        Splits<double> const splits = practical_splits(1.0, 1000.0, 3, lambda);
        EXPECT_EQ(splits.faults, Faults(Fault::clamped_option));
        EXPECT_EQ(splits.plane[1], practical_splits(1.0, 1000.0, 3, as_if).plane[1]);
    }
}

TEST(BadScene, NoCastersOrNoReceiversAreNothingToSeeAndNoFault) {
    for (bool const in_casters : {false, true}) {
        Input<double> in;
        (in_casters ? in.casters : in.receivers) = Aabb<double>{};
        for (Made<double> const& one : every_map(in)) {
            EXPECT_FALSE(one.map.visible) << one.technique;
            EXPECT_FALSE(one.map.faults.any()) << one.technique << ": " << describe(one.map.faults);
        }
    }
}

TEST(BadScene, CastersThatAreAPointALineOrAPlaneAreStillSeen) {
    for (glm::dvec3 const& extent : {glm::dvec3(0), glm::dvec3(1, 0, 0), glm::dvec3(3, 0, 3), glm::dvec3(0, 2, 0)}) {
        Input<double> in;
        in.casters = {glm::dvec3(0, 1, 0), glm::dvec3(0, 1, 0) + extent};
        std::size_t seen = 0;
        for (Made<double> const& one : every_map(in)) seen += one.map.visible ? 1u : 0u;
        EXPECT_GE(seen, 8u) << "a cascade of each of the four fits, and the four other maps";
    }
}

TEST(BadScene, BoxesAsLargeAsTheTypeAllowsAreCutBeforeTheyOverflow) {
    Input<float> in;
    in.casters =
        in.receivers = {glm::vec3(std::numeric_limits<float>::lowest()), glm::vec3(std::numeric_limits<float>::max())};
    for (Made<float> const& one : every_map(in))
        EXPECT_TRUE(one.map.visible) << one.technique << ": " << describe(one.map.faults);
}

TEST(BadScene, CastersBehindTheEyeAndBehindALampTakeNothingFromAMap) {
    Input<double> in;
    in.casters = {glm::dvec3(-20, 0, -40), glm::dvec3(20, 30, 40)};
    expect_visible(in);
}

TEST(BadScene, AShadowPlaneThroughTheEyeOrAlongTheLightIsInvalid) {
    Input<double> in;
    VdsmOptions<double> const options;
    ShadowPlane<double> const through_the_eye = plane_through(in.view.pose.position, glm::dvec3(0, 1, 0));
    ShadowPlane<double> const along_the_light =
        plane_through(glm::dvec3(0), glm::normalize(glm::cross(in.sun.direction, glm::dvec3(0, 0, 1))));
    for (ShadowPlane<double> const& plane : {through_the_eye, along_the_light, ShadowPlane<double>{glm::dvec3(0), 0}}) {
        ShadowMap<double> const map =
            view_dependent_map(in.view, in.sun, plane, in.casters, in.receivers, options, in.clip);
        EXPECT_TRUE(laws::harmless(map));
        EXPECT_FALSE(map.visible);
        EXPECT_TRUE(map.faults.has(Fault::invalid_plane)) << describe(map.faults);
    }
}

TEST(BadScene, AMapTooSmallForItsFilterIsNotVisibleAndAnyOtherSizeIs) {
    for (int const size : {-1, 0, 1, 6}) {
        Input<double> in;
        in.map_size = in.cascades.map_size = size;
        in.cascades.filter_radius = 2;
        expect_none_visible(in, Fault::map_too_small);
    }
    for (int const size : {64, 1000, 4095, 1 << 17}) {
        Input<double> in;
        in.map_size = in.cascades.map_size = size;
        expect_visible(in);
    }
}

TEST(BadScene, ATileOutsideItsAtlasIsABadRegionAndTheIdentity) {
    int const huge = std::numeric_limits<int>::max();
    for (Tile const& tile :
         {Tile{0, 0, 0, 64, 64}, Tile{60, 0, 8, 64, 64}, Tile{-1, 0, 8, 64, 64}, Tile{huge, huge, huge, 64, 64}}) {
        EXPECT_TRUE(faults_of(tile).has(Fault::bad_region));
        EXPECT_EQ(tile_matrix<double>(tile), glm::dmat4(1.0));
    }
    EXPECT_EQ(region_matrix(Region<double>{glm::dvec2(1), glm::dvec2(1)}), glm::dmat4(1.0));
}

TEST(BadScene, HugeOptionsAreClampedAndSaySo) {
    Input<double> in;
    in.cascades.blend = 1e9;
    EXPECT_TRUE(fit_cascades(in.view, in.sun, in.casters, in.receivers, in.cascades).faults.has(Fault::clamped_option));
    every_map(in);
    in.cascades.blend = 0;
    in.cascades.filter_radius = 1000000000;
    in.margin_texels = 1e9;
    for (Made<double> const& one : every_map(in))
        EXPECT_TRUE(!one.map.visible || one.map.faults.any()) << one.technique;
}

TEST(BadScene, ResultsMayReplaceTheirOwnArguments) {
    Input<double> in;
    ViewVolume<double> view = in.view;
    view = slice(view, SliceRange<double>{5, 8, 9});
    EXPECT_EQ(view.z_near, 5.0);
    glm::dmat4 map = clip_from_world(in.view, gl_clip);
    glm::dmat4 const expected = rebased(map, glm::dvec3(1, 2, 3));
    map = rebased(map, glm::dvec3(1, 2, 3));
    EXPECT_EQ(map, expected);
}
