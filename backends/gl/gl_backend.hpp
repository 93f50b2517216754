// SPDX-License-Identifier: MIT
//
// The OpenGL 4.5 core backend, headless. Several may live in one process and on one thread, of either kind;
// a thread's own current context is not kept across a call.
#pragma once

#include "backends/backend.hpp"

#include <memory>

namespace shadowmath::backend {

enum class GlContextKind {
    egl,     // the machine's driver, a real GPU where there is one
    osmesa,  // always Mesa's software rasteriser
};

enum class GlShaders {
    spirv,  // where the driver has GL_ARB_gl_spirv and the build had glslangValidator, else text
    text,
};

// Throws std::runtime_error with one sentence when there is no such context on this machine.
[[nodiscard]] std::unique_ptr<Backend> make_gl_backend(GlContextKind kind, GlShaders shaders = GlShaders::spirv);

}  // namespace shadowmath::backend
