// SPDX-License-Identifier: MIT
//
// Takes the structs of soft shadows.
#include "twin_map.glsl"
#include "shadowmath/glsl/pcss.glsl"

sm_MapPenumbra take_penumbra() {
    sm_MapPenumbra penumbra;
    penumbra.rim_x = take4();
    penumbra.rim_y = take4();
    penumbra.depth_of_gap = take();
    penumbra.largest_gap = take();
    return penumbra;
}

void give(sm_SoftShadow shadow) {
    give(shadow.visibility);
    give(shadow.gap);
    give(shadow.blocked);
}
