// SPDX-License-Identifier: MIT
//
// What the OpenGL backend draws into: the array of maps, the picture, and the depth that the eye sees.
#pragma once

#include "backends/backend.hpp"
#include "backends/gl/objects.hpp"

#include <array>
#include <stdexcept>
#include <string>

namespace shadowmath::backend::gl {

struct Maps {
    Texture texture;  // an array, one layer a map
    Framebuffer framebuffer;
    int size = 0;
    int layers = 0;
};

struct FrameTargets {
    Texture colour, position, normal, depth;
    Framebuffer framebuffer;
    Extent extent;
};

// For compute shaders.
struct EyeDepth {
    Texture texture;  // an array of one layer
    Framebuffer framebuffer;
    Extent extent;
};

inline void demand_complete(Procs const& gl, GLuint framebuffer, std::string const& what) {
    if (gl.CheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("the driver cannot hold " + what);
}

[[nodiscard]] inline Texture make_depth_layers(Procs const& gl, Extent extent, int layers) {
    Texture texture = make_texture(gl, GL_TEXTURE_2D_ARRAY);
    gl.TextureStorage3D(texture, 1, GL_DEPTH_COMPONENT32F, extent.width, extent.height, layers);
    gl.TextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

// The first layer is attached. All three throw std::runtime_error where the driver has no room.
[[nodiscard]] inline Maps make_maps(Procs const& gl, int size, int layers) {
    Maps maps{make_depth_layers(gl, {size, size}, layers), make_framebuffer(gl), size, layers};
    gl.NamedFramebufferTextureLayer(maps.framebuffer, GL_DEPTH_ATTACHMENT, maps.texture, 0, 0);
    demand_complete(gl, maps.framebuffer, std::to_string(layers) + " shadow maps of " + std::to_string(size));
    return maps;
}

[[nodiscard]] inline EyeDepth make_eye_depth(Procs const& gl, Extent extent) {
    EyeDepth eye{make_depth_layers(gl, extent, 1), make_framebuffer(gl), extent};
    gl.NamedFramebufferTextureLayer(eye.framebuffer, GL_DEPTH_ATTACHMENT, eye.texture, 0, 0);
    demand_complete(gl, eye.framebuffer, "the depth that the eye sees");
    return eye;
}

[[nodiscard]] inline FrameTargets make_frame(Procs const& gl, Extent extent) {
    FrameTargets frame;
    frame.framebuffer = make_framebuffer(gl);
    auto const attach = [&](Texture& texture, GLenum format, GLenum attachment) {
        texture = make_texture(gl, GL_TEXTURE_2D);
        gl.TextureStorage2D(texture, 1, format, extent.width, extent.height);
        gl.NamedFramebufferTexture(frame.framebuffer, attachment, texture, 0);
    };
    attach(frame.colour, GL_SRGB8_ALPHA8, GL_COLOR_ATTACHMENT0);
    attach(frame.position, GL_RGBA32F, GL_COLOR_ATTACHMENT1);
    attach(frame.normal, GL_RGBA32F, GL_COLOR_ATTACHMENT2);
    attach(frame.depth, GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT);
    constexpr std::array<GLenum, 3> outputs{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
    gl.NamedFramebufferDrawBuffers(frame.framebuffer, 3, outputs.data());
    demand_complete(gl, frame.framebuffer,
                    "a frame of " + std::to_string(extent.width) + " x " + std::to_string(extent.height));
    frame.extent = extent;
    return frame;
}

}  // namespace shadowmath::backend::gl
