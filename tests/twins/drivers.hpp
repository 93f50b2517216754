// SPDX-License-Identifier: MIT
//
// Runs a test of compute shaders on every driver, and fails it when the driver has something to say. Vulkan runs on the
// software driver under core and synchronisation validation; where it is missing the test is skipped with a line that
// says what is missing.
#pragma once

#include "backends/compute.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace shadowmath::twins {

using namespace shadowmath::backend;

enum class Driver { egl, egl_text, osmesa, vulkan };

[[nodiscard]] inline std::string name_of(Driver driver) {
    constexpr char const* names[] = {"egl", "egl_text", "osmesa", "vulkan"};
    return names[static_cast<int>(driver)];
}

inline void PrintTo(Driver driver, std::ostream* out) {
    *out << name_of(driver);
}

class OnDriver : public testing::TestWithParam<Driver> {
protected:
    void SetUp() override {
        try {
            switch (GetParam()) {
                case Driver::egl: runner = make_gl_compute(GlContextKind::egl); break;
                case Driver::egl_text: runner = make_gl_compute(GlContextKind::egl, GlShaders::text); break;
                case Driver::osmesa: runner = make_gl_compute(GlContextKind::osmesa); break;
                case Driver::vulkan:
                    runner = make_vulkan_compute({.software = true, .validation = true, .last_words = &last_words});
            }
        } catch (std::runtime_error const& error) {
            GTEST_SKIP() << "NOT TESTED on " << name_of(GetParam()) << ": " << error.what();
        }
    }

    void TearDown() override {
        if (runner == nullptr) return;
        for (std::string const& message : runner->take_messages()) ADD_FAILURE() << "driver: " << message;
        runner.reset();
        for (std::string const& message : last_words) ADD_FAILURE() << "driver, at the end: " << message;
    }

    std::vector<std::string> last_words;
    std::unique_ptr<ComputeRunner> runner;
};

inline auto const every_driver = testing::Values(Driver::egl, Driver::egl_text, Driver::osmesa, Driver::vulkan);
inline auto const twin_drivers = testing::Values(Driver::egl, Driver::egl_text, Driver::vulkan);
inline auto const driver_name = [](auto const& driver) { return name_of(driver.param); };

}  // namespace shadowmath::twins
