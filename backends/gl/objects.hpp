// SPDX-License-Identifier: MIT
//
// OpenGL object names that delete themselves. They must die while their context is current.
#pragma once

#include "backends/gl/procs.hpp"

#include "backends/shaders/shader.hpp"

#include <initializer_list>
#include <string>
#include <type_traits>
#include <utility>

namespace shadowmath::backend::gl {

// Delete is the member of Procs that ends the object's life, for one name or for an array of names.
template <auto Delete>
class Name {
public:
    Name() = default;
    Name(Procs const& gl, GLuint name) : gl_(&gl), name_(name) {}
    Name(Name&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0u)) {}
    Name& operator=(Name&& other) noexcept {
        std::swap(gl_, other.gl_);
        std::swap(name_, other.name_);
        return *this;
    }
    ~Name() {
        if (name_ == 0u) return;
        if constexpr (std::is_invocable_v<decltype(gl_->*Delete), GLsizei, GLuint const*>)
            (gl_->*Delete)(1, &name_);
        else
            (gl_->*Delete)(name_);
    }

    operator GLuint() const noexcept { return name_; }

private:
    Procs const* gl_ = nullptr;
    GLuint name_ = 0u;
};

using Buffer = Name<&Procs::DeleteBuffers>;
using VertexArray = Name<&Procs::DeleteVertexArrays>;
using Texture = Name<&Procs::DeleteTextures>;
using Framebuffer = Name<&Procs::DeleteFramebuffers>;
using Shader = Name<&Procs::DeleteShader>;
using Program = Name<&Procs::DeleteProgram>;
using Query = Name<&Procs::DeleteQueries>;

[[nodiscard]] inline Buffer make_buffer(Procs const& gl) {
    GLuint name = 0u;
    gl.CreateBuffers(1, &name);
    return {gl, name};
}

[[nodiscard]] inline VertexArray make_vertex_array(Procs const& gl) {
    GLuint name = 0u;
    gl.CreateVertexArrays(1, &name);
    return {gl, name};
}

[[nodiscard]] inline Texture make_texture(Procs const& gl, GLenum target) {
    GLuint name = 0u;
    gl.CreateTextures(target, 1, &name);
    return {gl, name};
}

[[nodiscard]] inline Framebuffer make_framebuffer(Procs const& gl) {
    GLuint name = 0u;
    gl.CreateFramebuffers(1, &name);
    return {gl, name};
}

// Not by glCreateQueries: Mesa 22.3 knows no statistics there.
[[nodiscard]] inline Query make_query(Procs const& gl) {
    GLuint name = 0u;
    gl.GenQueries(1, &name);
    return {gl, name};
}

struct ShaderSource {
    GLenum stage;
    shaders::Shader const& shader;
};

// Where the driver takes compiled words and they are there, it gets them; else the text.
[[nodiscard]] inline bool takes_spirv(Procs const& gl, shaders::Shader const& shader) {
    return gl.SpecializeShader != nullptr && !shader.spirv.empty();
}

// Compiles and links, or throws the driver's own words.
[[nodiscard]] inline Program make_program(Procs const& gl, std::initializer_list<ShaderSource> sources) {
    std::string log(4096, '\0');
    auto const room = static_cast<GLsizei>(log.size());
    GLsizei length = 0;
    GLint done = GL_FALSE;
    Program program(gl, gl.CreateProgram());
    for (auto const& [stage, source] : sources) {
        Shader const shader(gl, gl.CreateShader(stage));
        if (takes_spirv(gl, source)) {
            GLuint const name = shader;
            gl.ShaderBinary(1, &name, GL_SHADER_BINARY_FORMAT_SPIR_V_ARB, source.spirv.data(),
                            static_cast<GLsizei>(source.spirv.size_bytes()));
            gl.SpecializeShader(shader, "main", 0, nullptr, nullptr);
        } else {
            gl.ShaderSource(shader, 1, &source.text, nullptr);
            gl.CompileShader(shader);
        }
        gl.GetShaderiv(shader, GL_COMPILE_STATUS, &done);
        gl.GetShaderInfoLog(shader, room, &length, log.data());
        if (done != GL_TRUE)
            throw std::runtime_error("the driver rejects a shader: " + log.substr(0, std::size_t(length)));
        gl.AttachShader(program, shader);
    }
    gl.LinkProgram(program);
    gl.GetProgramiv(program, GL_LINK_STATUS, &done);
    gl.GetProgramInfoLog(program, room, &length, log.data());
    if (done != GL_TRUE)
        throw std::runtime_error("the driver cannot link shaders: " + log.substr(0, std::size_t(length)));
    return program;
}

}  // namespace shadowmath::backend::gl
