#version 330 core
// SPDX-License-Identifier: MIT
in vec4 vertex;
uniform mat4 clip_from_object;

void main() {
    gl_Position = clip_from_object * vertex;
}
