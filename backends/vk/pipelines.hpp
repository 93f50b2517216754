// SPDX-License-Identifier: MIT
//
// The fixed part of the Vulkan backend: what shaders may read, how passes begin and end, and the three pipelines.
//
// One descriptor set serves all: binding 0 a uniform block at a dynamic offset, binding 1 the array of maps.
// Render passes are the classic ones, for synchronisation validation 1.3.239 does not see dynamic rendering, and they
// change no layouts: barrier.hpp does, where a reader finds it.
#pragma once

#include "backends/vk/objects.hpp"

#include <array>

namespace shadowmath::backend::vk {

inline constexpr VkFormat depth_format = VK_FORMAT_D32_SFLOAT;
inline constexpr VkFormat colour_format = VK_FORMAT_R8G8B8A8_SRGB;
inline constexpr VkFormat geometry_format = VK_FORMAT_R32G32B32A32_SFLOAT;  // positions, normals

struct Pipelines {
    explicit Pipelines(VkDevice device);

    Sampler sampler;
    SetLayout set_layout;
    PipelineLayout layout;
    RenderPass depth_pass;    // depth
    RenderPass receive_pass;  // colour, position, normal, depth
    Pipeline depth_clipped, depth_clamped, receive;
};

}  // namespace shadowmath::backend::vk
