// SPDX-License-Identifier: MIT
//
// A Vulkan device without a window, one queue of it that draws and computes, and what the validation layers say.
#pragma once

#include "backends/vk/vk_backend.hpp"

#include <volk.h>

#include <string>
#include <vector>

namespace shadowmath::backend::vk {

// Throws unless the call succeeded; `what` completes "Vulkan could not ...".
void demand(VkResult result, char const* what);

// What a device may lack.
struct Abilities {
    bool geometry_shader = false;
    bool layer_from_vertex_shader = false;
    bool statistics = false;
    bool doubles = false;             // in shaders
    std::uint32_t views_at_once = 0;  // that multiview draws; 0: it has no multiview
};

class Device {
public:
    explicit Device(VulkanOptions const& options);
    Device(Device const&) = delete;
    Device& operator=(Device const&) = delete;
    ~Device();

    [[nodiscard]] VkDevice get() const noexcept { return device_; }
    [[nodiscard]] VkPhysicalDevice physical() const noexcept { return physical_; }
    [[nodiscard]] VkQueue queue() const noexcept { return queue_; }
    [[nodiscard]] std::uint32_t queue_family() const noexcept { return queue_family_; }
    [[nodiscard]] std::string description() const;
    [[nodiscard]] Abilities const& abilities() const noexcept { return abilities_; }

    // A memory type that a resource may live in: with `required`, and with `wished` too if there is one.
    [[nodiscard]] std::uint32_t memory_type(std::uint32_t allowed, VkMemoryPropertyFlags required,
                                            VkMemoryPropertyFlags wished) const;

    // NOTE: the layers hold its address.
    std::vector<std::string> messages;

private:
    void make_instance(bool validation);
    void choose_physical(bool software);
    void find_abilities();
    void make_device();
    void destroy() noexcept;

    std::vector<std::string>* last_words_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::uint32_t queue_family_ = 0;
    Abilities abilities_;
};

}  // namespace shadowmath::backend::vk
