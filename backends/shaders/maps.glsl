// SPDX-License-Identifier: MIT
//
// The matrices of all maps of a depth pass, for the ways that draw several maps at once.

layout(std140, binding = 0) uniform Maps {
    mat4 clip_from_world[8];
};
