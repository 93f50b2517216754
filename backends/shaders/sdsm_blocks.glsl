// SPDX-License-Identifier: MIT
//
// What the five passes of a sample-distribution fit share: sdsm_begin, sdsm_depths, sdsm_splits, sdsm_bounds and
// sdsm_maps, run in this order. After the last one the maps' constants lie in a buffer for the passes that draw and
// read the maps; nothing returns to the CPU.

#include "shadowmath/glsl/sample_layout.glsl"

layout(std140, binding = 0) uniform Fit {
    sm_SampleFit fit;
};

layout(std430, binding = 1) buffer State {
    sm_SampleState state;
};

// A group looks at so many pixels, 16 a thread.
const int tile_size = 64;
