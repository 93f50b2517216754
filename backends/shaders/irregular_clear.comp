// SPDX-License-Identifier: MIT
//
// Empties the grid. One invocation a word.
#version 450
#include "irregular_buffers.glsl"

layout(local_size_x = 64) in;

void main() {
    uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * 65535u * 64u;
    if (i < uint(words.length())) words[i] = 0u;
    if (i != 0u) return;
    node_count = 0u;
    levels_used = 0u;
    large_count = 0u;
    least_w = floatBitsToUint(huge);
    most_w = 0u;
}
