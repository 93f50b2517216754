// SPDX-License-Identifier: MIT
//
// The uniform blocks of a pass, in the order in which both APIs lay them into one buffer. Blocks lie at multiples of
// 256 bytes, the coarsest alignment that the specifications let a driver ask for.
#pragma once

#include "backends/view_plan.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace shadowmath::backend {

struct alignas(256) MapBlock {
    glm::mat4 clip_from_world;
};
struct alignas(256) MapsBlock {
    std::array<glm::mat4, max_maps> clip_from_world;
};
struct alignas(256) FrameBlock {
    FrameConstants frame;
};

// Bytes that go from the maps of a fit into the blocks of a pass, on the device.
struct BlockCopy {
    std::size_t from = 0;
    std::size_t to = 0;
    std::size_t size = 0;
};

struct Constants {
    std::array<MapBlock, max_maps> map{};    // one map each
    std::array<MapsBlock, max_maps> maps{};  // as many as are drawn at once, then the next as many, and so on
    std::array<FrameBlock, max_maps + 2> frame{};

    void set(std::span<DepthLayer const> layers, std::size_t at_once = max_maps) {
        for (std::size_t i = 0; i < layers.size(); ++i)
            map[i].clip_from_world = maps[i / at_once].clip_from_world[i % at_once] = layers[i].clip_from_world;
    }
    void set(std::span<ViewDraw const> views) {
        for (std::size_t i = 0; i < views.size(); ++i) frame[i].frame = views[i].frame;
    }

    [[nodiscard]] static std::size_t offset_of_map(std::size_t i) {
        return offsetof(Constants, map) + i * sizeof(MapBlock);
    }
    [[nodiscard]] static std::size_t offset_of_maps(std::size_t i) {
        return offsetof(Constants, maps) + i * sizeof(MapsBlock);
    }
    [[nodiscard]] static std::size_t offset_of_frame(std::size_t i) {
        return offsetof(Constants, frame) + i * sizeof(FrameBlock);
    }

    // What set() does, for constants that lie on the device as MapConstants[max_maps].
    [[nodiscard]] static std::vector<BlockCopy> copies_of_maps(std::size_t count, std::size_t at_once = max_maps) {
        std::vector<BlockCopy> copies;
        for (std::size_t i = 0; i < count; ++i) {
            std::size_t const from = i * sizeof(MapConstants);
            std::size_t const among = offset_of_maps(i / at_once) + i % at_once * sizeof(glm::mat4);
            copies.push_back({from, offset_of_map(i), sizeof(glm::mat4)});
            copies.push_back({from, among, sizeof(glm::mat4)});
        }
        return copies;
    }
    [[nodiscard]] static std::vector<BlockCopy> copies_of_frames(std::size_t count) {
        std::vector<BlockCopy> copies;
        for (std::size_t i = 0; i < count; ++i)
            copies.push_back({0, offset_of_frame(i) + offsetof(FrameConstants, maps), max_maps * sizeof(MapConstants)});
        return copies;
    }
};
static_assert(sizeof(MapsBlock) <= sizeof(FrameBlock), "a binding as wide as FrameBlock reaches past no end");

}  // namespace shadowmath::backend
