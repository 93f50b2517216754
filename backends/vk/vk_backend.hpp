// SPDX-License-Identifier: MIT
//
// The Vulkan 1.1 backend, headless: no surface, classic render passes, one queue, every call waits for the device.
// Several may live in one process. The loader's own VK_DRIVER_FILES and VK_ICD_FILENAMES choose among drivers as usual.
#pragma once

#include "backends/backend.hpp"

#include <memory>

namespace shadowmath::backend {

// Mistakes that a backend can be told to make, so that tests know that validation would have seen them.
enum class VulkanMistake {
    none,
    usage_forgotten,             // the maps are copied from, but were not made for it
    depth_pass_without_barrier,  // nothing waits for the depth pass before its maps change hands
    copy_without_barrier,        // nothing waits for a map to change hands before it is copied
    leak,                        // a sampler is never destroyed
};

struct VulkanOptions {
    bool software = false;    // only drivers that draw on the CPU; else a real GPU where there is one
    bool validation = false;  // core and synchronisation validation; what they say comes from take_messages()
    std::vector<std::string>* last_words = nullptr;  // gets what validation says of the backend's end; may be null
    VulkanMistake mistake = VulkanMistake::none;
};

// Throws std::runtime_error with one sentence when a driver, its abilities or the validation layers are missing.
[[nodiscard]] std::unique_ptr<Backend> make_vulkan_backend(VulkanOptions const& options = {});

}  // namespace shadowmath::backend
