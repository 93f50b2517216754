// SPDX-License-Identifier: MIT
//
// Draws the scene as the eye sees it. Positions travel relative to the eye: that keeps their differences, from which
// the fragment shader takes the plane, exact far from the world's origin.
#version 450
#include "receive.glsl"
#include "shadowmath/glsl/tangent.glsl"

layout(location = 0) in vec3 position;  // world
layout(location = 1) in vec3 normal;    // world, shading
layout(location = 2) in vec4 albedo;

layout(location = 0) out vec3 position_from_eye;
layout(location = 1) out vec3 shading_normal;
layout(location = 2) out vec3 reflectance;

void main() {
    position_from_eye = position - frame.eye_position.xyz;
    shading_normal = normal;
    reflectance = albedo.rgb;
    gl_Position = sm_transformed(frame.clip_from_world, position);
}
