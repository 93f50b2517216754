// SPDX-License-Identifier: MIT
#version 450
#include "twin.glsl"
#include "shadowmath/glsl/msm.glsl"
#include "shadowmath/glsl/vsm.glsl"

layout(binding = 3) uniform sampler2DArray stored_moments;

void answer(uint function) {
    vec4 moments;
    vec2 two, exponents;
    float depth;
    int layer, size, radius;
    switch (function) {
        case 0u:
            layer = take_int();
            two = take2();
            size = take_int();
            radius = take_int();
            give(sm_mean_moments(stored_moments, layer, two, size, radius, vec4(take())).x);
            break;
        case 1u:
            depth = take();
            give(sm_less_bleeding(depth, take()));
            break;
        case 2u: give(sm_vsm_moments(take())); break;
        case 3u:
            two = take2();
            depth = take();
            give(sm_vsm_visibility(two, depth, take()));
            break;
        case 4u:
            depth = take();
            give(sm_evsm_warp(depth, take2()));
            break;
        case 5u:
            depth = take();
            give(sm_evsm_moments(depth, take2()));
            break;
        case 6u:
            moments = take4();
            two = take2();
            exponents = take2();
            give(sm_evsm_bound(moments, two, exponents, take()));
            break;
        case 7u: give(sm_msm_moments(take())); break;
        case 8u: give(sm_msm_packed(take4())); break;
        case 9u: give(sm_msm_unpacked(take4())); break;
        case 10u:
            moments = take4();
            depth = take();
            give(sm_msm_visibility(moments, depth, take()));
            break;
        case 11u:
            moments = take4();
            depth = take();
            exponents = take2();
            give(sm_evsm_visibility(moments, depth, exponents, take()) < 0.5);
            break;
        case 12u:
            depth = take();
            give(sm_unit_depth(depth));
            give(sm_share_or_light(depth));
            give(sm_kept_deviation(depth));
            give(sm_kept_exponent(depth));
            break;
        case 13u:
            moments = take4();
            give(sm_most_light(moments.x, moments.y, moments.z, moments.w));
            break;
        case 14u:
            moments = take4();
            give(sm_solve_hankel(moments, take()));
            break;
        case 15u:
            moments = take4();
            depth = take();
            two = take2();
            give(sm_mass_before(moments, depth, two.x, two.y));
    }
}
