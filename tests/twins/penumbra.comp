// SPDX-License-Identifier: MIT
#version 450
#include "twin_soft.glsl"

void answer(uint function) {
    sm_MapPenumbra penumbra;
    vec4 place;
    vec3 point;
    vec2 u;
    float number;
    int size;
    switch (function) {
        case 0u:
            number = take();
            give(sm_penumbra_metres(number, take()));
            break;
        case 1u:
            place = take4();
            point = take3();
            give(sm_gap_of_metres(place, point, take()));
            break;
        case 2u:
            place = take4();
            point = take3();
            give(sm_metres_of_gap(place, point, take()));
            break;
        case 3u:
            penumbra = take_penumbra();
            place = take4();
            u = take2();
            give(sm_across(penumbra, place, u, take()));
            break;
        case 4u:
            penumbra = take_penumbra();
            place = take4();
            give(sm_gap_at(penumbra, place, take()));
            break;
        case 5u:
            penumbra = take_penumbra();
            place = take4();
            size = take_int();
            give(sm_kernel_texels(penumbra, place, size, take()));
            break;
        case 6u: give(sm_is_finite(take_penumbra()));
    }
}
