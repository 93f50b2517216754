// SPDX-License-Identifier: MIT
//
// One triangle against the lists of the texels that it may cover. Coverage is conservative without help from a
// rasteriser: the triangle's three edges are moved outward until they pass a texel's farthest corner.
//
// No fragment shader, so nothing is asked of the driver but atomics: no interlock, no conservative rasterisation.

#include "irregular_buffers.glsl"

struct Caster {
    dvec4 planes[4];
    vec3 edges[3];  // in texels of the finest level: x X + y Y + c >= 0 inside
    bool has_edges; // false: clipped, or of no area in the map; its bounds must do
    vec4 bounds;    // lo x, lo y, hi x, hi y
    uint nearest;   // depth as ordered(); 0: none can be told
    bool casts;
};

Caster caster_of(uint triangle) {
    Caster caster;
    caster.casts = false;
    dvec3 p[3];
    sm_ExactFrame exact = sm_exact_frame(frame, light);
    vec4 at[3];
    float away = 0.0;
    for (int i = 0; i < 3; ++i) {
        uint vertex = triangles[3u * triangle + uint(i)];
        if (vertex >= vertex_count) return caster;
        vec3 point = vec3(vertices[3u * vertex], vertices[3u * vertex + 1u], vertices[3u * vertex + 2u]);
        precise vec3 from_eye = point - frame.eye;
        float size = abs(from_eye.x) + abs(from_eye.y) + abs(from_eye.z);
        if (!(size <= 1e9)) return caster;
        away = max(away, size);
        p[i] = sm_point_in_pixels(exact, point);
        for (int r = 0; r < 4; ++r) {
            precise float value = sm_dot(row[r].xyz, from_eye) + row[r].w;
            at[i][r] = value;
        }
    }
    // All along a ray of a sun w is that of the receiver; toward a lamp it falls to 0.
    float w_floor = light.parallel != 0 ? 0.999 * uintBitsToFloat(least_w) : uintBitsToFloat(most_w) / 1048576.0;
    vec2 lo = vec2(huge);
    vec2 hi = vec2(-huge);
    float depth = huge;
    float least = huge;
    bool clipped = false;
    for (int i = 0; i < 3; ++i) {
        vec4 a = at[i];
        vec4 b = at[(i + 1) % 3];
        least = min(least, a.w);
        if (a.w >= w_floor) {
            vec3 there = a.xyz / a.w;
            lo = min(lo, there.xy);
            hi = max(hi, there.xy);
            depth = min(depth, there.z);
        } else {
            clipped = true;
        }
        if ((a.w >= w_floor) == (b.w >= w_floor)) continue;
        vec4 between = a + (b - a) * ((a.w - w_floor) / (a.w - b.w));
        lo = min(lo, between.xy / w_floor);
        hi = max(hi, between.xy / w_floor);
    }
    if (lo.x > hi.x) return caster;
    float steepest = 1.0 / max(least, w_floor);
    float pad = steepest * (away * texel_error + texel_error_here) + 1.0 / 128.0;
    caster.bounds = vec4(lo - pad, hi + pad);
    depth -= steepest * (away * depth_error + depth_error_here);
    caster.nearest = clipped || !sm_all_finite(depth) ? 0u : ordered(depth);

    vec2 corners[3];
    for (int i = 0; i < 3; ++i) corners[i] = at[i].xy / at[i].w;
    vec2 u = corners[1] - corners[0];
    vec2 v = corners[2] - corners[0];
    float area = u.x * v.y - u.y * v.x;
    caster.has_edges = !clipped && abs(area) > 0.0 && sm_all_finite(area);
    for (int i = 0; i < 3; ++i) {
        vec2 along = (corners[(i + 1) % 3] - corners[i]) * sign(area);
        vec2 n = vec2(-along.y, along.x);
        // The pad once more: corners are rounded as bounds are.
        caster.edges[i] = vec3(n, (abs(n.x) + abs(n.y)) * pad - dot(n, corners[i]));
        // Far from the map's corner the sum above rounds; so many texels it may be wrong.
        caster.edges[i].z += (abs(n.x * corners[i].x) + abs(n.y * corners[i].y)) * 1e-6 +
                             (abs(n.x) + abs(n.y)) * float(map_size) * 1e-6;
    }
    precise double metres = double(contact_share) * (double(away) + (1.0LF + double(contact_metres)));
    caster.casts = sm_shadow_volume(exact, p, metres, double(contact_share) * double(ray), caster.planes);
    return caster;
}

bool meets(Caster caster, ivec2 texel, int level) {
    int last = level_size(level) - 1;
    // The border stands for all that lies beyond it.
    if (!caster.has_edges || texel.x == 0 || texel.y == 0 || texel.x == last || texel.y == last) return true;
    float side = float(1 << (2 * level));
    vec2 middle = (vec2(texel) + 0.5) * side;
    for (int i = 0; i < 3; ++i) {
        vec3 edge = caster.edges[i];
        if (dot(edge.xy, middle) + edge.z + (abs(edge.x) + abs(edge.y)) * side * 0.5 < 0.0) return false;
    }
    return true;
}

void darken(Caster caster, uint pixel) {
    uint known = masks[pixel];
    if (known == sm_every_sample) return;
    ivec2 at = ivec2(int(pixel) % frame.width, int(pixel) / frame.width);
    uint dark = sm_occluded(caster.planes, sm_pixel_corner(frame, at), quad_of(pixel));
    if ((dark & ~known) != 0u) atomicOr(masks[pixel], dark);
}

// Blocks of 4 x 4 texels, all levels that are used together.
uint block_count(Caster caster) {
    uint count = 0u;
    for (uint levels = levels_used; levels != 0u; levels &= levels - 1u) {
        ivec4 range = texels_at(caster.bounds, findLSB(levels)) >> 2;
        count += uint((range.z - range.x + 1) * (range.w - range.y + 1));
    }
    return count;
}

// Every `stride`-th of them, from `first` on.
void walk(Caster caster, uint first, uint stride) {
    uint skip = first;
    for (uint levels = levels_used; levels != 0u; levels &= levels - 1u) {
        int level = findLSB(levels);
        ivec4 texels = texels_at(caster.bounds, level);
        ivec4 blocks = texels >> 2;
        uint across = uint(blocks.z - blocks.x + 1);
        uint count = across * uint(blocks.w - blocks.y + 1);
        int heads = texels_before(level);
        int reaches = blocks_before(level);
        uint i = skip;
        for (; i < count; i += stride) {
            ivec2 block = blocks.xy + ivec2(i % across, i / across);
            if (words[reaches + block.y * block_size(level) + block.x] <= caster.nearest) continue;
            ivec2 begin = max(block << 2, texels.xy);
            ivec2 end = min((block << 2) + 3, texels.zw);
            for (int y = begin.y; y <= end.y; ++y)
                for (int x = begin.x; x <= end.x; ++x) {
                    uint node = words[heads + y * level_size(level) + x];
                    if (node == 0u || !meets(caster, ivec2(x, y), level)) continue;
                    for (; node != 0u; node = nodes[node - 1u].y) darken(caster, nodes[node - 1u].x);
                }
        }
        skip = i - count;
    }
}
