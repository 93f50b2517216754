// SPDX-License-Identifier: MIT
//
// Bias along the normal, in metres.
#include "tests/laws/bias.hpp"
#include "tests/support/overhead_map.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace shadowmath;
using namespace shadowmath::test;

TEST(NormalOffsetAt, IsZeroInAMapWithoutDepth) {
    Overhead overhead;
    for (int column = 0; column < 4; ++column) overhead.map.clip_from_world[column][2] = 0;
    EXPECT_EQ(normal_offset_at(overhead.map, overhead.light, 100, 1, Vec3<double>(0), Vec3<double>(0, 1, 0), 1.0), 0.0);
}

TEST(NormalOffsetAt, OfASpotIsTheShareOfTheWayThatBringsThePlaneBeforeItsTexels) {
    // Off the origin: what counts is the distance to the lamp.
    Vec3<double> const place(3, 4, 5);
    Light<double> const lamp = spot(place, Vec3<double>(0, -1, 0), 0.5, 10.0);
    ShadowMap<double> map = spot_map(1, 10);
    for (int column = 0; column < 3; ++column) map.clip_from_world[3] -= map.clip_from_world[column] * place[column];
    Vec3<double> const point = place + Vec3<double>(0.5, -4, 0.3), normal = glm::normalize(Vec3<double>(0.6, 1, -0.2));
    DepthSlope<double> const s = slope(map, 100, point, normal, 1e6);
    double const needed = 1.5 * (std::abs(s.x) + std::abs(s.y)) / depth_gain(map, lamp), raised = needed * 4;
    double const distance = glm::length(point - place), cosine = glm::dot(normal, (place - point) / distance);
    double const wanted = cosine * distance * raised / (1 + raised);
    EXPECT_NEAR(normal_offset_at(map, lamp, 100, 1, point, normal, 9.0), wanted, 1e-12);
    EXPECT_EQ(normal_offset_at(map, lamp, 100, 1, point, normal, wanted / 2), wanted / 2);
    EXPECT_EQ(normal_offset_at(map, lamp, 100, 1, point, -normal, 9.0), 0.0) << "faces away";
    double const nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(normal_offset_at(map, lamp, 100, 1, place + Vec3<double>(0, 4, 0), normal, 9.0), 0.0) << "behind";
    EXPECT_EQ(normal_offset_at(map, lamp, 100, 1, point, Vec3<double>(nan), 9.0), 0.0);
    EXPECT_EQ(normal_offset_at(map, lamp, 100, 1, point, normal, nan), 0.0);
    EXPECT_EQ(normal_offset_at(map, lamp, 100, 1, point, normal, -1.0), 0.0);
}

TEST(NormalOffsetAt, OfANormalThatIsNotFiniteIsZeroAndRaisesNoFlag) {
    Overhead const overhead;
    for (double const bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        auto const run = test::watched([&] {
            return normal_offset_at(overhead.map, overhead.light, 100, 1, Vec3<double>(0), Vec3<double>(bad, 1, 0),
                                    1.0);
        });
        EXPECT_EQ(run.result, 0.0);
        EXPECT_TRUE(run.calm_in_range());
    }
}

TEST(NormalOffset, IsTheTableOfTheKernelsReachAndTheSineOfTheAngle) {
    Vec3<double> const up(0, 1, 0), low = glm::normalize(Vec3<double>(1, 1, 0));
    EXPECT_NEAR(normal_offset_metres(0.1, 1, up, low), std::sqrt(2.0) * 1.5 * 0.1 * std::sqrt(0.5), 1e-15);
    EXPECT_EQ(normal_offset_metres(0.1, 1, up, up), 0.0);
    EXPECT_EQ(normal_offset_metres(-0.1, 1, up, low), 0.0);
}

TEST(NormalOffset, OfAPlainMapIsTheKernelsReachTimesTheSine) {
    double const nan = std::numeric_limits<double>::quiet_NaN(), reach = 1.5 * std::sqrt(2.0) * 0.1;
    Vec3<double> const up(0, 1, 0), aside(1, 0, 0);
    EXPECT_NEAR(normal_offset_metres(0.1, 1, up, aside), reach, 1e-15);
    EXPECT_NEAR(normal_offset_metres(0.1, 1, up, Vec3<double>(0.6, 0.8, 0)), reach * 0.6, 1e-15);
    EXPECT_NEAR(normal_offset_metres(0.1, 1, up * 3.0, aside), reach, 1e-15) << "a sine is at most 1";
    EXPECT_EQ(normal_offset_metres(0.1, 1, Vec3<double>(nan), aside), 0.0);
    EXPECT_EQ(normal_offset_metres(0.1, 1, up, Vec3<double>(nan)), 0.0);
    EXPECT_EQ(normal_offset_metres(nan, 1, up, aside), 0.0);
    EXPECT_EQ(normal_offset_metres(-0.1, 1, up, aside), 0.0);
    EXPECT_EQ(normal_offset_metres(std::numeric_limits<double>::max(), 9, up, aside), 0.0) << "more than all numbers";
}
