// SPDX-License-Identifier: MIT
//
// Draws casters into one shadow map. No fragment shader: depth is all that is kept.
#version 450
#include "shadowmath/glsl/tangent.glsl"

layout(location = 0) in vec3 position;  // world

layout(std140, binding = 0) uniform Map {
    mat4 clip_from_world;
};

void main() {
    gl_Position = sm_transformed(clip_from_world, position);
}
