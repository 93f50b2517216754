// SPDX-License-Identifier: MIT
//
// What scrolling promises: kept and fresh texels are each in exactly one place.
#pragma once

#include <shadowmath/scroll.hpp>

#include <vector>

namespace shadowmath::laws {

// Every texel of the new window is either kept, and then it was in the old one, or in exactly one fresh rectangle.
template <class T>
[[nodiscard]] bool covers_once(TexelGrid<T> const& before, TexelGrid<T> const& after, Scroll const& scroll) {
    for (int y = 0; y < after.map_size; ++y)
        for (int x = 0; x < after.map_size; ++x) {
            int fresh = 0;
            for (int i = 0; i < scroll.fresh.count; ++i) {
                TexelRect const& r = scroll.fresh.at[static_cast<std::size_t>(i)];
                fresh += x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height;
            }
            std::int64_t const old_x = x + scroll.x, old_y = y + scroll.y;
            bool const had =
                scroll.kept && old_x >= 0 && old_x < before.map_size && old_y >= 0 && old_y < before.map_size;
            if (fresh != (had ? 0 : 1)) return false;
        }
    return true;
}

// The wrapped parts of a rectangle hold each of its texels once, where its index says.
template <class T>
[[nodiscard]] bool wraps_once(TexelGrid<T> const& grid, TexelRect const& rect) {
    auto const size = static_cast<std::size_t>(grid.map_size);
    std::vector<int> hits(size * size, 0);
    TexelRects<4> const parts = wrapped(grid, rect);
    for (int i = 0; i < parts.count; ++i) {
        TexelRect const& r = parts.at[static_cast<std::size_t>(i)];
        for (int y = r.y; y < r.y + r.height; ++y)
            for (int x = r.x; x < r.x + r.width; ++x)
                ++hits.at(static_cast<std::size_t>(y) * size + static_cast<std::size_t>(x));
    }
    for (int y = 0; y < rect.height; ++y)
        for (int x = 0; x < rect.width; ++x)
            if (--hits[static_cast<std::size_t>(wrapped(grid.y + rect.y + y, grid.map_size)) * size +
                       static_cast<std::size_t>(wrapped(grid.x + rect.x + x, grid.map_size))] != 0)
                return false;
    for (int const hit : hits)
        if (hit != 0) return false;
    return true;
}

}  // namespace shadowmath::laws
