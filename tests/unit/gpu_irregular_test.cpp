// SPDX-License-Identifier: MIT
//
// That the uniform block of the irregular z-buffer holds what tracing on the processor is given. That shaders find it
// there: tests/twins.
#include "tests/support/traced.hpp"

#include <shadowmath/irregular/gpu.hpp>

#include <gtest/gtest.h>

#include <vector>

using namespace shadowmath;

namespace {

using V = Vec3<float>;

Light<float> const sun = directional(V(0.3f, -1.0f, 0.2f));
Light<float> const lamp = spot(V(0.5f, 3, 0.25f), V(0, -1, 0), 1.2f, 20.0f);

PixelFrame<float> frame_of(bool flat) {
    auto const pose = pose_looking(V(1, 4, -3), V(0.1f, -1, -1), V(0, 1, 0));
    return pixel_frame(flat ? orthographic_view<float>(pose, -1, 9, -2, 4, 0.1f, 100)
                            : perspective_view<float>(pose, 0.8f, 1.5f, 0.1f, 100.0f),
                       48, 32);
}

ShadowMap<float> map_of(bool of_lamp) {
    if (!of_lamp) return test::sun_map(sun, V(0), 8.0f);
    ShadowMap<float> map;
    map.clip = gl_zero_to_one_clip;
    map.clip_from_world = clip_from_world(
        perspective_view<float>(pose_looking(lamp.position, V(0.2f, -1, 0.1f), V(0, 0, 1)), 2.0f, 1.0f, 0.1f, 30.0f),
        map.clip);
    return map;
}

void expect_same(GpuFloat3 const& a, V const& b) {
    EXPECT_EQ(V(a.x, a.y, a.z), b);
}

}  // namespace

TEST(GpuIrregular, HoldsWhatTracingOnTheProcessorIsGiven) {
    for (bool const flat : {false, true})
        for (bool const of_lamp : {false, true}) {
            auto const frame = frame_of(flat);
            auto const map = map_of(of_lamp);
            Light<float> const& light = of_lamp ? lamp : sun;
            GpuIrregular gpu;
            ASSERT_FALSE(gpu_irregular(frame, light, map, 16, gpu).any());

            std::vector<float> const depth(48 * 32, 5.0f), normal(3 * 48 * 32, 1.0f);
            Receivers<float> receivers;
            receivers.depth = depth.data();
            receivers.normal = normal.data();
            StorageSize const size = storage_for(48, 32, 16, 16 * 96);
            std::vector<float> scalars(size.scalars);
            std::vector<std::uint32_t> words(size.words);
            auto const buffer = list_receivers(frame, receivers, light, map, 16, {scalars.data(), words.data(), size});
            expect_same(gpu.frame.eye, frame.eye);
            expect_same(gpu.frame.across, frame.across);
            expect_same(gpu.frame.upward, frame.upward);
            expect_same(gpu.frame.inward, frame.inward);
            expect_same(gpu.frame.to_across, frame.to_across);
            expect_same(gpu.frame.to_upward, frame.to_upward);
            expect_same(gpu.frame.to_inward, frame.to_inward);
            EXPECT_EQ(gpu.frame.width, 48);
            EXPECT_EQ(gpu.frame.height, 32);
            EXPECT_EQ(gpu.frame.orthographic, flat ? 1 : 0);
            EXPECT_EQ(gpu.frame.origin_x, frame.origin.x);
            EXPECT_EQ(gpu.frame.origin_y, frame.origin.y);
            EXPECT_EQ(gpu.frame.turn_limit, detail::turn_limit(frame));
            expect_same(gpu.light_at, buffer.light.at);
            EXPECT_EQ(gpu.parallel, of_lamp ? 0 : 1);
            expect_same(gpu.source, of_lamp ? lamp.position : sun.direction);
            for (int i = 0; i < 4; ++i) {
                EXPECT_EQ(gpu.row[i], buffer.row[i]);
                auto const plane = detail::plane_of_row(frame, buffer.row[i]);
                EXPECT_EQ(gpu.seen[i], Vec4<float>(plane.x, plane.y, plane.a, plane.b));
            }
            EXPECT_EQ(gpu.texel_error, buffer.texel_error);
            EXPECT_EQ(gpu.texel_error_here, buffer.texel_error_here);
            EXPECT_EQ(gpu.depth_error, buffer.depth_error);
            EXPECT_EQ(gpu.depth_error_here, buffer.depth_error_here);
            EXPECT_EQ(gpu.ray, buffer.contact_ray);
            EXPECT_EQ(gpu.reach, buffer.contact_reach);
            EXPECT_EQ(gpu.contact_metres, buffer.contact_reach);
            EXPECT_EQ(gpu.contact_share, 0x1p-20f);
            EXPECT_EQ(gpu.map_size, 16);
        }
}

TEST(GpuIrregular, NoLeastWIsBelowNothing) {
    for (float const w_min : {-3.0f, 0.0f, 0.25f, 7.0f}) {
        auto map = map_of(true);
        map.w_min = w_min;
        GpuIrregular gpu;
        ASSERT_FALSE(gpu_irregular(frame_of(false), lamp, map, 16, gpu).any());
        EXPECT_EQ(gpu.w_min, w_min > 0.0f ? w_min : 0.0f);
    }
}

TEST(GpuIrregular, FaultsLeaveItAsItWas) {
    GpuIrregular gpu;
    gpu.map_size = -7;
    auto const broken = [&](PixelFrame<float> const& frame, Light<float> const& light, int map_size, Fault fault) {
        EXPECT_TRUE(gpu_irregular(frame, light, map_of(false), map_size, gpu).has(fault));
        EXPECT_EQ(gpu.map_size, -7);
    };
    PixelFrame<float> bad_frame = frame_of(false);
    bad_frame.faults = Fault::bad_pose;
    broken(bad_frame, sun, 16, Fault::bad_pose);
    broken(frame_of(false), directional(V(0)), 16, Fault::zero_light);
    broken(frame_of(false), lamp, 16, Fault::bad_projection);
    broken(frame_of(false), sun, 0, Fault::map_too_small);
    broken(frame_of(false), sun, largest_grid + 1, Fault::map_too_small);
    for (int const map_size : {1, largest_grid}) {
        EXPECT_FALSE(gpu_irregular(frame_of(false), sun, map_of(false), map_size, gpu).any());
        EXPECT_EQ(gpu.map_size, map_size);
    }
}
