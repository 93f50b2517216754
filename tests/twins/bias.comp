// SPDX-License-Identifier: MIT
#version 450
#include "twin_map.glsl"
#include "shadowmath/glsl/bias.glsl"

void answer(uint function) {
    sm_ShadowMap map;
    sm_MapBias bias;
    int whole, radius;
    vec3 point, normal;
    float number;
    vec3 to_light;
    vec3 metres;
    switch (function) {
        case 0u:
            map = take_map();
            whole = take_int();
            point = take3();
            normal = take3();
            give(sm_slope(map, whole, point, normal, take()));
            break;
        case 1u:
            map = take_map();
            whole = take_int();
            point = take3();
            give(sm_lean(map, whole, point, take()));
            break;
        case 2u:
            bias = take_bias();
            number = take();
            give(sm_depth_bias(bias, number, take2()));
            break;
        case 3u: give(sm_kernel_reach_texels(take_int())); break;
        case 4u:
            number = take();
            whole = take_int();
            normal = take3();
            give(sm_normal_offset_metres(number, whole, normal, take3()));
            break;
        case 5u:
            map = take_map();
            whole = take_int();
            radius = take_int();
            point = take3();
            normal = take3();
            to_light = take3();
            metres = take3();
            give(sm_normal_offset_at(map, whole, radius, point, normal, to_light, metres.x, metres.y, metres.z));
    }
}
