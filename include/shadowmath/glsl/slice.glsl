// SPDX-License-Identifier: MIT
//
// What splits have in common, however they were found: the GLSL twin of slice.hpp's fading. Equal to the C++ bit for
// bit on every processor.
#ifndef SM_SLICE_GLSL
#define SM_SLICE_GLSL

const int sm_max_splits = 16;

// Where the last `share` of [begin, end] starts; never before begin.
float sm_fade_begin(float begin, float end, float share) {
    precise float at = end - 2.0 * (share * (end * 0.5 - begin * 0.5));
    return at > begin && at <= end ? at : begin;
}

#endif
