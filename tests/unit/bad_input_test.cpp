// SPDX-License-Identifier: MIT
//
// What a level, a configuration file, a window or a user can get wrong, and what is promised for it: one test for each
// kind, over every technique it reaches. Data never aborts and never poisons; a result says what was wrong.
#include "tests/laws/shadow_map.hpp"
#include "tests/laws/splits.hpp"
#include "tests/laws/view_volume.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/shadowmath.hpp>

#include <gtest/gtest.h>

#include <cfenv>
#include <string>
#include <vector>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// All that a map is made from; the default is a good view of a good scene.
template <class T>
struct Input {
    ViewVolume<T> view = perspective_view(
        pose_looking(Vec3<T>(T(0), T(2), T(8)), Vec3<T>(T(0.1), T(-0.2), T(-1)), Vec3<T>(T(0), T(1), T(0))), T(1),
        T(1.5), T(0.1), T(60));
    Light<T> sun = directional(Vec3<T>(T(0.4), T(-1), T(0.3)));
    Light<T> lamp = spot(Vec3<T>(T(1), T(9), T(2)), Vec3<T>(T(-0.1), T(-1), T(-0.2)), T(0.7), T(40));
    Aabb<T> casters{Vec3<T>(T(-20), T(0), T(-40)), Vec3<T>(T(20), T(5), T(10))};
    Aabb<T> receivers{Vec3<T>(T(-30), T(0), T(-50)), Vec3<T>(T(30), T(5), T(15))};
    ShadowPlane<T> plane = mean_height_plane(receivers, Vec3<T>(T(0), T(1), T(0)));
    CascadeOptions<T> cascades;
    int map_size = 512;
    T margin_texels = T(2);
    ClipSpace clip = vulkan_clip;
};

template <class T>
struct Made {
    std::string technique;
    Light<T> light;
    ShadowMap<T> map;
};

// Every technique on one input. Whatever the input is, what comes out is harmless: here that is checked for all tests.
template <class T>
std::vector<Made<T>> every_map(Input<T> const& in) {
    std::vector<Made<T>> made;
    for (CascadeFit const fit : {CascadeFit::stable, CascadeFit::tight}) {
        CascadeOptions<T> options = in.cascades;
        options.fit = fit;
        options.clip = in.clip;
        Cascades<T> const cascades = fit_cascades(in.view, in.sun, in.casters, in.receivers, options);
        std::string const name = fit == CascadeFit::stable ? "stable cascade" : "tight cascade";
        // What was wrong with the inputs is said once, for all cascades.
        ShadowMap<T> none;
        none.faults = cascades.faults;
        if (cascades.count == 0) made.push_back({name, in.sun, none});
        for (Cascade<T> const& cascade : cascades) {
            made.push_back({name, in.sun, cascade.map});
            made.back().map.faults |= cascades.faults;
        }
    }
    WarpOptions<T> warp;
    warp.map_size = in.map_size;
    warp.margin_texels = in.margin_texels;
    VdsmOptions<T> vdsm;
    vdsm.map_size = in.map_size;
    vdsm.margin_texels = in.margin_texels;
    made.push_back({"simple perspective map", in.sun,
                    simple_perspective_map(in.view, in.sun, in.casters, in.receivers, warp, in.clip)});
    for (Light<T> const& light : {in.sun, in.lamp})
        made.push_back({"view-dependent map", light,
                        view_dependent_map(in.view, light, in.plane, in.casters, in.receivers, vdsm, in.clip)});
    made.push_back({"spot", in.lamp,
                    fit_spot(in.view, in.lamp, in.casters, in.receivers, in.map_size, in.margin_texels, in.clip)});
    for (Made<T> const& one : made) EXPECT_TRUE(laws::harmless(one.map)) << one.technique;
    return made;
}

template <class T>
void expect_visible(Input<T> const& in) {
    for (Made<T> const& one : every_map(in)) {
        EXPECT_TRUE(one.map.visible) << one.technique << ": " << describe(one.map.faults);
        EXPECT_TRUE(laws::is_map_of(one.map.clip_from_world, one.light, in.clip, 256)) << one.technique;
    }
}

template <class T>
void expect_none_visible(Input<T> const& in, Fault wanted) {
    for (Made<T> const& one : every_map(in)) {
        EXPECT_FALSE(one.map.visible) << one.technique;
        EXPECT_TRUE(one.map.faults.has(wanted)) << one.technique << " says: " << describe(one.map.faults);
    }
}

}  // namespace

TEST(BadInput, NoneOfItIsInTheGoodInputOfTheseTests) {
    expect_visible(Input<float>{});
    expect_visible(Input<double>{});
}

TEST(BadInput, NaNAndInfinityAnywhereInTheViewMakeNothingVisible) {
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

TEST(BadInput, NaNAndInfinityInALightMakeNothingVisible) {
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

TEST(BadInput, NaNInABoxMakesNothingVisibleAndNothingWorse) {
    for (int axis = 0; axis < 3; ++axis)
        for (bool const in_casters : {false, true}) {
            Input<double> in;
            (in_casters ? in.casters : in.receivers).hi[axis] = nan_value;
            for (Made<double> const& one : every_map(in)) EXPECT_FALSE(one.map.visible) << one.technique;
        }
}

TEST(BadInput, ALightAlongTheUpAxisOrTheViewIsNoFault) {
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

TEST(BadInput, ATinyLightDirectionIsNormalizedAndAZeroOneIsAFault) {
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

TEST(BadInput, ANearDistanceOfZeroLeavesUniformSplitsExactAndLogarithmicOnesFinite) {
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

TEST(BadInput, ANegativeOrCrossedRangeIsEmptyAndNeverSwapped) {
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

TEST(BadInput, AnInfiniteFarDistanceIsCutToTheShadowDistance) {
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

TEST(BadInput, RangesOfABillionKeepTheirFarCorners) {
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

TEST(BadInput, AnImpossibleFieldOfViewIsABadFrustum) {
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

TEST(BadInput, OffCentreAndOrthographicViewsAreNoneOfIt) {
    Input<double> in;
    in.view.left = -0.1;
    expect_visible(in);
    in.view = orthographic_view(in.view.pose, -6.0, 9.0, -4.0, 4.0, 0.5, 50.0);
    for (Made<double> const& one : every_map(in))
        if (one.technique != "view-dependent map") {
            EXPECT_TRUE(one.map.visible) << one.technique << ": " << describe(one.map.faults);
        }
}

TEST(BadInput, AnyNumberOfSplitsIsGivenAsFarAsThereIsRoom) {
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

TEST(BadInput, LambdaIsBroughtIntoItsRange) {
    for (auto const& [lambda, as_if] : {std::pair(-0.5, 0.0), std::pair(7.0, 1.0), std::pair(nan_value, 0.5)}) {
        Splits<double> const splits = practical_splits(1.0, 1000.0, 3, lambda);
        EXPECT_EQ(splits.faults, Faults(Fault::clamped_option));
        EXPECT_EQ(splits.plane[1], practical_splits(1.0, 1000.0, 3, as_if).plane[1]);
    }
}

TEST(BadInput, NoCastersOrNoReceiversAreNothingToSeeAndNoFault) {
    for (bool const in_casters : {false, true}) {
        Input<double> in;
        (in_casters ? in.casters : in.receivers) = Aabb<double>{};
        for (Made<double> const& one : every_map(in)) {
            EXPECT_FALSE(one.map.visible) << one.technique;
            EXPECT_FALSE(one.map.faults.any()) << one.technique << ": " << describe(one.map.faults);
        }
    }
}

TEST(BadInput, CastersThatAreAPointALineOrAPlaneAreStillSeen) {
    for (glm::dvec3 const& extent : {glm::dvec3(0), glm::dvec3(1, 0, 0), glm::dvec3(3, 0, 3), glm::dvec3(0, 2, 0)}) {
        Input<double> in;
        in.casters = {glm::dvec3(0, 1, 0), glm::dvec3(0, 1, 0) + extent};
        std::size_t seen = 0;
        for (Made<double> const& one : every_map(in)) seen += one.map.visible ? 1u : 0u;
        EXPECT_GE(seen, 6u) << "of two cascades and four other maps at least";
    }
}

TEST(BadInput, BoxesAsLargeAsTheTypeAllowsAreCutBeforeTheyOverflow) {
    Input<float> in;
    in.casters =
        in.receivers = {glm::vec3(std::numeric_limits<float>::lowest()), glm::vec3(std::numeric_limits<float>::max())};
    for (Made<float> const& one : every_map(in))
        EXPECT_TRUE(one.map.visible) << one.technique << ": " << describe(one.map.faults);
}

TEST(BadInput, FarFromTheOriginMapsStayMapsOfTheirLight) {
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
TEST(BadInput, FlushingDenormalsToZeroChangesNothingButDenormals) {
    Input<double> in;
    in.sun = directional(glm::dvec3(1e-310, -1, 5e-324));
    in.casters.lo.x = -1e-310;
    std::vector<Made<double>> const with = every_map(in);
    unsigned const before = _mm_getcsr();
    _mm_setcsr(before | 0x8040u);  // flush to zero, and denormals are zero
    std::vector<Made<double>> const without = every_map(in);
    _mm_setcsr(before);
    ASSERT_EQ(with.size(), without.size());
    for (std::size_t i = 0; i < with.size(); ++i)
        for (int column = 0; column < 4; ++column)
            for (int r = 0; r < 4; ++r)
                EXPECT_LE(std::abs(with[i].map.clip_from_world[column][r] - without[i].map.clip_from_world[column][r]),
                          std::numeric_limits<double>::min())
                    << with[i].technique << " " << column << " " << r;
}
#endif

TEST(BadInput, AProjectionWithoutSidesIsABadFrustum) {
    for (glm::dmat4 const& singular : {glm::dmat4(0.0), glm::dmat4(nan_value), glm::dmat4(infinity)}) {
        Input<double> in;
        in.view = view_from_projection(in.view.pose, singular, 0.1, 60.0);
        expect_none_visible(in, Fault::bad_frustum);
    }
}

TEST(BadInput, CastersBehindTheEyeAndBehindALampTakeNothingFromAMap) {
    Input<double> in;
    in.casters = {glm::dvec3(-20, 0, -40), glm::dvec3(20, 30, 40)};
    expect_visible(in);
}

TEST(BadInput, AShadowPlaneThroughTheEyeOrAlongTheLightIsInvalid) {
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

TEST(BadInput, ALightFromBelowIsADirectionLikeAnyOther) {
    Input<double> in;
    for (glm::dvec3 const& travel : {glm::dvec3(0, 1, 0), glm::dvec3(0.3, 0.8, -0.1)}) {
        in.sun = directional(travel);
        EXPECT_TRUE(faces_away(in.sun, glm::dvec3(0), glm::dvec3(0, 1, 0)));
        for (Made<double> const& one : every_map(in))
            EXPECT_TRUE(one.map.visible || one.technique.find("cascade") == std::string::npos) << one.technique;
    }
}

TEST(BadInput, TheAngleOfASpotIsBroughtIntoItsRangeAndARangeOfZeroIsNothing) {
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

TEST(BadInput, AMapTooSmallForItsFilterIsNotVisibleAndAnyOtherSizeIs) {
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

TEST(BadInput, ATileOutsideItsAtlasIsABadRegionAndTheIdentity) {
    int const huge = std::numeric_limits<int>::max();
    for (Tile const& tile :
         {Tile{0, 0, 0, 64, 64}, Tile{60, 0, 8, 64, 64}, Tile{-1, 0, 8, 64, 64}, Tile{huge, huge, huge, 64, 64}}) {
        EXPECT_TRUE(faults_of(tile).has(Fault::bad_region));
        EXPECT_EQ(tile_matrix<double>(tile), glm::dmat4(1.0));
    }
    EXPECT_EQ(region_matrix(Region<double>{glm::dvec2(1), glm::dvec2(1)}), glm::dmat4(1.0));
}

TEST(BadInput, HugeOptionsAreClampedAndSaySo) {
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

TEST(BadInput, ABentPoseIsMendedAndABrokenOneIsAFault) {
    Input<double> in;
    in.view.pose.right *= 1.0004;
    expect_visible(in);
    in.view.pose.right *= 1.1;
    expect_none_visible(in, Fault::bad_pose);
    in.view.pose.right = in.view.pose.up;
    expect_none_visible(in, Fault::bad_pose);
}

TEST(BadInput, ResultsMayReplaceTheirOwnArguments) {
    Input<double> in;
    ViewVolume<double> view = in.view;
    view = slice(view, SliceRange<double>{5, 8, 9});
    EXPECT_EQ(view.z_near, 5.0);
    glm::dmat4 map = clip_from_world(in.view, gl_clip);
    glm::dmat4 const expected = rebased(map, glm::dvec3(1, 2, 3));
    map = rebased(map, glm::dvec3(1, 2, 3));
    EXPECT_EQ(map, expected);
}
