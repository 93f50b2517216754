// SPDX-License-Identifier: MIT
//
// What the passes of the irregular z-buffer share: one numbering of buffers, and the levels of the grid.

#include "shadowmath/glsl/irregular.glsl"

layout(std140, binding = 0) uniform Irregular {
    sm_PixelFrame frame;
    sm_PixelLight light;
    vec4 row[4];   // texel x, texel y, depth and w of a point relative to the eye
    vec4 seen[4];  // the same as pixel planes: of a pixel's quad
    float texel_error;
    float texel_error_here;
    float depth_error;
    float depth_error_here;
    float ray;
    float reach;
    float contact_metres;
    float contact_share;
    float w_min;
    int map_size;
    uint triangle_count;
    uint vertex_count;
    uint node_capacity;
};

layout(std430, binding = 1) readonly buffer Receivers {
    float receiver[];  // six a pixel: world position, normal of the surface (0: sky)
};
layout(std430, binding = 2) buffer Quads {
    vec4 quads[];
};
layout(std430, binding = 3) buffer Masks {
    uint masks[];  // bit i: sample i is dark
};
layout(std430, binding = 4) buffer Grid {
    uint node_count;  // that were wanted, whatever the capacity
    uint levels_used;
    uint large_count;  // triangles for the pass of large ones
    uint least_w;      // of receivers, as bits
    uint most_w;
    uint words[];  // one more than the first node of each texel, level by level; then how far each block reaches
};
layout(std430, binding = 5) buffer Nodes {
    uvec2 nodes[];  // pixel, one more than the next node
};
layout(std430, binding = 6) readonly buffer Vertices {
    float vertices[];
};
layout(std430, binding = 7) buffer Triangles {
    uint triangles[];  // three indices each, then room for all that are large
};

sm_MicroQuad quad_of(uint pixel) {
    vec4 quad = quads[pixel];
    return sm_MicroQuad(quad.x, quad.y, quad.z, quad.w, true);
}

const int most_levels = 8;
const float huge = 3.0e38;

// A level's texels are four times as long as those of the one before it. A block is 4 x 4 texels.
int level_size(int level) {
    return (map_size + (1 << (2 * level)) - 1) >> (2 * level);
}
int block_size(int level) {
    return (level_size(level) + 3) >> 2;
}
int level_count() {
    int count = 1;
    while (level_size(count - 1) > 1 && count < most_levels) ++count;
    return count;
}

// Where a level's texels begin in words, and behind all of them its blocks.
int texels_before(int level) {
    int sum = 0;
    for (int i = 0; i < level; ++i) sum += level_size(i) * level_size(i);
    return sum;
}
int blocks_before(int level) {
    int sum = texels_before(level_count());
    for (int i = 0; i < level; ++i) sum += block_size(i) * block_size(i);
    return sum;
}

// Floats as words of the same order. 0 is below all of them.
uint ordered(float value) {
    uint bits = floatBitsToUint(value);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

// Texels of a level that an interval of texels of the finest one meets. What lies outside of the map belongs to its
// border: the frame decides nothing.
ivec4 texels_at(vec4 bounds, int level) {
    vec4 kept = clamp(bounds, vec4(0.0), vec4(float(map_size) - 0.5));
    return min(ivec4(kept) >> (2 * level), ivec4(level_size(level) - 1));
}
