// SPDX-License-Identifier: MIT
//
// What a renderer hands to its shaders, with the same layout in std140 and std430: gpu.hpp has the same structs in C++,
// fills them, and asserts every offset.
//
//   layout(std140, binding = 0) uniform Frame { sm_Cascades cascades; };
#ifndef SM_LAYOUT_GLSL
#define SM_LAYOUT_GLSL

const int sm_max_cascades = 16;

// DepthOrder of clip_space.hpp.
const int sm_zero_to_one = 0;
const int sm_one_to_zero = 1;
const int sm_minus_one_to_one = 2;

struct sm_ShadowMap {
    mat4 clip_from_world;  // the matrix that casters are drawn with
    float w_min;           // the map holds no receiver whose clip w is at or below this
    int depth_order;       // sm_zero_to_one, sm_one_to_zero or sm_minus_one_to_one
    int flip_v;            // 1: texture v counts against NDC y
    int visible;           // 0: it serves nothing
};

struct sm_MapBias {
    float constant;
    float per_inverse_w;
    float slope_texels;
    float slope_limit;  // the largest change of depth a texel that slope terms believe
};

struct sm_Cascade {
    sm_ShadowMap map;
    sm_MapBias bias;
};

// Metres of eye depth; range i stands in component i & 3 of vector i >> 2.
struct sm_Ranges {
    vec4 blend_begin[sm_max_cascades / 4];
    vec4 end[sm_max_cascades / 4];
};

struct sm_Cascades {
    sm_Cascade at[sm_max_cascades];
    sm_Ranges ranges;
    int count;
    int map_size;       // texels along one side
    int filter_radius;  // texels
    int tap_plane;      // 1: each tap is compared with the receiver plane's depth there
};

#endif
