// SPDX-License-Identifier: MIT
#version 450
#include "twin_map.glsl"
#include "shadowmath/glsl/vdsm.glsl"

void answer(uint function) {
    vec3 vector;
    sm_ShadowPlane plane;
    sm_ShadowMap map;
    switch (function) {
        case 0u:
            vector = take3();
            plane = sm_plane_through(vector, take3());
            give(plane.normal);
            give(plane.offset);
            break;
        case 1u:
            plane.normal = take3();
            plane.offset = take();
            give(sm_plane_projection(plane, take4()));
            break;
        case 2u:
            map = take_map();
            give(sm_receiver_valid(map, take3()));
            break;
        case 3u: give(sm_over_largest(take4()));
    }
}
