// SPDX-License-Identifier: MIT
//
// Runs a test in every kind of context, and fails it when the driver has something to say, up to the backend's end.
// Vulkan runs under core and synchronisation validation. Where it is missing the test is skipped with a line that says
// what is missing; ctest counts these among "did not run" at its end.
#pragma once

#include "backends/gl/gl_backend.hpp"
#include "backends/vk/vk_backend.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace shadowmath::image_test {

using namespace shadowmath::backend;

enum class Context { egl, osmesa, vulkan };

[[nodiscard]] inline std::string name_of(Context context) {
    return context == Context::egl ? "egl" : context == Context::osmesa ? "osmesa" : "vulkan";
}

inline void PrintTo(Context context, std::ostream* out) {
    *out << name_of(context);
}

// A test of Vulkan alone starts with: if (!try_vulkan(backend, options)) GTEST_SKIP() << not_tested;
inline std::string not_tested;

[[nodiscard]] inline bool try_vulkan(std::unique_ptr<Backend>& backend, VulkanOptions const& options) {
    try {
        backend = make_vulkan_backend(options);
    } catch (std::runtime_error const& error) {
        not_tested = std::string("NOT TESTED on Vulkan: ") + error.what();
    }
    return backend != nullptr;
}

class InContext : public testing::TestWithParam<Context> {
protected:
    void SetUp() override {
        VulkanOptions options;
        options.validation = true;
        options.last_words = &last_words;
        if (GetParam() == Context::egl)
            backend = make_gl_backend(GlContextKind::egl);
        else if (GetParam() == Context::osmesa)
            backend = make_gl_backend(GlContextKind::osmesa);
        else if (!try_vulkan(backend, options))
            GTEST_SKIP() << not_tested;
    }

    void TearDown() override {
        if (backend == nullptr) return;
        for (std::string const& message : backend->take_messages()) ADD_FAILURE() << "driver: " << message;
        backend.reset();
        for (std::string const& message : last_words) ADD_FAILURE() << "driver, at the end: " << message;
    }

    std::vector<std::string> last_words;
    std::unique_ptr<Backend> backend;
};

inline auto const every_context = testing::Values(Context::egl, Context::osmesa, Context::vulkan);
inline auto const context_name = [](auto const& context) { return name_of(context.param); };

}  // namespace shadowmath::image_test
