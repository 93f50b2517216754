// SPDX-License-Identifier: MIT
//
// Images of the device in the host's memory: a layer of a target, and the three pictures of a frame at once.
#pragma once

#include "backends/backend.hpp"
#include "backends/vk/barrier.hpp"
#include "backends/vk/commands.hpp"
#include "backends/vk/record.hpp"
#include "backends/vk/targets.hpp"

#include <cstddef>
#include <cstring>

namespace shadowmath::backend::vk {

template <class Pixel>
[[nodiscard]] VkDeviceSize byte_count(Image<Pixel> const& image) {
    return image.pixels.size() * sizeof(Pixel);
}

// The target is handed over from its `owner` to `reading`, a use with the layout of copied_from, and back.
[[nodiscard]] inline Image<float> read_layer(Device const& device, Commands const& commands, Target const& target,
                                             int layer, Extent extent, Use owner, Use reading = copied_from) {
    Image<float> image(extent);
    if (image.pixels.empty()) return image;
    Buffer const staging = make_host_buffer(device, byte_count(image), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    commands.submit([&](VkCommandBuffer buffer) {
        hand_over(buffer, target, owner, reading);
        copy_layer(buffer, target, layer, extent, staging, 0);
        hand_over(buffer, target, copied_from, owner);
        finish_copies(buffer, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
    });
    std::memcpy(image.pixels.data(), staging.mapped, byte_count(image));
    return image;
}

// The frame has been handed over to copied_from.
[[nodiscard]] inline Frame read_pictures(Device const& device, Commands const& commands, FrameTargets const& from) {
    Extent const extent = from.extent;
    Frame frame{Image<Rgba8>(extent), Image<Texel4>(extent), Image<Texel4>(extent)};
    if (frame.colour.pixels.empty()) return frame;
    VkDeviceSize const geometry = byte_count(frame.position);
    Buffer const staging =
        make_host_buffer(device, 2 * geometry + byte_count(frame.colour), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    commands.submit([&](VkCommandBuffer buffer) {
        copy_layer(buffer, from.position, 0, extent, staging, 0);
        copy_layer(buffer, from.normal, 0, extent, staging, geometry);
        copy_layer(buffer, from.colour, 0, extent, staging, 2 * geometry);
        finish_copies(buffer, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
    });
    auto const* const bytes = static_cast<std::byte const*>(staging.mapped);
    std::memcpy(frame.position.pixels.data(), bytes, geometry);
    std::memcpy(frame.normal.pixels.data(), bytes + geometry, geometry);
    std::memcpy(frame.colour.pixels.data(), bytes + 2 * geometry, byte_count(frame.colour));
    return frame;
}

}  // namespace shadowmath::backend::vk
