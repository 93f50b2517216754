// SPDX-License-Identifier: MIT
//
// What the shaders of a sample-distribution fit are given and keep, with the same layout in std140 and std430:
// gpu_samples.hpp has the same structs in C++, fills the first, and asserts every offset that could go wrong.
#ifndef SM_SAMPLE_LAYOUT_GLSL
#define SM_SAMPLE_LAYOUT_GLSL

#include "slice.glsl"

const int sm_depth_bins = 512;

struct sm_SampleFit {
    vec4 basis_x;        // w: z_near, metres of eye depth
    vec4 basis_y;        // w: z_far
    vec4 basis_depth;    // w: least ratio of a split
    vec4 inverse_along;  // 1 / basis_depth, 0 where no face is met; w: fraction of splits that blends
    vec4 eye;            // in light space; w: texels along a side of the map
    vec4 forward;        // of the eye, in light space; w: margin as a share of the body's extent
    vec4 right;          // w: 1 / (usable texels - 1), for still maps
    vec4 up;             // w: what the depth buffer is cleared to
    vec4 first_step;     // sides at the centre of pixel (0, 0), and from pixel to pixel
    vec4 casters_lo;     // world
    vec4 casters_hi;
    vec4 depth_code;     // numerator's scale and offset, denominator's scale and offset
    vec4 bias;           // texels flat, texels of the slope, steepest slope, step of the stored depth
    mat4 clip_from_canonical;
    ivec4 extent_count_adaptive;  // pixels, pixels, splits, 1: adaptive
    ivec4 flags;                  // orthographic, still, pancake, unused
};

struct sm_SampleState {
    uint bin_lo[sm_depth_bins];  // bits of depths; above bin_hi: an empty bin
    uint bin_hi[sm_depth_bins];
    uint counted;
    uint outside;
    uint not_finite;
    int count;                   // splits
    vec4 range[sm_max_splits];   // metres of eye depth: begin, blend_begin, end
    uvec4 box_lo[sm_max_splits]; // ordered bits of light space relative to the eye; above box_hi: nothing seen
    uvec4 box_hi[sm_max_splits];
};

const uint sm_no_depth_lo = 0x7f7fffffu;
const uint sm_no_depth_hi = 0u;

// Unsigned integers in the order of the numbers: what atomic minima and maxima of coordinates are taken of.
uint sm_ordered_bits(float value) {
    uint bits = floatBitsToUint(value);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
float sm_from_ordered_bits(uint ordered) {
    return uintBitsToFloat((ordered & 0x80000000u) != 0u ? ordered & 0x7fffffffu : ~ordered);
}

#endif
