// SPDX-License-Identifier: MIT
//
// The bias of a map, in texels and metres. Of its depth and of offsets along the normal: the files beside.
#include "tests/laws/bias.hpp"
#include "tests/support/overhead_map.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

BiasOptions<double> nothing() {
    BiasOptions<double> options;
    options.flat_texels = 0;
    options.texels = 0;
    options.depth_step = 0;
    return options;
}

}  // namespace

TEST(DepthBias, AtNoDistanceFromALampIsNothingAndRaisesNoFlag) {
    MapBias<float> bias;
    bias.per_inverse_w = 0.25f;
    for (float const w : {0.0f, -0.0f}) {
        auto const amount = test::watched([&] { return depth_bias(bias, w, {}); });
        EXPECT_EQ(amount.result, 0.0f);
        EXPECT_EQ(amount.raised, 0);
    }
    EXPECT_EQ(depth_bias(bias, 0.5f, {}), 0.5f);
}

TEST(DepthBias, IsNeverNegative) {
    MapBias<double> bias;
    bias.constant = -0.25;
    EXPECT_EQ(depth_bias(bias, 1.0, {}), 0.0);
    EXPECT_EQ(depth_bias(bias, 1.0, {0.0, 0.0}), 0.0);
}

TEST(BiasFor, MetresOfAPlainMapAreAConstantShareOfItsDepth) {
    Overhead const overhead;
    BiasOptions<double> options = nothing();
    double const rounding = bias_for(overhead.map, overhead.light, 100, options).constant;
    options.metres = 0.2;
    MapBias<double> const bias = bias_for(overhead.map, overhead.light, 100, options);
    EXPECT_NEAR(bias.constant - rounding, 0.2 / 40, 1e-15);
    EXPECT_EQ(bias.per_inverse_w, 0.0);
}

TEST(BiasFor, IsMadeForFloatsUnlessToldOtherwise) {
    Overhead const overhead;
    BiasOptions<double> options = nothing();
    double const rounding = bias_for(overhead.map, overhead.light, 100, options).constant;
    options.depth_step = BiasOptions<double>{}.depth_step;
    EXPECT_NEAR(bias_for(overhead.map, overhead.light, 100, options).constant - rounding, 2 * 0x1p-23, 1e-15);
}

TEST(BiasFor, KnowsAMapOfOneTexel) {
    Overhead const overhead;
    BiasOptions<double> options = nothing();
    options.metres = 0.2;
    EXPECT_GE(bias_for(overhead.map, overhead.light, 1, options).constant, 0.2 / 40);
    EXPECT_EQ(bias_for(overhead.map, overhead.light, 0, options).constant, 0.0);
}

TEST(BiasFor, FlatTexelsAreTexelsOfAPlaneAtHalfARightAngle) {
    // A texel of 100 is 0.1 m wide; the map 40 m deep.
    Overhead const overhead;
    BiasOptions<double> options = nothing();
    double const rounding = bias_for(overhead.map, overhead.light, 100, options).constant;
    options.flat_texels = 3;
    EXPECT_NEAR(bias_for(overhead.map, overhead.light, 100, options).constant - rounding, 3 * 0.1 / 40, 1e-14);
}

TEST(BiasFor, FlatTexelsOfASpotGrowWithItsTexelsAndShrinkWithItsDepth) {
    // At d metres a texel is 2 d tan(1/2) / 100 wide, and depth f/(f-n) (1 - n/d) changes by f n / ((f-n) d^2) a metre.
    Light<double> const light = spot(Vec3<double>(0), Vec3<double>(0, -1, 0), 0.5, 10.0);
    BiasOptions<double> options = nothing();
    MapBias<double> const none = bias_for(spot_map(1, 10), light, 100, options);
    options.flat_texels = 2;
    MapBias<double> const bias = bias_for(spot_map(1, 10), light, 100, options);
    for (double const d : {1.0, 4.0, 10.0}) {
        double const added = depth_bias(bias, d, {}) - depth_bias(none, d, {});
        EXPECT_NEAR(added, 2 * (2 * d * std::tan(0.5) / 100) * (10.0 / (9 * d * d)), 1e-12) << d;
    }
}

TEST(BiasFor, TheKernelCountsOnlyWhereTapsDoNotFollowThePlane) {
    Overhead const overhead;
    BiasOptions<double> options = nothing();
    options.filter_radius = 2;
    EXPECT_NEAR(bias_for(overhead.map, overhead.light, 100, options).slope_texels, 0.0, 1e-12);
    options.tap_plane = false;
    EXPECT_NEAR(bias_for(overhead.map, overhead.light, 100, options).slope_texels, 2.5, 1e-12);
    options.texels = 0.75;
    EXPECT_NEAR(bias_for(overhead.map, overhead.light, 100, options).slope_texels, 3.25, 1e-12);
}

TEST(BiasFor, AMapFarFromTheOriginGetsWhatFloatLosesThere) {
    Overhead const overhead;
    ShadowMap<double> far_away = overhead.map;
    far_away.clip_from_world = rebased(far_away.clip_from_world, Vec3<double>(-1e4, 3e4, 0));
    MapBias<double> const here = bias_for(overhead.map, overhead.light, 1024, BiasOptions<double>{});
    MapBias<double> const there = bias_for(far_away, overhead.light, 1024, BiasOptions<double>{});
    // x = 2e3 in NDC, 512 texels each, 4 * 2^-23: half a texel. Depth 750 of 1: 4e-4.
    EXPECT_NEAR(there.slope_texels - here.slope_texels, 2000 * 512 * std::ldexp(4.0, -23), 1e-9);
    EXPECT_NEAR(there.constant - here.constant, 750 * std::ldexp(4.0, -23), 1e-6);
}

TEST(BiasFor, OfASpotIsExactAtBothEndsOfItsAxisAndMoreBetween) {
    Light<double> const light = spot(Vec3<double>(0), Vec3<double>(0, -1, 0), 0.5, 10.0);
    ShadowMap<double> const map = spot_map(1, 10);
    BiasOptions<double> options = nothing();
    MapBias<double> const none = bias_for(map, light, 100, options);
    options.metres = 1e-6;
    MapBias<double> const some = bias_for(map, light, 100, options);
    auto const metres = [&](double distance) {
        double const added = depth_bias(some, distance, {}) - depth_bias(none, distance, {});
        return added / depth_shift(map, light, Vec3<double>(0, -distance, 0), 1e-6);
    };
    EXPECT_NEAR(metres(1.0), 1.0, 1e-5);
    EXPECT_NEAR(metres(10.0), 1.0, 1e-4);
    EXPECT_GT(metres(3.0), 1.5);
}

TEST(BiasFor, TheSteepestSlopeIsThatTangentInDepthATexel) {
    // Texels of 0.1 m by 0.2 m at most, 40 m deep.
    Overhead const overhead;
    BiasOptions<double> options = nothing();
    options.steepest = 10;
    EXPECT_NEAR(bias_for(overhead.map, overhead.light, 100, options).slope_limit, 10 * 0.2 / 40, 1e-15);
}

TEST(BiasFor, ALightWithoutDirectionOrAMapOfNothingGetsNoBias) {
    Overhead const overhead;
    Light<double> const dark = directional(Vec3<double>(0));
    MapBias<double> const of_dark = bias_for(overhead.map, dark, 100, BiasOptions<double>{});
    MapBias<double> const of_nothing = bias_for(ShadowMap<double>{}, overhead.light, 100, BiasOptions<double>{});
    for (MapBias<double> const& bias : {of_dark, of_nothing}) {
        EXPECT_EQ(bias.constant, 0.0);
        EXPECT_EQ(bias.slope_texels, 0.0);
    }
}

// Each of them alone comes to more than the type holds.
TEST(BiasFor, OptionsThatComeToNothingFiniteGiveNoBias) {
    Overhead const overhead;
    constexpr double most = std::numeric_limits<double>::max();
    BiasOptions<double> step = nothing(), metres = nothing();
    step.depth_step = most;
    metres.metres = most;
    ShadowMap<double> shallow = overhead.map;  // a thousand times its whole depth a metre
    for (int column = 0; column < 4; ++column) shallow.clip_from_world[column].z *= 4e4;
    ShadowMap<double> const near_lamp = spot_map(1e-3, 30.0);
    Light<double> const lamp = spot(Vec3<double>(0), Vec3<double>(0, -1, 0), 1.0, 30.0);
    ShadowMap<double> far_away = overhead.map;
    far_away.clip_from_world[3].x = 1e307;
    int row = 0;
    for (MapBias<double> const& bias :
         {bias_for(overhead.map, overhead.light, 100, step), bias_for(shallow, overhead.light, 100, metres),
          bias_for(near_lamp, lamp, 100, metres), bias_for(far_away, overhead.light, 1 << 30, nothing())}) {
        ++row;
        EXPECT_EQ(bias.constant, 0.0) << row;
        EXPECT_EQ(bias.per_inverse_w, 0.0) << row;
        EXPECT_EQ(bias.slope_texels, 0.0) << row;
        EXPECT_EQ(bias.slope_limit, MapBias<double>{}.slope_limit);
    }
    EXPECT_GT(bias_for(overhead.map, overhead.light, 100, metres).constant, 1e300);
}

TEST(BiasFor, SlopesOfAWarpLeanAsMuchAsTheWorseOfItsEnds) {
    // Depth leans by 0.05 a metre at its near end, and by 0.05 - 0.1 at its far one.
    Overhead overhead;
    overhead.map.clip_from_world = from_rows(Vec4<double>(0, 0, 0.1, 0), Vec4<double>(0.3, 0, 0, 0),
                                             Vec4<double>(0.05, -0.02, 0, 0.5), Vec4<double>(0.1, 0, 0, 1));
    overhead.map.clip = gl_zero_to_one_clip;
    BiasOptions<double> options = nothing();
    options.steepest = 0;
    Mat4<double> const canonical = canonical_from_clip<double>(overhead.map.clip) * overhead.map.clip_from_world;
    EXPECT_NEAR(bias_for(overhead.map, overhead.light, 100, options).slope_limit,
                detail::steepest_texel(canonical, 100, 0.05) * detail::worst_shear(canonical), 1e-12);
}

TEST(BiasFor, OptionsThatAreNoNumbersCountAsNone) {
    Overhead const overhead;
    double const nan = std::numeric_limits<double>::quiet_NaN();
    BiasOptions<double> options = nothing();
    MapBias<double> const none = bias_for(overhead.map, overhead.light, 100, options);
    options.depth_step = options.metres = options.flat_texels = options.texels = nan;
    MapBias<double> const bias = bias_for(overhead.map, overhead.light, 100, options);
    EXPECT_EQ(bias.constant, none.constant);
    EXPECT_EQ(bias.per_inverse_w, none.per_inverse_w);
    EXPECT_EQ(bias.slope_texels, none.slope_texels);
    EXPECT_EQ(bias_at(overhead.map, overhead.light, 100, options, Vec3<double>(0)).constant, none.constant);
}

TEST(BiasFor, OfASpotInAMapThatKnowsNoDistanceIsWhatTheFormatLoses) {
    Overhead const overhead;
    Light<double> const lamp = spot(Vec3<double>(0, 30, 0), Vec3<double>(0, -1, 0), 0.5, 60.0);
    BiasOptions<double> options;
    MapBias<double> const bias = bias_for(overhead.map, lamp, 100, options);
    EXPECT_EQ(bias.constant, 2 * options.depth_step);
}

TEST(SpannedByTexel, IsThatOfTheShortestTexelAlongTheAxis) {
    // NDC x = X.p / W.p changes by |X - x W| a metre: least where x is 0.9, and at x = 1 where that is outside the map.
    auto const map = [](double along_w) {
        return from_rows(Vec4<double>(along_w, 0, 1, 0), Vec4<double>(0, 1, 0, 0), Vec4<double>(0, 0, 0, 0.5),
                         Vec4<double>(1, 0, 0, 3));
    };
    EXPECT_NEAR(detail::spanned_by_texel(map(0.9), 0, 100, 1.0), 2.0 / 100, 1e-15);
    EXPECT_NEAR(detail::spanned_by_texel(map(5.0), 0, 100, 1.0), 2.0 / (100 * std::sqrt(17.0)), 1e-15);
}

TEST(WorstShear, IsThatOfTheWorstCorner) {
    // At (x, y) the axes run along X - x W and Y - y W; here they cross at the least angle where x and y are 1 or -1.
    for (double const sign : {-1.0, 1.0}) {
        Mat4<double> const warp = from_rows(Vec4<double>(1, 0, 0, 0), Vec4<double>(0, 1, 0, 0),
                                            Vec4<double>(0, 0, 1, 0), Vec4<double>(0.3 * sign, 0.4 * sign, 0, 1));
        double worst = 1;
        for (double const x : {-1.0, 1.0})
            for (double const y : {-1.0, 1.0}) {
                Vec3<double> const a = glm::normalize(Vec3<double>(1 - x * 0.3 * sign, -x * 0.4 * sign, 0));
                Vec3<double> const b = glm::normalize(Vec3<double>(-y * 0.3 * sign, 1 - y * 0.4 * sign, 0));
                worst = std::max(worst, 1 / glm::length(glm::cross(a, b)));
            }
        EXPECT_NEAR(detail::worst_shear(warp), worst, 1e-14);
        EXPECT_GT(worst, 1.1);
    }
}

TEST(EndsOfAxis, AreOneOverTheDistancesOfNearAndFar) {
    Light<double> const lamp = spot(Vec3<double>(0), Vec3<double>(0, -1, 0), 0.5, 10.0);
    ShadowMap<double> map = spot_map(2, 10);
    for (double const scale : {1.0, 3.0}) {  // w is then three times the distance
        Mat4<double> const canonical = map.clip_from_world * scale;
        map.clip_from_world = canonical;
        auto const ends = detail::ends_of_axis(canonical, lamp, depth_gain(map, lamp));
        EXPECT_NEAR(ends.nearest, 1 / (2 * scale), 1e-14);
        EXPECT_NEAR(ends.farthest, 1 / (10 * scale), 1e-14);
        BiasOptions<double> options = nothing();
        MapBias<double> const none = bias_for(map, lamp, 100, options);
        options.flat_texels = 2;
        MapBias<double> const bias = bias_for(map, lamp, 100, options);
        options.flat_texels = 0;
        options.metres = 0.01;
        MapBias<double> const metres = bias_for(map, lamp, 100, options);
        // Depth is f / (f - n) (1 - n / d).
        for (double const d : {2.0, 10.0}) {
            double const per_metre = 10.0 * 2.0 / (8 * d * d);
            EXPECT_NEAR(depth_bias(metres, d * scale, {}) - depth_bias(none, d * scale, {}), 0.01 * per_metre, 1e-12);
            EXPECT_NEAR(depth_bias(bias, d * scale, {}) - depth_bias(none, d * scale, {}),
                        2 * (2 * d * std::tan(0.5) / 100) * per_metre, 1e-12);
        }
    }
}

TEST(EndsOfAxis, EndAtInfinityWhereDepthNeverComesToOne) {
    Light<double> const lamp = spot(Vec3<double>(0), Vec3<double>(0, -1, 0), 0.5, 10.0);
    Mat4<double> canonical = spot_map(2, 10).clip_from_world;
    // Depth now ends at 0.9 times what it would be infinitely far away.
    for (int c = 0; c < 4; ++c) canonical[c][2] *= 0.9 / 1.25;
    auto const ends = detail::ends_of_axis(canonical, lamp, 2.5 * 0.9 / 1.25);
    EXPECT_NEAR(ends.nearest, 0.5, 1e-14);
    EXPECT_EQ(ends.farthest, 0.0);
}
