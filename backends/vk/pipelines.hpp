// SPDX-License-Identifier: MIT
//
// The fixed part of the Vulkan backend: what shaders may read, how passes begin and end, and the pipelines.
//
// One descriptor set serves all: binding 0 a uniform block at a dynamic offset, binding 1 the array of maps.
// Render passes are the classic ones, for synchronisation validation 1.3.239 does not see dynamic rendering, and they
// change no layouts: barrier.hpp does, where a reader finds it.
#pragma once

#include "backends/vk/objects.hpp"

#include <array>
#include <map>

namespace shadowmath::backend::vk {

inline constexpr VkFormat depth_format = VK_FORMAT_D32_SFLOAT;
inline constexpr VkFormat colour_format = VK_FORMAT_R8G8B8A8_SRGB;
inline constexpr VkFormat geometry_format = VK_FORMAT_R32G32B32A32_SFLOAT;  // positions, normals

struct DepthPipelines {
    Pipeline clipped, clamped;

    [[nodiscard]] VkPipeline get(bool depth_clamp) const noexcept { return depth_clamp ? clamped : clipped; }
};

// The views of a subpass belong to its render pass, and a pipeline to its render pass: so each set of views needs both.
struct ViewsPass {
    RenderPass pass;  // depth, kept as it is
    DepthPipelines pipelines;
};

class Pipelines {
public:
    explicit Pipelines(Device const& device);

    // Those of multiview for a set of views, made when they are first asked for.
    [[nodiscard]] ViewsPass const& views(std::uint32_t mask);

    Sampler sampler;
    SetLayout set_layout;
    PipelineLayout layout;
    RenderPass depth_pass;                      // depth, cleared: one map, or all as layers
    RenderPass receive_pass;                    // colour, position, normal, depth, cleared
    RenderPass receive_pass_resumed;            // the same, kept
    DepthPipelines per_map, clones, instances;  // clones, instances: empty where the device has no such shaders
    Pipeline eye_depth;                         // as per_map, the farther end cleared to 0 and nearer the greater
    Pipeline receive;

private:
    VkDevice device_;
    ShaderModule depth_views_;
    std::map<std::uint32_t, ViewsPass> views_;
};

}  // namespace shadowmath::backend::vk
