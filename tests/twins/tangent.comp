// SPDX-License-Identifier: MIT
#version 450
#include "twin.glsl"
#include "shadowmath/glsl/tangent.glsl"

void give_normalized(sm_Normalized unit) {
    give(unit.direction);
    give(unit.size);
    give(unit.ok);
}

void give_projected(sm_Projected point) {
    give(point.at);
    give(point.w);
    give(point.in_front);
}

void give_tangents(sm_Tangents plane) {
    give(plane.s);
    give(plane.t);
    give(plane.ok);
}

sm_Projected take_projected() {
    mat4 matrix = take_mat4();
    vec3 point = take3();
    return sm_projected(matrix, point, take());
}

void answer(uint function) {
    mat4 matrix;
    sm_Projected point;
    switch (function) {
        case 0u: give(sm_all_finite(take3())); break;
        case 1u: give_normalized(sm_safe_normalize(take3())); break;
        case 2u:
            matrix = take_mat4();
            give(sm_transformed(matrix, take3()));
            break;
        case 3u: give_projected(take_projected()); break;
        case 4u:
            matrix = take_mat4();
            point = sm_projected(matrix, take3(), 0.0);
            give(sm_gain_along(matrix, point, take3()));
            break;
        case 5u: give_tangents(sm_tangents(take3())); break;
        case 6u:
            vec3 quotient = take3();
            give(sm_bounded_quotient(quotient.x, quotient.y, quotient.z));
            break;
        case 7u:
            matrix = take_mat4();
            give(sm_all_finite(matrix));
            give(sm_all_finite(matrix[0]));
            give(sm_all_finite(matrix[1].xy));
            give(sm_all_finite(matrix[2].x));
            break;
        case 8u:
            matrix = take_mat4();
            give(sm_dot(matrix[0].xyz, matrix[1].xyz));
            give(sm_dot(matrix[2], matrix[3]));
            give(sm_cross(matrix[0].xyz, matrix[1].xyz));
    }
}
