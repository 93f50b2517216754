// SPDX-License-Identifier: MIT
#version 450
#include "twin.glsl"
#include "shadowmath/glsl/hfts.glsl"

void answer(uint function) {
    sm_ExactShadow exact;
    sm_SoftShadow soft;
    float gap;
    switch (function) {
        case 0u:
            gap = take();
            give(sm_softness(gap, take()));
            break;
        case 1u:
            exact.visibility = take();
            exact.gap = take();
            soft.visibility = take();
            soft.gap = take();
            soft.blocked = take_bool();
            give(sm_hybrid_visibility(exact, soft, take()));
    }
}
