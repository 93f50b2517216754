// SPDX-License-Identifier: MIT
//
// Empties the bins.
#version 450
#include "sdsm_blocks.glsl"

layout(local_size_x = 256) in;

void main() {
    for (uint i = gl_LocalInvocationIndex; i < uint(sm_depth_bins); i += gl_WorkGroupSize.x) {
        state.bin_lo[i] = sm_no_depth_lo;
        state.bin_hi[i] = sm_no_depth_hi;
    }
    if (gl_LocalInvocationIndex == 0u) {
        state.counted = 0u;
        state.outside = 0u;
        state.not_finite = 0u;
    }
}
