// SPDX-License-Identifier: MIT
//
// Vulkan objects that destroy themselves, and the two that own memory. They must die before their device.
#pragma once

#include "backends/image.hpp"
#include "backends/vk/device.hpp"

#include <span>
#include <utility>

namespace shadowmath::backend::vk {

// Destroy points to where the loader puts the function.
template <class Handle, auto* Destroy>
class Owned {
public:
    Owned() = default;
    Owned(VkDevice device, Handle handle) noexcept : device_(device), handle_(handle) {}

    // Create is the vkCreate... function of the handle; `what` completes "Vulkan could not ...".
    template <class Create, class Info>
    Owned(VkDevice device, Create create, Info const& info, char const* what) : device_(device) {
        demand(create(device, &info, nullptr, &handle_), what);
    }
    Owned(Owned&& other) noexcept : device_(other.device_), handle_(std::exchange(other.handle_, Handle{})) {}
    Owned& operator=(Owned&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Owned() {
        if (handle_ != Handle{}) (*Destroy)(device_, handle_, nullptr);
    }

    operator Handle() const noexcept { return handle_; }
    [[nodiscard]] Handle const* address() const noexcept { return &handle_; }
    Handle forget() noexcept { return std::exchange(handle_, Handle{}); }

private:
    VkDevice device_ = VK_NULL_HANDLE;
    Handle handle_{};
};

using Memory = Owned<VkDeviceMemory, &vkFreeMemory>;
using BufferHandle = Owned<VkBuffer, &vkDestroyBuffer>;
using ImageHandle = Owned<VkImage, &vkDestroyImage>;
using ImageView = Owned<VkImageView, &vkDestroyImageView>;
using Sampler = Owned<VkSampler, &vkDestroySampler>;
using ShaderModule = Owned<VkShaderModule, &vkDestroyShaderModule>;
using SetLayout = Owned<VkDescriptorSetLayout, &vkDestroyDescriptorSetLayout>;
using DescriptorPool = Owned<VkDescriptorPool, &vkDestroyDescriptorPool>;
using PipelineLayout = Owned<VkPipelineLayout, &vkDestroyPipelineLayout>;
using Pipeline = Owned<VkPipeline, &vkDestroyPipeline>;
using RenderPass = Owned<VkRenderPass, &vkDestroyRenderPass>;
using Framebuffer = Owned<VkFramebuffer, &vkDestroyFramebuffer>;
using CommandPool = Owned<VkCommandPool, &vkDestroyCommandPool>;
using Fence = Owned<VkFence, &vkDestroyFence>;
using QueryPool = Owned<VkQueryPool, &vkDestroyQueryPool>;

struct Buffer {
    Memory memory;
    BufferHandle handle;
    void* mapped = nullptr;  // where the host sees it; null if it does not
    VkDeviceSize size = 0;
};

// Memory that both sides see at once, without flushes; cached, so that reading it is fast.
[[nodiscard]] Buffer make_host_buffer(Device const& device, VkDeviceSize size, VkBufferUsageFlags usage);
[[nodiscard]] Buffer make_device_buffer(Device const& device, VkDeviceSize size, VkBufferUsageFlags usage);

struct Target {
    Memory memory;
    ImageHandle image;
    VkImageAspectFlags aspect = 0;
};

struct TargetShape {
    VkFormat format = VK_FORMAT_UNDEFINED;
    Extent extent;
    int layers = 1;
    VkImageUsageFlags usage = 0;
};

// An image that is drawn into. Throws "the driver cannot hold ..." if it is too large for the device.
[[nodiscard]] Target make_target(Device const& device, TargetShape const& shape, std::string const& what);

[[nodiscard]] ImageView make_view(VkDevice device, Target const& target, VkFormat format, VkImageViewType type,
                                  int first_layer, int layers);

[[nodiscard]] ShaderModule make_shader(VkDevice device, std::span<std::uint32_t const> words);
[[nodiscard]] SetLayout make_set_layout(VkDevice device, std::span<VkDescriptorSetLayoutBinding const> bindings);
[[nodiscard]] PipelineLayout make_layout(VkDevice device, SetLayout const& set);

[[nodiscard]] Framebuffer make_framebuffer(VkDevice device, VkRenderPass render_pass, Extent extent,
                                           std::span<VkImageView const> attachments, int layers = 1);

}  // namespace shadowmath::backend::vk
