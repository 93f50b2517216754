// SPDX-License-Identifier: MIT
//
// The shadow lookup: from a point with a plane through it to the share of light that reaches it, 0 to 1.
// Comparisons are filtered, never depths (Reeves, Salesin, Cook 1987). Each is written so that NaN ends lit.

layout(binding = 1) uniform sampler2DArray maps;

struct Projected {
    vec3 ndc;
    float w;       // clip w
    vec2 texel;    // texels from the map's corner; texel centres lie at halves
    bool in_front; // w is large enough for the division to mean something
};

struct Shadow {
    int map;           // that was read; -1: none
    float visibility;
};

Projected project_to_map(int map, vec3 point) {
    vec4 clip = transformed(frame.maps[map].clip_from_world, point);
    vec3 ndc = clip.xyz / clip.w;
    return Projected(ndc, clip.w, (ndc.xy * 0.5 + 0.5) * frame.map_size, clip.w > frame.maps[map].w_min);
}

bool is_inside(Projected p, float margin_texels) {
    return p.in_front && all(greaterThanEqual(p.texel, vec2(margin_texels))) &&
           all(lessThanEqual(p.texel, vec2(frame.map_size - margin_texels)));
}

// Texels in x and y and depth, gained a metre along a direction: the derivative of xyz / w.
vec3 gain_along(int map, Projected p, vec3 direction) {
    vec4 clip = frame.maps[map].clip_from_world * vec4(direction, 0.0);
    return (clip.xyz - p.ndc * clip.w) / p.w * vec3(vec2(0.5 * frame.map_size), 1.0);
}

// Depth gained a texel in x and in y on the plane through the point: exact for any projective map.
// A plane that the light grazes has no such slope; there it is the limit, never NaN.
vec2 plane_slope(int map, Projected p, vec3 normal) {
    vec3 tangent = normalize(cross(normal, abs(normal.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
    vec3 s = gain_along(map, p, tangent);
    vec3 t = gain_along(map, p, cross(normal, tangent));
    float area = s.x * t.y - s.y * t.x;
    vec2 rise = vec2(s.z * t.y - s.y * t.z, s.x * t.z - s.z * t.x);
    float limit = frame.maps[map].slope_limit;
    return clamp(rise / (abs(area) > 1e-30 ? area : 1e-30), -limit, limit);
}

// The slope of the plane across the light: what a map that is not affine adds to the slope of every receiver. Along a
// light ray neither x nor y of NDC changes, so the ray is at a right angle to both of their gradients.
vec2 map_lean(int map, Projected p) {
    mat4 m = frame.maps[map].clip_from_world;
    vec3 w = vec3(m[0].w, m[1].w, m[2].w);
    vec3 ray = cross(normalize(vec3(m[0].x, m[1].x, m[2].x) - p.ndc.x * w),
                     normalize(vec3(m[0].y, m[1].y, m[2].y) - p.ndc.y * w));
    float size = length(ray);
    return size > 0.0 ? plane_slope(map, p, ray / size) : vec2(0.0);
}

float depth_bias(int map, Projected p, vec2 slope) {
    MapConstants m = frame.maps[map];
    return m.bias_constant + m.bias_w / p.w + m.bias_slope_texels * (abs(slope.x) + abs(slope.y));
}

// Texels outside the map hold nothing. Depths are compared within [0, 1], as they were stored: what lies in front of
// the map's range counts as its near end, what lies behind it as its far end, where the cleared map is lit.
bool is_lit_by_texel(int map, ivec2 texel, float depth) {
    int size = int(frame.map_size);
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(size)))) return true;
    return !(clamp(depth, 0.0, 1.0) > texelFetch(maps, ivec3(texel, map), 0).r);
}

// Texels that a box 2 * radius texels wide, centred on the point, covers of one tap's texel along one axis.
// The filter is continuous everywhere: a tap enters and leaves with nothing covered.
float covered_texels(int tap, int radius, float fraction) {
    if (radius == 0) return 1.0;
    return tap == -radius ? 1.0 - fraction : tap == radius ? fraction : 1.0;
}

float map_visibility(int map, vec3 point, vec3 normal) {
    int radius = frame.filter_radius;
    Projected p = project_to_map(map, point);
    if (!is_inside(p, -float(radius + 1))) return 1.0;

    vec2 slope = plane_slope(map, p, normal);
    // Taps that follow the plane follow the map's lean too; then only what the receiver adds can go wrong.
    vec2 own = frame.tap_plane == 1 ? map_lean(map, p) : vec2(0.0);
    float depth = p.ndc.z - depth_bias(map, p, slope - own);
    vec2 home = floor(p.texel);
    vec2 fraction = p.texel - home;
    float lit = 0.0;
    float dark = 0.0;
    for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) {
            vec2 texel = home + vec2(x, y);
            float rise = frame.tap_plane == 1 ? dot(slope, texel + 0.5 - p.texel) : 0.0;
            float weight = covered_texels(x, radius, fraction.x) * covered_texels(y, radius, fraction.y);
            if (is_lit_by_texel(map, ivec2(texel), depth + rise)) lit += weight;
            else dark += weight;
        }
    }
    return dark == 0.0 ? 1.0 : lit / (lit + dark);  // all lit and all dark are exact, however the weights round
}

// The first map that reaches past the point, blended into the next one near its end; the last one blends into light.
Shadow shadow_by_depth(vec3 point, vec3 normal, float eye_depth) {
    for (int map = 0; map < frame.map_count; ++map) {
        float blend_begin = frame.maps[map].blend_begin;
        float depth_end = frame.maps[map].depth_end;
        if (!(eye_depth < depth_end)) continue;
        float here = map_visibility(map, point, normal);
        if (!(eye_depth > blend_begin)) return Shadow(map, here);
        float next = map + 1 < frame.map_count ? map_visibility(map + 1, point, normal) : 1.0;
        return Shadow(map, mix(here, next, (eye_depth - blend_begin) / (depth_end - blend_begin)));
    }
    return Shadow(-1, 1.0);
}

// The first map that holds the point and every texel that its filter touches.
Shadow shadow_by_map(vec3 point, vec3 normal) {
    for (int map = 0; map < frame.map_count; ++map) {
        Projected p = project_to_map(map, point);
        if (is_inside(p, float(frame.filter_radius + 1)) && p.ndc.z <= 1.0)
            return Shadow(map, map_visibility(map, point, normal));
    }
    return Shadow(-1, 1.0);
}

Shadow shadow_at(vec3 point, vec3 normal, float eye_depth) {
    return frame.choice == choose_by_depth ? shadow_by_depth(point, normal, eye_depth) : shadow_by_map(point, normal);
}
