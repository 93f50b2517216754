// SPDX-License-Identifier: MIT
//
// The ways in which receivers may lie in memory, and what a shader is given of them.
#include "tests/support/traced.hpp"

#include <shadowmath/fit_crop.hpp>
#include <shadowmath/irregular/gpu.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

using V = Vec3<float>;

struct ReceiversInMemory : ::testing::Test {
    static constexpr int width = 22, height = 17, map_size = 32;  // tiles are cut on both sides
    ViewVolume<float> perspective =
        perspective_view<float>(pose_looking(V(0, 4, 4), V(0, -1, -1), V(0, 1, 0)), 0.8f, 1.5f, 0.1f, 100.0f);
    ViewVolume<float> orthographic = orthographic_view<float>(perspective.pose, -3.0f, 4.0f, -2.0f, 2.0f, 0.1f, 100.0f);
    Light<float> sun = directional(V(0.3f, -1.0f, 0.2f));
    ShadowMap<float> grid = sun_map(sun, V(0, 0, 0), 8.0f);
    Triangle<float> roof{V(-2, 1, -1), V(1, 1, -1), V(0, 1.5f, 1)};

    template <class Lanes>
    std::vector<std::uint32_t> masks(PixelFrame<float> const& frame, Receivers<float> const& receivers) const {
        StorageSize const size = storage_for(width, height, map_size);
        std::vector<float> scalars(size.scalars);
        std::vector<std::uint32_t> words(size.words), masks(width * height);
        IrregularBuffer<float> buffer =
            list_receivers<float, Lanes>(frame, receivers, sun, grid, map_size, {scalars.data(), words.data(), size});
        trace<float, Lanes>(buffer, Casters<float>{&roof[0].x, 3, 3, nullptr, 1});
        write_masks(buffer, masks.data());
        EXPECT_FALSE(buffer.faults.any()) << describe(buffer.faults);
        return masks;
    }

    // Where the depths of a picture lie in the world.
    static std::vector<float> places(PlanePicture<float> const& picture, std::size_t stride) {
        PixelFrame<float> const& f = picture.frame;
        std::vector<float> all(picture.depth.size() * stride, -77.0f);
        for (std::size_t pixel = 0; pixel < picture.depth.size(); ++pixel) {
            float const x = float(pixel % width) + 0.5f - width / 2.0f, y = float(pixel / width) + 0.5f - height / 2.0f;
            bool const flat = f.kind == ViewKind::orthographic;
            V const aside = f.across * (x + f.origin.x) + f.upward * (y + f.origin.y);
            float const depth = picture.depth[pixel];
            V const place = flat ? f.eye + aside + f.inward * depth : f.eye + (f.inward + aside) * depth;
            for (int axis = 0; axis < 3; ++axis)
                all[pixel * stride + std::size_t(axis)] = depth > 0.0f ? place[axis] : f.eye[axis];
        }
        return all;
    }
};

int bits_apart(std::vector<std::uint32_t> const& a, std::vector<std::uint32_t> const& b) {
    int apart = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::uint32_t differ = a[i] ^ b[i]; differ != 0; differ &= differ - 1) ++apart;
    return apart;
}

}  // namespace

TEST_F(ReceiversInMemory, PositionsAreShadowedAsDepthsAreAndStridesDoNotMatterByABit) {
    for (ViewVolume<float> const& eye : {perspective, orthographic}) {
        PlanePicture<float> const floor = picture_of_plane(eye, width, height, V(0), V(0, 1, 0));
        Receivers<float> by_depth;
        by_depth.depth = floor.depth.data();
        by_depth.normal = floor.normals.data();
        auto const wanted = masks<BestLanes<float>>(floor.frame, by_depth);
        EXPECT_GT(std::count_if(wanted.begin(), wanted.end(), [](auto mask) { return mask != 0; }), 20);

        std::vector<float> const tight = places(floor, 3), loose = places(floor, 5);
        std::vector<float> normals(floor.depth.size() * 4, -77.0f);
        for (std::size_t pixel = 0; pixel < floor.depth.size(); ++pixel)
            std::copy_n(&floor.normals[3 * pixel], 3, &normals[4 * pixel]);
        Receivers<float> const by_place{tight.data(), 3, nullptr, floor.normals.data(), 3};
        Receivers<float> const apart{loose.data(), 5, nullptr, normals.data(), 4};
        Receivers<float> const depth_apart{nullptr, 3, floor.depth.data(), normals.data(), 4};
        auto const placed = masks<BestLanes<float>>(floor.frame, by_place);
        EXPECT_LE(bits_apart(placed, wanted), 8) << "but for the rounding of a place";
        EXPECT_EQ(masks<BestLanes<float>>(floor.frame, apart), placed);
        EXPECT_EQ(masks<BestLanes<float>>(floor.frame, depth_apart), wanted);
        EXPECT_EQ(masks<PlainLanes<float>>(floor.frame, by_depth), wanted);
        EXPECT_EQ(masks<PlainLanes<float>>(floor.frame, by_place), placed);
        EXPECT_EQ(masks<PlainLanes<float>>(floor.frame, apart), placed);
    }
}

TEST_F(ReceiversInMemory, AShaderIsGivenWhatTheListsAreMadeWith) {
    Light<float> const lamp = spot(V(1, 6, 0), V(0, -1, 0), 1.2f, 50.0f);
    ShadowMap<float> lamp_map;
    lamp_map.clip = gl_zero_to_one_clip;
    lamp_map.clip_from_world = spot_clip_from_world(lamp, 0.1f, lamp_map.clip);
    lamp_map.w_min = 0.1f;
    lamp_map.visible = true;
    for (ViewVolume<float> const& eye : {perspective, orthographic})
        for (bool const is_sun : {true, false}) {
            Light<float> const& light = is_sun ? sun : lamp;
            ShadowMap<float> const& map = is_sun ? grid : lamp_map;
            PlanePicture<float> const floor = picture_of_plane(eye, width, height, V(0), V(0, 1, 0));
            Receivers<float> seen;
            seen.depth = floor.depth.data();
            seen.normal = floor.normals.data();
            StorageSize const size = storage_for(width, height, map_size);
            std::vector<float> scalars(size.scalars);
            std::vector<std::uint32_t> words(size.words);
            auto const buffer =
                list_receivers(floor.frame, seen, light, map, map_size, {scalars.data(), words.data(), size});
            GpuIrregular gpu;
            ASSERT_FALSE(gpu_irregular(floor.frame, light, map, map_size, gpu).any());
            for (int i = 0; i < 4; ++i) EXPECT_EQ(gpu.row[i], buffer.row[i]);
            EXPECT_EQ(gpu.texel_error, buffer.texel_error);
            EXPECT_EQ(gpu.depth_error_here, buffer.depth_error_here);
            EXPECT_EQ(gpu.frame.width, width);
            EXPECT_EQ(gpu.frame.orthographic, eye.kind == ViewKind::orthographic ? 1 : 0);
            EXPECT_EQ(gpu.frame.inward.z, floor.frame.inward.z);
            EXPECT_EQ(gpu.parallel, is_sun ? 1 : 0);
            EXPECT_EQ(gpu.source.y, is_sun ? sun.direction.y : lamp.position.y);
            EXPECT_EQ(gpu.w_min, is_sun ? 0.0f : 0.1f);
            EXPECT_EQ(gpu.map_size, map_size);
        }
}

TEST_F(ReceiversInMemory, WithFaultsAShaderKeepsWhatItHad) {
    PixelFrame<float> const frame = pixel_frame(perspective, width, height);
    GpuIrregular before;
    before.map_size = 77;
    auto const faults = [&](PixelFrame<float> const& of, Light<float> const& light, ShadowMap<float> const& map,
                            int size) {
        GpuIrregular gpu = before;
        Faults const told = gpu_irregular(of, light, map, size, gpu);
        EXPECT_EQ(gpu.map_size, 77);
        return told;
    };
    EXPECT_EQ(faults(frame, sun, grid, 0), Faults(Fault::map_too_small));
    EXPECT_EQ(faults(frame, sun, grid, largest_grid + 1), Faults(Fault::map_too_small));
    EXPECT_EQ(faults(frame, directional(V(1, 0, 0)), grid, 32), Faults(Fault::bad_projection)) << "another light's map";
    EXPECT_TRUE(faults(pixel_frame(perspective, 0, 4), sun, grid, 32).has(Fault::map_too_small));
    EXPECT_TRUE(faults(pixel_frame(perspective, 4, 0), sun, grid, 32).has(Fault::map_too_small));
    EXPECT_TRUE(faults(frame, directional(V(0.0f)), grid, 32).any());
}

TEST_F(ReceiversInMemory, OfAPartThatIsNotInThePictureNothingIsListed) {
    PlanePicture<float> const floor = picture_of_plane(perspective, width, height, V(0), V(0, 1, 0));
    Receivers<float> seen;
    seen.depth = floor.depth.data();
    seen.normal = floor.normals.data();
    StorageSize const size = storage_for(width, height, map_size);
    std::vector<float> scalars(size.scalars);
    std::vector<std::uint32_t> words(size.words);
    Storage<float> const storage{scalars.data(), words.data(), size};
    auto const faults = [&](PixelRect const& rect, ShadowMap<float> const& map, Storage<float> const& in) {
        return list_receivers(floor.frame, seen, sun, map, map_size, in, rect).faults;
    };
    EXPECT_FALSE(faults({2, 3, 8, 9}, grid, storage).any());
    for (PixelRect const& rect :
         {PixelRect{-1, 0, 4, 4}, PixelRect{0, -1, 4, 4}, PixelRect{width, 0, 0, 4}, PixelRect{0, height, 4, 0},
          PixelRect{width - 3, 0, 4, 4}, PixelRect{0, height - 3, 4, 4}})
        EXPECT_EQ(faults(rect, grid, storage), Faults(Fault::bad_region)) << rect.x << ' ' << rect.y;
    ShadowMap<float> bad = grid;
    bad.w_min = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(faults({}, bad, storage), Faults(Fault::bad_projection));
    EXPECT_EQ(faults({}, grid, {nullptr, words.data(), size}), Faults(Fault::storage_too_small));
    EXPECT_EQ(faults({}, grid, {scalars.data(), nullptr, size}), Faults(Fault::storage_too_small));
    for (StorageSize const& none :
         {storage_for(0, 4, 8), storage_for(4, 0, 8), storage_for(4, 4, 0), storage_for(4, 4, largest_grid + 1)})
        EXPECT_TRUE(none.scalars == 0 && none.words == 0);
}
