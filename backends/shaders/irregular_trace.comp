// SPDX-License-Identifier: MIT
//
// Takes the light of every small triangle out of the masks, and puts the large ones down for a pass of their own. One
// invocation a triangle.
#version 450
#include "irregular_trace.glsl"

layout(local_size_x = 64) in;

const uint small_blocks = 64u;

void main() {
    uint triangle = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * 65535u * 64u;
    if (triangle >= triangle_count || node_count > node_capacity || levels_used == 0u) return;
    Caster caster = caster_of(triangle);
    if (!caster.casts) return;
    if (block_count(caster) > small_blocks)
        triangles[3u * triangle_count + atomicAdd(large_count, 1u)] = triangle;
    else
        walk(caster, 0u, 1u);
}
