// SPDX-License-Identifier: MIT
//
// Which map a point is looked up in, and what its shadow does to its colour: the GLSL twin of sampling.hpp, equal to it
// bit for bit where the driver divides as IEEE 754 does (Mesa's software drivers).
//
// by_map of the C++ is a loop over sm_contains in the shader itself: maps stay in the uniform block that they are in.
#ifndef SM_SAMPLING_GLSL
#define SM_SAMPLING_GLSL

#include "layout.glsl"
#include "tangent.glsl"

struct sm_LookUp {
    int first;    // map to read; -1: none, the point is lit
    int second;   // map to fade into; -1 with blend > 0: into light
    float blend;  // share of the second, [0, 1]
};

// True when the map can answer for the point: w above w_min, at least `margin_texels` inside the four sides, and not
// beyond the map's far end. The margin is the kernel's reach: filter radius + 1.
bool sm_contains(sm_ShadowMap map, int map_size, float margin_texels, vec3 point) {
    sm_Projected at = sm_projected(map.clip_from_world, point, map.w_min);
    if (map.visible == 0 || !at.in_front || map_size < 1 || !sm_all_finite(margin_texels)) return false;
    precise float side = 1.0 - 2.0 * margin_texels / float(map_size);
    bool before_far_end = map.depth_order == sm_one_to_zero ? at.at.z >= 0.0 : at.at.z <= 1.0;
    return at.at.x >= -side && at.at.x <= side && at.at.y >= -side && at.at.y <= side && before_far_end;
}

// The first of `count` ranges that ends beyond the eye depth.
sm_LookUp sm_by_depth(sm_Ranges ranges, int count, float eye_depth) {
    if (!sm_all_finite(eye_depth)) return sm_LookUp(-1, -1, 0.0);
    for (int i = 0; i < min(count, sm_max_cascades); ++i) {
        float end = ranges.end[i >> 2][i & 3];
        if (!(eye_depth < end)) continue;
        float blend_begin = ranges.blend_begin[i >> 2][i & 3];
        if (!(eye_depth > blend_begin)) return sm_LookUp(i, -1, 0.0);
        precise float blend = (eye_depth - blend_begin) / (end - blend_begin);
        return sm_LookUp(i, i + 1 < count ? i + 1 : -1, blend);
    }
    return sm_LookUp(-1, -1, 0.0);
}

// Visibility of the two maps of a look-up, mixed; pass 1 for a map that is -1.
float sm_blended(sm_LookUp look_up, float first_visibility, float second_visibility) {
    precise float mixed = first_visibility * (1.0 - look_up.blend) + second_visibility * look_up.blend;
    return mixed;
}

// Light that is let through takes part in diffuse and specular, never in ambient; albedo tints all three (Kwon 2002,
// section 4.4). Linear colours.
vec3 sm_shade(vec3 ambient, vec3 diffuse, vec3 specular, float visibility, vec3 albedo) {
    precise vec3 colour = (ambient + (diffuse + specular) * visibility) * albedo;
    return colour;
}

#endif
