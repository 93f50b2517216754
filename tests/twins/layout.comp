// SPDX-License-Identifier: MIT
//
// Says what it sees in each member of a block, as a uniform and as storage.
#version 450
#include "shadowmath/glsl/layout.glsl"

layout(local_size_x = 2) in;

layout(std140, binding = 0) uniform Uniforms {
    sm_Cascades cascades;
};
layout(std430, binding = 1) readonly buffer Stored {
    sm_Cascades stored;
};
layout(std430, binding = 2) writeonly buffer Seen {
    uint seen[];
};

uint writing = 0u;

void give(float v) {
    seen[writing++] = floatBitsToUint(v);
}
void give(int v) {
    seen[writing++] = uint(v);
}
void give(vec4 v) {
    for (int i = 0; i < 4; ++i) give(v[i]);
}

void give(sm_Cascade cascade) {
    for (int i = 0; i < 4; ++i) give(cascade.map.clip_from_world[i]);
    give(cascade.map.w_min);
    give(cascade.map.depth_order);
    give(cascade.map.flip_v);
    give(cascade.map.visible);
    give(cascade.bias.constant);
    give(cascade.bias.per_inverse_w);
    give(cascade.bias.slope_texels);
    give(cascade.bias.slope_limit);
}

// Not by value: drivers are slow with copies of so large a struct.
#define GIVE_ALL(all)                                                      \
    for (int i = 0; i < sm_max_cascades; ++i) give(all.at[i]);             \
    for (int i = 0; i < 4; ++i) give(all.ranges.blend_begin[i]);           \
    for (int i = 0; i < 4; ++i) give(all.ranges.end[i]);                   \
    give(all.count);                                                       \
    give(all.map_size);                                                    \
    give(all.filter_radius);                                               \
    give(all.tap_plane);

void main() {
    if (gl_LocalInvocationID.x == 0u) {
        GIVE_ALL(cascades)
    } else {
        writing = uint(seen.length()) / 2u;
        GIVE_ALL(stored)
    }
}
