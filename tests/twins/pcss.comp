// SPDX-License-Identifier: MIT
#version 450
#include "twin_soft.glsl"

layout(binding = 3) uniform sampler2DArray depths;

sm_TapPlane take_plane() {
    vec2 texel = take2();
    float depth = take();
    return sm_TapPlane(texel, depth, take2());
}

void answer(uint function) {
    sm_Receiver receiver;
    sm_ShadowMap map;
    sm_MapBias bias;
    sm_MapPenumbra penumbra;
    int layer, size, order, search_taps, filter_taps;
    float w;
    vec3 point, normal;
    sm_TapPlane plane;
    ivec2 texel;
    vec4 place;
    vec2 at;
    switch (function) {
        case 0u: give(sm_next_direction(take2())); break;
        case 1u:
            layer = take_int();
            receiver.texel = take2();
            receiver.depth = take();
            receiver.slope = take2();
            w = take();
            penumbra = take_penumbra();
            size = take_int();
            order = take_int();
            search_taps = take_int();
            filter_taps = take_int();
            give(sm_soft_filtered(depths, layer, receiver, w, penumbra, size, order, search_taps, filter_taps,
                                  take2()));
            break;
        case 2u:
            layer = take_int();
            map = take_map();
            bias = take_bias();
            penumbra = take_penumbra();
            size = take_int();
            point = take3();
            normal = take3();
            search_taps = take_int();
            filter_taps = take_int();
            give(sm_soft_visibility(depths, layer, map, size, point, normal, bias, penumbra, search_taps, filter_taps,
                                    take2()));
            break;
        case 3u:
            layer = take_int();
            size = take_int();
            order = take_int();
            texel.x = take_int();
            texel.y = take_int();
            give(sm_is_in_map(texel, size));
            give(sm_is_in_map(texel, size) ? sm_tap_depth(depths, layer, order, texel) : 0.0);
            plane = take_plane();
            give(sm_plane_depth(plane, texel));
            break;
        case 4u:
            size = take_int();
            place = take4();
            bool is_near = sm_texel_of(place, size, at);
            give(is_near);
            give(is_near ? at : vec2(0.0));
            break;
        case 5u:
            place = take4();
            give(sm_mean_of_four(place, take2()));
            break;
        case 6u:
            layer = take_int();
            plane = take_plane();
            place = take4();
            penumbra = take_penumbra();
            order = take_int();
            search_taps = take_int();
            give(sm_search(depths, layer, plane, place, penumbra, 32, order, search_taps, take2()));
            break;
        case 7u:
            layer = take_int();
            plane = take_plane();
            order = take_int();
            give(sm_lit_around(depths, layer, plane, 32, order, take2()));
            break;
        case 8u:
            layer = take_int();
            plane = take_plane();
            place = take4();
            penumbra = take_penumbra();
            order = take_int();
            texel.x = take_int();
            texel.y = take_int();
            w = take();
            give(sm_gap_in_cone(depths, layer, plane, penumbra, 32, order, texel, place, w, take()));
    }
}
