// SPDX-License-Identifier: MIT
#version 450
#include "twin_soft.glsl"

layout(binding = 3) uniform sampler2DArray depths;

void answer(uint function) {
    sm_Receiver receiver;
    sm_ShadowMap map;
    sm_MapBias bias;
    sm_MapPenumbra penumbra;
    int layer, size, order, search_taps, filter_taps;
    float w;
    vec3 point, normal;
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
    }
}
