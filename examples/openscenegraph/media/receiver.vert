#version 130
// SPDX-License-Identifier: MIT
out vec4 point;  // eye space
out vec3 shading_normal;
out vec3 reflectance;

void main() {
    point = gl_ModelViewMatrix * gl_Vertex;
    shading_normal = gl_NormalMatrix * gl_Normal;
    reflectance = gl_Color.rgb;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
