// SPDX-License-Identifier: MIT
//
// One thread a split: its map, as the passes that draw and read maps want it.
#version 450
#include "sdsm_blocks.glsl"
#include "shadowmath/glsl/sdsm.glsl"

layout(local_size_x = 16) in;

// backends/backend.hpp's MapConstants.
struct MapConstants {
    mat4 clip_from_world;
    float depth_end;
    float blend_begin;
    float w_min;
    float bias_constant;
    float bias_slope_texels;
    float slope_limit;
    float bias_w;
};

layout(std430, binding = 2) buffer Maps {
    MapConstants maps[];
};

void main() {
    int i = int(gl_LocalInvocationIndex);
    if (i >= maps.length()) return;
    bool asked = i < state.count;
    vec3 lo = vec3(1.0);
    vec3 hi = vec3(0.0);
    if (asked) {
        for (int axis = 0; axis < 3; ++axis) {
            lo[axis] = sm_from_ordered_bits(state.box_lo[i][axis]);
            hi[axis] = sm_from_ordered_bits(state.box_hi[i][axis]);
        }
    }
    sm_SampleMap map = sm_fit_samples(fit, lo, hi);
    sm_SampleBias bias = sm_bias_of(fit, map);
    // A split that was not needed ends where it begins: at the far end, where no receiver asks for it.
    vec4 range = asked ? state.range[i] : vec4(fit.basis_y.w);
    maps[i].clip_from_world = map.clip_from_world;
    maps[i].depth_end = range.z;
    maps[i].blend_begin = range.y;
    maps[i].w_min = 0.0;
    maps[i].bias_constant = bias.constant;
    maps[i].bias_slope_texels = bias.slope_texels;
    maps[i].slope_limit = bias.slope_limit;
    maps[i].bias_w = 0.0;
}
