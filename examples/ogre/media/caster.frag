#version 330 core
// SPDX-License-Identifier: MIT
out vec4 unused;

void main() {
    unused = vec4(1.0);
}
