// SPDX-License-Identifier: MIT
//
// How depth changes in a map: along a plane, along the light. What bias is made of it: bias_test.cpp.
#include "tests/laws/bias.hpp"
#include "tests/support/overhead_map.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace shadowmath;
using namespace shadowmath::test;

TEST(Slope, OfALeaningPlaneIsItsTangentTimesTheTexelOverTheDepth) {
    // y rises by 0.5 a metre of x: depth falls by 0.5 m a metre. A texel of 100 is 0.1 m wide; the map 40 m deep.
    Overhead const overhead;
    DepthSlope<double> const s = slope(overhead.map, 100, Vec3<double>(1, 0.5, 3), Vec3<double>(-0.5, 1, 0), 1.0);
    EXPECT_NEAR(s.x, -0.5 * 0.1 / 40, 1e-15);
    EXPECT_NEAR(s.y, 0.0, 1e-15);
}

TEST(Slope, IsNegatedByReversedDepthAndByFlippedTextures) {
    Vec3<double> const point(1, 0.5, 3), normal(-0.5, 1, 0.7);
    DepthSlope<double> const s = slope(Overhead().map, 100, point, normal, 1.0);
    DepthSlope<double> const turned = slope(Overhead(reversed(gl_zero_to_one_clip)).map, 100, point, normal, 1.0);
    EXPECT_NEAR(turned.x, -s.x, 1e-15);
    EXPECT_NEAR(turned.y, -s.y, 1e-15);
    DepthSlope<double> const flipped = slope(Overhead(d3d_clip).map, 100, point, normal, 1.0);
    EXPECT_NEAR(flipped.x, s.x, 1e-15);
    EXPECT_NEAR(flipped.y, -s.y, 1e-15);
    // Stored depth is half of OpenGL's NDC depth, so the default convention has the same slope.
    DepthSlope<double> const halved = slope(Overhead(gl_clip).map, 100, point, normal, 1.0);
    EXPECT_NEAR(halved.x, s.x, 1e-15);
}

TEST(Slope, OfAPlaneThatTheLightGrazesIsTheLimit) {
    Overhead const overhead;
    DepthSlope<double> const s = slope(overhead.map, 100, Vec3<double>(0), Vec3<double>(1, 0, 0), 0.01);
    EXPECT_EQ(std::abs(s.x), 0.01);
    EXPECT_LE(std::abs(s.y), 0.01);
}

TEST(Slope, WithoutANormalOrAMapIsZero) {
    Overhead const overhead;
    for (auto const& s :
         {slope(overhead.map, 100, Vec3<double>(0), Vec3<double>(0), 1.0),
          slope(overhead.map, 0, Vec3<double>(0), Vec3<double>(1, 1, 1), 1.0),
          slope(spot_map(1, 10), 100, Vec3<double>(0, 5, 0), Vec3<double>(1, 1, 1), 1.0),
          slope(overhead.map, 100, Vec3<double>(0), Vec3<double>(1, 1, 1), std::numeric_limits<double>::quiet_NaN())}) {
        EXPECT_EQ(s.x, 0.0);
        EXPECT_EQ(s.y, 0.0);
    }
}

TEST(Slope, KnowsAMapOfOneTexel) {
    Overhead const overhead;
    EXPECT_NEAR(slope(overhead.map, 1, Vec3<double>(1, 0.5, 3), Vec3<double>(-0.5, 1, 0), 1.0).x, -0.5 * 10 / 40,
                1e-14);
}

TEST(Slope, InAMapWithoutExtentIsZeroAndDividesByNothing) {
    Overhead overhead;
    Vec4<double> const none(0.0);
    overhead.map.clip_from_world = from_rows(none, none, none, Vec4<double>(0, 0, 0, 1));
    auto const run =
        test::watched([&] { return slope(overhead.map, 100, Vec3<double>(0), Vec3<double>(0, 1, 1), 1.0).x; });
    EXPECT_EQ(run.result, 0.0);
    EXPECT_TRUE(run.calm_in_range());
}

// Gains too small, or too large, to be multiplied with each other.
TEST(Slope, IsThatOfItsTexelsHoweverLargeTheMapsUnitIs) {
    Overhead const overhead;
    for (double const unit : {1e-200, 1e200}) {
        ShadowMap<double> map = overhead.map;
        for (int r : {0, 1, 2})
            for (int c : {0, 1, 2}) map.clip_from_world[c][r] *= unit;
        DepthSlope<double> const s = slope(map, 100, Vec3<double>(0), Vec3<double>(-0.5, 1, 0), 1.0);
        EXPECT_NEAR(s.x, -0.5 * 0.1 / 40, 1e-15) << unit;
        EXPECT_NEAR(s.y, 0.0, 1e-15) << unit;
    }
}

TEST(DepthGain, IsOneOverTheDepthOfAPlainMapInEveryConvention) {
    for (ClipSpace clip : {gl_clip, vulkan_clip, reversed(vulkan_clip), d3d_clip})
        EXPECT_NEAR(depth_gain(Overhead(clip).map, Overhead().light), 1.0 / 40, 1e-16);
}

TEST(DepthGain, OfAMapThatIsNoNumberIsZero) {
    Overhead overhead;
    overhead.map.clip_from_world[1][2] = std::numeric_limits<double>::infinity();
    EXPECT_EQ(depth_gain(overhead.map, overhead.light), 0.0);
}

TEST(DepthGain, BeyondWhatItsTypeHoldsIsZero) {
    Overhead overhead;
    Light<double> const aslant = directional(Vec3<double>(1, 1, 1));
    double const most = std::numeric_limits<double>::max();
    for (int c : {0, 1, 2}) overhead.map.clip_from_world[c][2] = most;
    EXPECT_EQ(depth_gain(overhead.map, aslant), 0.0);
}

TEST(DepthShift, OfASpotFollowsItsPerspective) {
    // Depth f/(f-n) (1 - n/d), pulled from 8 m to 7.5 m.
    Light<double> const light = spot(Vec3<double>(0), Vec3<double>(0, -1, 0), 0.5, 10.0);
    double const wanted = 10.0 / 9 * (1 / 7.5 - 1 / 8.0);
    EXPECT_NEAR(depth_shift(spot_map(1, 10), light, Vec3<double>(0, -8, 0), 0.5), wanted, 1e-14);
    EXPECT_EQ(depth_shift(spot_map(1, 10), light, Vec3<double>(0, 8, 0), 0.5), 0.0) << "behind the light";
}

TEST(DepthShift, IsNeverMoreThanTheWholeDepth) {
    Overhead const overhead;
    EXPECT_DOUBLE_EQ(depth_shift(overhead.map, overhead.light, Vec3<double>(0), 39.0), 39.0 / 40.0);
    EXPECT_EQ(depth_shift(overhead.map, overhead.light, Vec3<double>(0), 41.0), 1.0);
    EXPECT_EQ(depth_shift(overhead.map, overhead.light, Vec3<double>(0), 1e300), 1.0);
}

TEST(Lean, IsZeroInAnAffineMapWhateverTheLight) {
    DepthSlope<double> const own = lean(Overhead().map, 100, Vec3<double>(1, 0.5, 3), 1.0);
    EXPECT_NEAR(own.x, 0.0, 1e-15);
    EXPECT_NEAR(own.y, 0.0, 1e-15);
}
