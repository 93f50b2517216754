// SPDX-License-Identifier: MIT
#version 450
#include "twin.glsl"
#include "shadowmath/glsl/splits.glsl"

sm_Splits take_splits() {
    float z_near = take();
    float z_far = take();
    int wanted = take_int();
    return sm_practical_splits(z_near, z_far, wanted, take());
}

void answer(uint function) {
    sm_Splits splits;
    sm_SliceRange range;
    int whole;
    switch (function) {
        case 0u:
            splits = take_splits();
            for (int i = 0; i <= sm_max_splits; ++i) give(splits.plane[i]);
            give(splits.count);
            give(splits.faults);
            break;
        case 1u:
            for (int i = 0; i <= sm_max_splits; ++i) splits.plane[i] = take();
            splits.count = take_int();
            splits.faults = 0u;
            whole = take_int();
            range = sm_slice_range(splits, whole, take());
            give(range.begin);
            give(range.blend_begin);
            give(range.end);
            break;
        case 2u:
            range.begin = take();
            range.end = take();
            give(sm_fade_begin(range.begin, range.end, take()));
            break;
        case 3u:
            range.begin = take();
            give(sm_root(range.begin, take_int()));
    }
}
