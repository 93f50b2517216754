// SPDX-License-Identifier: MIT
#version 450
#include "twin.glsl"
#include "shadowmath/glsl/sample_bounds.glsl"
#include "shadowmath/glsl/sample_depths.glsl"
#include "shadowmath/glsl/sdsm.glsl"

ivec4 take_ivec4() {
    int x = take_int();
    int y = take_int();
    int z = take_int();
    return ivec4(x, y, z, take_int());
}

sm_SampleFit take_fit() {
    sm_SampleFit fit;
    fit.basis_x = take4();
    fit.basis_y = take4();
    fit.basis_depth = take4();
    fit.inverse_along = take4();
    fit.eye = take4();
    fit.forward = take4();
    fit.right = take4();
    fit.up = take4();
    fit.first_step = take4();
    fit.casters_lo = take4();
    fit.casters_hi = take4();
    fit.depth_code = take4();
    fit.bias = take4();
    fit.clip_from_canonical = take_mat4();
    fit.extent_count_adaptive = take_ivec4();
    fit.flags = take_ivec4();
    return fit;
}

void give_map(sm_SampleMap map) {
    give(map.clip_from_world);
    give(map.texel_metres);
    give(map.depth_metres);
    give(map.visible);
}

void give_side(sm_MapSide side) {
    give(side.lo);
    give(side.hi);
    give(side.scale);
    give(side.offset);
    give(side.texel_metres);
}

void answer(uint function) {
    sm_SampleFit fit;
    vec2 pair;
    vec3 lo;
    vec4 code;
    ivec2 pixel;
    switch (function) {
        case 0u:
            pair = take2();
            give(sm_quotient(pair.x, pair.y));
            break;
        case 1u:
            pair.x = take();
            give(sm_ordered_bits(pair.x));
            give(sm_from_ordered_bits(sm_ordered_bits(pair.x)));
            break;
        case 2u:
            code = take4();
            pair = take2();
            give(sm_decoded_depth(code, pair.x, pair.y));
            break;
        case 3u:
            lo = take3();
            give(sm_kind_of_depth(lo.x, lo.y, lo.z));
            break;
        case 4u:
            pair = take2();
            give(sm_depth_bin(pair.x, pair.y));
            break;
        case 5u:
            fit = take_fit();
            pixel.x = take_int();
            pixel.y = take_int();
            give(sm_from_eye(fit, pixel, take()));
            break;
        case 6u:
            code = take4();
            give(sm_is_served(code, take()));
            break;
        case 7u:
            lo = take3();
            give(sm_largest_of(lo));
            give(sm_widened(lo.xy, lo.z));
            give(sm_eighth_of_octave_up(abs(lo.x)));
            break;
        case 8u:
            lo = take3();
            give_side(sm_tight_side(lo.x, lo.y, lo.z));
            break;
        case 9u:
            code = take4();
            give_side(sm_still_side(code.x, code.y, code.z, code.w));
            break;
        case 10u:
            fit = take_fit();
            pair = take2();
            give(sm_light_entry(fit, pair, take2()));
            break;
        case 11u:
            fit = take_fit();
            lo = take3();
            give_map(sm_fit_samples(fit, lo, take3()));
            break;
        case 12u:
            fit = take_fit();
            lo = take3();
            sm_SampleBias bias = sm_bias_of(fit, sm_fit_samples(fit, lo, take3()));
            give(bias.constant);
            give(bias.slope_texels);
            give(bias.slope_limit);
            break;
        case 13u: give_map(sm_no_map());
    }
}
