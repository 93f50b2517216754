// SPDX-License-Identifier: MIT
//
// Takes the structs of layout.glsl.
#include "twin.glsl"
#include "shadowmath/glsl/layout.glsl"

sm_ShadowMap take_map() {
    sm_ShadowMap map;
    map.clip_from_world = take_mat4();
    map.w_min = take();
    map.depth_order = take_int();
    map.flip_v = take_int();
    map.visible = take_int();
    return map;
}

sm_MapBias take_bias() {
    sm_MapBias bias;
    bias.constant = take();
    bias.per_inverse_w = take();
    bias.slope_texels = take();
    bias.slope_limit = take();
    return bias;
}
