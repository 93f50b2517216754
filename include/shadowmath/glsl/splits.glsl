// SPDX-License-Identifier: MIT
//
// Where to cut the view along its depth: the GLSL twin of the practical splits of splits.hpp and of slice.hpp, for
// shaders that find the range of depths themselves (sample-distribution shadow maps).
//
// Planes lie within 96 ulp of the C++ (22 seen): powers differ, ends and uniform planes are equal bit for bit. Where
// z_near and z_far are so close that planes fall together, the two may keep different ones.
#ifndef SM_SPLITS_GLSL
#define SM_SPLITS_GLSL

#include "finite.glsl"
#include "slice.glsl"

// Those of fault.hpp that splits can have.
const uint sm_fault_not_finite = 1u << 0;
const uint sm_fault_near_clamped = 1u << 2;
const uint sm_fault_empty_range = 1u << 3;
const uint sm_fault_count_clamped = 1u << 7;
const uint sm_fault_clamped_option = 1u << 8;

struct sm_Splits {
    float plane[sm_max_splits + 1];  // plane[0] = n, plane[count] = f, exactly; the rest is zero
    int count;                       // splits, one fewer than planes; 0: nothing to see
    uint faults;
};

// The root of order `count` of a ratio in [1, 2^64]. pow() of a driver may be off by thousands of ulp; one step of
// Newton's method on r^count = ratio leaves its square.
float sm_root(float ratio, int count) {
    precise float root = pow(ratio, 1.0 / float(count));
    precise float power = 1.0;
    for (int i = 1; i < count; ++i) power *= root;
    precise float better = root - (power * root - ratio) / (float(count) * power);
    return better;
}

// Ends exact, strictly increasing, between the uniform and the logarithmic planes; lambda = 1 is logarithmic, 0
// uniform. 0 <= z_near < z_far < infinity. Where no ratio of distances exists (z_near = 0, or below 2^-64 of z_far) the
// logarithmic part starts at 2^-20 of z_far (near_clamped).
sm_Splits sm_practical_splits(float z_near, float z_far, int count, float lambda) {
    sm_Splits splits;
    for (int i = 0; i <= sm_max_splits; ++i) splits.plane[i] = 0.0;
    splits.count = 0;
    splits.faults = 0u;
    if (!sm_all_finite(z_near) || !sm_all_finite(z_far)) {
        splits.faults = sm_fault_not_finite;
    } else if (!(z_near >= 0.0) || !(z_near < z_far)) {
        splits.faults = sm_fault_empty_range;
    } else {
        splits.count = clamp(count, 0, sm_max_splits);
        if (splits.count != count) splits.faults |= sm_fault_count_clamped;
    }
    float weight = sm_all_finite(lambda) ? clamp(lambda, 0.0, 1.0) : 0.5;
    if (weight != lambda) splits.faults |= sm_fault_clamped_option;
    if (splits.count == 0) return splits;

    bool has_ratio = z_near > z_far * 5.42101086e-20;  // 2^-64
    if (weight > 0.0 && !has_ratio) splits.faults |= sm_fault_near_clamped;
    precise float ratio = has_ratio ? z_far / z_near : 1048576.0;
    precise float logarithmic = has_ratio ? z_near : z_far / ratio;
    float step_of_ratio = sm_root(ratio, splits.count);
    int kept = 0;
    splits.plane[0] = z_near;
    for (int i = 1; i < splits.count; ++i) {
        precise float fraction = float(i) / float(splits.count);
        precise float uniform_plane = z_near + (z_far - z_near) * fraction;
        logarithmic *= step_of_ratio;
        precise float logarithmic_part = weight > 0.0 ? weight * logarithmic : 0.0;
        precise float plane = logarithmic_part + (1.0 - weight) * uniform_plane;
        if (plane > splits.plane[kept] && plane < z_far) splits.plane[++kept] = plane;
    }
    splits.plane[++kept] = z_far;
    if (kept != splits.count) splits.faults |= sm_fault_count_clamped;
    splits.count = kept;
    return splits;
}

struct sm_SliceRange {
    float begin;        // eye depth, metres: the map must hold everything from here
    float blend_begin;  // fading into the next map starts here; equal to end where nothing follows
    float end;          // to here
};

// Metres of eye depth that split `index` must serve; `blend` in [0, 1] is the fraction of each split that fades.
sm_SliceRange sm_slice_range(sm_Splits splits, int index, float blend) {
    float share = blend > 0.0 ? (blend < 1.0 ? blend : 1.0) : 0.0;
    float begin = splits.plane[index];
    float end = splits.plane[index + 1];
    sm_SliceRange range = sm_SliceRange(begin, end, end);
    if (index > 0) range.begin = sm_fade_begin(splits.plane[index - 1], begin, share);
    if (index + 1 < splits.count) range.blend_begin = sm_fade_begin(begin, end, share);
    return range;
}

#endif
