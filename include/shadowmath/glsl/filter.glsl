// SPDX-License-Identifier: MIT
//
// Percentage-closer filtering: the GLSL twin of filter.hpp. Comparisons are filtered, never depths (Reeves, Salesin,
// Cook 1987). Equal to the C++ bit for bit where the driver divides as IEEE 754 does (Mesa's software drivers); on
// others a tap whose depths are equal to a rounding may fall to the other side.
//
// `depths` holds one map a layer, as they were stored; its sampler compares nothing and filters nothing.
#ifndef SM_FILTER_GLSL
#define SM_FILTER_GLSL

#include "bias.glsl"

const int sm_largest_filter_radius = 64;
const int sm_largest_map_size = 1 << 24;

// Texels that the kernel, 2 * radius texels wide, covers of texel `tap` (-radius to radius from the one that holds the
// point) along one axis, when the point lies the `fraction` [0, 1) into its texel.
float sm_covered_texels(int tap, int radius, float fraction) {
    if (radius == 0) return 1.0;
    precise float uncovered = 1.0 - fraction;
    return tap == -radius ? uncovered : (tap == radius ? fraction : 1.0);
}

// The same as a share of the kernel: the taps of an axis sum to 1.
float sm_tap_weight(int tap, int radius, float fraction) {
    if (radius == 0) return 1.0;
    precise float weight = sm_covered_texels(tap, radius, fraction) / float(2 * radius);
    return weight;
}

// A receiver as the map sees it.
struct sm_Receiver {
    vec2 texel;   // from texture u = v = 0
    float depth;  // stored depth, already moved toward the light by its bias
    vec2 slope;   // on its plane
};

// Texels outside the map hold nothing. Depths are compared within [0, 1], as they were stored.
bool sm_is_tap_lit(sampler2DArray depths, int layer, int map_size, int depth_order, ivec2 texel, float depth) {
    if (texel.x < 0 || texel.y < 0 || texel.x >= map_size || texel.y >= map_size) return true;
    float stored = texelFetch(depths, ivec3(texel, layer), 0).r;
    float kept = depth > 0.0 ? (depth < 1.0 ? depth : 1.0) : 0.0;
    return !(depth_order == sm_one_to_zero ? kept < stored : kept > stored);
}

// Share of light that reaches the receiver, in [0, 1]; 1 and 0 are exact where all taps agree. What is not finite is
// lit.
float sm_filtered(sampler2DArray depths, int layer, sm_Receiver receiver, int map_size, int depth_order,
                  int filter_radius, bool tap_plane) {
    int radius = clamp(filter_radius, 0, sm_largest_filter_radius);
    float reach = float(radius + 1);
    float size = float(map_size);
    vec2 at = receiver.texel;
    if (map_size < 1 || map_size > sm_largest_map_size) return 1.0;
    if (!sm_all_finite(at) || !sm_all_finite(receiver.depth) || !sm_all_finite(receiver.slope)) return 1.0;
    if (!(at.x >= -reach && at.y >= -reach && at.x <= size + reach && at.y <= size + reach)) return 1.0;
    vec2 home = floor(at);
    precise vec2 fraction = at - home;
    precise float lit = 0.0;
    precise float dark = 0.0;
    for (int j = -radius; j <= radius; ++j) {
        for (int i = -radius; i <= radius; ++i) {
            precise float weight =
                sm_covered_texels(i, radius, fraction.x) * sm_covered_texels(j, radius, fraction.y);
            precise vec2 to_tap = vec2(i, j) + 0.5 - fraction;
            precise float rise = tap_plane ? receiver.slope.x * to_tap.x + receiver.slope.y * to_tap.y : 0.0;
            precise float depth = receiver.depth + rise;
            if (sm_is_tap_lit(depths, layer, map_size, depth_order, ivec2(home) + ivec2(i, j), depth)) lit += weight;
            else dark += weight;
        }
    }
    precise float share = lit / (lit + dark);
    return dark == 0.0 ? 1.0 : share;
}

struct sm_Seen {
    sm_Receiver receiver;
    float w;      // clip w of the receiver
    bool in_map;  // false: the map cannot answer, the point is lit
};

// The point and the plane through it in the map, moved toward the light by its bias. `normal` is the surface's own, not
// the interpolated one.
sm_Seen sm_seen_by(sm_ShadowMap map, int map_size, vec3 point, vec3 normal, sm_MapBias bias, bool tap_plane) {
    sm_Seen unseen = sm_Seen(sm_Receiver(vec2(0.0), 0.0, vec2(0.0)), 1.0, false);
    if (map.visible == 0 || map_size < 1) return unseen;
    mat4 texture_from_world = sm_texture_from_world(map);
    sm_Projected at = sm_projected(texture_from_world, point, map.w_min);
    if (!at.in_front) return unseen;
    vec2 slope = sm_slope_at(texture_from_world, at, map_size, normal, bias.slope_limit);
    vec2 own = tap_plane ? sm_lean_at(texture_from_world, at, map_size, bias.slope_limit) : vec2(0.0);
    precise vec2 steeper = slope - own;
    float toward_light = sm_depth_bias(bias, at.w, steeper);
    precise float depth = map.depth_order == sm_one_to_zero ? at.at.z + toward_light : at.at.z - toward_light;
    precise vec2 texel = at.at.xy * float(map_size);
    return sm_Seen(sm_Receiver(texel, depth, slope), at.w, true);
}

// What a receiver needs of one map: project the point and the plane through it, subtract the bias, filter. 1 where the
// map does not hold the point.
float sm_visibility(sampler2DArray depths, int layer, sm_ShadowMap map, int map_size, vec3 point, vec3 normal,
                    sm_MapBias bias, int filter_radius, bool tap_plane) {
    sm_Seen seen = sm_seen_by(map, map_size, point, normal, bias, tap_plane);
    if (!seen.in_map) return 1.0;
    return sm_filtered(depths, layer, seen.receiver, map_size, map.depth_order, filter_radius, tap_plane);
}

#endif
