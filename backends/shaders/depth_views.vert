// SPDX-License-Identifier: MIT
//
// Draws a caster into all maps of the subpass's view mask: Vulkan's multiview runs it once a map.
#version 450
#extension GL_EXT_multiview : require
#include "maps.glsl"
#include "shadowmath/glsl/tangent.glsl"

layout(location = 0) in vec3 position;  // world

void main() {
    gl_Position = sm_transformed(clip_from_world[gl_ViewIndex], position);
}
