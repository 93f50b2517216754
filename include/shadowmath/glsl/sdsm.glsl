// SPDX-License-Identifier: MIT
//
// One map from the box of a split's samples: the GLSL twin of sdsm.hpp's fit_samples. Bit for bit equal to the C++ at
// float on every processor: products, sums and sm_quotient, each in the order of the C++.
#ifndef SM_SDSM_GLSL
#define SM_SDSM_GLSL

#include "quotient.glsl"
#include "sample_layout.glsl"

const float sm_farthest_metres = 1e18;
const float sm_four_eps = 4.76837158203125e-7;

struct sm_SampleMap {
    mat4 clip_from_world;
    vec2 texel_metres;
    float depth_metres;
    bool visible;
};

// One axis of a map: NDC = scale * (light-space coordinate) + offset.
struct sm_MapSide {
    float lo;  // metres
    float hi;
    float scale;
    float offset;
    float texel_metres;
};

float sm_largest_of(vec3 v) {
    return max(abs(v.x), max(abs(v.y), abs(v.z)));
}

// At least this long, about its middle.
vec2 sm_widened(vec2 interval, float least) {
    precise float extent = interval.y - interval.x;
    precise float middle = interval.x + extent * 0.5;
    precise vec2 wide = vec2(middle - least * 0.5, middle + least * 0.5);
    return extent >= least ? interval : wide;
}

float sm_eighth_of_octave_up(float x) {
    return uintBitsToFloat((floatBitsToUint(x) + 0x000fffffu) & 0xfff00000u);
}

sm_MapSide sm_tight_side(float lo, float hi, float size) {
    precise float extent = hi - lo;
    precise float minus_sum = -(hi + lo);
    return sm_MapSide(lo, hi, sm_quotient(2.0, extent), sm_quotient(minus_sum, extent), sm_quotient(extent, size));
}

sm_MapSide sm_still_side(float lo, float hi, float size, float spare) {
    precise float needed = (hi - lo) * spare;
    float texel = sm_eighth_of_octave_up(needed);
    precise float middle = 0.5 * (lo + hi);
    precise float index = floor(sm_quotient(middle, texel) - size * 0.5 + 0.5);
    precise vec2 ends = vec2(index, index + size) * texel;
    precise float extent = size * texel;
    precise float minus_sum = -(2.0 * index + size);
    return sm_MapSide(ends.x, ends.y, sm_quotient(2.0, extent), sm_quotient(minus_sum, size), texel);
}

// Metres along the light at which the rays between the sides enter the casters' box.
float sm_light_entry(sm_SampleFit fit, vec2 lo, vec2 hi) {
    float entry = -sm_farthest_metres;
    for (int k = 0; k < 3; ++k) {
        float inverse = fit.inverse_along[k];
        if (inverse == 0.0) continue;
        precise float x0 = fit.basis_x[k] * lo.x;
        precise float x1 = fit.basis_x[k] * hi.x;
        precise float y0 = fit.basis_y[k] * lo.y;
        precise float y1 = fit.basis_y[k] * hi.y;
        bool forward = inverse > 0.0;
        float face = forward ? fit.casters_lo[k] : fit.casters_hi[k];
        precise float across = forward ? max(x0, x1) + max(y0, y1) : min(x0, x1) + min(y0, y1);
        precise float rounding = sm_four_eps * (abs(face) + abs(x0) + abs(x1) + abs(y0) + abs(y1));
        precise float enters = ((face - across) - (forward ? rounding : -rounding)) * inverse;
        entry = max(entry, enters);
    }
    return entry;
}

// A map that serves nothing: every point lands at NDC x = 2.
sm_SampleMap sm_no_map() {
    return sm_SampleMap(mat4(vec4(0.0), vec4(0.0), vec4(0.0), vec4(2.0, 2.0, 2.0, 1.0)), vec2(0.0), 0.0, false);
}

// lo, hi: of the samples, in light space relative to the eye; lo above hi where there are none.
sm_SampleMap sm_fit_samples(sm_SampleFit fit, vec3 lo, vec3 hi) {
    if (!all(lessThanEqual(lo, hi)) || !all(lessThanEqual(fit.casters_lo.xyz, fit.casters_hi.xyz))) return sm_no_map();
    float way = max(sm_largest_of(lo), sm_largest_of(hi));
    precise float slack = 3.814697265625e-6 * way;
    precise vec3 body_lo = lo + fit.eye.xyz - slack;
    precise vec3 body_hi = hi + fit.eye.xyz + slack;
    precise vec3 body_extent = body_hi - body_lo;
    float farthest = max(sm_largest_of(body_lo), sm_largest_of(body_hi));
    if (!(farthest <= sm_farthest_metres)) return sm_no_map();

    float size = fit.eye.w;
    precise float rounding = sm_four_eps * farthest;
    float least = max(max(sm_quotient(sm_largest_of(body_extent), size), rounding), 1e-6);
    sm_MapSide side[2];
    for (int axis = 0; axis < 2; ++axis) {
        vec2 body = sm_widened(vec2(body_lo[axis], body_hi[axis]), least);
        precise float margin = fit.forward.w * (body.y - body.x);
        precise float box_lo = body.x - margin - rounding;
        precise float box_hi = body.y + margin + rounding;
        if (fit.flags.y != 0) side[axis] = sm_still_side(box_lo, box_hi, size, fit.right.w);
        else side[axis] = sm_tight_side(box_lo, box_hi, size);
    }
    precise vec2 depth_body = vec2(body_lo.z - rounding, body_hi.z + rounding);
    vec2 depth = sm_widened(depth_body, max(rounding, 1e-6));

    float entry = sm_light_entry(fit, vec2(side[0].lo, side[1].lo), vec2(side[0].hi, side[1].hi));
    if (!(entry <= depth.y)) return sm_no_map();
    precise float whole = (side[0].hi - side[0].lo) + (side[1].hi - side[1].lo) + (depth.y - depth.x) + way;
    precise float deepest = depth.x - 65536.0 * whole;
    float reach = fit.flags.z != 0 ? depth.x : max(entry, deepest);
    float depth_lo = min(reach, depth.x);
    precise float depth_metres = depth.y - depth_lo;
    float depth_scale = sm_quotient(1.0, depth_metres);
    precise float depth_offset = -depth_lo * depth_scale;

    precise vec3 x = fit.basis_x.xyz * side[0].scale;
    precise vec3 y = fit.basis_y.xyz * side[1].scale;
    precise vec3 z = fit.basis_depth.xyz * depth_scale;
    mat4 canonical = mat4(vec4(x.x, y.x, z.x, 0.0), vec4(x.y, y.y, z.y, 0.0), vec4(x.z, y.z, z.z, 0.0),
                          vec4(side[0].offset, side[1].offset, depth_offset, 1.0));
    mat4 clip_from_world;
    for (int i = 0; i < 4; ++i) {
        vec4 c = canonical[i];
        precise vec4 column = fit.clip_from_canonical[0] * c.x + fit.clip_from_canonical[1] * c.y +
                              fit.clip_from_canonical[2] * c.z + fit.clip_from_canonical[3] * c.w;
        clip_from_world[i] = column;
        // Too shallow or too small for its numbers; NaN fails the comparison too.
        if (!all(lessThan(abs(column), vec4(3e38)))) return sm_no_map();
    }
    return sm_SampleMap(clip_from_world, vec2(side[0].texel_metres, side[1].texel_metres), depth_metres, true);
}

struct sm_SampleBias {
    float constant;
    float slope_texels;
    float slope_limit;
};

// bias_for (bias.hpp) of such a map, drawn with depth from 0 to 1, to a few ulp.
sm_SampleBias sm_bias_of(sm_SampleFit fit, sm_SampleMap map) {
    float size = fit.eye.w;
    float gain = map.visible ? 1.0 / map.depth_metres : 0.0;
    float texel_lo = min(map.texel_metres.x, map.texel_metres.y);
    float texel_hi = max(map.texel_metres.x, map.texel_metres.y);
    vec3 offset = abs(map.clip_from_world[3].xyz);
    float constant = 2.0 * fit.bias.w + fit.bias.x * min(gain * texel_lo, 1e6) + sm_four_eps * offset.z;
    float slope_texels = fit.bias.y + sm_four_eps * max(offset.x, offset.y) * size * 0.5;
    float limit = min(fit.bias.z * gain * texel_hi, 1e6);
    return sm_SampleBias(constant, slope_texels, limit > 0.0 ? limit : 1.0);
}

#endif
