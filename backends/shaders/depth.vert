// SPDX-License-Identifier: MIT
//
// Draws casters into one shadow map. No fragment shader: depth is all that is kept.
#version 450

layout(location = 0) in vec3 position;  // world

layout(std140, binding = 0) uniform Map {
    mat4 clip_from_world;
};

void main() {
    // NOTE: project_to_map in shadow.glsl forms the same product, so that both sides round alike.
    gl_Position = clip_from_world * vec4(position, 1.0);
}
