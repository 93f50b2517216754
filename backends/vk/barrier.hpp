// SPDX-License-Identifier: MIT
//
// How an image changes hands: every barrier of the backend goes from one use of an image to another.
#pragma once

#include "backends/vk/objects.hpp"

namespace shadowmath::backend::vk {

struct Use {
    VkImageLayout layout;
    VkPipelineStageFlags stages;
    VkAccessFlags access;
};

inline constexpr Use fresh{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0};
inline constexpr Use depth_drawn{
    VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
    VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
inline constexpr Use colour_drawn{VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                  VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                                  VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT};
inline constexpr Use depth_sampled{VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL,
                                   VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT};
inline constexpr Use copied_from{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                 VK_ACCESS_TRANSFER_READ_BIT};
inline constexpr Use copied_to{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                               VK_ACCESS_TRANSFER_WRITE_BIT};
inline constexpr Use computed_with{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                                   VK_ACCESS_SHADER_READ_BIT};

// The same layout, but nobody waits before (as `from`) or after (as `to`) the change: the mistake that tests make.
[[nodiscard]] constexpr Use unsynchronised_from(Use use) {
    return {use.layout, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0};
}
[[nodiscard]] constexpr Use unsynchronised_to(Use use) {
    return {use.layout, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0};
}

inline void hand_over(VkCommandBuffer commands, Target const& target, Use from, Use to) {
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcAccessMask = from.access;
    barrier.dstAccessMask = to.access;
    barrier.oldLayout = from.layout;
    barrier.newLayout = to.layout;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = target.image;
    barrier.subresourceRange = {target.aspect, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
    vkCmdPipelineBarrier(commands, from.stages, to.stages, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

// What was copied into buffers becomes visible to the stages that read them next.
inline void finish_copies(VkCommandBuffer commands, VkPipelineStageFlags readers, VkAccessFlags access) {
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = access;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, readers, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

}  // namespace shadowmath::backend::vk
