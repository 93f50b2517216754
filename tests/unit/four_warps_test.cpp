// SPDX-License-Identifier: MIT
#include "tests/laws/slice_warps.hpp"
#include "tests/support/seen_boxes.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace shadowmath;

namespace {

// In double, where what planes are moved by is nothing beside any mistake.
struct FourWarps : ::testing::Test {
    using V3 = Vec3<double>;
    static constexpr double blend = 0.1;
    test::SeenBoxes<double> some;
    ViewVolume<double> view =
        perspective_view(pose_looking(V3(3, 2, 10), V3(0.3, -0.1, -1), V3(0, 1, 0)), 1.0, 1.6, 0.1, 200.0);
    Light<double> sun = directional(V3(0.4, -0.8, 0.3));
    Aabb<double> receivers{V3(-120, 0, -120), V3(120, 30, 120)};
    Aabb<double> casters = receivers;
    WarpOptions<double> options;
    ClipSpace clip = gl_clip;
    int count = 4;
    ShadowMap<double> maps[max_splits];

    Splits<double> splits() const {
        Splits<double> found = practical_splits(view.z_near, view.z_far, count);
        found.plane[0] = view.z_near;
        return found;
    }
    unsigned fit() { return fit_slice_warps(view, sun, splits(), blend, casters, receivers, options, clip, maps); }
    ShadowMap<double> twin(int i) const {
        return simple_perspective_map(slice(view, slice_range(splits(), i, blend)), sun, casters, receivers, options,
                                      clip);
    }
    // To a part of a row, the largest of all.
    static double apart(Mat4<double> const& a, Mat4<double> const& b) {
        double worst = 0;
        for (int r = 0; r < 4; ++r)
            worst = std::max(worst, glm::length(row(a, r) - row(b, r)) / glm::length(row(b, r)));
        return worst;
    }
    // How many are visible.
    int expect_twins(double close) {
        unsigned const visible = fit();
        int met = 0;
        for (int i = 0; i < count; ++i) {
            ShadowMap<double> const wanted = twin(i);
            EXPECT_EQ((visible >> i & 1u) != 0, wanted.visible) << i;
            EXPECT_EQ(maps[i].visible, wanted.visible) << i;
            EXPECT_EQ(maps[i].faults.bits, wanted.faults.bits) << i;
            EXPECT_EQ(maps[i].w_min, wanted.w_min) << i;
            EXPECT_EQ(maps[i].clip.depth, clip.depth) << i;
            EXPECT_EQ(maps[i].clip.ndc_y, clip.ndc_y) << i;
            if (!wanted.visible) {
                EXPECT_EQ(maps[i].clip_from_world, nowhere<double>()) << i;
                continue;
            }
            EXPECT_LT(apart(maps[i].clip_from_world, wanted.clip_from_world), close) << i;
            ++met;
        }
        return met;
    }
    void draw(int i) {
        view = some.view(i % 4 == 3 ? ViewKind::orthographic : ViewKind::perspective);
        sun = directional(some.point(1));
        receivers = some.box(view);
        V3 const up = sun.direction * -some.from_to(0, 40), more = V3(some.from_to(-1, 10));
        casters = merge(receivers, Aabb<double>{receivers.lo + up - more, receivers.lo + up + more});
        if (i % 5 == 4) casters = {receivers.lo + up - more, receivers.lo + up + more};
        options.strength = i % 7 == 6 ? double(i % 3) : some.from_to(0, 2);
        options.margin_texels = some.from_to(0, 8);
        options.map_size = 256 << i % 4;
        ClipSpace const clips[] = {gl_clip, vulkan_clip, d3d_clip, reversed(d3d_clip), reversed(vulkan_clip)};
        clip = clips[i % 5];
        count = 1 + i % 6;
    }
};

}  // namespace

TEST_F(FourWarps, AreWhatOneMapAfterTheOtherIs) {
    int met = 0;
    for (int i = 0; i < 120; ++i) {
        draw(i);
        SCOPED_TRACE(i);
        met += expect_twins(1e-6);
    }
    EXPECT_GT(met, 150);
}

TEST_F(FourWarps, OfAPostAreAsWideAsATexelOfItsLength) {
    sun = directional(V3(0, -1, -0.4));
    view.pose = pose_looking(V3(1, 2, 3), V3(0, -0.2, -1), V3(0, 1, 0));
    int met = 0;
    for (int axis = 0; axis < 3; ++axis)
        for (double const aside : {-10.0, -1.0, 12.0}) {
            SCOPED_TRACE(axis);
            V3 const from = point_at(view, 0.0, -0.1, 30.0) + V3(aside, 0, 0);
            V3 to = from;
            to[axis] += 6;
            receivers = {from, to};
            casters = {from - V3(1), to + V3(1)};
            met += expect_twins(1e-4);
        }
    EXPECT_GE(met, 9);
}

// From the eye itself on; and those that see nothing.
TEST_F(FourWarps, FromNoDepthOnAreWhatOneMapAfterTheOtherIs) {
    view.z_near = 0;
    casters.hi.y = 60;
    EXPECT_EQ(expect_twins(1e-6), 4);
    EXPECT_TRUE(maps[0].faults.has(Fault::near_clamped));
    EXPECT_FALSE(maps[1].faults.has(Fault::near_clamped));
    receivers = casters = {V3(-20, 0, -190), V3(20, 30, -150)};
    EXPECT_EQ(expect_twins(1e-6), 1);
    view = orthographic_view(view.pose, -20.0, 20.0, -10.0, 10.0, 0.0, 200.0);
    receivers = casters = {V3(-120, 0, -200), V3(120, 30, 120)};
    EXPECT_EQ(expect_twins(1e-6), 4);
}

TEST_F(FourWarps, OfSlicesThatSeeNothingAreCalm) {
    receivers = casters = {V3(-20, 0, -190), V3(20, 30, -150)};
    for (V3 const& eye : {view.pose.position, V3(0)}) {
        view.pose = pose_looking(eye, V3(0.3, -0.1, -1), V3(0, 1, 0));
        auto const made = test::watched([this] { return fit(); });
        EXPECT_EQ(made.result, 8u);
        EXPECT_TRUE(made.calm_in_range());
    }
}

// Along each axis of the light: a caster is held though it is hundreds of times as far away as what is seen.
TEST_F(FourWarps, HoldCastersFarAboveWhatIsSeen) {
    for (V3 const& towards : {V3(1, 0, 0), V3(0, 0, -1), V3(0, -1, 0)}) {
        sun = directional(V3(0, -1, 0));
        view.pose = pose_looking(V3(1, -2, 3), towards, V3(0.1, 0.3, 1));
        V3 const seen = view.pose.position + towards * 60.0, up = seen + V3(0, 20e3, 0);
        receivers = {seen - V3(0.5), seen + V3(0.5)};
        casters = merge(receivers, up);
        unsigned const visible = fit();
        EXPECT_NE(visible, 0u);
        for (int i = 0; i < count; ++i)
            if ((visible >> i & 1u) != 0) {
                Vec4<double> const at =
                    canonical_from_clip<double>(clip) * maps[i].clip_from_world * Vec4<double>(up, 1);
                EXPECT_GE(at.z, 0) << i;
                EXPECT_LE(at.z / at.w, 0.01) << i;
            }
    }
}

// What lies as deep as the last receiver is a caster too.
TEST_F(FourWarps, HoldTheFloorOfARoomAlone) {
    sun = directional(V3(0, -1, 0));
    for (double const height : {-30.0, 5.0}) {
        view.pose = pose_looking(V3(1, 0, 2), V3(0, height > 0 ? 1 : -1, 0.3), V3(0, 0.3, 1));
        receivers = {V3(-200, height, -200), V3(200, height + 20, 200)};
        casters = {receivers.lo, V3(200, height, 200)};
        EXPECT_NE(fit(), 0u) << height;
    }
}

// The last bit of the eye's place, in texels.
TEST_F(FourWarps, SayWhereTheLastBitOfAPlaceIsMoreThanATexel) {
    options.map_size = 1 << 14;
    for (int i = 0; i < 20; ++i) {
        sun = directional(some.point(1));
        view.pose = pose_looking(V3(1, -2, 3), some.point(1), some.point(1));
        V3 const seen = view.pose.forward * 150.0, here = seen + view.pose.position;
        receivers = casters = {here - V3(1), here + V3(1)};
        ASSERT_NE(fit() & 8u, 0u);
        double const across = glm::length(V3(row(maps[3].clip_from_world, 0)));
        double const along = glm::length(V3(row(maps[3].clip_from_world, 1)));
        double const limit = 1 / (std::numeric_limits<double>::epsilon() * std::max(across, along) * options.map_size);
        for (double const share : {0.8, 1.25}) {
            V3 const eye = V3(0.36, -0.48, 0.8) * (share * limit);
            view.pose.position = eye;
            receivers = casters = {seen - V3(1) + eye, seen + V3(1) + eye};
            EXPECT_NE(fit() & 8u, 0u);
            EXPECT_EQ(maps[3].faults.has(Fault::precision_lost), share > 1) << i << ' ' << share;
        }
    }
}

// In float, where a slice at the eye is a few steps of the far end's rounding long.
TEST(FourWarpsOfFloats, HoldEveryCornerOfWhatTheySee) {
    using V3 = Vec3<float>;
    test::SeenBoxes<float> some;
    int met = 0;
    for (int i = 0; i < 40; ++i) {
        ViewVolume<float> const view =
            perspective_view(pose_looking(V3(0), some.point(1), some.point(1)), 1.0f, 1.6f, 0.1f, 4000.0f);
        Light<float> const sun = directional(some.point(1));
        Aabb<float> const world{V3(-1e4f), V3(1e4f)};
        WarpOptions<float> options;
        options.margin_texels = 0;
        options.strength = some.from_to(0, 2);
        Splits<float> const splits = practical_splits(0.1f, 4000.0f, 4);
        ShadowMap<float> maps[4];
        EXPECT_EQ(fit_slice_warps(view, sun, splits, 0.0f, world, world, options, vulkan_clip, maps), 15u);
        for (int k = 0; k < 4; ++k)
            for (auto const& corner : laws::exact_corners(slice(view, slice_range(splits, k)))) {
                Vec4<long double> const at = Mat4<long double>(maps[k].clip_from_world) * Vec4<long double>(corner, 1);
                long double const noise = 1e-5L * at.w;
                EXPECT_LE(std::abs(at.x), at.w + noise) << i << ' ' << k;
                EXPECT_LE(std::abs(at.y), at.w + noise) << i << ' ' << k;
                EXPECT_GE(at.z, 0) << i << ' ' << k;
                EXPECT_LE(at.z, at.w) << i << ' ' << k;
                ++met;
            }
    }
    EXPECT_EQ(met, 40 * 4 * 8);
}

TEST(FourWarpsOfFloats, OfAFloorAcrossTheLightHaveADepthForIt) {
    using V3 = Vec3<float>;
    Light<float> const sun = directional(V3(0, -1, 0));
    ViewVolume<float> const view =
        perspective_view(pose_looking(V3(1, 0, 2), V3(0.2f, -0.3f, 1), V3(0, 1, 0)), 1.0f, 1.6f, 0.1f, 200.0f);
    Aabb<float> const floor{V3(-1000, -6, -1000), V3(1000, -6, 1000)};
    for (ClipSpace const clip : {gl_clip, vulkan_clip, reversed(d3d_clip)}) {
        Splits<float> const splits = practical_splits(0.1f, 200.0f, 4);
        ShadowMap<float> maps[4];
        unsigned const visible = fit_slice_warps(view, sun, splits, 0.0f, floor, floor, {}, clip, maps);
        EXPECT_NE(visible & 8u, 0u);
        for (int k = 0; k < 4; ++k) {
            if ((visible >> k & 1u) == 0) continue;
            Mat4<long double> const map =
                canonical_from_clip<long double>(clip) * Mat4<long double>(maps[k].clip_from_world);
            ViewVolume<long double> const part = laws::exact_view(slice(view, slice_range(splits, k)));
            for_each_vertex(visible_body(part, {Vec3<long double>(floor.lo), Vec3<long double>(floor.hi)}),
                            [&](Vec3<long double> const& p) {
                                Vec4<long double> const at = map * Vec4<long double>(p, 1);
                                EXPECT_GT(at.z, 0) << k;
                                EXPECT_LT(at.z, at.w) << k;
                            });
            EXPECT_LT(map[1][2], 0) << "deeper as the light goes down";
        }
    }
}
