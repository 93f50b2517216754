// SPDX-License-Identifier: MIT
//
// View-dependent shadow maps in the shader: the projection along the light onto a plane, and whether a map can answer
// for a receiver. The GLSL twin of that part of vdsm.hpp, equal to it bit for bit where the driver divides as IEEE 754
// does (Mesa's software drivers).
#ifndef SM_VDSM_GLSL
#define SM_VDSM_GLSL

#include "layout.glsl"
#include "tangent.glsl"

// The points p with normal . p + offset = 0. Neither length nor sign of the normal matters.
struct sm_ShadowPlane {
    vec3 normal;
    float offset;
};

sm_ShadowPlane sm_plane_through(vec3 point, vec3 normal) {
    vec3 unit = sm_safe_normalize(normal).direction;
    return sm_ShadowPlane(unit, -sm_dot(unit, point));
}

vec4 sm_over_largest(vec4 v) {
    float largest = max(max(abs(v.x), abs(v.y)), max(abs(v.z), abs(v.w)));
    precise vec4 scaled = v / largest;
    return largest > 0.0 ? scaled : v;
}

// Moves points along the rays of the light onto the plane: I - l pi^T / (pi . l). `homogeneous_light` is (direction, 0)
// of a sun, (-position, -1) of a spot. The identity where the plane contains the light, or an input is not finite.
mat4 sm_plane_projection(sm_ShadowPlane plane, vec4 homogeneous_light) {
    vec4 pi = vec4(plane.normal, plane.offset);
    if (!sm_all_finite(pi) || !sm_all_finite(homogeneous_light)) return mat4(1.0);
    pi = sm_over_largest(pi);
    vec4 light = sm_over_largest(homogeneous_light);
    float height = sm_dot(pi, light);
    if (!(abs(height) > 1e-30)) return mat4(1.0);
    precise vec4 along = pi / height;
    mat4 projection = mat4(1.0);
    for (int i = 0; i < 4; ++i) {
        precise vec4 column = projection[i] - light * along[i];
        projection[i] = column;
    }
    return projection;
}

// Whether the map can answer for a receiver at all: where w is at or below w_min, its light ray meets the plane behind
// the eye. Where true, the usual test of the map's sides still applies.
bool sm_receiver_valid(sm_ShadowMap map, vec3 point) {
    mat4 m = map.clip_from_world;
    return map.visible != 0 && sm_dot(vec4(m[0].w, m[1].w, m[2].w, m[3].w), vec4(point, 1.0)) > map.w_min;
}

#endif
