// SPDX-License-Identifier: MIT
//
// The splits of sample_depths.hpp from the bins, and no samples in any of them yet. One group: its threads try 64
// ratios at a time. The least complete ratio is one number however it is searched for, so it is the C++ one's.
#version 450
#include "sdsm_blocks.glsl"
#include "shadowmath/glsl/sample_bounds.glsl"

const uint threads = 64u;
layout(local_size_x = 64) in;

// The bins that hold samples, one behind the other.
shared uint bin_lo[sm_depth_bins];
shared uint bin_hi[sm_depth_bins];
shared int bins;
shared uint least_complete;
shared float start[sm_max_splits];

bool even_cover(float first, float last, float ratio, int most, bool keep, out int count) {
    precise float at = first;
    for (count = 0; count < most && (count == 0 || at < last); ++count) {
        if (keep) start[count] = at;
        at *= ratio;
    }
    return at >= last;
}

bool adaptive_cover(float first, float ratio, int most, bool keep, out int count) {
    precise float end = 0.0;
    count = 0;
    for (int i = 0; i < bins; ++i) {
        if (count > 0 && uintBitsToFloat(bin_hi[i]) <= end) continue;
        if (count == most) return false;
        float at = max(uintBitsToFloat(bin_lo[i]), first);
        if (keep) start[count] = at;
        ++count;
        end = at * ratio;
    }
    return true;
}

bool cover(float ratio, bool keep, out int count) {
    float last = uintBitsToFloat(bin_hi[bins - 1]);
    precise float least_first = last * 9.5367431640625e-7;
    float first = max(uintBitsToFloat(bin_lo[0]), least_first);
    int most = fit.extent_count_adaptive.z;
    return fit.extent_count_adaptive.w == 0 ? even_cover(first, last, ratio, most, keep, count)
                                            : adaptive_cover(first, ratio, most, keep, count);
}

// Outer planes where the view has them; inner ones in between and increasing.
void keep_splits(int count) {
    float z_near = fit.basis_x.w;
    float z_far = fit.basis_y.w;
    float plane[sm_max_splits + 1];
    plane[0] = z_near;
    int kept = 0;
    for (int i = 1; i < count; ++i)
        if (start[i] > plane[kept] && start[i] < z_far) plane[++kept] = start[i];
    plane[++kept] = z_far;
    state.count = kept;
    float share = fit.inverse_along.w;
    for (int i = 0; i < kept; ++i) {
        float begin = i > 0 ? sm_fade_begin(plane[i - 1], plane[i], share) : z_near;
        float fade = i + 1 < kept ? sm_fade_begin(plane[i], plane[i + 1], share) : z_far;
        state.range[i] = vec4(begin, fade, plane[i + 1], 0.0);
    }
}

void main() {
    uint thread = gl_LocalInvocationIndex;
    for (uint i = thread; i < uint(sm_depth_bins); i += threads) {
        bin_lo[i] = state.bin_lo[i];
        bin_hi[i] = state.bin_hi[i];
    }
    for (uint i = thread; i < uint(sm_max_splits); i += threads) {
        state.range[i] = vec4(0.0);
        state.box_lo[i] = uvec4(sm_ordered_bits(3.402823466e38));
        state.box_hi[i] = uvec4(sm_ordered_bits(-3.402823466e38));
    }
    barrier();
    if (thread == 0u) {
        bins = 0;
        for (int i = 0; i < sm_depth_bins; ++i) {
            if (bin_lo[i] > bin_hi[i]) continue;
            bin_lo[bins] = bin_lo[i];
            bin_hi[bins] = bin_hi[i];
            ++bins;
        }
    }
    barrier();
    if (bins == 0) {
        if (thread == 0u) state.count = 0;
        return;
    }

    // In the bits of the ratio, which order as the ratio does: everything up to `below` is too little, `enough` is not.
    int count = 0;
    uint below = floatBitsToUint(fit.basis_depth.w) - 1u;
    uint enough = floatBitsToUint(1048576.0);
    while (enough - below > 1u) {
        if (thread == 0u) least_complete = enough;
        barrier();
        uint step = (enough - below - 2u) / threads + 1u;
        uint tried = below + step * (thread + 1u);
        if (tried < enough && cover(uintBitsToFloat(tried), false, count)) atomicMin(least_complete, tried);
        barrier();
        uint found = least_complete;
        // Of those that were tried, the one before it was too little.
        uint tries = (found - below - 1u) / step;
        below += tries * step;
        enough = found;
        barrier();
    }
    if (thread != 0u) return;
    state.count = 0;
    if (fit.extent_count_adaptive.z == 0) return;
    cover(uintBitsToFloat(enough), true, count);
    keep_splits(count);
}
