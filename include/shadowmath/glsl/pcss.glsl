// SPDX-License-Identifier: MIT
//
// Percentage-closer soft shadows: the GLSL twin of pcss.hpp. Look for occluders in the cone that the light subtends,
// take their mean gap, filter as wide as the penumbra of that gap. Equal to the C++ bit for bit where the driver
// divides and takes roots as IEEE 754 does (Mesa's software drivers); on others a tap at the very edge may fall to the
// other side.
//
// `depths` holds one map a layer, as they were stored; its sampler compares nothing and filters nothing. `turn` is
// (cos, sin) of an angle that turns the taps: one a pixel trades bands for noise, (1, 0) turns nothing.
#ifndef SM_PCSS_GLSL
#define SM_PCSS_GLSL

#include "filter.glsl"
#include "penumbra.glsl"

const int sm_largest_tap_count = 256;

struct sm_SoftShadow {
    float visibility;  // share of the light that is seen, [0, 1]
    float gap;         // mean of the occluders found; 0 without any
    bool blocked;      // some were found
};

// Directions at the golden angle to each other.
vec2 sm_next_direction(vec2 direction) {
    const float cosine = -0.737368878078319693498;
    const float sine = 0.675490294261523644571;
    precise vec2 next = vec2(direction.x * cosine - direction.y * sine, direction.x * sine + direction.y * cosine);
    return next;
}

// A receiver and the plane through it; depth grows away from the light.
struct sm_TapPlane {
    vec2 texel;
    float depth;
    vec2 slope;
};

bool sm_is_in_map(ivec2 texel, int map_size) {
    return texel.x >= 0 && texel.y >= 0 && texel.x < map_size && texel.y < map_size;
}

float sm_tap_depth(sampler2DArray depths, int layer, int depth_order, ivec2 texel) {
    float stored = texelFetch(depths, ivec3(texel, layer), 0).r;
    precise float depth = depth_order == sm_one_to_zero ? 1.0 - stored : stored;
    return depth;
}

// The plane's depth at the centre of a texel, as a map would store it.
float sm_plane_depth(sm_TapPlane plane, ivec2 texel) {
    precise vec2 to_tap = vec2(texel) + 0.5 - plane.texel;
    precise float there = plane.depth + (plane.slope.x * to_tap.x + plane.slope.y * to_tap.y);
    return there > 0.0 ? (there < 1.0 ? there : 1.0) : 0.0;
}

// Texels of a place, at most one outside of the map; false where it is farther away or nowhere.
bool sm_texel_of(vec4 place, int map_size, out vec2 texel) {
    float size = float(map_size);
    precise vec2 at = place.xy * size / place.w;
    texel = at;
    return place.w > 0.0 && at.x >= -1.0 && at.y >= -1.0 && at.x <= size + 1.0 && at.y <= size + 1.0;
}

// The mean of what four texels say, by the distance to them: exactly 0 and 1 where they agree.
float sm_mean_of_four(vec4 values, vec2 share) {
    precise float lower = values.x * (1.0 - share.x) + values.y * share.x;
    precise float upper = values.z * (1.0 - share.x) + values.w * share.x;
    precise float mean = lower * (1.0 - share.y) + upper * share.y;
    return mean;
}

// 0 where there is no occluder in the cone.
float sm_gap_in_cone(sampler2DArray depths, int layer, sm_TapPlane plane, sm_MapPenumbra penumbra, int map_size,
                     int depth_order, ivec2 texel, vec4 place, float least_gap, float widest) {
    if (!sm_is_in_map(texel, map_size)) return 0.0;
    float depth = sm_tap_depth(depths, layer, depth_order, texel);
    float gap = sm_gap_at(penumbra, place, depth);
    if (!(depth < sm_plane_depth(plane, texel)) || !(gap >= least_gap)) return 0.0;
    return gap < widest ? gap : widest;
}

// Mean gap of the occluders that stand in the cone. Its tip is as wide as a texel.
sm_SoftShadow sm_search(sampler2DArray depths, int layer, sm_TapPlane plane, vec4 receiver, sm_MapPenumbra penumbra,
                        int map_size, int depth_order, int taps, vec2 direction) {
    sm_SoftShadow lit = sm_SoftShadow(1.0, 0.0, false);
    float nothing_beyond = sm_gap_at(penumbra, receiver, 0.0);
    float allowed = penumbra.largest_gap < sm_widest_gap ? penumbra.largest_gap : sm_widest_gap;
    float widest = nothing_beyond < allowed ? nothing_beyond : allowed;
    if (!(widest > 0.0)) return lit;
    precise float sum = 0.0;
    precise float found = 0.0;
    vec2 texel;
    if (sm_texel_of(receiver, map_size, texel)) {
        vec2 corner = floor(texel - 0.5);
        precise vec2 share = texel - 0.5 - corner;
        vec4 gaps;
        for (int i = 0; i < 4; ++i)
            gaps[i] = sm_gap_in_cone(depths, layer, plane, penumbra, map_size, depth_order,
                                     ivec2(corner) + ivec2(i & 1, i >> 1), receiver, 0.0, widest);
        sum = sm_mean_of_four(gaps, share);
        found = sm_mean_of_four(vec4(greaterThan(gaps, vec4(0.0))), share);
    }
    for (int i = 1; i < taps; ++i) {
        direction = sm_next_direction(direction);
        precise float share = (float(i) + 0.5) / float(taps);
        precise float reach = share * share;
        precise vec2 u = direction * reach;
        vec4 place = sm_across(penumbra, receiver, u, widest);
        if (!sm_texel_of(place, map_size, texel)) continue;
        precise float least_gap = reach * widest;
        float gap = sm_gap_in_cone(depths, layer, plane, penumbra, map_size, depth_order, ivec2(floor(texel)), place,
                                   least_gap, widest);
        if (!(gap > 0.0)) continue;
        sum += gap;
        found += 1.0;
    }
    if (!(found > 0.0)) return lit;
    precise float mean = sum / found;
    return sm_SoftShadow(0.0, mean < widest ? mean : widest, true);
}

// Share of the four texels around a place that are lit, by their distance to it.
float sm_lit_around(sampler2DArray depths, int layer, sm_TapPlane plane, int map_size, int depth_order, vec2 texel) {
    vec2 corner = floor(texel - 0.5);
    precise vec2 share = texel - 0.5 - corner;
    vec4 lit = vec4(1.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 at = ivec2(corner) + ivec2(i & 1, i >> 1);
        if (!sm_is_in_map(at, map_size)) continue;
        if (sm_plane_depth(plane, at) > sm_tap_depth(depths, layer, depth_order, at)) lit[i] = 0.0;
    }
    return sm_mean_of_four(lit, share);
}

// Share of light that reaches a receiver whose clip w is `w`. Without an occluder in the cone exactly 1; no plane
// shadows itself however wide the kernel. What is not finite is lit.
sm_SoftShadow sm_soft_filtered(sampler2DArray depths, int layer, sm_Receiver receiver, float w, sm_MapPenumbra penumbra,
                               int map_size, int depth_order, int search_taps, int filter_taps, vec2 turn) {
    sm_SoftShadow lit = sm_SoftShadow(1.0, 0.0, false);
    if (map_size < 1 || map_size > sm_largest_map_size || !sm_all_finite(w) || !(w > 0.0)) return lit;
    bool finite = sm_all_finite(receiver.texel) && sm_all_finite(receiver.depth) && sm_all_finite(receiver.slope);
    if (!finite || !sm_is_finite(penumbra) || !(penumbra.depth_of_gap > 0.0)) return lit;
    sm_TapPlane plane = sm_TapPlane(receiver.texel, receiver.depth, receiver.slope);
    if (depth_order == sm_one_to_zero) {
        precise float depth = 1.0 - receiver.depth;
        plane.depth = depth;
        plane.slope = -receiver.slope;
    }
    precise float length2 = turn.x * turn.x + turn.y * turn.y;
    if (!sm_all_finite(turn) || !(abs(length2 - 1.0) <= 1e-3)) turn = vec2(1.0, 0.0);
    precise vec4 place = vec4(receiver.texel / float(map_size), plane.depth, 1.0) * w;
    sm_SoftShadow shadow = sm_search(depths, layer, plane, place, penumbra, map_size, depth_order,
                                     clamp(search_taps, 1, sm_largest_tap_count), turn);
    if (!shadow.blocked) return lit;
    int taps = clamp(filter_taps, 1, sm_largest_tap_count);
    precise float sum = 0.0;
    vec2 direction = turn;
    for (int i = 0; i < taps; ++i) {
        precise vec2 u = direction * sqrt((float(i) + 0.5) / float(taps));
        vec2 texel;
        bool in_map = sm_texel_of(sm_across(penumbra, place, u, shadow.gap), map_size, texel);
        sum += in_map ? sm_lit_around(depths, layer, plane, map_size, depth_order, texel) : 1.0;
        direction = sm_next_direction(direction);
    }
    precise float visibility = sum / float(taps);
    shadow.visibility = visibility < 1.0 ? visibility : 1.0;
    return shadow;
}

// What a receiver needs of one map: project the point and the plane through it, subtract the bias, search, filter. Lit
// where the map does not hold the point. `normal` is the surface's own, not the interpolated one.
sm_SoftShadow sm_soft_visibility(sampler2DArray depths, int layer, sm_ShadowMap map, int map_size, vec3 point,
                                 vec3 normal, sm_MapBias bias, sm_MapPenumbra penumbra, int search_taps,
                                 int filter_taps, vec2 turn) {
    sm_Seen seen = sm_seen_by(map, map_size, point, normal, bias, true);
    if (!seen.in_map) return sm_SoftShadow(1.0, 0.0, false);
    return sm_soft_filtered(depths, layer, seen.receiver, seen.w, penumbra, map_size, map.depth_order, search_taps,
                            filter_taps, turn);
}

#endif
