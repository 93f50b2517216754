// SPDX-License-Identifier: MIT
//
// A program that answers for functions of the library: each invocation takes its own words, as many as the host gives,
// and leaves as many as the host expects. Numbers travel as bits, so that NaN and denormals arrive.
// Whoever includes this defines answer(function).

layout(local_size_x = 64) in;

layout(std140, binding = 0) uniform Question {
    uint function;
    uint count;
    uint words_given;
    uint words_found;
};
layout(std430, binding = 1) readonly buffer Given {
    uint given[];
};
layout(std430, binding = 2) writeonly buffer Found {
    uint found[];
};

uint reading = 0u;
uint writing = 0u;

float take() {
    return uintBitsToFloat(given[reading++]);
}
int take_int() {
    return int(given[reading++]);
}
bool take_bool() {
    return given[reading++] != 0u;
}
vec2 take2() {
    float x = take();
    return vec2(x, take());
}
vec3 take3() {
    vec2 xy = take2();
    return vec3(xy, take());
}
vec4 take4() {
    vec2 xy = take2();
    return vec4(xy, take2());
}
mat4 take_mat4() {
    mat4 m;
    for (int i = 0; i < 4; ++i) m[i] = take4();
    return m;
}

void give(float v) {
    found[writing++] = floatBitsToUint(v);
}
void give(int v) {
    found[writing++] = uint(v);
}
void give(uint v) {
    found[writing++] = v;
}
void give(bool v) {
    found[writing++] = v ? 1u : 0u;
}
void give(vec2 v) {
    give(v.x);
    give(v.y);
}
void give(vec3 v) {
    give(v.xy);
    give(v.z);
}
void give(vec4 v) {
    give(v.xy);
    give(v.zw);
}
void give(mat4 m) {
    for (int i = 0; i < 4; ++i) give(m[i]);
}

void answer(uint function);

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    reading = i * words_given;
    writing = i * words_found;
    answer(function);
}
