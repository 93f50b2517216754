// SPDX-License-Identifier: MIT
#include "tests/laws/view_volume.hpp"
#include "tests/support/projections.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

ViewVolume<double> off_centre() {
    ViewVolume<double> view;
    view.left = -0.75;
    view.right = 1.5;
    view.bottom = -0.25;
    view.top = 0.5;
    view.z_near = 0.5;
    view.z_far = 200;
    return view;
}

template <class T>
bool reads_back_from_every_projection(ViewVolume<T> const& view) {
    bool const flat = view.kind == ViewKind::orthographic;
    for (Hand const hand : {Hand::right, Hand::left})
        for (Depth const depth : all_depths)
            for (bool const y_flipped : {false, true}) {
                if (flat && (depth == Depth::endless || depth == Depth::reversed_endless)) continue;
                Mat4<T> const clip_from_view = projection_of(view, hand, depth, y_flipped);
                if (!laws::has_the_sides_of(read_back(view, clip_from_view), view)) return false;
            }
    return true;
}

}  // namespace

TEST(ViewVolume, CornersOfACubeAreWhereAChildWouldPutThem) {
    ViewVolume<float> const view = orthographic_view(Pose<float>{}, -1.0f, 1.0f, -1.0f, 1.0f, 0.0f, 2.0f);
    std::array<glm::vec3, 8> const points = corners(view);
    EXPECT_EQ(points[0], glm::vec3(-1, -1, 0));
    EXPECT_EQ(points[1], glm::vec3(1, -1, 0));
    EXPECT_EQ(points[2], glm::vec3(-1, 1, 0));
    EXPECT_EQ(points[7], glm::vec3(1, 1, -2));
}

TEST(ViewVolume, PerspectiveTakesTheWholeVerticalAngle) {
    double const pi = 3.14159265358979323846;
    ViewVolume<double> const view = perspective_view(Pose<double>{}, pi / 2, 2.0, 1.0, 10.0);
    EXPECT_NEAR(view.top, 1.0, 1e-15);
    EXPECT_NEAR(view.right, 2.0, 2e-15);
    EXPECT_EQ(view.left, -view.right);
    EXPECT_EQ(view.bottom, -view.top);
}

TEST(ViewVolume, IsReadFromEveryKindOfProjectionMatrix) {
    EXPECT_TRUE(reads_back_from_every_projection(off_centre()));
    ViewVolume<double> flat = off_centre();
    flat.kind = ViewKind::orthographic;
    EXPECT_TRUE(reads_back_from_every_projection(flat));
}

TEST(ViewVolume, IsReadFromGlmsPerspectiveFunctions) {
    ViewVolume<float> const view = perspective_view(Pose<float>{}, 1.0f, 1.5f, 0.1f, 1000.0f);
    for (glm::mat4 const& clip_from_view :
         {glm::perspectiveRH_ZO(1.0f, 1.5f, 0.1f, 1000.0f), glm::perspectiveRH_NO(1.0f, 1.5f, 0.1f, 1000.0f),
          glm::perspectiveLH_ZO(1.0f, 1.5f, 0.1f, 1000.0f), glm::perspectiveRH_ZO(1.0f, 1.5f, 1000.0f, 0.1f),
          glm::infinitePerspectiveRH(1.0f, 1.5f, 0.1f), glm::infinitePerspectiveLH(1.0f, 1.5f, 0.1f)})
        EXPECT_TRUE(laws::has_the_sides_of(read_back(view, clip_from_view), view));
}

TEST(ViewVolume, TheEyesMatrixIsGlmsForTheDefaultPose) {
    // The default pose looks along -z as OpenGL's eye does, so the view matrix is the identity.
    ViewVolume<double> const view = off_centre();
    glm::dmat4 const wanted = projection_of(view, Hand::right, Depth::minus_one_to_one, false);
    glm::dmat4 const made = clip_from_world(view, gl_clip);
    for (int column = 0; column < 4; ++column)
        for (int r = 0; r < 4; ++r) EXPECT_NEAR(made[column][r], wanted[column][r], 1e-14) << column << " " << r;
}

TEST(ViewVolume, AnInfiniteFarIsExact) {
    ViewVolume<double> view = off_centre();
    view.z_far = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(faults_of(view).any());
    glm::dmat4 const endless = clip_from_world(view, vulkan_clip);
    EXPECT_TRUE(all_finite(endless));
    glm::dvec4 const at_near = endless * glm::dvec4(0, 0, -view.z_near, 1);
    glm::dvec4 const at_1e9 = endless * glm::dvec4(0, 0, -1e9, 1);
    EXPECT_EQ(at_near.z, 0.0);
    EXPECT_EQ(at_1e9.z / at_1e9.w, (1e9 - view.z_near) / 1e9);
    EXPECT_EQ(clip_from_world(view, reversed(d3d_clip))[3][2], view.z_near) << "reversed infinite: z = n, w = depth";
}

TEST(ViewVolume, DepthGrowsAlongForwardInAMirroredWorldToo) {
    ViewVolume<double> view = off_centre();
    view.pose.right = glm::dvec3(-1, 0, 0);
    EXPECT_FALSE(faults_of(view).any());
    EXPECT_EQ(eye_depth(view, glm::dvec3(3, 4, -7)), 7.0);
    EXPECT_TRUE(laws::fills_the_clip_volume(view, vulkan_clip));
    EXPECT_EQ(orthonormalized(view.pose).up, view.pose.up) << "a mirrored pose stays mirrored";
}

TEST(ViewVolume, FloatCornersAtAFarDistanceOfAMillionAreStillThere) {
    Pose<float> const pose = pose_looking(glm::vec3(100, 2, -50), glm::vec3(1, -0.2f, 0.3f), glm::vec3(0, 1, 0));
    EXPECT_TRUE(laws::has_accurate_corners(perspective_view(pose, 1.0f, 1.7f, 0.1f, 1e5f)));
    EXPECT_TRUE(laws::has_accurate_corners(perspective_view(pose, 1.0f, 1.7f, 1e-3f, 1e6f)));
}

TEST(ViewVolume, WhoseMatrixWouldOverflowInOneConventionIsNowhereThere) {
    // 1 / range fits into a float, the twice of it that depth in [-1, 1] needs does not.
    ViewVolume<float> const flat = orthographic_view(Pose<float>{}, -1.0f, 1.0f, -1.0f, 1.0f, 0.0f, 4e-39f);
    EXPECT_TRUE(all_finite(clip_from_world(flat, vulkan_clip)));
    EXPECT_EQ(clip_from_world(flat, gl_clip), nowhere<float>());
}

TEST(Pose, LooksAlongItsForwardAxisWithUpAboveTheHorizon) {
    Pose<double> const pose = pose_looking(glm::dvec3(1, 2, 3), glm::dvec3(0, 0, -5), glm::dvec3(0, 1, 0));
    EXPECT_EQ(pose.position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(pose.forward, glm::dvec3(0, 0, -1));
    EXPECT_EQ(pose.right, glm::dvec3(1, 0, 0));
    EXPECT_EQ(pose.up, glm::dvec3(0, 1, 0));
}

TEST(Pose, IsMendedWhenItsAxesAreOrthonormalToOneInAThousand) {
    Pose<float> pose = pose_looking(glm::vec3(0), glm::vec3(1, 2, 3), glm::vec3(0, 1, 0));
    pose.right += glm::vec3(4e-4f, -3e-4f, 2e-4f);
    pose.up *= 1.0004f;
    EXPECT_FALSE(laws::is_orthonormal(pose));
    EXPECT_TRUE(laws::is_orthonormal(orthonormalized(pose)));
}

TEST(ViewVolume, OfAMatrixWithoutAScaleHasNoSides) {
    for (int axis = 0; axis < 2; ++axis) {
        glm::dmat4 matrix(1.0);
        matrix[axis][axis] = 0.0;
        EXPECT_TRUE(faults_of(view_from_projection(Pose<double>{}, matrix, 0.1, 10.0)).has(Fault::bad_frustum));
    }
}

TEST(ViewVolume, OfAMirroredMatrixHasItsSidesInOrder) {
    glm::dmat4 mirrored(1.0);
    mirrored[0][0] = mirrored[1][1] = -0.5;
    ViewVolume<double> const view = view_from_projection(Pose<double>{}, mirrored, 0.1, 10.0);
    EXPECT_EQ(view.left, -2.0);
    EXPECT_EQ(view.right, 2.0);
    EXPECT_EQ(view.bottom, -2.0);
    EXPECT_EQ(view.top, 2.0);
}

TEST(ViewVolume, NamesWhicheverNumberIsNone) {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    ViewVolume<double> const good = perspective_view(Pose<double>{}, 1.0, 1.6, 0.1, 100.0);
    EXPECT_FALSE(faults_of(good).any());
    for (double ViewVolume<double>::*number : {&ViewVolume<double>::left, &ViewVolume<double>::right,
                                               &ViewVolume<double>::bottom, &ViewVolume<double>::top}) {
        ViewVolume<double> bad = good;
        bad.*number = nan;
        EXPECT_TRUE(faults_of(bad).has(Fault::bad_frustum));
    }
    for (double ViewVolume<double>::*number : {&ViewVolume<double>::z_near, &ViewVolume<double>::z_far}) {
        ViewVolume<double> bad = good;
        bad.*number = nan;
        EXPECT_TRUE(faults_of(bad).has(Fault::not_finite));
    }
    for (glm::dvec3 Pose<double>::*axis :
         {&Pose<double>::position, &Pose<double>::right, &Pose<double>::up, &Pose<double>::forward}) {
        ViewVolume<double> bad = good;
        (bad.pose.*axis).y = nan;
        EXPECT_TRUE(faults_of(bad).has(Fault::not_finite));
    }
}

TEST(ViewVolume, OfAnEndlessOrthographicViewHasAFiniteMatrix) {
    ViewVolume<double> view = orthographic_view(Pose<double>{}, -1.0, 1.0, -1.0, 1.0, 0.1, 10.0);
    view.z_far = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(all_finite(clip_from_world(view, gl_clip)));
}

TEST(Pose, WithoutAForwardOrARightAxisComesBackAsItIs) {
    for (glm::dvec3 Pose<double>::*axis : {&Pose<double>::forward, &Pose<double>::right}) {
        Pose<double> pose;
        pose.*axis = glm::dvec3(0.0);
        EXPECT_EQ(orthonormalized(pose).*axis, glm::dvec3(0.0));
        EXPECT_EQ(orthonormalized(pose).up, pose.up);
    }
}

TEST(ViewFromProjection, OfAMatrixWithoutAScaleHasEqualSides) {
    for (int axis = 0; axis < 2; ++axis) {
        Mat4<double> matrix(1.0);
        matrix[axis][axis] = 0;
        ViewVolume<double> const view = view_from_projection(Pose<double>{}, matrix, 0.1, 10.0);
        for (double const side : {view.left, view.right, view.bottom, view.top}) EXPECT_EQ(side, 0.0);
        EXPECT_TRUE(faults_of(view).has(Fault::bad_frustum));
    }
}

TEST(ViewVolume, WithASideThatEndsNowhereOrNoExtentIsABadFrustum) {
    double const inf = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(faults_of(off_centre()).any());
    for (double ViewVolume<double>::*side : {&ViewVolume<double>::left, &ViewVolume<double>::right,
                                             &ViewVolume<double>::bottom, &ViewVolume<double>::top}) {
        ViewVolume<double> view = off_centre();
        view.*side *= inf;
        EXPECT_EQ(faults_of(view), Faults(Fault::bad_frustum));
    }
    ViewVolume<double> narrow = off_centre(), low = off_centre();
    narrow.left = narrow.right;
    low.bottom = low.top;
    EXPECT_EQ(faults_of(narrow), Faults(Fault::bad_frustum));
    EXPECT_EQ(faults_of(low), Faults(Fault::bad_frustum));
}

TEST(ViewVolume, OfAnAngleOutsideAHalfTurnIsABadFrustum) {
    constexpr double pi = 3.14159265358979323846;
    for (double const angle : {-1.0, 0.0, pi, 4.0, 7.0})
        EXPECT_TRUE(faults_of(perspective_view(Pose<double>{}, angle, 1.5, 0.1, 10.0)).has(Fault::bad_frustum))
            << angle;
}

TEST(ViewVolume, WhoseDepthsDoNotIncreaseFromTheEyeOnIsAnEmptyRange) {
    ViewVolume<double> view = off_centre();
    for (auto const& [z_near, z_far] :
         {std::pair{-1.0, 200.0}, std::pair{5.0, 5.0}, std::pair{9.0, 5.0}, std::pair{-2.0, -3.0}}) {
        view.z_near = z_near, view.z_far = z_far;
        EXPECT_EQ(faults_of(view), Faults(Fault::empty_range)) << z_near << ' ' << z_far;
    }
    view.z_near = 0.0, view.z_far = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(faults_of(view).any());
}

TEST(ViewVolume, IsReadFromAMatrixTimesAnyPositiveNumber) {
    ViewVolume<double> const view = off_centre();
    for (double const scale : {0.25, 3.0})
        EXPECT_TRUE(laws::has_the_sides_of(
            read_back(view, projection_of(view, Hand::left, Depth::minus_one_to_one, false) * scale), view));
}

namespace {

// One axis of the default pose, moved.
Pose<double> bent(Vec3<double> const& right, Vec3<double> const& up, Vec3<double> const& forward) {
    Pose<double> pose;
    pose.right += right, pose.up += up, pose.forward += forward;
    return pose;
}

}  // namespace

TEST(Pose, IsBadByTheLengthOfOneAxisOrTheAngleOfTwo) {
    Vec3<double> const none(0), r = Pose<double>{}.right * 0.01, u = Pose<double>{}.up * 0.01;
    Vec3<double> const f = Pose<double>{}.forward * 0.01;
    ViewVolume<double> view = off_centre();
    for (Pose<double> const& pose : {bent(r, none, none), bent(none, u, none), bent(none, none, f), bent(u, none, none),
                                     bent(none, f, none), bent(none, none, r)}) {
        view.pose = pose;
        EXPECT_EQ(faults_of(view), Faults(Fault::bad_pose));
    }
}

TEST(Pose, IsMendedWhicheverOfItsAxesAreOffAndAsItIsWhereNoneIs) {
    Vec3<double> const none(0), r = Pose<double>{}.right * 1e-9, u = Pose<double>{}.up * 1e-9;
    Vec3<double> const f = Pose<double>{}.forward * 1e-9;
    for (Pose<double> const& pose :
         {bent(r, none, none), bent(none, u, none), bent(none, none, f), bent(r, u, none), bent(none, u, f),
          bent(r, none, f), bent(u, none, none), bent(none, f, none), bent(none, none, r), bent(none, r + f, none),
          bent(u + f, none, none), bent(none, none, r + u)}) {
        Pose<double> const mended = orthonormalized(pose);
        EXPECT_NEAR(glm::dot(mended.right, mended.right), 1.0, 1e-15);
        EXPECT_NEAR(glm::dot(mended.up, mended.up), 1.0, 1e-15);
        EXPECT_NEAR(glm::dot(mended.forward, mended.forward), 1.0, 1e-15);
        EXPECT_NEAR(glm::dot(mended.right, mended.up), 0.0, 1e-15);
        EXPECT_NEAR(glm::dot(mended.up, mended.forward), 0.0, 1e-15);
        EXPECT_NEAR(glm::dot(mended.forward, mended.right), 0.0, 1e-15);
    }
    double const bit = 0.5e-6;  // 2^-52 of 1e-9
    Pose<double> const good = bent(r * bit, u * bit, f * bit), as_it_was = orthonormalized(good);
    ASSERT_NE(good.right, Pose<double>{}.right);
    EXPECT_EQ(as_it_was.right, good.right);
    EXPECT_EQ(as_it_was.up, good.up);
    EXPECT_EQ(as_it_was.forward, good.forward);
}

TEST(Pose, LookingAlongItsUpTakesTheWorldAxisLeastAlongIt) {
    for (auto const& [forward, least] :
         {std::pair{Vec3<double>(0.1, 0.9, 0.3), 0}, std::pair{Vec3<double>(0.5, 0.8, 0.1), 2},
          std::pair{Vec3<double>(0.8, 0.1, 0.5), 1}, std::pair{Vec3<double>(0.5, 0.1, 0.8), 1}}) {
        Vec3<double> axis(0);
        axis[least] = 1.0;
        Pose<double> const pose = pose_looking(Vec3<double>(0), forward, forward);
        EXPECT_NEAR(glm::dot(pose.right, glm::normalize(glm::cross(forward, axis))), 1.0, 1e-15) << least;
    }
}

TEST(ViewVolume, OfAnEndlessOrthographicViewLosesNothingHoweverFar) {
    ViewVolume<double> const view =
        orthographic_view(Pose<double>{}, -1.0, 1.0, -1.0, 1.0, 0.1, std::numeric_limits<double>::infinity());
    Vec4<double> const at = clip_from_world(view, gl_zero_to_one_clip) * Vec4<double>(0, 0, -1e9, 1);
    EXPECT_GE(at.z, 0.0);
    EXPECT_LE(at.z, at.w);
}
