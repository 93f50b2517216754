// SPDX-License-Identifier: MIT
//
// Stands in where Vulkan was not built, so that whoever offers a choice of backends needs no #ifdef.
#include "backends/vk/vk_backend.hpp"

#include <stdexcept>

std::unique_ptr<shadowmath::backend::Backend> shadowmath::backend::make_vulkan_backend(VulkanOptions const&) {
    throw std::runtime_error("built without Vulkan; the Debian packages libvulkan-dev and glslang-tools bring it");
}
