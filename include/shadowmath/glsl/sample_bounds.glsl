// SPDX-License-Identifier: MIT
//
// Where a sample lies and which splits it counts for: the GLSL twin of sample_bounds.hpp. Bit for bit equal to the C++
// on every processor.
#ifndef SM_SAMPLE_BOUNDS_GLSL
#define SM_SAMPLE_BOUNDS_GLSL

#include "sample_layout.glsl"

// Light space relative to the eye, metres.
vec3 sm_from_eye(sm_SampleFit fit, ivec2 pixel, float depth) {
    precise vec2 side = fit.first_step.xy + fit.first_step.zw * vec2(pixel);
    precise vec3 aside = fit.right.xyz * side.x + fit.up.xyz * side.y;
    precise vec3 spread = (fit.forward.xyz + aside) * depth;
    precise vec3 parallel = fit.forward.xyz * depth + aside;
    return fit.flags.x == 0 ? spread : parallel;
}

bool sm_is_served(vec4 range, float depth) {
    precise float later = depth * 1.000244140625;
    precise float sooner = depth * 0.999755859375;
    return later >= range.x && sooner < range.z;
}

#endif
