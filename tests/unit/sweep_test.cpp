// SPDX-License-Identifier: MIT
#include "tests/laws/sweep.hpp"

#include <shadowmath/light.hpp>

#include <gtest/gtest.h>

#include <algorithm>

#include <limits>

using namespace shadowmath;

namespace {

using V3 = glm::dvec3;
using V4 = glm::dvec4;

Aabb<double> const unit_box{V3(0.0), V3(1.0)};
V4 const down(0, -1, 0, 0);

}  // namespace

TEST(Sweep, OfABoxUnderAnOverheadSunIsItsFootprintAndItsFloor) {
    auto const swept = swept_to_light(convex_body(unit_box), down);
    EXPECT_EQ(swept.count, 5);
    EXPECT_TRUE(laws::inside(swept, V3(0.5, 1000, 0.5), 0.0));
    EXPECT_FALSE(laws::inside(swept, V3(0.5, -0.01, 0.5), 0.0));
    EXPECT_FALSE(laws::inside(swept, V3(1.01, 5, 0.5), 0.0));
}

TEST(Sweep, OfACubeUnderADiagonalSunHasAHexagonalOutline) {
    V3 const travel = glm::normalize(V3(-1, -1, -1));
    auto const swept = swept_to_light(convex_body(unit_box), V4(travel, 0));
    EXPECT_EQ(swept.count, 9);
    int along = 0;
    for (V4 const& plane : swept) along += std::abs(glm::dot(V3(plane), travel)) < 1e-15;
    EXPECT_EQ(along, 6);
}

TEST(Sweep, UnderASpotNarrowsTowardIt) {
    Light<double> const lamp = spot(V3(0.5, 3, 0.5), V3(0, -1, 0), 1.0, 10.0);
    auto const swept = swept_to_light(convex_body(unit_box), homogeneous(lamp));
    EXPECT_TRUE(laws::inside(swept, lamp.position, 1e-12));
    // Half way up from the top face at 1 to the lamp at 3, half of the width is left.
    EXPECT_TRUE(laws::inside(swept, V3(0.74, 2, 0.5), 0.0));
    EXPECT_FALSE(laws::inside(swept, V3(0.76, 2, 0.5), 0.0));
    EXPECT_FALSE(laws::inside(swept, V3(0.5, 3.01, 0.5), 0.0));
}

TEST(Sweep, OfABodyAroundTheSpotIsTheBody) {
    auto const swept = swept_to_light(convex_body(unit_box), V4(-0.5, -0.5, -0.5, -1));
    EXPECT_EQ(swept.count, 6);
}

TEST(Sweep, OfAFlatBodyKeepsItsOutline) {
    Aabb<double> const ground{V3(0, 0, 0), V3(4, 0, 4)};
    auto const swept = swept_to_light(convex_body(ground), down);
    EXPECT_TRUE(laws::inside(swept, V3(2, 9, 2), 0.0));
    EXPECT_FALSE(laws::inside(swept, V3(4.1, 9, 2), 0.0));
    EXPECT_FALSE(laws::inside(swept, V3(2, -0.1, 2), 0.0));
}

TEST(Sweep, IsPaddedInMetresAndByTheSunsRadius) {
    auto const padded = swept_to_light(convex_body(unit_box), down, SweepPadding<double>{0.25, 0.0});
    EXPECT_TRUE(laws::inside(padded, V3(1.249, 9, 0.5), 0.0));
    EXPECT_FALSE(laws::inside(padded, V3(1.251, 9, 0.5), 0.0));
    // A caster ten metres up may stand ten times the slope aside and still cover part of the sun.
    auto const soft = swept_to_light(convex_body(unit_box), down, SweepPadding<double>{0.0, 0.01});
    EXPECT_TRUE(laws::inside(soft, V3(1.099, 10, 0.5), 0.0));
    EXPECT_FALSE(laws::inside(soft, V3(1.111, 10, 0.5), 0.0));
    EXPECT_TRUE(laws::inside(soft, V3(0.5, 0.001, 0.5), 0.0));
}

TEST(Sweep, CullsBoxesThatCastElsewhereAndNoOthers) {
    auto const swept = swept_to_light(convex_body(unit_box), down);
    EXPECT_TRUE(may_meet(swept, Aabb<double>{V3(0.9, 50, 0.9), V3(3, 51, 3)}));
    EXPECT_FALSE(may_meet(swept, Aabb<double>{V3(1.1, 50, 0.9), V3(3, 51, 3)}));
    EXPECT_FALSE(may_meet(swept, Aabb<double>{V3(0, -2, 0), V3(1, -1, 1)}));
    EXPECT_FALSE(may_meet(swept, Aabb<double>{}));
    double const most = std::numeric_limits<double>::max();
    EXPECT_TRUE(may_meet(swept, Aabb<double>{V3(-most), V3(most)}));
}

TEST(Sweep, OfNothingHoldsNothing) {
    auto const swept = swept_to_light(ConvexBody<double>{}, down);
    EXPECT_FALSE(swept.visible);
    EXPECT_FALSE(may_meet(swept, unit_box));
    EXPECT_EQ(clipped(convex_body(unit_box), swept).edge_count, 0);
}

TEST(Sweep, PlanesThatMissABodyCostNoFace) {
    HalfSpaces<double> planes;
    planes.visible = true;
    planes.at[static_cast<unsigned>(planes.count++)] = Vec4<double>(1, 0, 0, 0.5);
    EXPECT_EQ(clipped(convex_body(unit_box), planes).face_count, 6);
    planes.at[static_cast<unsigned>(planes.count++)] = Vec4<double>(1, 0, 0, -0.5);
    EXPECT_EQ(clipped(convex_body(unit_box), planes).face_count, 7);
}

TEST(Sweep, OfABodyThatHasRunOutOfFacesIsTooLargeAndNeverTooSmall) {
    ConvexBody<double> body = convex_body(Aabb<double>{Vec3<double>(-1.0), Vec3<double>(1.0)});
    HalfSpaces<double> planes;
    planes.visible = true;
    for (int i = 0; i < max_body_faces; ++i) {
        double const angle = 0.19 * i;
        planes.at[static_cast<unsigned>(planes.count++)] = Vec4<double>(std::cos(angle), std::sin(angle), 0.0, 0.99);
    }
    ConvexBody<double> const part = clipped(body, planes);
    EXPECT_EQ(part.face_count, max_body_faces);
    EXPECT_GT(part.edge_count, 12);
    body.face_count = max_body_faces;
#if defined(NDEBUG)
    EXPECT_EQ(clipped(body, Vec4<double>(1, 0, 0, 0)).edge_count, body.edge_count) << "a cut too many cuts nothing";
#endif
}

TEST(Sweep, OfABodyOfAsManyFacesAsThereCanBeLeavesNothingOut) {
    ConvexBody<double> body = convex_body(Aabb<double>{Vec3<double>(-1.0), Vec3<double>(1.0)});
    for (int i = 0; body.face_count < max_body_faces; ++i) {
        double const height = 1 - 2 * (i + 0.5) / 26, angle = 2.399963 * i, r = std::sqrt(1 - height * height);
        Vec3<double> const outward(r * std::cos(angle), height, r * std::sin(angle));
        body = clipped(body, Vec4<double>(-outward, 1.0));
    }
    int most = 0;
    for (int i = 0; i < 400; ++i) {
        double const height = std::cos(0.37 * i), angle = 0.13 * i, r = std::sqrt(1 - height * height);
        Vec3<double> const travel(r * std::cos(angle), height, r * std::sin(angle));
        HalfSpaces<double> const swept = swept_to_light(body, Vec4<double>(travel, 0.0));
        most = std::max(most, swept.count);
        for_each_vertex(body, [&](Vec3<double> const& vertex) {
            for (double const way : {0.0, 5.0}) EXPECT_TRUE(laws::inside(swept, vertex - travel * way, 1e-12));
        });
    }
    EXPECT_EQ(most, max_body_faces) << "some outlines and unlit faces are more than there is room for";
}

TEST(Sweep, OfASpotIsNoWiderForTheSizeOfTheSun) {
    ConvexBody<double> const body = convex_body(Aabb<double>{V3(-1, 0, -1), V3(1, 1, 1)});
    V4 const source = homogeneous(spot(V3(3, 9, 2), V3(0, -1, 0), 0.5, 20.0));
    HalfSpaces<double> const plain = swept_to_light(body, source);
    HalfSpaces<double> const wide = swept_to_light(body, source, SweepPadding<double>{0.0, 0.5});
    ASSERT_EQ(wide.count, plain.count);
    for (int i = 0; i < plain.count; ++i) EXPECT_EQ(wide.at[std::size_t(i)], plain.at[std::size_t(i)]);
}

TEST(Sweep, IsPaddedInMetresHoweverLongTheNormalOfACutIs) {
    ConvexBody<double> const cube = convex_body(Aabb<double>{V3(-1), V3(1)});
    V4 const sun(0, -1, 0, 0), cut = V4(glm::normalize(V3(0.2, 1, 0.1)), 0.3);
    SweepPadding<double> const metre{1.0, 0.0};
    HalfSpaces<double> const once = swept_to_light(clipped(cube, cut), sun, metre);
    for (double const length : {0.25, 8.0}) {
        HalfSpaces<double> const longer = swept_to_light(clipped(cube, cut * length), sun, metre);
        ASSERT_EQ(longer.count, once.count);
        for (int i = 0; i < once.count; ++i)
            EXPECT_NEAR(glm::length(longer.at[std::size_t(i)] - once.at[std::size_t(i)]), 0.0, 1e-12);
    }
}
