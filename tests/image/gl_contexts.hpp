// SPDX-License-Identifier: MIT
//
// Runs a test in both kinds of OpenGL context, and fails it when the driver has something to say.
#pragma once

#include "backends/gl/gl_backend.hpp"

#include <gtest/gtest.h>

#include <string>

namespace shadowmath::image_test {

using namespace shadowmath::backend;

[[nodiscard]] inline std::string name_of(GlContextKind kind) {
    return kind == GlContextKind::egl ? "egl" : "osmesa";
}

class InGlContext : public testing::TestWithParam<GlContextKind> {
protected:
    void TearDown() override {
        for (std::string const& message : backend->take_messages()) ADD_FAILURE() << "driver: " << message;
    }

    std::unique_ptr<Backend> backend = make_gl_backend(GetParam());
};

inline auto const both_contexts = testing::Values(GlContextKind::egl, GlContextKind::osmesa);
inline auto const context_name = [](auto const& kind) { return name_of(kind.param); };

}  // namespace shadowmath::image_test
