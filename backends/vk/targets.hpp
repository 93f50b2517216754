// SPDX-License-Identifier: MIT
//
// What the Vulkan backend draws into: the array of maps, and the picture.
#pragma once

#include "backends/backend.hpp"
#include "backends/vk/pipelines.hpp"

#include <array>
#include <map>

namespace shadowmath::backend::vk {

struct Maps {
    Target target;
    ImageView all;                          // what the receiver reads
    std::array<ImageView, max_maps> layer;  // one map each
    std::array<Framebuffer, max_maps> framebuffer;
    Framebuffer layered;                            // all maps, for shaders that name the layer
    std::array<ImageView, max_maps> views;          // as many maps as multiview draws at once, the next as many, ...
    std::map<std::uint32_t, Framebuffer> of_views;  // by the set of maps
    int size = 0;
    int layers = 0;
};

struct FrameTargets {
    Target colour, position, normal, depth;
    ImageView colour_view, position_view, normal_view, depth_view;
    Framebuffer framebuffer;
    Extent extent;
};

// The depth that the eye sees, for compute shaders.
struct EyeDepth {
    Target target;
    ImageView drawn, array;
    Framebuffer framebuffer;
    Extent extent;
};

[[nodiscard]] EyeDepth make_eye_depth(Device const& device, Pipelines const& pipelines, Extent extent);
[[nodiscard]] Maps make_maps(Device const& device, Pipelines const& pipelines, int size, int layers, int views_at_once,
                             VkImageUsageFlags usage);
[[nodiscard]] FrameTargets make_frame(Device const& device, Pipelines const& pipelines, Extent extent);

}  // namespace shadowmath::backend::vk
