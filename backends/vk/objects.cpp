// SPDX-License-Identifier: MIT
#include "backends/vk/objects.hpp"

#include <stdexcept>

namespace shadowmath::backend::vk {
namespace {

Memory allocate(Device const& device, VkMemoryRequirements const& needs, VkMemoryPropertyFlags required,
                VkMemoryPropertyFlags wished) {
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = needs.size;
    info.memoryTypeIndex = device.memory_type(needs.memoryTypeBits, required, wished);
    return {device.get(), vkAllocateMemory, info, "allocate memory"};
}

Buffer make_buffer(Device const& device, VkDeviceSize size, VkBufferUsageFlags usage, VkMemoryPropertyFlags required,
                   VkMemoryPropertyFlags wished) {
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size;
    info.usage = usage;
    Buffer buffer;
    buffer.size = size;
    buffer.handle = {device.get(), vkCreateBuffer, info, "make a buffer"};
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device.get(), buffer.handle, &needs);
    buffer.memory = allocate(device, needs, required, wished);
    demand(vkBindBufferMemory(device.get(), buffer.handle, buffer.memory, 0), "give a buffer its memory");
    return buffer;
}

}  // namespace

Buffer make_host_buffer(Device const& device, VkDeviceSize size, VkBufferUsageFlags usage) {
    Buffer buffer =
        make_buffer(device, size, usage, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                    VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
    demand(vkMapMemory(device.get(), buffer.memory, 0, VK_WHOLE_SIZE, 0, &buffer.mapped), "map a buffer");
    return buffer;
}

Buffer make_device_buffer(Device const& device, VkDeviceSize size, VkBufferUsageFlags usage) {
    return make_buffer(device, size, usage, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
}

Target make_target(Device const& device, TargetShape const& shape, std::string const& what) {
    auto const width = static_cast<std::uint32_t>(shape.extent.width);
    auto const height = static_cast<std::uint32_t>(shape.extent.height);
    auto const layers = static_cast<std::uint32_t>(shape.layers);
    VkImageFormatProperties limits;
    VkResult const known = vkGetPhysicalDeviceImageFormatProperties(device.physical(), shape.format, VK_IMAGE_TYPE_2D,
                                                                    VK_IMAGE_TILING_OPTIMAL, shape.usage, 0, &limits);
    if (known != VK_SUCCESS || width > limits.maxExtent.width || height > limits.maxExtent.height ||
        layers > limits.maxArrayLayers)
        throw std::runtime_error("the driver cannot hold " + what);

    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = shape.format;
    info.extent = {width, height, 1};
    info.mipLevels = 1;
    info.arrayLayers = layers;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = shape.usage;
    Target target;
    target.aspect = shape.format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    target.image = {device.get(), vkCreateImage, info, "make an image"};
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device.get(), target.image, &needs);
    target.memory = allocate(device, needs, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    demand(vkBindImageMemory(device.get(), target.image, target.memory, 0), "give an image its memory");
    return target;
}

ImageView make_view(VkDevice device, Target const& target, VkFormat format, VkImageViewType type, int first_layer,
                    int layers) {
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = target.image;
    info.viewType = type;
    info.format = format;
    info.subresourceRange = {target.aspect, 0, 1, static_cast<std::uint32_t>(first_layer),
                             static_cast<std::uint32_t>(layers)};
    return {device, vkCreateImageView, info, "make an image view"};
}

ShaderModule make_shader(VkDevice device, std::span<std::uint32_t const> words) {
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = words.size_bytes();
    info.pCode = words.data();
    return {device, vkCreateShaderModule, info, "load a shader"};
}

SetLayout make_set_layout(VkDevice device, std::span<VkDescriptorSetLayoutBinding const> bindings) {
    VkDescriptorSetLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    return {device, vkCreateDescriptorSetLayout, info, "describe what shaders read"};
}

PipelineLayout make_layout(VkDevice device, SetLayout const& set) {
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = 1;
    info.pSetLayouts = set.address();
    return {device, vkCreatePipelineLayout, info, "lay out a pipeline"};
}

Framebuffer make_framebuffer(VkDevice device, VkRenderPass render_pass, Extent extent,
                             std::span<VkImageView const> attachments, int layers) {
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = render_pass;
    info.attachmentCount = static_cast<std::uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.width = static_cast<std::uint32_t>(extent.width);
    info.height = static_cast<std::uint32_t>(extent.height);
    info.layers = static_cast<std::uint32_t>(layers);
    return {device, vkCreateFramebuffer, info, "make a framebuffer"};
}

}  // namespace shadowmath::backend::vk
