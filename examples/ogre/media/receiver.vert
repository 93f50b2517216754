#version 330 core
// SPDX-License-Identifier: MIT
in vec4 vertex;
in vec3 normal;
in vec4 colour;
uniform mat4 clip_from_object;
uniform mat4 world_from_object;
out vec3 point;  // world
out vec3 shading_normal;
out vec3 reflectance;

void main() {
    point = (world_from_object * vertex).xyz;
    shading_normal = mat3(world_from_object) * normal;
    reflectance = colour.rgb;
    gl_Position = clip_from_object * vertex;
}
