// SPDX-License-Identifier: MIT
#version 450
#include "twin.glsl"
#include "shadowmath/glsl/by_footprint.glsl"

void answer(uint function) {
    sm_FinestMaps finest = sm_no_maps();
    int count = take_int();
    for (int i = 0; i < 6; ++i) {
        float major = take();
        if (i < count) finest = sm_with_map(finest, i, major);
    }
    sm_LookUp look_up = sm_look_up_in(finest, take());
    give(look_up.first);
    give(look_up.second);
    give(look_up.blend);
}
