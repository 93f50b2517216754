// SPDX-License-Identifier: MIT
//
// How wide the edge of a shadow is under a light that has a size: the GLSL twin of what penumbra.hpp does in each
// shader invocation. What is done once a map (penumbra_for) comes in as sm_MapPenumbra. Equal to the C++ bit for bit
// where the driver divides as IEEE 754 does (Mesa's software drivers).
//
// Lights are (direction toward the light, 0) or (position, 1).
#ifndef SM_PENUMBRA_GLSL
#define SM_PENUMBRA_GLSL

#include "tangent.glsl"

const float sm_widest_gap = 1e6;

// The same in std140 and std430. Places are (u w, v w, depth w, w), depth growing away from the light.
struct sm_MapPenumbra {
    vec4 rim_x;          // what a place gains per unit of gap from the cone's axis to its rim
    vec4 rim_y;          // and at a right angle to it
    float depth_of_gap;  // depth w lost per unit of gap along the axis, > 0
    float largest_gap;   // what is farther counts as this far
    float unused_x;
    float unused_y;
};

// Metres across the light over which its shadow fades.
float sm_penumbra_metres(float light_radius, float gap) {
    precise float metres = 2.0 * light_radius * gap;
    return metres;
}

// The gap of an occluder so many metres from the point on its way to the light.
float sm_gap_of_metres(vec4 light, vec3 point, float metres) {
    if (!sm_all_finite(metres) || !(metres > 0.0) || !sm_all_finite(point)) return 0.0;
    if (light.w == 0.0) return metres < sm_widest_gap ? metres : sm_widest_gap;
    precise vec3 way = point - light.xyz;
    float size = sm_safe_normalize(way).size;
    precise float beyond = size - metres;
    return metres < size ? sm_bounded_quotient(metres, beyond, sm_widest_gap) : sm_widest_gap;
}

// And back.
float sm_metres_of_gap(vec4 light, vec3 point, float gap) {
    if (!sm_all_finite(gap) || !(gap > 0.0) || !sm_all_finite(point)) return 0.0;
    float kept = gap < sm_widest_gap ? gap : sm_widest_gap;
    if (light.w == 0.0) return kept;
    precise vec3 way = point - light.xyz;
    precise float metres = sm_safe_normalize(way).size * (kept / (1.0 + kept));
    return sm_all_finite(metres) ? metres : 0.0;
}

// Where the plane across the light through the receiver is met by the light ray that passes the cone from `receiver` to
// the light at `gap`, toward `u` in the unit disk.
vec4 sm_across(sm_MapPenumbra penumbra, vec4 receiver, vec2 u, float gap) {
    precise vec4 place = receiver + (penumbra.rim_x * u.x + penumbra.rim_y * u.y) * gap;
    return place;
}

// The gap of what is stored at a place; negative for what lies behind the receiver's plane across the light.
float sm_gap_at(sm_MapPenumbra penumbra, vec4 place, float depth) {
    precise float gap = (place.z - depth * place.w) / penumbra.depth_of_gap;
    return gap;
}

// Half axes of the kernel in texels, along the map's x and y.
vec2 sm_kernel_texels(sm_MapPenumbra penumbra, vec4 receiver, int map_size, float gap) {
    if (!sm_all_finite(receiver) || !(receiver.w > 0.0) || !sm_all_finite(gap) || map_size < 1) return vec2(0.0);
    precise float scale = gap * float(map_size) / receiver.w;
    precise vec2 at = receiver.xy / receiver.w;
    precise vec2 x = penumbra.rim_x.xy - at * penumbra.rim_x.w;
    precise vec2 y = penumbra.rim_y.xy - at * penumbra.rim_y.w;
    vec2 half_axes = vec2(sm_safe_normalize(vec3(x.x, y.x, 0.0)).size, sm_safe_normalize(vec3(x.y, y.y, 0.0)).size);
    precise vec2 texels = half_axes * scale;
    return sm_all_finite(texels) ? texels : vec2(0.0);
}

bool sm_is_finite(sm_MapPenumbra penumbra) {
    return sm_all_finite(penumbra.rim_x) && sm_all_finite(penumbra.rim_y) && sm_all_finite(penumbra.depth_of_gap) &&
           sm_all_finite(penumbra.largest_gap);
}

#endif
