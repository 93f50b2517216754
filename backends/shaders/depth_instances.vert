// SPDX-License-Identifier: MIT
//
// Draws a caster's instance into the map of its number (Zhang, Sun, Nyman 2007, 10.3.3); the chapter needs a geometry
// shader to name the layer, later hardware does not. The number comes as an instance attribute, so that it counts from
// the draw's first instance in OpenGL and Vulkan alike.
#version 450
#extension GL_ARB_shader_viewport_layer_array : require
#include "maps.glsl"
#include "shadowmath/glsl/tangent.glsl"

layout(location = 0) in vec3 position;  // world
layout(location = 3) in uint number;    // the map

void main() {
    gl_Layer = int(number);
    gl_Position = sm_transformed(clip_from_world[number], position);
}
