// SPDX-License-Identifier: MIT
//
// The box of each split's samples in light space: within the group first, then once for all groups.
#version 450
#include "sdsm_blocks.glsl"
#include "shadowmath/glsl/sample_bounds.glsl"
#include "shadowmath/glsl/sample_depths.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

layout(binding = 3) uniform sampler2DArray eye_depths;

shared uint group_lo[sm_max_splits][3];
shared uint group_hi[sm_max_splits][3];

void main() {
    uint thread = gl_LocalInvocationIndex;
    if (thread < uint(sm_max_splits)) {
        for (int axis = 0; axis < 3; ++axis) {
            group_lo[thread][axis] = 0xffffffffu;
            group_hi[thread][axis] = 0u;
        }
    }
    barrier();

    ivec2 extent = fit.extent_count_adaptive.xy;
    ivec2 first = ivec2(gl_WorkGroupID.xy) * tile_size + ivec2(gl_LocalInvocationID.xy);
    for (int y = first.y; y < min(first.y + tile_size, extent.y); y += int(gl_WorkGroupSize.y)) {
        for (int x = first.x; x < min(first.x + tile_size, extent.x); x += int(gl_WorkGroupSize.x)) {
            float stored = texelFetch(eye_depths, ivec3(x, y, 0), 0).r;
            float depth = sm_decoded_depth(fit.depth_code, fit.up.w, stored);
            if (sm_kind_of_depth(depth, fit.basis_x.w, fit.basis_y.w) != sm_depth_counts) continue;
            vec3 point = sm_from_eye(fit, ivec2(x, y), depth);
            for (int i = 0; i < state.count; ++i) {
                if (!sm_is_served(state.range[i], depth)) continue;
                // Most samples change nothing: a look is cheaper than an atomic.
                for (int axis = 0; axis < 3; ++axis) {
                    uint bits = sm_ordered_bits(point[axis]);
                    if (bits < group_lo[i][axis]) atomicMin(group_lo[i][axis], bits);
                    if (bits > group_hi[i][axis]) atomicMax(group_hi[i][axis], bits);
                }
            }
        }
    }
    barrier();

    if (thread >= uint(state.count) || group_lo[thread][0] > group_hi[thread][0]) return;
    for (int axis = 0; axis < 3; ++axis) {
        atomicMin(state.box_lo[thread][axis], group_lo[thread][axis]);
        atomicMax(state.box_hi[thread][axis], group_hi[thread][axis]);
    }
}
