// SPDX-License-Identifier: MIT
//
// What can be wrong with everything but the camera and the light (boxes, planes, counts, sizes, options), and what is
// promised for it: one test for each kind, over every technique that it reaches.
#include "tests/laws/projected_bounds.hpp"
#include "tests/laws/trace.hpp"
#include "tests/support/every_map.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <utility>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

void expect_none_visible_without_fault(Input<double> const& in) {
    for (Made<double> const& one : every_map(in)) {
        EXPECT_FALSE(one.map.visible) << one.technique;
        EXPECT_FALSE(one.map.faults.any()) << one.technique << ": " << describe(one.map.faults);
    }
}

// Eight weights from one number.
std::array<double, 8> weights(int drawn) {
    std::array<double, 8> weight{};
    for (std::size_t i = 0; i < 8; ++i) weight[i] = 1e-3 + (drawn >> i & 1);
    return weight;
}

}  // namespace

TEST(BadInput, Row01NaNInABoxMakesNothingVisibleAndNothingWorse) {
    for (int axis = 0; axis < 3; ++axis)
        for (bool const in_casters : {false, true}) {
            Input<double> in;
            (in_casters ? in.casters : in.receivers).hi[axis] = nan_value;
            for (Made<double> const& one : every_map(in)) EXPECT_FALSE(one.map.visible) << one.technique;
        }
}

TEST(BadInput, Row01NaNAndInfinityInAPlaneOrAnOptionPoisonNothing) {
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

TEST(BadInput, Row10AnyNumberOfSplitsIsGivenAsFarAsThereIsRoom) {
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

TEST(BadInput, Row11LambdaIsBroughtIntoItsRange) {
    for (auto const& [lambda, as_if] : {std::pair(-0.5, 0.0), std::pair(7.0, 1.0), std::pair(nan_value, 0.5)}) {
        Splits<double> const splits = practical_splits(1.0, 1000.0, 3, lambda);
        EXPECT_EQ(splits.faults, Faults(Fault::clamped_option));
        EXPECT_EQ(splits.plane[1], practical_splits(1.0, 1000.0, 3, as_if).plane[1]);
    }
}

TEST(BadInput, Row12NoCastersAreNothingToDrawAndNoFault) {
    Input<double> in;
    in.casters = Aabb<double>{};
    expect_none_visible_without_fault(in);
}

TEST(BadInput, Row13NoReceiversAreNothingToSeeAndNoFault) {
    Input<double> in;
    in.receivers = Aabb<double>{};
    expect_none_visible_without_fault(in);
}

TEST(BadInput, Row14CastersThatAreAPointALineOrAPlaneAreStillSeen) {
    for (glm::dvec3 const& extent : {glm::dvec3(0), glm::dvec3(1, 0, 0), glm::dvec3(3, 0, 3), glm::dvec3(0, 2, 0)}) {
        Input<double> in;
        in.casters = {glm::dvec3(0, 1, 0), glm::dvec3(0, 1, 0) + extent};
        std::size_t seen = 0;
        for (Made<double> const& one : every_map(in)) seen += one.map.visible ? 1u : 0u;
        EXPECT_GE(seen, 8u) << "a cascade of each of the four fits, and the four other maps";
    }
}

TEST(BadInput, Row15BoxesAsLargeAsTheTypeAllowsAreCutBeforeTheyOverflow) {
    Input<float> in;
    in.casters =
        in.receivers = {glm::vec3(std::numeric_limits<float>::lowest()), glm::vec3(std::numeric_limits<float>::max())};
    for (Made<float> const& one : every_map(in))
        EXPECT_TRUE(one.map.visible) << one.technique << ": " << describe(one.map.faults);
}

TEST(BadInput, Row19CastersBehindTheEyeAndBehindALampTakeNothingFromAMap) {
    Input<double> in;
    in.casters = {glm::dvec3(-20, 0, -40), glm::dvec3(20, 30, 40)};
    expect_visible(in);
}

TEST(BadInput, Row19BodiesThatCrossTheEyesPlaneLoseNoPointInFrontOfIt) {
    Input<double> in;
    Mat4<double> const eye = clip_from_world(in.view, ClipSpace{});
    Vec3<double> const& at = in.view.pose.position;
    for (double const half : {0.01, 1.0, 100.0})
        for (double const ahead : {-0.9, 0.0, 0.9}) {
            Vec3<double> const centre = at + in.view.pose.forward * (ahead * half);
            auto const body = corners(Aabb<double>{centre - half, centre + half});
            for (int drawn = 0; drawn < 256; ++drawn)
                EXPECT_TRUE(laws::loses_no_point_in_front(eye, body, in.view.z_near, weights(drawn)));
        }
}

TEST(BadInput, Row20AShadowPlaneThroughTheEyeOrAlongTheLightIsInvalid) {
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

TEST(BadInput, Row23AMapTooSmallForItsFilterIsNotVisibleAndAnyOtherSizeIs) {
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

TEST(BadInput, Row24ATileOutsideItsAtlasIsABadRegionAndTheIdentity) {
    int const huge = std::numeric_limits<int>::max();
    for (Tile const& tile :
         {Tile{0, 0, 0, 64, 64}, Tile{60, 0, 8, 64, 64}, Tile{-1, 0, 8, 64, 64}, Tile{huge, huge, huge, 64, 64}}) {
        EXPECT_TRUE(faults_of(tile).has(Fault::bad_region));
        EXPECT_EQ(tile_matrix<double>(tile), glm::dmat4(1.0));
    }
    EXPECT_EQ(region_matrix(Region<double>{glm::dvec2(1), glm::dvec2(1)}), glm::dmat4(1.0));
}

TEST(BadInput, Row25HugeOptionsAreClampedAndSaySo) {
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

TEST(BadInput, Row27ADegenerateTriangleShadowsNothingAndAHugeOneEverything) {
    using V = Vec3<double>;
    Input<double> const in;
    PlanePicture<double> const floor = picture_of_plane(in.view, 13, 9, V(0), V(0, 1, 0));
    ShadowMap<double> const grid = sun_map(in.sun, V(0), 40.0);
    V const up = -in.sun.direction;
    std::vector<Triangle<double>> const nothing{{V(0, 1, 0), V(0, 1, 0), V(0, 1, 0)},
                                                {V(0, 1, 0), V(1, 1, 0), V(2, 1, 0)},
                                                {V(nan_value, 1, 0), V(5, 1, 0), V(0, 1, 5)},
                                                {V(0, 1, 0), V(5, infinity, 0), V(0, 1, 5)}};
    std::vector<Triangle<double>> const edge_on{{V(0, 1, -3), V(0, 1, -3) + up, V(4, 1, -6)}};
    std::vector<Triangle<double>> const huge{{V(-1e6, 5, -1e6), V(1e6, 5, -1e6), V(0, 5, 1e6)}};
    auto const masks = [&](std::vector<Triangle<double>> const& casters) {
        return traced<PlainLanes<double>>(floor, casters, in.sun, grid, 16).masks;
    };
    for (std::uint32_t const mask : masks(nothing)) EXPECT_EQ(mask, 0u);
    EXPECT_TRUE(laws::agrees_with_segments(floor, masks(edge_on), edge_on, in.sun, grid));
    std::vector<std::uint32_t> const covered = masks(huge);
    for (std::size_t i = 0; i < covered.size(); ++i)
        if (floor.depth[i] > 0) {
            EXPECT_EQ(covered[i], every_sample) << i;
        }
}

TEST(BadInput, Row27AnyTriangleAddedTakesNoBitAway) {
    using V = Vec3<double>;
    Input<double> const in;
    PlanePicture<double> const floor = picture_of_plane(in.view, 13, 9, V(0), V(0, 1, 0));
    ShadowMap<double> const grid = sun_map(in.sun, V(0), 40.0);
    std::vector<Triangle<double>> casters;
    std::vector<std::uint32_t> before(floor.depth.size(), 0u);
    for (Triangle<double> const& added :
         {Triangle<double>{V(-3, 2, -6), V(3, 2, -6), V(0, 2, 4)}, Triangle<double>{V(0, 1, 0), V(0, 1, 0), V(1, 1, 1)},
          Triangle<double>{V(nan_value, 1, 0), V(5, 1, 0), V(0, 1, 5)},
          Triangle<double>{V(-1e6, 5, -1e6), V(1e6, 5, -1e6), V(0, 5, 1e6)}}) {
        casters.push_back(added);
        auto const after = traced<PlainLanes<double>>(floor, casters, in.sun, grid, 16).masks;
        EXPECT_TRUE(laws::only_adds(before, after));
        before = after;
    }
}

// Starts at any float, ends between any two boxes: what is read and written is that and no more. The neighbours are
// NaN, which would show in a mask, and the address sanitizer sees the rest.
TEST(BadInput, Row28ArraysOfAnyLengthAtAnyAddressAreReadToTheirEndAndNoFurther) {
    Input<float> const in;
    auto const cascades = fit_cascades(in.view, in.sun, in.casters, in.receivers, in.cascades);
    ShadowMap<float> maps[max_splits];
    for (int i = 0; i < cascades.count; ++i) maps[i] = cascades.at[static_cast<std::size_t>(i)].map;
    CasterMaps<float> const gathered = caster_maps(maps, cascades.count);
    for (int const count : {0, 1, 63, 64, 65, 130})
        for (int const shift : {0, 1, 3}) {
            auto const size = static_cast<std::size_t>(count + shift);
            std::vector<float> side[6];
            for (std::size_t axis = 0; axis < 6; ++axis) {
                side[axis].assign(size, static_cast<float>(nan_value));
                for (std::size_t i = static_cast<std::size_t>(shift); i < size; ++i)
                    side[axis][i] = static_cast<float>(i) * 0.3f - 20.0f + (axis % 2 == 0 ? 0.0f : 1.0f);
            }
            std::vector<MapMask> masks(size + 1, MapMask(0xabcd));
            BoxArrays<float> const boxes{side[0].data() + shift, side[2].data() + shift, side[4].data() + shift,
                                         side[1].data() + shift, side[3].data() + shift, side[5].data() + shift};
            caster_masks(gathered, boxes, count, masks.data() + shift);
            for (std::size_t i = static_cast<std::size_t>(shift); i < size; ++i) {
                Aabb<float> const box{glm::vec3(side[0][i], side[2][i], side[4][i]),
                                      glm::vec3(side[1][i], side[3][i], side[5][i])};
                EXPECT_EQ(masks[i], caster_mask(gathered, box)) << i << " of " << count;
            }
            EXPECT_EQ(masks[size], MapMask(0xabcd));
            for (std::size_t i = 0; i < static_cast<std::size_t>(shift); ++i) EXPECT_EQ(masks[i], MapMask(0xabcd));
        }
}

TEST(BadInput, Row28ResultsMayReplaceTheirOwnArguments) {
    Input<double> in;
    ViewVolume<double> view = in.view;
    view = slice(view, SliceRange<double>{5, 8, 9});
    EXPECT_EQ(view.z_near, 5.0);
    glm::dmat4 map = clip_from_world(in.view, gl_clip);
    glm::dmat4 const expected = rebased(map, glm::dvec3(1, 2, 3));
    map = rebased(map, glm::dvec3(1, 2, 3));
    EXPECT_EQ(map, expected);
}

TEST(BadInput, EveryRowOfTheTableHasATest) {
    std::set<int> rows;
    ::testing::UnitTest const& all = *::testing::UnitTest::GetInstance();
    for (int i = 0; i < all.total_test_suite_count(); ++i) {
        ::testing::TestSuite const& suite = *all.GetTestSuite(i);
        if (std::string(suite.name()) != "BadInput") continue;
        for (int j = 0; j < suite.total_test_count(); ++j) {
            std::string const name = suite.GetTestInfo(j)->name();
            if (name.rfind("Row", 0) == 0) rows.insert(std::stoi(name.substr(3, 2)));
        }
    }
    std::set<int> wanted;
    for (int row = 1; row <= 28; ++row) wanted.insert(wanted.end(), row);
    EXPECT_EQ(rows, wanted);
}
