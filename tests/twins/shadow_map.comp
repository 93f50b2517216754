// SPDX-License-Identifier: MIT
#version 450
#include "twin_map.glsl"
#include "shadowmath/glsl/shadow_map.glsl"

void answer(uint function) {
    switch (function) {
        case 0u: give(sm_texture_from_world(take_map())); break;
        case 1u: give(sm_far_depth(take_int())); break;
        case 2u:
            vec3 depth = take3();
            give(sm_is_lit(depth.x, depth.y, depth.z, take_int()));
    }
}
