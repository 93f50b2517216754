// SPDX-License-Identifier: MIT
//
// Everything that a pass can be given: uniforms, storage to read and to write, an atomic, a texture.
#version 450

layout(local_size_x = 64) in;

layout(std140, binding = 0) uniform Uniforms {
    uint count;
    float factor;
};
layout(std430, binding = 1) buffer Values {
    float value[];
};
layout(std430, binding = 2) buffer Counted {
    uint above_one;
};
layout(binding = 3) uniform sampler2DArray layers;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    value[i] = value[i] * factor + texelFetch(layers, ivec3(i % 2u, 0, 1), 0).r;
    if (value[i] > 1.0) atomicAdd(above_one, 1u);
}
