// SPDX-License-Identifier: MIT
//
// A rectangle of a map as a matrix on the left: crop, or place in an atlas. The GLSL twin of region.hpp, for shaders
// that fit maps themselves. Equal to the C++ bit for bit where the driver divides as IEEE 754 does (Mesa's software
// drivers).
#ifndef SM_REGION_GLSL
#define SM_REGION_GLSL

#include "finite.glsl"

struct sm_Region {
    vec2 lo;  // NDC; (-1, -1) to (1, 1) is the whole map
    vec2 hi;
};

bool sm_is_empty(sm_Region region) {
    return !(region.lo.x < region.hi.x && region.lo.y < region.hi.y);
}

// May be empty.
sm_Region sm_intersect(sm_Region a, sm_Region b) {
    return sm_Region(max(a.lo, b.lo), min(a.hi, b.hi));
}

// At least `least` wide on both axes, about the same centre.
sm_Region sm_widened(sm_Region region, float least) {
    precise vec2 width = region.hi - region.lo;
    precise vec2 centre = region.lo / 2.0 + region.hi / 2.0;
    precise vec2 lo = centre - least / 2.0;
    precise vec2 hi = centre + least / 2.0;
    bvec2 wide = greaterThanEqual(width, vec2(least));
    return sm_Region(mix(lo, region.lo, wide), mix(hi, region.hi, wide));
}

// Leaves `margin_texels` of the map free on every side. 2 * margin_texels < map_size.
sm_Region sm_with_margin(sm_Region region, int map_size, float margin_texels) {
    precise vec2 border = (region.hi - region.lo) * (margin_texels / (float(map_size) - 2.0 * margin_texels));
    precise vec2 lo = region.lo - border;
    precise vec2 hi = region.hi + border;
    return sm_Region(lo, hi);
}

// x and y scaled, then moved by the offset times w.
mat4 sm_scale_and_move(vec2 scale, vec2 offset) {
    return mat4(scale.x, 0.0, 0.0, 0.0, 0.0, scale.y, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, offset, 0.0, 1.0);
}

// The region fills the map. One that is empty, not finite, or so small or so large that its scale would not be, gives
// the identity.
mat4 sm_region_matrix(sm_Region region) {
    if (!sm_all_finite(region.lo) || !sm_all_finite(region.hi) || sm_is_empty(region)) return mat4(1.0);
    precise vec2 scale = 2.0 / (region.hi - region.lo);
    precise vec2 offset = -(region.hi + region.lo) / (region.hi - region.lo);
    if (!sm_all_finite(scale) || !sm_all_finite(offset)) return mat4(1.0);
    return sm_scale_and_move(scale, offset);
}

// A square of texels in an atlas. Rows count from texture v = 0.
struct sm_Tile {
    ivec2 corner;
    int size;
    ivec2 atlas;
};

// False for a tile without area, or not wholly inside its atlas.
bool sm_is_valid(sm_Tile tile) {
    return tile.size > 0 && all(greaterThanEqual(tile.corner, ivec2(0))) && all(greaterThan(tile.atlas, ivec2(0))) &&
           all(lessThanEqual(tile.corner, tile.atlas - tile.size));
}

// The whole map lands on the tile. The identity where the tile is not valid.
mat4 sm_tile_matrix(sm_Tile tile, bool flip_v) {
    if (!sm_is_valid(tile)) return mat4(1.0);
    float size = float(tile.size);
    vec2 atlas = vec2(tile.atlas);
    precise vec2 scale = size / atlas;
    precise vec2 centre = (2.0 * vec2(tile.corner) + size) / atlas - 1.0;
    return sm_scale_and_move(scale, flip_v ? vec2(centre.x, -centre.y) : centre);
}

#endif
