// SPDX-License-Identifier: MIT
#version 450
#include "twin_map.glsl"
#include "shadowmath/glsl/cascades.glsl"

layout(binding = 3) uniform sampler2DArray depths;

sm_Cascade take_cascade() {
    sm_Cascade cascade;
    cascade.map = take_map();
    cascade.bias = take_bias();
    return cascade;
}

void answer(uint function) {
    sm_Receiver receiver;
    sm_Cascade cascade, second;
    sm_LookUp look_up;
    int tap, layer, size, order, radius;
    vec3 point, normal;
    sm_Seen seen;
    switch (function) {
        case 0u:
            tap = take_int();
            radius = take_int();
            give(sm_covered_texels(tap, radius, take()));
            break;
        case 1u:
            tap = take_int();
            radius = take_int();
            give(sm_tap_weight(tap, radius, take()));
            break;
        case 2u:
            layer = take_int();
            receiver.texel = take2();
            receiver.depth = take();
            receiver.slope = take2();
            size = take_int();
            order = take_int();
            radius = take_int();
            give(sm_filtered(depths, layer, receiver, size, order, radius, take_bool()));
            break;
        case 3u:
            layer = take_int();
            cascade = take_cascade();
            size = take_int();
            point = take3();
            normal = take3();
            radius = take_int();
            give(sm_visibility(depths, layer, cascade.map, size, point, normal, cascade.bias, radius, take_bool()));
            break;
        case 4u:
            look_up.first = take_int();
            look_up.second = take_int();
            look_up.blend = take();
            cascade = take_cascade();
            second = take_cascade();
            size = take_int();
            point = take3();
            normal = take3();
            radius = take_int();
            give(sm_cascaded_visibility(depths, look_up, cascade, second, size, point, normal, radius, take_bool()));
            break;
        case 5u:
            cascade = take_cascade();
            size = take_int();
            point = take3();
            normal = take3();
            seen = sm_seen_by(cascade.map, size, point, normal, cascade.bias, take_bool());
            give(seen.receiver.texel);
            give(seen.receiver.depth);
            give(seen.receiver.slope);
            give(seen.w);
            give(seen.in_map);
            break;
        case 6u:
            layer = take_int();
            size = take_int();
            order = take_int();
            tap = take_int();
            radius = take_int();
            give(sm_is_tap_lit(depths, layer, size, order, ivec2(tap, radius), take()));
    }
}
