// SPDX-License-Identifier: MIT
//
// How much a receiver is moved toward the light so that it does not shadow itself: the GLSL twin of what bias.hpp does
// in each shader invocation. What is done once a map (bias_for) comes in as sm_MapBias. Equal to the C++ bit for bit
// where the driver divides as IEEE 754 does (Mesa's software drivers).
//
//   bias = constant + per_inverse_w / w + slope_texels * (|slope.x| + |slope.y|)
#ifndef SM_BIAS_GLSL
#define SM_BIAS_GLSL

#include "shadow_map.glsl"
#include "tangent.glsl"

// As sm_slope, of a point that is projected already.
vec2 sm_slope_at(mat4 texture_from_world, sm_Projected at, int map_size, vec3 normal, float limit) {
    sm_Tangents plane = sm_tangents(normal);
    if (!at.in_front || !plane.ok || map_size < 1 || !sm_all_finite(limit) || !(limit > 0.0)) return vec2(0.0);
    vec3 s = sm_gain_along(texture_from_world, at, plane.s);
    vec3 t = sm_gain_along(texture_from_world, at, plane.t);
    // Over the largest of them, the product of two gains neither under- nor overflows.
    float largest = max(max(abs(s.x), abs(s.y)), max(abs(t.x), abs(t.y)));
    if (!sm_all_finite(s) || !sm_all_finite(t) || !(largest > 0.0)) return vec2(0.0);
    precise vec3 a = s / largest;
    precise vec3 b = t / largest;
    precise float area = (a.x * b.y - a.y * b.x) * float(map_size);
    precise vec2 rise = vec2(a.z * b.y - a.y * b.z, a.x * b.z - a.z * b.x);
    return vec2(sm_bounded_quotient(rise.x, area, limit), sm_bounded_quotient(rise.y, area, limit));
}

// Stored depth gained a texel in x and y on the plane through the point: exact for every projective map. Each is
// clamped to [-limit, limit], its value also where the light grazes the plane. Zero where the map does not hold the
// point.
vec2 sm_slope(sm_ShadowMap map, int map_size, vec3 point, vec3 normal, float limit) {
    mat4 texture_from_world = sm_texture_from_world(map);
    return sm_slope_at(texture_from_world, sm_projected(texture_from_world, point, map.w_min), map_size, normal, limit);
}

// As sm_lean, of a point that is projected already.
vec2 sm_lean_at(mat4 texture_from_world, sm_Projected at, int map_size, float limit) {
    mat4 m = texture_from_world;
    vec3 w = vec3(m[0].w, m[1].w, m[2].w);
    precise vec3 u = vec3(m[0].x, m[1].x, m[2].x) - at.at.x * w;
    precise vec3 v = vec3(m[0].y, m[1].y, m[2].y) - at.at.y * w;
    // Along a light ray neither u nor v changes: it is at a right angle to both of these.
    vec3 across = sm_cross(sm_safe_normalize(u).direction, sm_safe_normalize(v).direction);
    return sm_slope_at(texture_from_world, at, map_size, across, limit);
}

// The slope of the plane across the light: 0 in an affine map; in any other what the map itself adds to the slope of
// every receiver.
vec2 sm_lean(sm_ShadowMap map, int map_size, vec3 point, float limit) {
    mat4 texture_from_world = sm_texture_from_world(map);
    return sm_lean_at(texture_from_world, sm_projected(texture_from_world, point, map.w_min), map_size, limit);
}

// The bias of one shader invocation: `w` is the receiver's clip w, `slope` its slope, less the lean where taps follow
// the plane. Never negative, never NaN.
float sm_depth_bias(sm_MapBias bias, float w, vec2 slope) {
    precise float amount =
        bias.constant + bias.per_inverse_w / w + bias.slope_texels * (abs(slope.x) + abs(slope.y));
    return sm_all_finite(amount) && amount > 0.0 ? amount : 0.0;
}

// Half the kernel's width and half a texel. Texels.
float sm_kernel_reach_texels(int filter_radius) {
    return float(max(filter_radius, 0)) + 0.5;
}

// Metres to move a receiver along its unit normal before projecting it, instead of a slope bias.
float sm_normal_offset_metres(float texel_metres, int filter_radius, vec3 normal, vec3 to_light) {
    bool finite = sm_all_finite(normal) && sm_all_finite(to_light) && sm_all_finite(texel_metres);
    if (!finite || !(texel_metres > 0.0)) return 0.0;
    vec3 across = sm_cross(normal, to_light);
    precise float sine = sqrt(sm_dot(across, across));
    precise float reach_metres = sm_kernel_reach_texels(filter_radius) * texel_metres;
    precise float offset = 1.41421356 * reach_metres * (sine < 1.0 ? sine : 1.0);
    return sm_all_finite(offset) ? offset : 0.0;
}

// The same for any map, whose texels differ from place to place: the least metres along the unit `normal` with which
// the plane through `point` does not shadow itself in this map. `to_light` is unit; `lamp_metres` the distance to a
// spot, 0 of a sun; `depth_gain` the map's (depth_gain of the C++, once a map). At most `most_metres`; 0 where the
// plane faces away, or the map does not hold the point.
float sm_normal_offset_at(sm_ShadowMap map, int map_size, int filter_radius, vec3 point, vec3 normal, vec3 to_light,
                          float lamp_metres, float depth_gain, float most_metres) {
    sm_Projected at = sm_projected(map.clip_from_world, point, map.w_min);
    if (!at.in_front || !sm_all_finite(normal) || !sm_all_finite(most_metres) || !(most_metres > 0.0) ||
        !(depth_gain > 0.0))
        return 0.0;
    float cosine = sm_dot(normal, to_light);
    if (!(cosine > 0.0)) return 0.0;
    vec2 s = sm_slope(map, map_size, point, normal, 1e6);
    // What the kernel needs of clip depth, before the division by w.
    precise float needed = sm_kernel_reach_texels(filter_radius) * (abs(s.x) + abs(s.y)) / depth_gain;
    precise float offset = most_metres;
    if (!(lamp_metres > 0.0)) {
        // needed * (w + offset * gain of w) = offset / cosine
        mat4 m = map.clip_from_world;
        float gain_of_w = sm_dot(vec3(m[0].w, m[1].w, m[2].w), normal);
        precise float left = 1.0 - needed * cosine * gain_of_w;
        precise float raised = needed * cosine * at.w;
        if (left > 0.0) offset = sm_bounded_quotient(raised, left, most_metres);
    } else {
        // The way to the lamp, shortened by the share s, gains k s / (1 - s).
        precise float raised = needed * at.w;
        precise float whole = 1.0 + raised;
        offset = cosine * lamp_metres * sm_bounded_quotient(raised, whole, 1.0);
    }
    return sm_all_finite(offset) && offset < most_metres ? offset : most_metres;
}

#endif
