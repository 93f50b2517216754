// SPDX-License-Identifier: MIT
//
// The shadow lookup: from a point with a plane through it to the share of light that reaches it, 0 to 1. All of its
// mathematics is the library's own; here stands what the frame's constants mean.

#include "shadowmath/glsl/filter.glsl"
#include "shadowmath/glsl/sampling.glsl"

layout(binding = 1) uniform sampler2DArray depths;

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
    int layer = frame.split < 0 ? map : 0;
    return sm_visibility(depths, layer, shadow_map(map), int(frame.map_size), point, normal, bias_of(map),
                         frame.filter_radius, frame.tap_plane == 1);
}

// The first map that reaches past the point, blended into the next one near its end; the last one blends into light.
sm_LookUp look_up_by_depth(float eye_depth) {
    sm_Ranges ranges;
    for (int map = 0; map < frame.map_count; ++map) {
        ranges.blend_begin[map >> 2][map & 3] = frame.maps[map].blend_begin;
        ranges.end[map >> 2][map & 3] = frame.maps[map].depth_end;
    }
    return sm_by_depth(ranges, frame.map_count, eye_depth);
}

// The first map that holds the point and every texel that its filter touches.
sm_LookUp look_up_by_map(vec3 point) {
    float margin_texels = float(frame.filter_radius + 1);
    for (int map = 0; map < frame.map_count; ++map)
        if (sm_contains(shadow_map(map), int(frame.map_size), margin_texels, point)) return sm_LookUp(map, -1, 0.0);
    return sm_LookUp(-1, -1, 0.0);
}

sm_LookUp look_up_at(vec3 point, float eye_depth) {
    if (frame.choice == choose_by_depth) return look_up_by_depth(eye_depth);
    return look_up_by_map(point);
}

// Where one map is there at a time: whether it is not this one.
bool is_of_another_split(sm_LookUp look_up) {
    return frame.split >= 0 && (look_up.first < 0 ? frame.map_count : look_up.first) != frame.split;
}

float visibility_at(sm_LookUp look_up, vec3 point, vec3 normal) {
    // A loop, so that the filter stands in the shader once: software drivers walk through both sides of every branch.
    vec2 lit = vec2(1.0);
    int reads = look_up.first < 0 ? 0 : (look_up.second < 0 ? 1 : 2);
    for (int i = 0; i < reads; ++i)
        lit[i] = map_visibility(i == 0 ? look_up.first : look_up.second, point, normal);
    return sm_blended(look_up, lit.x, lit.y);
}
