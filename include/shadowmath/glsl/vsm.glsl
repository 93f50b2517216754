// SPDX-License-Identifier: MIT
//
// Variance shadow maps, plain and exponential: the GLSL twin of vsm.hpp. Equal to the C++ bit for bit where the driver
// divides as IEEE 754 does (Mesa's software drivers), but for sm_evsm_warp, 128 ulp, and what is made of it: GLSL's exp
// is good to 3 + 2 |x| ulp.
#ifndef SM_VSM_GLSL
#define SM_VSM_GLSL

#include "moments.glsl"

const float sm_largest_exponent_float = 42.0;
const float sm_largest_exponent_half = 5.54;

// Cantelli's bound; `least_deviation` >= 0, of the same quantity.
float sm_most_light(float mean, float mean_square, float value, float least_deviation) {
    if (!(value > mean)) return 1.0;
    precise float measured = mean_square - mean * mean;
    precise float least = least_deviation * least_deviation;
    float variance = measured > least ? measured : least;
    precise float off = value - mean;
    precise float sum = variance + off * off;
    precise float share = variance / sum;
    return sum > 0.0 ? sm_share_or_light(share) : 1.0;
}

float sm_kept_deviation(float deviation) {
    if (!sm_all_finite(deviation) || !(deviation > 0.0)) return 0.0;
    return deviation < 0.01 ? deviation : 0.01;
}

float sm_kept_exponent(float exponent) {
    if (!sm_all_finite(exponent) || !(exponent > 0.0)) return 0.0;
    return exponent < sm_largest_exponent_float ? exponent : sm_largest_exponent_float;
}

vec2 sm_vsm_moments(float depth) {
    if (!sm_all_finite(depth)) return vec2(1.0);
    float kept = sm_unit_depth(depth);
    precise float square = kept * kept;
    return vec2(kept, square);
}

// Never less than the share of the kernel at or beyond `depth`, and never growing with it.
float sm_vsm_visibility(vec2 moments, float depth, float least_deviation) {
    if (!sm_all_finite(moments) || !sm_all_finite(depth)) return 1.0;
    return sm_most_light(moments.x, moments.y, sm_unit_depth(depth), sm_kept_deviation(least_deviation));
}

// exp(c z) and -exp(-c z), both growing with depth; `exponents` are those of the growing and of the falling warp.
vec2 sm_evsm_warp(float depth, vec2 exponents) {
    float z = sm_all_finite(depth) ? 2.0 * sm_unit_depth(depth) - 1.0 : 1.0;
    return vec2(exp(sm_kept_exponent(exponents.x) * z), -exp(-sm_kept_exponent(exponents.y) * z));
}

vec4 sm_evsm_moments(float depth, vec2 exponents) {
    vec2 warp = sm_evsm_warp(depth, exponents);
    return vec4(warp.x, warp.x * warp.x, warp.y, warp.y * warp.y);
}

// Never more than either warp alone allows; `warp` is that of the receiver's depth.
float sm_evsm_bound(vec4 moments, vec2 warp, vec2 exponents, float least_deviation) {
    if (!sm_all_finite(moments) || !sm_all_finite(warp)) return 1.0;
    float deviation = 2.0 * sm_kept_deviation(least_deviation);
    precise float of_growing = deviation * sm_kept_exponent(exponents.x) * warp.x;
    precise float of_falling = -deviation * sm_kept_exponent(exponents.y) * warp.y;
    float growing = sm_most_light(moments.x, moments.y, warp.x, of_growing);
    float falling = sm_most_light(moments.z, moments.w, warp.y, of_falling);
    return growing < falling ? growing : falling;
}

float sm_evsm_visibility(vec4 moments, float depth, vec2 exponents, float least_deviation) {
    if (!sm_all_finite(depth)) return 1.0;
    return sm_evsm_bound(moments, sm_evsm_warp(depth, exponents), exponents, least_deviation);
}

#endif
