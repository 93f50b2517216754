// SPDX-License-Identifier: MIT
#include "tests/laws/polytope.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>

using namespace shadowmath;

namespace {

using V3 = glm::dvec3;
using V4 = glm::dvec4;

Aabb<double> const unit_box{V3(0.0), V3(1.0)};

std::size_t distinct_vertices(ConvexBody<double> const& body) {
    std::set<std::tuple<double, double, double>> seen;
    for_each_vertex(body, [&](V3 const& v) { seen.emplace(v.x, v.y, v.z); });
    return seen.size();
}

}  // namespace

TEST(Polytope, OfABoxHasTwelveEdgesAndEightVertices) {
    ConvexBody<double> const body = convex_body(corners(unit_box));
    EXPECT_EQ(body.edge_count, 12);
    EXPECT_EQ(distinct_vertices(body), 8u);
    EXPECT_TRUE(laws::is_a_polyhedron(body));
}

TEST(Polytope, OfABoxHasItsPlanesToTheBitEvenWhereItIsFlat) {
    Aabb<double> const flat{V3(-0.3, 2, 0.7), V3(5.1, 2, 9)};
    ConvexBody<double> const body = convex_body(flat);
    ASSERT_EQ(body.face_count, 6);
    for (int axis = 0; axis < 3; ++axis) {
        V3 normal(0.0);
        normal[axis] = 1.0;
        EXPECT_EQ(body.half_space[static_cast<unsigned>(2 * axis)], V4(normal, -flat.lo[axis]));
        EXPECT_EQ(body.half_space[static_cast<unsigned>(2 * axis + 1)], V4(-normal, flat.hi[axis]));
    }
}

// Of what a view sees, in any size: unit normals, each plane through four corners, and all eight on its inner side.
TEST(Polytope, OfAViewHasSixPlanesThroughFourCornersEachThatHoldAll) {
    for (double const unit : {1e-3, 1.0, 1e3}) {
        ViewVolume<double> view = perspective_view(
            pose_looking(V3(30, -20, 70) * unit, V3(1, -0.5, 0.3), V3(0, 1, 0.2)), 1.0, 1.5, 2.0 * unit, 30.0 * unit);
        view.left *= 0.3;
        view.top *= 0.5;
        ConvexBody<double> const body = convex_body(corners(view));
        ASSERT_EQ(body.face_count, 6);
        for (unsigned face = 0; face < 6; ++face) {
            V4 const& plane = body.half_space[face];
            EXPECT_NEAR(glm::length(V3(plane)), 1.0, 1e-14);
            int touched = 0;
            for (V3 const& corner : corners(view)) {
                double const inside = glm::dot(plane, V4(corner, 1.0));
                EXPECT_GE(inside, -1e-12 * 100 * unit);
                touched += std::abs(inside) <= 1e-12 * 100 * unit;
            }
            EXPECT_EQ(touched, 4) << face;
        }
    }
}

TEST(Polytope, ElsewhereHasItsCornersThere) {
    V3 const offset(3, -4, 5);
    Aabb<double> bounds;
    for_each_vertex(translated(convex_body(unit_box), offset), [&](V3 const& v) { bounds = merge(bounds, v); });
    EXPECT_EQ(bounds.lo, unit_box.lo + offset);
    EXPECT_EQ(bounds.hi, unit_box.hi + offset);
}

TEST(VisibleBody, OfABoxInTheMiddleOfTheViewGrowsByTheSlackOnEverySide) {
    ViewVolume<double> const view = perspective_view(Pose<double>{V3(1, 2, 3)}, 1.5, 1.0, 0.1, 100.0);
    Aabb<double> const box{V3(0, 1, -20), V3(2, 2.5, -18)};
    Aabb<double> bounds;
    for_each_vertex(visible_body(view, box, 0.25), [&](V3 const& v) { bounds = merge(bounds, v); });
    EXPECT_EQ(bounds.lo, box.lo - view.pose.position - 0.25);
    EXPECT_EQ(bounds.hi, box.hi - view.pose.position + 0.25);
}

TEST(Polytope, LosesACornerToAPlane) {
    // x + y + z <= 2.5 cuts (1, 1, 1) off: one triangle more, 12 + 3 edges, 8 - 1 + 3 vertices.
    ConvexBody<double> const body = clipped(convex_body(corners(unit_box)), V4(-1, -1, -1, 2.5));
    EXPECT_EQ(body.edge_count, 15);
    EXPECT_EQ(distinct_vertices(body), 10u);
    EXPECT_TRUE(laws::is_a_polyhedron(body));
}

TEST(Polytope, CutThroughTheMiddleIsAHexagonalHalf) {
    ConvexBody<double> const body = clipped(convex_body(corners(unit_box)), V4(-1, -1, -1, 1.5));
    EXPECT_EQ(body.edge_count, 15);
    EXPECT_EQ(distinct_vertices(body), 10u);
    EXPECT_TRUE(laws::is_a_polyhedron(body));
}

TEST(Polytope, IsWholeOrGoneWhenThePlaneMissesIt) {
    ConvexBody<double> const body = convex_body(corners(unit_box));
    EXPECT_EQ(clipped(body, V4(1, 0, 0, 1)).edge_count, 12);
    EXPECT_EQ(clipped(body, V4(1, 0, 0, -2)).edge_count, 0);
    EXPECT_EQ(clipped(clipped(body, V4(1, 0, 0, -2)), V4(0, 1, 0, 0)).edge_count, 0);
}

TEST(Polytope, FindsCornersWhereThreeCutsMeet) {
    ConvexBody<double> body = convex_body(corners(unit_box));
    for (V4 const& cut : {V4(-1, 0, 0, 0.5), V4(0, -1, 0, 0.5), V4(0, 0, -1, 0.5)}) body = clipped(body, cut);
    bool found = false;
    for_each_vertex(body, [&](V3 const& v) { found = found || v == V3(0.5); });
    EXPECT_TRUE(found);
    EXPECT_EQ(distinct_vertices(body), 8u);
}

TEST(Polytope, OfAFlatBoxSurvivesBeingCut) {
    Aabb<double> const ground{V3(-50, 0, -50), V3(50, 0, 50)};
    ViewVolume<double> const view =
        perspective_view(pose_looking(V3(0, 2, 0), V3(0, -0.2, -1), V3(0, 1, 0)), 1.0, 1.5, 0.1, 30.0);
    ConvexBody<double> const seen = visible_body(view, ground);
    EXPECT_TRUE(laws::is_a_polyhedron(seen));
    double least = 1e9, most = 0.0;
    for_each_vertex(seen, [&](V3 const& v) {
        EXPECT_NEAR(v.y, -2.0, 1e-12);
        least = std::min(least, glm::dot(view.pose.forward, v));
        most = std::max(most, glm::dot(view.pose.forward, v));
    });
    // The lower edge of the picture meets the ground where depth * (sin pitch + cos pitch tan 0.5) = 2.
    double const cosine = 1 / std::sqrt(1.04), sine = 0.2 * cosine;
    EXPECT_NEAR(least, 2.0 / (sine + cosine * std::tan(0.5)), 1e-9);
    EXPECT_NEAR(most, 30.0, 1e-9);
}

TEST(Polytope, OfABoxWithoutEndIsTheViewItself) {
    float const most = std::numeric_limits<float>::max();
    ViewVolume<float> const view = perspective_view(
        pose_looking(glm::vec3(5, 6, 7), glm::vec3(1, 2, 3), glm::vec3(0, 1, 0)), 1.0f, 1.5f, 0.1f, 100.0f);
    ConvexBody<float> const seen = visible_body(view, Aabb<float>{glm::vec3(-most), glm::vec3(most)});
    for (glm::vec3 const& corner : corners(view))
        EXPECT_TRUE(laws::may_contain(seen, corner - view.pose.position, 1e-3f));
    for_each_vertex(seen, [&](glm::vec3 const& v) {
        EXPECT_LE(glm::dot(view.pose.forward, v), 100.01f);
        EXPECT_GE(glm::dot(view.pose.forward, v), 0.099f);
    });
}

TEST(Polytope, OfWhatIsNotInViewIsEmpty) {
    ViewVolume<double> const view =
        perspective_view(pose_looking(V3(0.0), V3(0, 0, -1), V3(0, 1, 0)), 1.0, 1.0, 0.1, 100.0);
    EXPECT_EQ(visible_body(view, Aabb<double>{V3(-1, -1, 1), V3(1, 1, 2)}).edge_count, 0);
    EXPECT_EQ(visible_body(view, Aabb<double>{}).edge_count, 0);
}

// What rounds to one plane twice may leave the corners of its face linked in another order; nothing of it is lost.
TEST(Polytope, CutTwiceAlongOnePlaneHoldsWhatItHeldCutOnce) {
    Aabb<float> const box{Vec3<float>(-10.2845f, -10.1185f, -19.854f), Vec3<float>(9.7355f, 9.5695f, 0.0099f)};
    Vec4<float> const cut(Vec3<float>(-0.577350259f), -2.22282219f);
    ConvexBody<float> const once = clipped(convex_body(box), cut);
    ConvexBody<float> many = once;
    for (int i = 0; i < 7; ++i) many = clipped(many, cut);
    // A third cut runs along the links.
    for (Vec4<float> const& across :
         {Vec4<float>(1, 0, 0, 0), Vec4<float>(0, -1, 0.5f, 1), Vec4<float>(0.6f, 0.8f, 0, 3)})
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z) {
                    auto const end = [&](ConvexBody<float> const& body) {
                        float farthest = -1e9f;
                        for_each_vertex(clipped(body, across), [&](Vec3<float> const& v) {
                            farthest = std::max(farthest, glm::dot(Vec3<float>(x, y, z), v));
                        });
                        return farthest;
                    };
                    // Seven cuts, each of twenty roundings of 35 m.
                    EXPECT_NEAR(end(many), end(once), 7 * 20 * 35 * std::numeric_limits<float>::epsilon());
                }
}

TEST(Polytope, OfABoxAnywhereHasItsMiddleInsideAllPlanes) {
    for (V3 const& middle : {V3(0.0), V3(20, -3, 7), V3(-20, 300, -7)}) {
        V3 const half(1, 2, 3);
        ConvexBody<double> const body = convex_body(Aabb<double>{middle - half, middle + half});
        for (int i = 0; i < body.face_count; ++i)
            EXPECT_GE(glm::dot(body.half_space[static_cast<unsigned>(i)], V4(middle, 1)), 1.0) << i;
    }
}

TEST(VisibleBody, GrowsByTheSlackOnEverySide) {
    ViewVolume<double> const view = orthographic_view(Pose<double>{}, -2.0, 3.0, -4.0, 5.0, 1.0, 10.0);
    Aabb<double> const everything{V3(-1e6), V3(1e6)};
    for (double const slack : {0.0, 0.5}) {
        Aabb<double> bounds;
        for_each_vertex(visible_body(view, everything, slack), [&](V3 const& v) { bounds = merge(bounds, v); });
        V3 const right = view.pose.right, up = view.pose.up, forward = view.pose.forward;
        V3 const lo = right * -2.0 + up * -4.0 + forward * 10.0, hi = right * 3.0 + up * 5.0 + forward * 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(bounds.lo[axis], std::min(lo[axis], hi[axis]) - slack, 1e-12) << axis;
            EXPECT_NEAR(bounds.hi[axis], std::max(lo[axis], hi[axis]) + slack, 1e-12) << axis;
        }
    }
}

TEST(Polytope, OfAsManyFacesAsThereCanBeIsMovedWithAllOfThem) {
    ConvexBody<double> body = convex_body(unit_box);
    body.face_count = max_body_faces;
    body.half_space[max_body_faces - 1] = V4(1, 0, 0, 2);
    EXPECT_EQ(translated(body, V3(3, 0, 0)).half_space[max_body_faces - 1], V4(1, 0, 0, -1));
}
