// SPDX-License-Identifier: MIT
//
// Moment shadow maps, the sharpest bound that four moments of depth allow: the GLSL twin of msm.hpp. Equal to the C++
// bit for bit where the driver divides and takes roots as IEEE 754 does (Mesa's software drivers).
#ifndef SM_MSM_GLSL
#define SM_MSM_GLSL

#include "moments.glsl"
#include "quotient.glsl"

const float sm_msm_bias_float = 3e-6;
const float sm_msm_bias_16_bits = 6e-5;

// z, z^2, z^3, z^4 of z = 2 depth - 1.
vec4 sm_msm_moments(float depth) {
    precise float z = sm_all_finite(depth) ? 2.0 * sm_unit_depth(depth) - 1.0 : 1.0;
    precise float square = z * z;
    precise vec4 moments = vec4(z, square, square * z, square * square);
    return moments;
}

// Four numbers in [0, 1] to be stored with 16 bits each and filtered as they are.
vec4 sm_msm_packed(vec4 moments) {
    const float root3 = 1.73205080756887729;
    precise vec4 packed_moments =
        vec4(1.5 * moments.x - 2.0 * moments.z + 0.5, 4.0 * (moments.y - moments.w),
             root3 * (moments.x / 2.0 - moments.z * (2.0 / 9.0)) + 0.5, (moments.y + moments.w) / 2.0);
    return packed_moments;
}

vec4 sm_msm_unpacked(vec4 stored) {
    const float root3 = 1.73205080756887729;
    precise float first = stored.x - 0.5;
    precise float second = root3 * (stored.z - 0.5);
    precise vec4 moments = vec4(second - first / 3.0, stored.w + stored.y / 8.0, 0.75 * (second - first),
                                stored.w - stored.y / 8.0);
    return moments;
}

// Coefficients c of 1, z, z^2 with Hankel(b) c = (1, x, x^2), through L D L^T.
vec3 sm_solve_hankel(vec4 b, float x) {
    precise float variance = b.y - b.x * b.x;
    precise float skew = b.z - b.x * b.y;
    precise float spread = (b.w - b.y * b.y) * variance - skew * skew;
    precise float c1 = x - b.x;
    precise float c2 = x * x - b.y - sm_quotient_or_zero(skew, variance) * c1;
    precise float scaled = c2 * variance;
    precise float z = sm_quotient_or_zero(scaled, spread);
    precise float rest = c1 - skew * z;
    precise float y = sm_quotient_or_zero(rest, variance);
    precise float constant = 1.0 - b.x * y - b.y * z;
    return vec3(constant, y, z);
}

// The mass before x in the distribution with these moments, an atom at x and atoms at low <= high.
float sm_mass_before(vec4 b, float x, float low, float high) {
    if (!(x > low)) return 0.0;
    precise float dividend = x * high - b.x * (x + high) + b.y;
    precise float divisor = (high - low) * (x - low);
    if (!(x > high)) return sm_quotient_or_zero(dividend, divisor);
    dividend = low * high - b.x * (low + high) + b.y;
    divisor = (x - low) * (x - high);
    precise float beyond = 1.0 - sm_quotient_or_zero(dividend, divisor);
    return beyond;
}

// Never less than (1 - bias) times the share of the kernel at or beyond `depth`, up to rounding; never growing with it.
float sm_msm_visibility(vec4 moments, float depth, float bias) {
    if (!sm_all_finite(moments) || !sm_all_finite(depth)) return 1.0;
    const float least = 1.9073486328125e-6;  // 16 epsilon
    float share = sm_all_finite(bias) && bias > least ? (bias < 0.1 ? bias : 0.1) : least;
    precise vec4 b = moments * (1.0 - share) + vec4(0.0, 0.375, 0.0, 0.375) * share;
    precise float x = 2.0 * sm_unit_depth(depth) - 1.0;
    vec3 c = sm_solve_hankel(b, x);
    precise float discriminant = c.y * c.y - 4.0 * c.z * c.x;
    precise float root = sqrt(discriminant > 0.0 ? discriminant : 0.0);
    precise float sum = (c.y < 0.0 ? root - c.y : -root - c.y) / 2.0;
    float one = sm_bounded_quotient(sum, c.z, 1e4);
    float other = sm_bounded_quotient(c.x, sum, 1e4);
    precise float lit = 1.0 - sm_mass_before(b, x, one < other ? one : other, one < other ? other : one);
    return sm_share_or_light(lit);
}

#endif
