// SPDX-License-Identifier: MIT
//
// What clip maps promise: levels that nest, pages that the camera does not name, texels that fit pixels.
#pragma once

#include <shadowmath/clipmap.hpp>

#include <cmath>

namespace shadowmath::laws {

// Corners are whole pages, texels double exactly, and each window is inside the next but for half a page of that.
template <class T>
[[nodiscard]] bool nests(Clipmap<T> const& map) {
    for (int i = 0; i < map.count; ++i) {
        TexelGrid<T> const& grid = map.level[static_cast<std::size_t>(i)];
        if (grid.x % map.page_texels != 0 || grid.y % map.page_texels != 0 || grid.map_size % map.page_texels != 0)
            return false;
        if (i + 1 == map.count) continue;
        TexelGrid<T> const& next = map.level[static_cast<std::size_t>(i + 1)];
        if (next.texel_metres != grid.texel_metres + grid.texel_metres) return false;
        if (grid.map_size < 4 * map.page_texels) continue;
        std::int64_t const half = map.page_texels / 2, size = grid.map_size;
        if (grid.x < 2 * (next.x - half) || grid.y < 2 * (next.y - half) ||
            grid.x + size > 2 * (next.x + size + half) || grid.y + size > 2 * (next.y + size + half))
            return false;
    }
    return true;
}

// The page of the next level is the one that this page is a quarter of.
[[nodiscard]] inline bool is_quarter_of(Page const& page, Page const& next) {
    auto const half = [](std::int64_t i) { return i >= 0 ? i / 2 : -((1 - i) / 2); };
    return next.level == page.level + 1 && next.x == half(page.x) && next.y == half(page.y);
}

// A texel is at most a pixel, and more than half of one, unless a finer level does not hold the page, or there is none.
template <class T>
[[nodiscard]] bool fits_the_pixel(Clipmap<T> const& map, Vec3<T> const& point, T pixel) {
    Page const page = page_for(map, point, pixel);
    if (page.level < 0) {
        for (int i = 0; i < map.count; ++i)
            if (holds(map, page_at(map, i, point)) &&
                (i + 1 == map.count || pixel < map.level[static_cast<std::size_t>(i + 1)].texel_metres))
                return false;
        return true;
    }
    T const texel = map.level[static_cast<std::size_t>(page.level)].texel_metres;
    if (!holds(map, page)) return false;
    bool const finer_holds = page.level > 0 && holds(map, page_at(map, page.level - 1, point));
    bool const coarse_enough = texel * T(2) > pixel || page.level + 1 == map.count;
    bool const fine_enough = texel <= pixel || page.level == 0 || !finer_holds;
    return coarse_enough && fine_enough;
}

}  // namespace shadowmath::laws
