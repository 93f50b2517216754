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
#include <string_view>

// clang-format off
#define SHADOWMATH_GL_PROCS(X)                                                                                      \
    X(GetString) X(GetStringi) X(GetIntegerv) X(Enable) X(Disable) X(Finish)                                        \
    X(Viewport) X(DepthFunc) X(ClipControl) X(ProvokingVertex)                                                      \
    X(DebugMessageCallback) X(DebugMessageControl)                                                                  \
    X(CreateShader) X(ShaderSource) X(ShaderBinary) X(CompileShader) X(GetShaderiv) X(GetShaderInfoLog)             \
    X(DeleteShader)                                                                                                 \
    X(CreateProgram) X(AttachShader) X(LinkProgram) X(GetProgramiv) X(GetProgramInfoLog) X(UseProgram)              \
    X(DeleteProgram)                                                                                                \
    X(CreateBuffers) X(NamedBufferData) X(NamedBufferSubData) X(GetNamedBufferSubData) X(CopyNamedBufferSubData)    \
    X(BindBuffer) X(BindBufferBase) X(BindBufferRange) X(DeleteBuffers)                                             \
    X(CreateVertexArrays) X(VertexArrayVertexBuffer) X(VertexArrayElementBuffer) X(EnableVertexArrayAttrib)         \
    X(VertexArrayAttribFormat) X(VertexArrayAttribIFormat) X(VertexArrayAttribBinding) X(VertexArrayBindingDivisor) \
    X(BindVertexArray) X(DeleteVertexArrays)                                                                        \
    X(CreateTextures) X(TextureStorage2D) X(TextureStorage3D) X(TextureParameteri) X(BindTextureUnit)               \
    X(TextureSubImage3D) X(GetTextureImage) X(GetTextureSubImage) X(DeleteTextures)                                 \
    X(CreateFramebuffers) X(NamedFramebufferTexture) X(NamedFramebufferTextureLayer) X(NamedFramebufferDrawBuffers) \
    X(CheckNamedFramebufferStatus) X(ClearNamedFramebufferfv) X(BindFramebuffer) X(DeleteFramebuffers)              \
    X(GenQueries) X(BeginQuery) X(EndQuery) X(GetQueryObjectui64v) X(DeleteQueries)                                 \
    X(MultiDrawElementsIndirect) X(DispatchCompute) X(MemoryBarrier)
// clang-format on

namespace shadowmath::backend::gl {

struct Procs {
#define SHADOWMATH_GL_MEMBER(name) decltype(&::gl##name) name = nullptr;
    SHADOWMATH_GL_PROCS(SHADOWMATH_GL_MEMBER)
#undef SHADOWMATH_GL_MEMBER
    decltype(&::glSpecializeShaderARB) SpecializeShader = nullptr;  // null without GL_ARB_gl_spirv

    // Loads every entry point of the core or throws; get_proc maps a name such as "glEnable" to a function pointer.
    template <class GetProc>
    explicit Procs(GetProc const& get_proc) {
#define SHADOWMATH_GL_LOAD(name)                                   \
    name = reinterpret_cast<decltype(name)>(get_proc("gl" #name)); \
    if (name == nullptr) throw std::runtime_error("this OpenGL driver has no gl" #name);
        SHADOWMATH_GL_PROCS(SHADOWMATH_GL_LOAD)
#undef SHADOWMATH_GL_LOAD
        if (has_extension("GL_ARB_gl_spirv"))
            SpecializeShader = reinterpret_cast<decltype(SpecializeShader)>(get_proc("glSpecializeShaderARB"));
    }

    [[nodiscard]] bool has_extension(std::string_view wanted) const {
        GLint count = 0;
        GetIntegerv(GL_NUM_EXTENSIONS, &count);
        for (GLuint i = 0; i < static_cast<GLuint>(count); ++i)
            if (wanted == reinterpret_cast<char const*>(GetStringi(GL_EXTENSIONS, i))) return true;
        return false;
    }
};

}  // namespace shadowmath::backend::gl
