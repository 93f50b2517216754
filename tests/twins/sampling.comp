// SPDX-License-Identifier: MIT
#version 450
#include "twin_map.glsl"
#include "shadowmath/glsl/sampling.glsl"

sm_LookUp take_look_up() {
    int first = take_int();
    int second = take_int();
    return sm_LookUp(first, second, take());
}

sm_Ranges take_ranges() {
    sm_Ranges ranges;
    for (int i = 0; i < 4; ++i) ranges.blend_begin[i] = take4();
    for (int i = 0; i < 4; ++i) ranges.end[i] = take4();
    return ranges;
}

void answer(uint function) {
    sm_ShadowMap map;
    sm_LookUp look_up;
    sm_Ranges ranges;
    int whole;
    float number;
    vec3 ambient, diffuse, specular;
    vec2 pair;
    switch (function) {
        case 0u:
            map = take_map();
            whole = take_int();
            number = take();
            give(sm_contains(map, whole, number, take3()));
            break;
        case 1u:
            ranges = take_ranges();
            whole = take_int();
            look_up = sm_by_depth(ranges, whole, take());
            give(look_up.first);
            give(look_up.second);
            give(look_up.blend);
            break;
        case 2u:
            look_up = take_look_up();
            pair = take2();
            give(sm_blended(look_up, pair.x, pair.y));
            break;
        case 3u:
            ambient = take3();
            diffuse = take3();
            specular = take3();
            number = take();
            give(sm_shade(ambient, diffuse, specular, number, take3()));
    }
}
