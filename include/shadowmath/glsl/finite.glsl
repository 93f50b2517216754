// SPDX-License-Identifier: MIT
//
// Is it a number, and how long is it: the GLSL twin of finite.hpp.
//
// Bits decide, for a compiler may take isnan() for false. Equal to the C++ bit for bit where the driver divides and
// takes roots as IEEE 754 does and keeps denormals (Mesa's software drivers); where it flushes denormals they are
// zeros.
#ifndef SM_FINITE_GLSL
#define SM_FINITE_GLSL

// True when no component is NaN or infinite.
bool sm_all_finite(float v) {
    return (floatBitsToUint(v) & 0x7f800000u) != 0x7f800000u;
}
bool sm_all_finite(vec2 v) {
    return sm_all_finite(v.x) && sm_all_finite(v.y);
}
bool sm_all_finite(vec3 v) {
    return sm_all_finite(v.x) && sm_all_finite(v.y) && sm_all_finite(v.z);
}
bool sm_all_finite(vec4 v) {
    return sm_all_finite(v.xy) && sm_all_finite(v.zw);
}
bool sm_all_finite(mat4 m) {
    return sm_all_finite(m[0]) && sm_all_finite(m[1]) && sm_all_finite(m[2]) && sm_all_finite(m[3]);
}

// dot() and cross() with their order of sums written out, and kept.
float sm_dot(vec3 a, vec3 b) {
    precise float sum = a.x * b.x + a.y * b.y + a.z * b.z;
    return sum;
}
float sm_dot(vec4 a, vec4 b) {
    precise float sum = (a.x * b.x + a.y * b.y) + (a.z * b.z + a.w * b.w);
    return sum;
}
vec3 sm_cross(vec3 a, vec3 b) {
    precise vec3 c = vec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
    return c;
}

struct sm_Normalized {
    vec3 direction;  // unit, or zero when ok is false
    float size;      // length of the input; may overflow to infinity
    bool ok;
};

// Unit for every finite vector but zero: nothing overflows. A vector with a NaN or an infinity is as good as zero.
sm_Normalized sm_safe_normalize(vec3 v) {
    float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    if (!sm_all_finite(v) || !(largest > 0.0)) return sm_Normalized(vec3(0.0), 0.0, false);
    // A driver that divides by way of the reciprocal loses what is very short or very long: a power of two first.
    float power = largest < 7.88860905e-31 ? 1.26765060e30 : (largest > 1.26765060e30 ? 7.88860905e-31 : 1.0);
    precise vec3 scaled = (v * power) / (largest * power);
    precise float size = sqrt(sm_dot(scaled, scaled));
    precise vec3 direction = scaled / size;
    precise float whole = size * largest;
    return sm_Normalized(direction, whole, true);
}

#endif
