// SPDX-License-Identifier: MIT
#version 450
#include "twin.glsl"
#include "shadowmath/glsl/footprint.glsl"

void give_footprint(sm_Footprint footprint) {
    give(footprint.major);
    give(footprint.minor);
}

void answer(uint function) {
    vec2 pair;
    mat4 eye, map;
    float texels;
    vec3 point;
    switch (function) {
        case 0u:
            pair = take2();
            give(sm_hypot(pair.x, pair.y));
            break;
        case 1u:
            pair = take2();
            give(sm_area(sm_Footprint(pair.x, pair.y)));
            break;
        case 2u:
            pair = take2();
            give_footprint(sm_texels_per_pixel(sm_Footprint(pair.x, pair.y)));
            break;
        case 3u:
            eye = take_mat4();
            pair = take2();
            map = take_mat4();
            texels = take();
            point = take3();
            give_footprint(sm_footprint(eye, pair, map, texels, point, take3()));
            break;
        case 4u:
            map = take_mat4();
            point = take3();
            pair = take2();
            sm_ScaledColumns gains = sm_gains_on_plane(map, sm_projected(map, point, 0.0), sm_tangents(take3()), pair);
            give(gains.s);
            give(gains.t);
            give(gains.scale);
    }
}
