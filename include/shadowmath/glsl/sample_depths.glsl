// SPDX-License-Identifier: MIT
//
// From a depth buffer to the bins of sample_depths.hpp: the GLSL twin of stored_depth.hpp and of the bins. Bit for bit
// equal to the C++ on every processor. The splits are sdsm_splits.comp's work, for they need the bins in shared memory.
#ifndef SM_SAMPLE_DEPTHS_GLSL
#define SM_SAMPLE_DEPTHS_GLSL

#include "quotient.glsl"
#include "sample_layout.glsl"

// Metres; for the sky a number beyond every depth.
float sm_decoded_depth(vec4 code, float sky, float stored) {
    if (stored == sky) return 3.402823466e38;
    precise float numerator = code.x * stored + code.y;
    precise float denominator = code.z * stored + code.w;
    return sm_quotient(numerator, denominator);
}

const int sm_depth_counts = 0;
const int sm_depth_outside = 1;
const int sm_depth_not_finite = 2;

int sm_kind_of_depth(float depth, float z_near, float z_far) {
    if ((floatBitsToUint(depth) & 0x7f800000u) == 0x7f800000u) return sm_depth_not_finite;
    return depth >= z_near && depth < z_far ? sm_depth_counts : sm_depth_outside;
}

// The sign is shifted out: -0 is not below a near distance of 0.
int sm_depth_bin(float z_far, float depth) {
    int bin = int((floatBitsToUint(depth) & 0x7fffffffu) >> 18) - int(floatBitsToUint(z_far) >> 18) + sm_depth_bins - 1;
    return max(bin, 0);
}

#endif
