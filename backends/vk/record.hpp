// SPDX-License-Identifier: MIT
//
// What one records for every pass alike: its beginning, its viewport, what it clears to, copies out of what it drew.
#pragma once

#include "backends/backend.hpp"
#include "backends/vk/barrier.hpp"
#include "backends/vk/objects.hpp"

#include <span>

namespace shadowmath::backend::vk {

inline void begin_pass(VkCommandBuffer commands, VkRenderPass render_pass, VkFramebuffer framebuffer, Extent extent,
                       std::span<VkClearValue const> clear, VkPipeline pipeline) {
    VkRect2D const area{{0, 0}, {static_cast<std::uint32_t>(extent.width), static_cast<std::uint32_t>(extent.height)}};
    VkRenderPassBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = render_pass;
    info.framebuffer = framebuffer;
    info.renderArea = area;
    info.clearValueCount = static_cast<std::uint32_t>(clear.size());
    info.pClearValues = clear.data();
    vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    // A positive viewport: NDC y = -1 is row 0, as in the other backends.
    VkViewport const viewport{0.0f, 0.0f, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0.0f, 1.0f};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &area);
}

[[nodiscard]] constexpr VkClearValue far_end() {
    VkClearValue clear{};
    clear.depthStencil = {1.0f, 0};
    return clear;
}

// `from` has been handed over to copied_from.
inline void copy_layer(VkCommandBuffer commands, Target const& from, int layer, Extent extent, Buffer const& to,
                       VkDeviceSize offset) {
    VkBufferImageCopy region{};
    region.bufferOffset = offset;
    region.imageSubresource = {from.aspect, 0, static_cast<std::uint32_t>(layer), 1};
    region.imageExtent = {static_cast<std::uint32_t>(extent.width), static_cast<std::uint32_t>(extent.height), 1};
    vkCmdCopyImageToBuffer(commands, from.image, copied_from.layout, to.handle, 1, &region);
}

}  // namespace shadowmath::backend::vk
