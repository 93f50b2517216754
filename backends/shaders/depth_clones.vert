// SPDX-License-Identifier: MIT
//
// Leaves the vertex in the world, for depth_clones.geom takes it to each map. The set of maps is the draw's first
// instance, read by an attribute: OpenGL and Vulkan disagree on whether the built-in instance number counts from there.
#version 450

layout(location = 0) in vec3 position;  // world
layout(location = 3) in uint number;    // a bit for each map that the object is drawn into

layout(location = 0) out vec3 point;
layout(location = 1) flat out uint maps;

void main() {
    point = position;
    maps = number;
}
