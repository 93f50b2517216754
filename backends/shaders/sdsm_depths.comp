// SPDX-License-Identifier: MIT
//
// Puts the eye depth of every pixel into its bin: within the group first, then once a bin for all groups.
#version 450
#include "sdsm_blocks.glsl"
#include "shadowmath/glsl/sample_depths.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

layout(binding = 3) uniform sampler2DArray eye_depths;

shared uint group_lo[sm_depth_bins];
shared uint group_hi[sm_depth_bins];
shared uint group_kinds[3];

void main() {
    uint threads = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
    for (uint i = gl_LocalInvocationIndex; i < uint(sm_depth_bins); i += threads) {
        group_lo[i] = sm_no_depth_lo;
        group_hi[i] = sm_no_depth_hi;
    }
    if (gl_LocalInvocationIndex < 3u) group_kinds[gl_LocalInvocationIndex] = 0u;
    barrier();

    ivec2 extent = fit.extent_count_adaptive.xy;
    ivec2 first = ivec2(gl_WorkGroupID.xy) * tile_size + ivec2(gl_LocalInvocationID.xy);
    for (int y = first.y; y < min(first.y + tile_size, extent.y); y += int(gl_WorkGroupSize.y)) {
        for (int x = first.x; x < min(first.x + tile_size, extent.x); x += int(gl_WorkGroupSize.x)) {
            float stored = texelFetch(eye_depths, ivec3(x, y, 0), 0).r;
            float depth = sm_decoded_depth(fit.depth_code, fit.up.w, stored);
            int kind = sm_kind_of_depth(depth, fit.basis_x.w, fit.basis_y.w);
            atomicAdd(group_kinds[kind], 1u);
            if (kind != sm_depth_counts) continue;
            int bin = sm_depth_bin(fit.basis_y.w, depth);
            // Most samples change nothing: a look is cheaper than an atomic.
            uint bits = floatBitsToUint(depth);
            if (bits < group_lo[bin]) atomicMin(group_lo[bin], bits);
            if (bits > group_hi[bin]) atomicMax(group_hi[bin], bits);
        }
    }
    barrier();

    for (uint i = gl_LocalInvocationIndex; i < uint(sm_depth_bins); i += threads) {
        if (group_lo[i] > group_hi[i]) continue;
        atomicMin(state.bin_lo[i], group_lo[i]);
        atomicMax(state.bin_hi[i], group_hi[i]);
    }
    if (gl_LocalInvocationIndex == 0u) {
        atomicAdd(state.counted, group_kinds[sm_depth_counts]);
        atomicAdd(state.outside, group_kinds[sm_depth_outside]);
        atomicAdd(state.not_finite, group_kinds[sm_depth_not_finite]);
    }
}
