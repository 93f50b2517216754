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
};
static_assert(sizeof(MapsBlock) <= sizeof(FrameBlock), "a binding as wide as FrameBlock reaches past no end");

}  // namespace shadowmath::backend
