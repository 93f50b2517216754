// SPDX-License-Identifier: MIT
//
// The shadow lookup: from a point with a plane through it to the share of light that reaches it, 0 to 1. All of its
// mathematics is the library's own; here stands what the frame's constants mean.

#include "shadowmath/glsl/filter.glsl"
#include "shadowmath/glsl/sampling.glsl"

layout(binding = 1) uniform sampler2DArray depths;

struct Shadow {
    int map;           // that was read; -1: none
    float visibility;
};

sm_MapBias bias_of(int map) {
    MapConstants m = frame.maps[map];
    return sm_MapBias(m.bias_constant, m.bias_w, m.bias_slope_texels, m.slope_limit);
}

// A map whose constants are no numbers shadows nothing.
sm_ShadowMap shadow_map(int map) {
    MapConstants m = frame.maps[map];
    bool visible = sm_all_finite(vec4(m.bias_constant, m.bias_w, m.bias_slope_texels, m.slope_limit));
    return sm_ShadowMap(m.clip_from_world, m.w_min, sm_zero_to_one, 0, visible ? 1 : 0);
}

float map_visibility(int map, vec3 point, vec3 normal) {
    if (map < 0) return 1.0;
    return sm_visibility(depths, map, shadow_map(map), int(frame.map_size), point, normal, bias_of(map),
                         frame.filter_radius, frame.tap_plane == 1);
}

// The first map that reaches past the point, blended into the next one near its end; the last one blends into light.
Shadow shadow_by_depth(vec3 point, vec3 normal, float eye_depth) {
    sm_Ranges ranges;
    for (int map = 0; map < frame.map_count; ++map) {
        ranges.blend_begin[map >> 2][map & 3] = frame.maps[map].blend_begin;
        ranges.end[map >> 2][map & 3] = frame.maps[map].depth_end;
    }
    sm_LookUp look_up = sm_by_depth(ranges, frame.map_count, eye_depth);
    float here = map_visibility(look_up.first, point, normal);
    float next = look_up.blend > 0.0 ? map_visibility(look_up.second, point, normal) : 1.0;
    return Shadow(look_up.first, sm_blended(look_up, here, next));
}

// The first map that holds the point and every texel that its filter touches.
Shadow shadow_by_map(vec3 point, vec3 normal) {
    float margin_texels = float(frame.filter_radius + 1);
    for (int map = 0; map < frame.map_count; ++map)
        if (sm_contains(shadow_map(map), int(frame.map_size), margin_texels, point))
            return Shadow(map, map_visibility(map, point, normal));
    return Shadow(-1, 1.0);
}

Shadow shadow_at(vec3 point, vec3 normal, float eye_depth) {
    return frame.choice == choose_by_depth ? shadow_by_depth(point, normal, eye_depth) : shadow_by_map(point, normal);
}
