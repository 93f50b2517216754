// SPDX-License-Identifier: MIT
#version 450
#include "twin.glsl"
#include "shadowmath/glsl/region.glsl"

sm_Region take_region() {
    vec2 lo = take2();
    return sm_Region(lo, take2());
}

void give_region(sm_Region region) {
    give(region.lo);
    give(region.hi);
}

void answer(uint function) {
    sm_Region region;
    sm_Tile tile;
    int whole;
    switch (function) {
        case 0u: give(sm_is_empty(take_region())); break;
        case 1u:
            region = take_region();
            give_region(sm_intersect(region, take_region()));
            break;
        case 2u:
            region = take_region();
            give_region(sm_widened(region, take()));
            break;
        case 3u:
            region = take_region();
            whole = take_int();
            give_region(sm_with_margin(region, whole, take()));
            break;
        case 4u: give(sm_region_matrix(take_region())); break;
        case 5u:
            tile.corner.x = take_int();
            tile.corner.y = take_int();
            tile.size = take_int();
            tile.atlas.x = take_int();
            tile.atlas.y = take_int();
            give(sm_is_valid(tile));
            give(sm_tile_matrix(tile, take_bool()));
            break;
        case 6u:
            vec2 scale = take2();
            give(sm_scale_and_move(scale, take2()));
    }
}
