// SPDX-License-Identifier: MIT
//
// What the map is, serves and spends. Of the plane and of bad input: the files beside.
#include "tests/laws/vdsm.hpp"
#include "tests/support/vdsm_cases.hpp"

#include <shadowmath/aliasing.hpp>
#include <shadowmath/footprint.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

// Points of the ground in view, from the feet to the far plane.
std::vector<V3> ground_in_view(ViewVolume<double> const& view) {
    std::vector<V3> points;
    for (double x = -0.95; x <= 0.96; x += 0.19)
        for (double y = -0.99; y < 0.99; y += 0.02) {
            V3 const ray = point_at(view, x * view.right, y * view.top, 1.0) - view.pose.position;
            double const depth = -view.pose.position.y / ray.y;
            if (ray.y < 0.0 && depth < view.z_far) points.push_back(view.pose.position + ray * depth);
        }
    return points;
}

}  // namespace

TEST(Vdsm, OnThePlaneTheMapIsTheScreen) {
    VdsmOptions<double> options;
    options.crop = false;
    options.margin_texels = 0.0;
    for (Light<double> const& light :
         {morning, directional(V3(-3, -1, -2)), spot(V3(5, 30, -20), V3(0, -1, 0), 1.2, 400.0)}) {
        ViewVolume<double> const view = walker();
        ShadowMap<double> const map = view_dependent_map(view, light, ground, town, town, options, gl_zero_to_one_clip);
        ASSERT_TRUE(map.visible);
        glm::dmat4 const eye = clip_from_world(view, gl_zero_to_one_clip);
        auto const points = ground_in_view(view);
        ASSERT_GT(points.size(), 400u);
        for (V3 const& p : points) {
            // Entries of the projection are some 10, w some 1; 1e4 roundings of headroom would still be 1e-11.
            EXPECT_NEAR(ndc(map.clip_from_world, p).x, ndc(eye, p).x, 1e-11);
            EXPECT_NEAR(ndc(map.clip_from_world, p).y, ndc(eye, p).y, 1e-11);
        }
    }
}

TEST(Vdsm, TexelsOnThePlaneHaveTheSameSizeInPixelsFromNearToFar) {
    ViewVolume<double> const view = walker();
    VdsmOptions<double> const options;
    ShadowMap<double> const map =
        view_dependent_map(view, morning, ground, level_ground, level_ground, options, gl_clip);
    ASSERT_TRUE(map.visible);
    double least = inf, most = 0.0;
    for (V3 const& p : ground_in_view(view)) {
        double const here = area(
            footprint(clip_from_world(view, gl_clip), V2(1600, 1000), map.clip_from_world, 1024.0, p, V3(0, 1, 0)));
        least = std::min(least, here);
        most = std::max(most, here);
    }
    EXPECT_LT(most / least, 1.0 + 1e-8);
    // Only the lower half of the picture shows ground, and the map is all of it: finer than the picture's own 1.6.
    EXPECT_LT(most, 1600.0 * 1000.0 / (1024.0 * 1024.0));
}

TEST(Vdsm, TexelsOffThePlaneHaveTheSizeOfTheClosedForm) {
    ViewVolume<double> const view = walker();
    VdsmOptions<double> options;
    options.crop = false;
    options.margin_texels = 0.0;
    ShadowMap<double> const map = view_dependent_map(view, morning, ground, town, town, options, gl_clip);
    glm::dmat4 const eye = clip_from_world(view, gl_clip);
    V3 const e = view.pose.position, light = morning.direction;
    for (V3 const& p : {V3(2, 0.5, -8), V3(-3, 4, -30), V3(10, 8, -60), V3(1, -0.5, -20)})
        for (V3 const& m : {V3(0, 1, 0), glm::normalize(V3(0.3, 0.8, 0.4)), V3(0, 0, 1)}) {
            V3 const q = p - light * (p.y / light.y);
            double const w_p = eye_depth(view, p), w_q = eye_depth(view, q);
            double const wanted = std::abs(glm::dot(m, p - e)) * std::abs(light.y) * std::pow(w_q, 3) /
                                  (e.y * std::abs(glm::dot(m, light)) * std::pow(w_p, 3));
            EXPECT_NEAR(area(footprint(eye, V2(1024), map.clip_from_world, 1024.0, p, m)) / wanted, 1.0, 1e-8);
        }
}

TEST(Vdsm, ObeysTheLawOfShadowMapsInEveryConvention) {
    for (Light<double> const& light :
         {morning, directional(V3(0, -0.5, 1)), spot(V3(5, 30, -20), V3(0, -1, 0), 1.2, 400.0)})
        for (ClipSpace const clip :
             {gl_clip, gl_zero_to_one_clip, vulkan_clip, d3d_clip, reversed(vulkan_clip), reversed(d3d_clip)}) {
            ShadowMap<double> const map = view_dependent_map(walker(), light, ground, town, town, {}, clip);
            ASSERT_TRUE(map.visible);
            EXPECT_TRUE(laws::is_map_of(map.clip_from_world, light, clip));
        }
}

TEST(Vdsm, HoldsThePlaneInViewWithItsMarginAndTheCastersAboveIt) {
    for (Light<double> const& light :
         {morning, directional(V3(0, -0.5, 1)), spot(V3(5, 30, -20), V3(0, -1, 0), 1.45, 400.0)})
        for (ClipSpace const clip : {gl_clip, gl_zero_to_one_clip, vulkan_clip, reversed(d3d_clip)}) {
            ViewVolume<double> const view = walker();
            VdsmOptions<double> const options;
            ShadowMap<double> const map = view_dependent_map(view, light, ground, town, level_ground, options, clip);
            ASSERT_TRUE(map.visible);
            double const margin = options.margin_texels * 2.0 / options.map_size;
            bool const sun = light.kind == LightKind::directional;
            for (V3 const& p : ground_in_view(view)) {
                EXPECT_TRUE(laws::serves(map, p, margin));
                EXPECT_TRUE(receiver_valid(map, p));
                V3 const up = sun ? -light.direction * (12.0 / -light.direction.y)
                                  : (light.position - p) * (12.0 / light.position.y);
                for (double const part : {0.01, 0.5, 1.0}) {
                    if (!contains(level_ground, p + V3(up.x, 0, up.z) * part - V3(0, p.y, 0))) continue;
                    EXPECT_TRUE(laws::serves(map, p + up * part, margin)) << part;
                    EXPECT_TRUE(laws::keeps_the_order(map, p + up * part, p));
                }
            }
        }
}

TEST(Vdsm, TellsReceiversThatProjectBehindTheEye) {
    // A wall ahead, lit from the front: the thesis' "w > 0 always" does not hold.
    ViewVolume<double> const view =
        perspective_view(pose_looking(V3(0, 1.7, 0), V3(0, 0, -1), V3(0, 1, 0)), 1.2, 1.0, 0.1, 200.0);
    ShadowMap<double> const map =
        view_dependent_map(view, directional(V3(0, -0.5, 1)), ground, town, town, {}, gl_clip);
    ASSERT_TRUE(map.visible);
    // The ray through height h meets the ground 2 h nearer: at the eye for h = 5 on a wall 10 m ahead.
    for (double height = 0.0; height < 4.9; height += 0.1) EXPECT_TRUE(receiver_valid(map, V3(0, height, -10)));
    for (double height = 5.0; height < 12.0; height += 0.1) EXPECT_FALSE(receiver_valid(map, V3(0, height, -10)));
}

TEST(Vdsm, SpendsNoDepthOnReceiversBelowItsWMin) {
    // The wall's receivers come as near to w = 0 as w_min lets them, and the least w scales the depth of all.
    ViewVolume<double> const view =
        perspective_view(pose_looking(V3(0, 1.7, 0), V3(0, 0, -1), V3(0, 1, 0)), 1.2, 1.0, 0.1, 200.0);
    auto const depth_scale = [&](double w_min) {
        VdsmOptions<double> options;
        options.w_min = w_min;
        ShadowMap<double> const map =
            view_dependent_map(view, directional(V3(0, -0.5, 1)), ground, town, town, options, gl_zero_to_one_clip);
        EXPECT_EQ(map.w_min, w_min);
        return glm::length(V3(row(map.clip_from_world, 2)));
    };
    EXPECT_GT(depth_scale(4.0), 3.0 * depth_scale(0.1));
}

TEST(Vdsm, GivesFloatDepthBuffersTheirPrecisionBackInBothOrders) {
    for (ClipSpace const clip : {gl_zero_to_one_clip, reversed(gl_zero_to_one_clip)}) {
        ShadowMap<double> const map = view_dependent_map(walker(), morning, ground, town, town, {}, clip);
        bool const from_far = clip.depth == DepthOrder::one_to_zero;
        // At the end that the buffer counts from, the stored value is small whatever w is.
        for (V3 const& p : {V3(0, from_far ? 0.0 : 12.0, -5), V3(0, from_far ? 0.0 : 12.0, -150)})
            EXPECT_LT(ndc(map.clip_from_world, p).z, 0.01);
    }
}

TEST(Vdsm, DependsNeitherOnSignNorOnLengthOfThePlane) {
    ShadowPlane<double> const hill{V3(0.1, 0.8, 0.2), -0.5};
    auto const of = [](ShadowPlane<double> const& plane) {
        return view_dependent_map(walker(), morning, plane, town, town, {}, gl_clip).clip_from_world;
    };
    for (double const scale : {-1.0, 2.0, 0.25})
        EXPECT_EQ(of(ShadowPlane<double>{hill.normal * scale, hill.offset * scale}), of(hill)) << scale;
}

TEST(Vdsm, ServesReceiversFromTheNearDistanceOrFromTheWAskedFor) {
    VdsmOptions<double> options;
    EXPECT_EQ(view_dependent_map(walker(), morning, ground, town, town, options, gl_clip).w_min, walker().z_near);
    options.w_min = 0.5;
    EXPECT_EQ(view_dependent_map(walker(), morning, ground, town, town, options, gl_clip).w_min, 0.5);
}

TEST(Vdsm, MayReachNoFartherThanTheScreen) {
    VdsmOptions<double> options;
    options.reach = 1.0;
    ShadowMap<double> const map = view_dependent_map(walker(), morning, ground, town, town, options, gl_clip);
    EXPECT_TRUE(map.visible);
    EXPECT_FALSE(map.faults.any());
}

// Receivers that rise beside the road slide far out of the picture, on the side that the light sends them to.
TEST(Vdsm, GoesAsFarBeyondTheScreenAsItsReachAndNoFarther) {
    VdsmOptions<double> options;
    options.margin_texels = 0.0;
    double most[4] = {};
    for (V3 const& travel : {V3(1, -0.4, 0), V3(-1, -0.4, 0), V3(0, -0.4, 1), V3(0, -0.1, -1)}) {
        ViewVolume<double> view = walker();
        // Toward the horizon nothing goes beyond a level picture.
        double const down = travel.z < 0.0 ? 1.5 : 0.0;
        view.pose = pose_looking(V3(0, 9, 0), V3(0, -down, -1), V3(0, 1, 0));
        ShadowMap<double> const map =
            view_dependent_map(view, directional(travel), ground, town, town, options, gl_clip);
        ASSERT_TRUE(map.visible);
        glm::dmat4 const screen = clip_from_world(view, gl_clip);
        V3 const a(-2, 0, -9), b(3, 0, -20);
        for (int axis = 0; axis < 2; ++axis) {
            double const of_screen = ndc(screen, b)[axis] - ndc(screen, a)[axis];
            double const of_map = ndc(map.clip_from_world, b)[axis] - ndc(map.clip_from_world, a)[axis];
            for (double const side : {-1.0, 1.0}) {
                double const at =
                    ndc(screen, a)[axis] + (side - ndc(map.clip_from_world, a)[axis]) * of_screen / of_map;
                EXPECT_LE(side * at, options.reach + 1e-9);
                double& farthest = most[2 * axis + (side > 0 ? 1 : 0)];
                farthest = std::max(farthest, side * at);
            }
        }
    }
    for (double const farthest : most) EXPECT_NEAR(farthest, options.reach, 1e-9) << "or nothing was tried";
}

// A mast over ground that is nearer than w_min, though in the picture: nothing that the map serves is below it.
TEST(Vdsm, SpendsNoDepthOnCastersNearerThanItsWMin) {
    ViewVolume<double> view = walker();
    view.pose = pose_looking(V3(0, 1.7, 0), V3(0, -1, -1), V3(0, 1, 0));
    VdsmOptions<double> options;
    options.crop = false;
    options.w_min = 2.5;
    auto const is_visible = [&](double ahead) {
        Aabb<double> const mast{V3(-0.05, 0.1, -ahead - 0.05), V3(0.05, 50, -ahead + 0.05)};
        return view_dependent_map(view, directional(V3(0, -1, 0)), ground, mast, level_ground, options, gl_clip)
            .visible;
    };
    EXPECT_FALSE(is_visible(1.1));
    EXPECT_TRUE(is_visible(3.0));
}

TEST(Vdsm, ServesOrthographicEyes) {
    ViewVolume<double> const view = orthographic_view(pose_looking(V3(0, 50, 0), V3(0.1, -1, -0.3), V3(0, 1, 0)), -20.0,
                                                      20.0, -20.0, 20.0, 1.0, 100.0);
    ShadowMap<double> const map = view_dependent_map(view, morning, ground, town, level_ground, {}, gl_clip);
    ASSERT_TRUE(map.visible);
    EXPECT_TRUE(laws::is_map_of(map.clip_from_world, morning, gl_clip));
    EXPECT_TRUE(laws::serves(map, V3(0, 0, -10), 0.0));
}

TEST(ReceiverValid, IsWhereWIsAboveItsLeast) {
    ShadowMap<double> map;
    map.clip_from_world = Mat4<double>(1.0);
    map.visible = true;
    map.w_min = 0.5;
    EXPECT_TRUE(receiver_valid(map, Vec3<double>(3, 4, 5)));
    map.w_min = 1.0;
    EXPECT_FALSE(receiver_valid(map, Vec3<double>(3, 4, 5)));
    map.w_min = 0.5;
    map.visible = false;
    EXPECT_FALSE(receiver_valid(map, Vec3<double>(3, 4, 5)));
}

// Found by the fuzzer: the caster is nine times as far away as the view is deep, the plane lies along light and eye,
// and the depth row of a float is -w but for 190 roundings. Those suffice.
TEST(Vdsm, OrdersAFarCasterInOpenGlsDefaultRange) {
    using F3 = glm::vec3;
    ViewVolume<float> eye;
    eye.pose.position = F3(-0x1.410c74p-1f, 0x1.90f1b2p-2f, 0x1.0659f4p-2f);
    eye.pose.right = F3(-0x1.c3f348p-5f, 0x1.941adap-1f, -0x1.391f3ap-1f);
    eye.pose.up = F3(-0x1.9c82e4p-1f, 0x1.4e6e9cp-2f, 0x1.fa085ep-2f);
    eye.pose.forward = F3(-0x1.2df612p-1f, -0x1.0a3ca2p-1f, -0x1.3c5b3cp-1f);
    eye.left = -0x1.934778p+0f;
    eye.right = 0x1.f20f2p-1f;
    eye.bottom = -0x1.ade964p-1f;
    eye.top = 0x1.ade964p-1f;
    eye.z_near = 0x1.2b086p-4f;
    eye.z_far = 0x1.d45142p+3f;
    Light<float> const sun = directional(F3(-0x1.2a5a36p-1f, -0x1.46a538p-3f, -0x1.97ff24p-1f));
    F3 const point(-0x1.a52a2ap+0f, 0x1.1e219cp-3f, -0x1.4191aap+0f);
    F3 const caster(0x1.0ad07cp+6f, 0x1.2d8e88p+4f, 0x1.70d7dp+6f);
    ShadowPlane<float> const plane = plane_through(point, F3(0x1.236ffep-1f, 0x1.0e5976p-1f, -0x1.42ace4p-1f));
    Aabb<float> const receivers{F3(-0x1.08819cp+3f, -0x1.36c6a2p+2f, -0x1.4191aap+0f),
                                F3(0x1.3e6e22p+2f, 0x1.48a8bap+2f, -0x1.4191aap+0f)};
    VdsmOptions<float> const options;
    auto const map = view_dependent_map(eye, sun, plane, merge(receivers, caster), receivers, options, gl_clip);
    EXPECT_TRUE(laws::is_map_of(map.clip_from_world, sun, gl_clip, 256));
    EXPECT_TRUE(laws::keeps_the_order(map, caster, point));
}
