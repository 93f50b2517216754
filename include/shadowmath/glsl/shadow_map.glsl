// SPDX-License-Identifier: MIT
//
// From a map to its texture: the GLSL twin of shadow_map.hpp and of what a receiver needs of clip_space.hpp. Equal to
// the C++ bit for bit.
#ifndef SM_SHADOW_MAP_GLSL
#define SM_SHADOW_MAP_GLSL

#include "layout.glsl"

// Where the map holds a point: u, v and stored depth in [0, 1].
mat4 sm_texture_from_world(sm_ShadowMap map) {
    float v = map.flip_v == 0 ? 0.5 : -0.5;
    mat4 texture_from_world = map.clip_from_world;
    for (int i = 0; i < 4; ++i) {
        vec4 column = map.clip_from_world[i];
        precise vec3 at = vec3(0.5, v, 0.5) * column.xyz + 0.5 * column.w;
        texture_from_world[i] = vec4(at.xy, map.depth_order == sm_minus_one_to_one ? at.z : column.z, column.w);
    }
    return texture_from_world;
}

// The value that a map is cleared to, and that "nothing in the way" reads as.
float sm_far_depth(int depth_order) {
    return depth_order == sm_one_to_zero ? 0.0 : 1.0;
}

// Is the receiver at or before the occluder that the map stored? The bias is in favour of light, never negative.
bool sm_is_lit(float stored_depth, float receiver_depth, float bias, int depth_order) {
    precise float nearer = depth_order == sm_one_to_zero ? receiver_depth + bias : receiver_depth - bias;
    return depth_order == sm_one_to_zero ? nearer >= stored_depth : nearer <= stored_depth;
}

#endif
