// SPDX-License-Identifier: MIT
//
// Lists each pixel that the light may reach in every texel that its footprint touches, at the level whose texels are
// as large as the footprint: at most four nodes. Beside it, how far from the light each block of texels reaches, for
// the pass that follows to leave out what has nothing to darken. One invocation a pixel.
#version 450
#include "irregular_buffers.glsl"

layout(local_size_x = 64) in;

void list_in(uint pixel, int level, ivec2 texel) {
    uint node = atomicAdd(node_count, 1u);
    if (node >= node_capacity) return;
    uint head = uint(texels_before(level) + texel.y * level_size(level) + texel.x);
    nodes[node] = uvec2(pixel, atomicExchange(words[head], node + 1u));
}

void main() {
    uint pixel = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * 65535u * 64u;
    if (pixel >= uint(frame.width * frame.height)) return;
    ivec2 at = ivec2(int(pixel) % frame.width, int(pixel) / frame.width);
    vec3 position = vec3(receiver[6u * pixel], receiver[6u * pixel + 1u], receiver[6u * pixel + 2u]);
    vec3 normal = vec3(receiver[6u * pixel + 3u], receiver[6u * pixel + 4u], receiver[6u * pixel + 5u]);
    vec3 n = sm_normal_in_pixels(frame, normal);
    precise vec3 from_eye = position - frame.eye;
    float depth = sm_inner(frame.to_inward, from_eye);
    masks[pixel] = 0u;
    if (n == vec3(0.0) || !sm_all_finite(position)) return;
    sm_MicroQuad quad = sm_micro_quad(frame, at, depth, n);
    if (!quad.ok) return;
    if (!sm_faces_light(frame, light, at, depth, n)) {
        masks[pixel] = sm_every_sample;
        return;
    }
    quads[pixel] = vec4(quad.q, quad.q_rest, quad.q_x, quad.q_y);

    bool flat_eye = frame.orthographic != 0;
    vec2 corner = sm_pixel_corner(frame, at);
    vec2 lo = vec2(huge);
    vec2 hi = vec2(-huge);
    vec2 w_range = vec2(huge, 0.0);
    float deepest = -huge;
    float steepest = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 aside = vec2(i & 1, i >> 1);
        vec4 value;
        for (int r = 0; r < 4; ++r) {
            vec3 line = sm_line_across(seen[r], corner, quad);
            precise float there = line.x + line.y * aside.x + line.z * aside.y;
            value[r] = there;
        }
        precise float q = quad.q + quad.q_x * aside.x + quad.q_y * aside.y;
        if (!(value.w >= sm_least_normal) || !(value.w > (flat_eye ? w_min : w_min * q))) return;
        vec3 there = value.xyz / value.w;
        lo = min(lo, there.xy);
        hi = max(hi, there.xy);
        deepest = max(deepest, there.z);
        float w = flat_eye ? value.w : value.w / q;
        w_range = vec2(min(w_range.x, w), max(w_range.y, w));
        steepest = max(steepest, 1.0 / value.w);
    }
    // What rounding may add, so that no triangle misses a texel.
    float size = abs(quad.q) + abs(quad.q_x) + abs(quad.q_y);
    float away = flat_eye ? reach + size : ray;
    float here = flat_eye ? 1.0 : size;
    float pad = steepest * (away * texel_error + here * texel_error_here) + 1.0 / 128.0;
    lo -= pad;
    hi += pad;
    deepest += steepest * (away * depth_error + here * depth_error_here);
    if (!sm_all_finite(lo) || !sm_all_finite(hi) || !sm_all_finite(deepest)) return;

    atomicMin(least_w, floatBitsToUint(w_range.x));
    atomicMax(most_w, floatBitsToUint(w_range.y));
    float extent = max(hi.x - lo.x, hi.y - lo.y);
    int level = 0;
    int last = level_count() - 1;
    for (float texel = 1.0; level < last && extent > texel; texel *= 4.0) ++level;
    atomicOr(levels_used, 1u << level);
    ivec4 range = texels_at(vec4(lo, hi), level);
    uint depth_word = ordered(deepest);
    for (int y = range.y; y <= range.w; ++y)
        for (int x = range.x; x <= range.z; ++x) {
            list_in(pixel, level, ivec2(x, y));
            atomicMax(words[blocks_before(level) + (y >> 2) * block_size(level) + (x >> 2)], depth_word);
        }
}
