// SPDX-License-Identifier: MIT
//
// The triangles that irregular_trace.comp has put aside: each by a whole group, block by block. Any number of groups.
#version 450
#include "irregular_trace.glsl"

layout(local_size_x = 64) in;

void main() {
    if (node_count > node_capacity) return;
    for (uint i = gl_WorkGroupID.x; i < large_count; i += gl_NumWorkGroups.x) {
        Caster caster = caster_of(triangles[3u * triangle_count + i]);
        if (caster.casts) walk(caster, gl_LocalInvocationID.x, gl_WorkGroupSize.x);
    }
}
