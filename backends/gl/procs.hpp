// SPDX-License-Identifier: MIT
//
// The OpenGL 4.5 core entry points that the backend calls, loaded for one context.
// Each context keeps its own table: EGL and OSMesa hand out different functions in one process.
// The types come from the prototypes of glcorearb.h, which are named but never linked.
#pragma once

#ifndef GL_GLEXT_PROTOTYPES
#define GL_GLEXT_PROTOTYPES
#endif
#include <GL/glcorearb.h>

#include <stdexcept>

// clang-format off
#define SHADOWMATH_GL_PROCS(X)                                                                                      \
    X(GetString) X(Enable) X(Disable) X(Finish) X(Viewport) X(DepthFunc) X(ClipControl)                             \
    X(DebugMessageCallback) X(DebugMessageControl)                                                                  \
    X(CreateShader) X(ShaderSource) X(CompileShader) X(GetShaderiv) X(GetShaderInfoLog) X(DeleteShader)             \
    X(CreateProgram) X(AttachShader) X(LinkProgram) X(GetProgramiv) X(GetProgramInfoLog) X(UseProgram)              \
    X(DeleteProgram)                                                                                                \
    X(CreateBuffers) X(NamedBufferData) X(BindBufferRange) X(DeleteBuffers)                                         \
    X(CreateVertexArrays) X(VertexArrayVertexBuffer) X(VertexArrayElementBuffer) X(EnableVertexArrayAttrib)         \
    X(VertexArrayAttribFormat) X(VertexArrayAttribBinding) X(BindVertexArray) X(DeleteVertexArrays)                 \
    X(CreateTextures) X(TextureStorage2D) X(TextureStorage3D) X(TextureParameteri) X(BindTextureUnit)               \
    X(GetTextureImage) X(GetTextureSubImage) X(DeleteTextures)                                                      \
    X(CreateFramebuffers) X(NamedFramebufferTexture) X(NamedFramebufferTextureLayer) X(NamedFramebufferDrawBuffers) \
    X(CheckNamedFramebufferStatus) X(ClearNamedFramebufferfv) X(BindFramebuffer) X(DeleteFramebuffers)              \
    X(MultiDrawElements)
// clang-format on

namespace shadowmath::backend::gl {

struct Procs {
#define SHADOWMATH_GL_MEMBER(name) decltype(&::gl##name) name = nullptr;
    SHADOWMATH_GL_PROCS(SHADOWMATH_GL_MEMBER)
#undef SHADOWMATH_GL_MEMBER

    // Loads every entry point or throws; get_proc maps a name such as "glEnable" to a function pointer.
    template <class GetProc>
    explicit Procs(GetProc const& get_proc) {
#define SHADOWMATH_GL_LOAD(name)                                   \
    name = reinterpret_cast<decltype(name)>(get_proc("gl" #name)); \
    if (name == nullptr) throw std::runtime_error("this OpenGL driver has no gl" #name);
        SHADOWMATH_GL_PROCS(SHADOWMATH_GL_LOAD)
#undef SHADOWMATH_GL_LOAD
    }
};

}  // namespace shadowmath::backend::gl
