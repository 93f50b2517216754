// SPDX-License-Identifier: MIT
//
// Cascaded shadows in three lines, from the block that gpu.hpp fills:
//
//   sm_LookUp look_up = sm_by_depth(cascades.ranges, cascades.count, eye_depth);
//   float lit = sm_cascaded_visibility(depths, look_up, cascades.at[max(look_up.first, 0)],
//                                      cascades.at[max(look_up.second, 0)], cascades.map_size, point, plane_normal,
//                                      cascades.filter_radius, cascades.tap_plane != 0);
//
// Only the two cascades that are read are handed over: a shader that took them all by value would copy kilobytes a
// pixel. `depths` holds cascade i in layer i.
#ifndef SM_CASCADES_GLSL
#define SM_CASCADES_GLSL

#include "filter.glsl"
#include "sampling.glsl"

// Share of light that reaches the point, continuous across the seams. `first` and `second` are the look-up's cascades;
// either may be anything where the look-up has none.
float sm_cascaded_visibility(sampler2DArray depths, sm_LookUp look_up, sm_Cascade first, sm_Cascade second,
                             int map_size, vec3 point, vec3 normal, int filter_radius, bool tap_plane) {
    float here = 1.0;
    float next = 1.0;
    if (look_up.first >= 0)
        here = sm_visibility(depths, look_up.first, first.map, map_size, point, normal, first.bias, filter_radius,
                             tap_plane);
    if (look_up.second >= 0)
        next = sm_visibility(depths, look_up.second, second.map, map_size, point, normal, second.bias, filter_radius,
                             tap_plane);
    return sm_blended(look_up, here, next);
}

#endif
