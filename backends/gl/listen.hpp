// SPDX-License-Identifier: MIT
//
// Keeps what the driver complains of; its notes on where a buffer lies are no complaint.
#pragma once

#include "backends/gl/procs.hpp"

#include <string>
#include <vector>

namespace shadowmath::backend::gl {

// The driver holds the address of `messages` for as long as the context lives.
inline void listen(Procs const& gl, std::vector<std::string>& messages) {
    GLDEBUGPROC const keep = [](GLenum, GLenum type, GLuint, GLenum severity, GLsizei, GLchar const* text,
                                void const* heard) {
        bool const always = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR ||
                            type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR || type == GL_DEBUG_TYPE_PORTABILITY;
        if (always || severity == GL_DEBUG_SEVERITY_HIGH || severity == GL_DEBUG_SEVERITY_MEDIUM)
            static_cast<std::vector<std::string>*>(const_cast<void*>(heard))->emplace_back(text);
    };
    gl.Enable(GL_DEBUG_OUTPUT);
    gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    gl.DebugMessageCallback(keep, &messages);
    gl.DebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
}

}  // namespace shadowmath::backend::gl
