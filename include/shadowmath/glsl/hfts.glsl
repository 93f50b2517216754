// SPDX-License-Identifier: MIT
//
// Hybrid frustum-traced shadows, exact in contact and soft far from it: the GLSL twin of hfts.hpp. Equal to the C++ bit
// for bit where the driver divides as IEEE 754 does (Mesa's software drivers).
#ifndef SM_HFTS_GLSL
#define SM_HFTS_GLSL

#include "pcss.glsl"

// What an exact test says of one receiver.
struct sm_ExactShadow {
    float visibility;  // share of its samples that are lit, [0, 1]
    float gap;         // of the occluder nearest to the receiver, >= 0
};

// Share of the soft answer: 0 in contact, growing in proportion to the gap, 1 from `soft_gap` on.
float sm_softness(float gap, float soft_gap) {
    if (!sm_all_finite(gap) || !sm_all_finite(soft_gap)) return 0.0;
    if (!(gap < soft_gap)) return 1.0;
    precise float share = gap / soft_gap;
    return gap > 0.0 ? share : 0.0;
}

// Between the two answers, the exact one in contact; 1 where neither found an occluder.
float sm_hybrid_visibility(sm_ExactShadow exact, sm_SoftShadow soft, float soft_gap) {
    if (!sm_all_finite(exact.visibility)) return 1.0;
    float hard = exact.visibility > 0.0 ? (exact.visibility < 1.0 ? exact.visibility : 1.0) : 0.0;
    if (!sm_all_finite(soft.visibility) || !sm_all_finite(soft.gap) || !sm_all_finite(exact.gap)) return hard;
    bool traced = hard < 1.0;
    if (!traced && !soft.blocked) return 1.0;
    float gap = traced ? exact.gap : soft.gap;
    if (traced && soft.blocked && soft.gap < gap) gap = soft.gap;
    float mixed_in = soft.visibility > 0.0 ? (soft.visibility < 1.0 ? soft.visibility : 1.0) : 0.0;
    float share = sm_softness(gap, soft_gap);
    precise float mixed = hard * (1.0 - share) + mixed_in * share;
    return mixed;
}

#endif
