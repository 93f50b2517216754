// SPDX-License-Identifier: MIT
#include "backends/vk/targets.hpp"

#include <algorithm>

namespace shadowmath::backend::vk {

Maps make_maps(Device const& device, Pipelines const& pipelines, int size, int layers, int views_at_once,
               VkImageUsageFlags usage) {
    Maps maps;
    maps.target = make_target(device, {depth_format, {size, size}, layers, usage},
                              std::to_string(layers) + " shadow maps of " + std::to_string(size));
    auto const array_view = [&](int first, int count) {
        return make_view(device.get(), maps.target, depth_format, VK_IMAGE_VIEW_TYPE_2D_ARRAY, first, count);
    };
    auto const framebuffer = [&](ImageView const& view, int count) {
        return make_framebuffer(device.get(), pipelines.depth_pass, {size, size}, {view.address(), 1}, count);
    };
    maps.all = array_view(0, layers);
    maps.layered = framebuffer(maps.all, layers);
    for (int i = 0; i < layers; ++i) {
        auto const at = static_cast<std::size_t>(i);
        maps.layer[at] = make_view(device.get(), maps.target, depth_format, VK_IMAGE_VIEW_TYPE_2D, i, 1);
        maps.framebuffer[at] = framebuffer(maps.layer[at], 1);
    }
    if (views_at_once > 0)
        for (int i = 0; i * views_at_once < layers; ++i)
            maps.views[static_cast<std::size_t>(i)] =
                array_view(i * views_at_once, std::min(views_at_once, layers - i * views_at_once));
    maps.size = size;
    maps.layers = layers;
    return maps;
}

EyeDepth make_eye_depth(Device const& device, Pipelines const& pipelines, Extent extent) {
    EyeDepth eye;
    constexpr auto usage =
        VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    eye.target = make_target(device, {depth_format, extent, 1, usage}, "the depth that the eye sees");
    eye.drawn = make_view(device.get(), eye.target, depth_format, VK_IMAGE_VIEW_TYPE_2D, 0, 1);
    eye.array = make_view(device.get(), eye.target, depth_format, VK_IMAGE_VIEW_TYPE_2D_ARRAY, 0, 1);
    eye.framebuffer = make_framebuffer(device.get(), pipelines.depth_pass, extent, {eye.drawn.address(), 1});
    eye.extent = extent;
    return eye;
}

FrameTargets make_frame(Device const& device, Pipelines const& pipelines, Extent extent) {
    FrameTargets frame;
    auto const make = [&](Target& target, ImageView& view, VkFormat format, VkImageUsageFlags usage) {
        target = make_target(device, {format, extent, 1, usage},
                             "a frame of " + std::to_string(extent.width) + " x " + std::to_string(extent.height));
        view = make_view(device.get(), target, format, VK_IMAGE_VIEW_TYPE_2D, 0, 1);
    };
    constexpr auto kept = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    make(frame.colour, frame.colour_view, colour_format, kept);
    make(frame.position, frame.position_view, geometry_format, kept);
    make(frame.normal, frame.normal_view, geometry_format, kept);
    make(frame.depth, frame.depth_view, depth_format, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    std::array<VkImageView, 4> const views{frame.colour_view, frame.position_view, frame.normal_view, frame.depth_view};
    frame.framebuffer = make_framebuffer(device.get(), pipelines.receive_pass, extent, views);
    frame.extent = extent;
    return frame;
}

}  // namespace shadowmath::backend::vk
