// SPDX-License-Identifier: MIT
#include "tests/laws/sampling.hpp"

#include <shadowmath/light_box.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace shadowmath;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// Two cascades with a band from 8 to 10 m, the last fading into light from 28 to 30 m.
constexpr SliceRange<double> ranges[] = {{1, 8, 10}, {8, 28, 30}};

ShadowMap<double> map_of_half_width(double half) {
    LightBox<double> box;
    box.lo = Vec2<double>(-half);
    box.hi = Vec2<double>(half);
    box.depth_hi = 10;
    ShadowMap<double> map;
    map.clip_from_world = clip_from_world(box, gl_zero_to_one_clip);
    map.clip = gl_zero_to_one_clip;
    map.visible = true;
    return map;
}

}  // namespace

TEST(ByDepth, TakesTheFirstMapThatReachesPastThePoint) {
    EXPECT_EQ(by_depth(ranges, 2, 0.1).first, 0) << "nearer than the first slice";
    EXPECT_EQ(by_depth(ranges, 2, 7.0).first, 0);
    EXPECT_EQ(by_depth(ranges, 2, 10.0).first, 1) << "an end belongs to the next map";
    EXPECT_EQ(by_depth(ranges, 2, 30.0).first, -1);
    EXPECT_EQ(by_depth(ranges, 2, not_a_number).first, -1);
    EXPECT_EQ(by_depth(ranges, 0, 5.0).first, -1);
}

TEST(ByDepth, FadesIntoTheNextMapAndTheLastIntoLight) {
    LookUp<double> const band = by_depth(ranges, 2, 9.0);
    EXPECT_EQ(band.first, 0);
    EXPECT_EQ(band.second, 1);
    EXPECT_EQ(band.blend, 0.5);
    LookUp<double> const end = by_depth(ranges, 2, 29.5);
    EXPECT_EQ(end.second, -1);
    EXPECT_EQ(blended(end, 0.0, 1.0), 0.75);
}

TEST(ByDepth, WithoutABandChangesAtOnce) {
    SliceRange<double> const hard[] = {{1, 10, 10}, {10, 30, 30}};
    EXPECT_EQ(by_depth(hard, 2, 9.999).blend, 0.0);
    EXPECT_EQ(by_depth(hard, 2, 10.0).first, 1);
}

TEST(Contains, LeavesTheMarginOut) {
    // 100 texels of 0.02 m; three of them are 0.06 m.
    ShadowMap<double> const map = map_of_half_width(1);
    EXPECT_TRUE(contains(map, 100, 3.0, Vec3<double>(0.93, -1, 0)));
    EXPECT_FALSE(contains(map, 100, 3.0, Vec3<double>(0.95, -1, 0)));
    EXPECT_FALSE(contains(map, 100, 3.0, Vec3<double>(0, -1, -0.95)));
    EXPECT_TRUE(contains(map, 100, -3.0, Vec3<double>(1.05, -1, 0)));
}

TEST(Contains, ReceiversBeforeTheNearEndButNotBeyondTheFarEnd) {
    ShadowMap<double> const map = map_of_half_width(1);
    EXPECT_TRUE(contains(map, 100, 0.0, Vec3<double>(0, 5, 0)));
    EXPECT_FALSE(contains(map, 100, 0.0, Vec3<double>(0, -10.5, 0)));
}

TEST(Contains, NothingWhenTheMapServesNothing) {
    ShadowMap<double> const none;
    EXPECT_FALSE(contains(none, 100, 0.0, Vec3<double>(0)));
    ShadowMap<double> map = map_of_half_width(1);
    EXPECT_FALSE(contains(map, 0, 0.0, Vec3<double>(0)));
    EXPECT_FALSE(contains(map, 100, not_a_number, Vec3<double>(0)));
    EXPECT_FALSE(contains(map, 100, 0.0, Vec3<double>(not_a_number)));
    map.w_min = 1.0;
    EXPECT_FALSE(contains(map, 100, 0.0, Vec3<double>(0))) << "w equal to w_min";
}

TEST(ByMap, FallsBackInTheOrderGiven) {
    ShadowMap<double> const maps[] = {map_of_half_width(1), map_of_half_width(4)};
    EXPECT_EQ(by_map(maps, 2, 100, 2.0, Vec3<double>(0.5, -1, 0)).first, 0);
    EXPECT_EQ(by_map(maps, 2, 100, 2.0, Vec3<double>(0.5, -1, 0)).blend, 0.0);
    EXPECT_EQ(by_map(maps, 2, 100, 2.0, Vec3<double>(0.99, -1, 0)).first, 1) << "inside the margin of the first";
    EXPECT_EQ(by_map(maps, 2, 100, 2.0, Vec3<double>(5, -1, 0)).first, -1);
}

TEST(Shade, ShadowTakesDiffuseAndSpecularButNotAmbient) {
    Vec3<double> const ambient(0.1), diffuse(0.6), specular(0.2), albedo(0.5, 1, 2);
    EXPECT_EQ(shade(ambient, diffuse, specular, 0.0, albedo), ambient * albedo);
    EXPECT_EQ(shade(ambient, diffuse, specular, 1.0, albedo), (ambient + (diffuse + specular)) * albedo);
    EXPECT_EQ(shade(ambient, diffuse, specular, 0.5, albedo), (ambient + (diffuse + specular) * 0.5) * albedo);
}

TEST(Contains, OfAMapOfOneTexelIsTheWholeMapAndOfAPointBehindItNothing) {
    ShadowMap<double> map = map_of_half_width(4);
    Vec3<double> const inside(0, -5, 0);
    EXPECT_TRUE(contains(map, 1, 0.0, inside));
    map.clip_from_world[3][3] = -1.0;
    EXPECT_FALSE(contains(map, 16, 0.0, inside));
}

TEST(Blended, IsEachMapsShare) {
    EXPECT_EQ(blended(LookUp<double>{0, 1, 0.25}, 0.5, 1.0), 0.5 * 0.75 + 0.25);
    EXPECT_EQ(blended(LookUp<double>{0, -1, 0.0}, 0.5, 1.0), 0.5);
}
