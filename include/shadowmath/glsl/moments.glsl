// SPDX-License-Identifier: MIT
//
// What filterable shadow maps share: the GLSL twin of moments.hpp, equal to it bit for bit where the driver divides as
// IEEE 754 does (Mesa's software drivers). Depths are in [0, 1] and grow away from the light: 1 - depth of a map whose
// depth is reversed.
#ifndef SM_MOMENTS_GLSL
#define SM_MOMENTS_GLSL

#include "filter.glsl"

float sm_unit_depth(float depth) {
    return depth > 0.0 ? (depth < 1.0 ? depth : 1.0) : 0.0;
}

// Within [0, 1]; light for what is not a number.
float sm_share_or_light(float share) {
    return share < 1.0 ? (share > 0.0 ? share : 0.0) : 1.0;
}

// Mean of the moments over the box of filter.glsl; texels outside of the map count as `outside`. A blurred map read
// through a linear sampler needs none of this.
vec4 sm_mean_moments(sampler2DArray moments, int layer, vec2 texel, int map_size, int filter_radius, vec4 outside) {
    int radius = clamp(filter_radius, 0, sm_largest_filter_radius);
    float reach = float(radius + 1);
    float size = float(map_size);
    if (map_size < 1 || map_size > sm_largest_map_size || !sm_all_finite(texel)) return outside;
    if (!(texel.x >= -reach && texel.y >= -reach && texel.x <= size + reach && texel.y <= size + reach)) return outside;
    vec2 home = floor(texel);
    precise vec2 fraction = texel - home;
    precise vec4 mean = vec4(0.0);
    for (int j = -radius; j <= radius; ++j) {
        for (int i = -radius; i <= radius; ++i) {
            ivec2 at = ivec2(home) + ivec2(i, j);
            bool inside = at.x >= 0 && at.y >= 0 && at.x < map_size && at.y < map_size;
            precise float weight = sm_tap_weight(i, radius, fraction.x) * sm_tap_weight(j, radius, fraction.y);
            precise vec4 weighted = (inside ? texelFetch(moments, ivec3(at, layer), 0) : outside) * weight;
            mean += weighted;
        }
    }
    return mean;
}

// Takes the faint light out of overlapping shadows: shares below `amount` [0, 1) become 0, the rest is stretched.
float sm_less_bleeding(float visibility, float amount) {
    if (!sm_all_finite(visibility) || !sm_all_finite(amount)) return 1.0;
    float cut = amount > 0.0 ? (amount < 0.99 ? amount : 0.99) : 0.0;
    precise float share = (visibility - cut) / (1.0 - cut);
    return share < 1.0 ? (share > 0.0 ? share : 0.0) : 1.0;
}

#endif
