// SPDX-License-Identifier: MIT
//
// The one number: how many eye pixels one texel of a shadow map covers, at a point of a surface. The GLSL twin of
// footprint.hpp, within 12 ulp of it where the driver divides as IEEE 754 does (Mesa's software drivers): GLSL has no
// hypot. Draw it as a heat map, or choose among maps by it.
#ifndef SM_FOOTPRINT_GLSL
#define SM_FOOTPRINT_GLSL

#include "tangent.glsl"

struct sm_Footprint {
    float major;  // eye pixels per texel along the axis where a texel is longest in the picture
    float minor;  // and across it; 0 <= minor <= major <= sm_footprint_limit
};

// What a footprint is where the map sees the surface edge-on, or does not see it at all.
const float sm_footprint_limit = 1e6;

// Eye pixels, as an area.
float sm_area(sm_Footprint footprint) {
    precise float area = footprint.major * footprint.minor;
    return area;
}

// The same seen from the map: the axes, in texels, of one eye pixel.
sm_Footprint sm_texels_per_pixel(sm_Footprint footprint) {
    return sm_Footprint(sm_bounded_quotient(1.0, footprint.minor, sm_footprint_limit),
                        sm_bounded_quotient(1.0, footprint.major, sm_footprint_limit));
}

// The length of (a, b), to 4 ulp; neither square over- nor underflows.
float sm_hypot(float a, float b) {
    float longer = max(abs(a), abs(b));
    float shorter = min(abs(a), abs(b));
    if (!(longer > 0.0)) return 0.0;
    precise float share = shorter / longer;
    precise float size = longer * sqrt(1.0 + share * share);
    return size;
}

// Columns of a 2x2 matrix over their largest entry, so that no product of two under- or overflows.
struct sm_ScaledColumns {
    vec2 s;
    vec2 t;
    float scale;
};

sm_ScaledColumns sm_gains_on_plane(mat4 matrix, sm_Projected point, sm_Tangents plane, vec2 half_size) {
    precise vec2 s = sm_gain_along(matrix, point, plane.s).xy * half_size;
    precise vec2 t = sm_gain_along(matrix, point, plane.t).xy * half_size;
    float scale = max(max(abs(s.x), abs(s.y)), max(abs(t.x), abs(t.y)));
    if (!sm_all_finite(s) || !sm_all_finite(t) || !(scale > 0.0)) return sm_ScaledColumns(vec2(0.0), vec2(0.0), 0.0);
    precise vec2 a = s / scale;
    precise vec2 b = t / scale;
    return sm_ScaledColumns(a, b, scale);
}

// Exact on the tangent plane of `normal` (of any length and either sign) at `point`, both in world space. 0 where the
// eye does not see the point and where something is not finite; sm_footprint_limit where the map does not hold it, or
// sees the plane edge-on.
sm_Footprint sm_footprint(mat4 eye_clip_from_world, vec2 eye_pixels, mat4 map_clip_from_world, float map_texels,
                          vec3 point, vec3 normal) {
    sm_Footprint none = sm_Footprint(0.0, 0.0);
    sm_Footprint unseen = sm_Footprint(sm_footprint_limit, sm_footprint_limit);
    sm_Projected in_eye = sm_projected(eye_clip_from_world, point, 0.0);
    sm_Tangents plane = sm_tangents(normal);
    bool sizes = sm_all_finite(eye_pixels) && eye_pixels.x > 0.0 && eye_pixels.y > 0.0;
    if (!in_eye.in_front || !plane.ok || !sizes) return none;
    sm_ScaledColumns eye = sm_gains_on_plane(eye_clip_from_world, in_eye, plane, eye_pixels * 0.5);
    if (!(eye.scale > 0.0)) return none;

    sm_Projected in_map = sm_projected(map_clip_from_world, point, 0.0);
    if (!in_map.in_front || !sm_all_finite(map_texels) || !(map_texels > 0.0)) return unseen;
    sm_ScaledColumns map = sm_gains_on_plane(map_clip_from_world, in_map, plane, vec2(map_texels * 0.5));
    if (!(map.scale > 0.0)) return unseen;

    // J * det(map) = eye * adjugate(map), the 2x2 matrix (a b; c d).
    precise float map_det = map.s.x * map.t.y - map.s.y * map.t.x;
    precise float eye_det = eye.s.x * eye.t.y - eye.s.y * eye.t.x;
    precise float a = eye.s.x * map.t.y - eye.t.x * map.s.y;
    precise float b = eye.t.x * map.s.x - eye.s.x * map.t.x;
    precise float c = eye.s.y * map.t.y - eye.t.y * map.s.y;
    precise float d = eye.t.y * map.s.x - eye.s.y * map.t.x;
    precise float stretch = (sm_hypot(a + d, c - b) + sm_hypot(a - d, c + b)) * 0.5;
    float pixels_per_texel = sm_bounded_quotient(eye.scale, map.scale, sm_footprint_limit * sm_footprint_limit);
    precise float longest = stretch * pixels_per_texel;
    precise float whole = abs(eye_det) * pixels_per_texel;
    float major = sm_bounded_quotient(longest, abs(map_det), sm_footprint_limit);
    return sm_Footprint(major, min(sm_bounded_quotient(whole, stretch, sm_footprint_limit), major));
}

#endif
