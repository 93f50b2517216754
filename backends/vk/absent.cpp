// SPDX-License-Identifier: MIT
//
// Stands in where Vulkan was not built, so that whoever offers a choice of backends needs no #ifdef.
#include "backends/compute.hpp"

#include <stdexcept>

namespace shadowmath::backend {

constexpr char const* sentence =
    "built without Vulkan; the Debian packages libvulkan-dev, libvulkan-volk-dev and glslang-tools bring it";

std::unique_ptr<Backend> make_vulkan_backend(VulkanOptions const&) {
    throw std::runtime_error(sentence);
}
std::unique_ptr<ComputeRunner> make_vulkan_compute(VulkanOptions const&) {
    throw std::runtime_error(sentence);
}

}  // namespace shadowmath::backend
