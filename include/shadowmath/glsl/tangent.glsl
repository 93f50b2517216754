// SPDX-License-Identifier: MIT
//
// What a projective matrix does to a point and to the small piece of plane around it: the GLSL twin of tangent.hpp, and
// equal to it bit for bit where the driver divides as IEEE 754 does (Mesa's software drivers); else each division may
// add 2.5 ulp.
#ifndef SM_TANGENT_GLSL
#define SM_TANGENT_GLSL

#include "finite.glsl"

// matrix * (point, 1) with its order of sums written out, and kept: a caster, its receiver, the C++ and every driver
// with any compiler of this text round alike.
vec4 sm_transformed(mat4 matrix, vec3 point) {
    precise vec4 clip = matrix[0] * point.x + (matrix[1] * point.y + (matrix[2] * point.z + matrix[3]));
    return clip;
}

struct sm_Projected {
    vec3 at;        // after the division by w
    float w;        // before it
    bool in_front;  // w exceeds w_min and 0, and at is finite; otherwise at is 0 and w is 1
};

// Finite for every matrix and point.
sm_Projected sm_projected(mat4 matrix, vec3 point, float w_min) {
    sm_Projected outside = sm_Projected(vec3(0.0), 1.0, false);
    if (!sm_all_finite(matrix) || !sm_all_finite(point)) return outside;
    vec4 clip = sm_transformed(matrix, point);
    if (!(clip.w > 0.0) || !(clip.w > w_min)) return outside;
    precise vec3 at = clip.xyz / clip.w;
    if (!sm_all_finite(at) || !sm_all_finite(clip.w)) return outside;
    return sm_Projected(at, clip.w, true);
}

// The change of at for a metre along the direction, to first order.
vec3 sm_gain_along(mat4 matrix, sm_Projected point, vec3 direction) {
    precise vec4 clip = matrix[0] * direction.x + (matrix[1] * direction.y + matrix[2] * direction.z);
    precise vec3 gain = (clip.xyz - point.at * clip.w) / point.w;
    return gain;
}

struct sm_Tangents {
    vec3 s;  // unit, orthogonal to each other and to the normal; zero when ok is false
    vec3 t;
    bool ok;
};

// Two axes of the plane with this normal, of any length but zero.
sm_Tangents sm_tangents(vec3 normal) {
    sm_Normalized unit = sm_safe_normalize(normal);
    if (!unit.ok) return sm_Tangents(vec3(0.0), vec3(0.0), false);
    vec3 n = unit.direction;
    vec3 aside = abs(n.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 s = sm_safe_normalize(sm_cross(n, aside)).direction;
    return sm_Tangents(s, sm_cross(n, s), true);
}

// Within [-limit, limit] whatever a and b are: a / 0 is the limit with the sign of a, 0 / 0 is 0.
float sm_bounded_quotient(float a, float b, float limit) {
    if (a == 0.0) return 0.0;
    precise float bound = limit * abs(b);
    precise float quotient = a / b;
    if (abs(a) < bound) return quotient;
    return (a < 0.0) == (b < 0.0) ? limit : -limit;
}

#endif
