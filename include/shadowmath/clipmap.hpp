// SPDX-License-Identifier: MIT
//
// Concentric still windows around the eye, each with texels twice as large as the one before, cut into pages: what a
// virtual shadow map is, but for the page table. Every page is a square of the endless grid with a name that does not
// depend on the camera; what was drawn into it stays right until the light or a caster moves.
//
//   +---------------+      level l: texels of finest * 2^l metres; the window moves in whole pages (grid_window)
//   |   +-------+   |      a page of level l + 1 is exactly four pages of level l
//   |   | +---+ |   |
//   |   | | e | |   |      a receiver takes the finest level that holds it and whose texel its pixel can tell apart
//   |   | +---+ |   |
//   |   +-------+   |      Use it where the virtual texture is; for a few maps in fixed memory cascades are simpler.
//   +---------------+
//
// Source: Sakmary, Ryan, Hall, Lustri, "Virtual shadow maps", GPU Zen 3 (2024), and Epic's documentation of its own,
// from which the sizes are; the selection of the level is derived here.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/texel_grid.hpp>
#include <shadowmath/view_volume.hpp>

#include <array>
#include <cmath>
#include <cstdint>

namespace shadowmath {
inline namespace v0 {

inline constexpr int max_clip_levels = 24;

template <class T>
struct ClipmapOptions {
    int levels = 12;              // 1 to max_clip_levels
    int map_size = 4096;          // texels along a side of each level's window, a multiple of page_texels
    int page_texels = 128;        // along a side of a page
    T finest_metres = T(0x1p-8);  // of a texel of level 0; a power of two keeps all texels exact
};

template <class T>
struct Clipmap {
    std::array<TexelGrid<T>, max_clip_levels> level;
    int count = 0;  // 0: nothing
    int page_texels = 1;
    Faults faults;
};

// A page of one level: [x, x + 1) x [y, y + 1) pages from the world origin in light space.
struct Page {
    int level = -1;  // -1: none
    std::int64_t x = 0;
    std::int64_t y = 0;

    friend constexpr bool operator==(Page const& a, Page const& b) noexcept {
        return a.level == b.level && a.x == b.x && a.y == b.y;
    }
};

// Windows around `center`, which is no more than half a page off the middle of each. The same corner to the bit as long
// as the centre stays within the same half page. A map_size that is no multiple of the page is lowered to one
// (clamped_option). precision_lost: the finest levels are too fine to be still in this scalar type at this distance
// from the origin; where not even their places can be counted, there is no level.
template <class T>
[[nodiscard]] inline Clipmap<T> clipmap(LightBasis<T> const& basis, Vec3<T> const& center,
                                        ClipmapOptions<T> const& options) noexcept {
    Clipmap<T> map;
    int const page = options.page_texels < 1 ? 1 : options.page_texels;
    int const size = options.map_size / page * page;
    int const levels = options.levels < 1 ? 1 : (options.levels > max_clip_levels ? max_clip_levels : options.levels);
    if (page != options.page_texels || size != options.map_size || levels != options.levels)
        map.faults |= Fault::clamped_option;
    map.page_texels = page;
    T texel = options.finest_metres;
    for (int i = 0; i < levels; ++i, texel += texel) {
        TexelGrid<T> const grid = grid_window(basis, center, texel, size, page);
        map.faults |= grid.faults;
        if (!grid.visible) break;
        map.level[static_cast<std::size_t>(map.count++)] = grid;
    }
    return map;
}

// Metres that a pixel of the picture covers at this eye depth, upright and facing the eye.
template <class T>
[[nodiscard]] inline T pixel_metres(ViewVolume<T> const& view, T picture_height, T depth) noexcept {
    T const spread = view.kind == ViewKind::perspective ? depth : T(1);
    return (view.top - view.bottom) * spread / picture_height;
}

// The page of a level in which a world point lies; where the camera is does not enter.
template <class T>
[[nodiscard]] inline Page page_at(Clipmap<T> const& map, int level, Vec3<T> const& point) noexcept {
    if (level < 0 || level >= map.count || !all_finite(point)) return {};
    using Exact = decltype(T() + double());
    TexelGrid<T> const& grid = map.level[static_cast<std::size_t>(level)];
    Exact const page_metres = Exact(grid.texel_metres) * Exact(map.page_texels);
    Exact const x = std::floor(glm::dot(Vec3<Exact>(grid.basis.x), Vec3<Exact>(point)) / page_metres);
    Exact const y = std::floor(glm::dot(Vec3<Exact>(grid.basis.y), Vec3<Exact>(point)) / page_metres);
    constexpr Exact whole_numbers = Exact(std::int64_t(1) << 52);
    if (!(std::abs(x) < whole_numbers && std::abs(y) < whole_numbers)) return {};
    return {level, static_cast<std::int64_t>(x), static_cast<std::int64_t>(y)};
}

// Whether the page is in its level's window, and `margin_pages` from its sides.
template <class T>
[[nodiscard]] inline bool holds(Clipmap<T> const& map, Page const& page, int margin_pages = 0) noexcept {
    if (page.level < 0 || page.level >= map.count) return false;
    TexelGrid<T> const& grid = map.level[static_cast<std::size_t>(page.level)];
    std::int64_t const size = grid.map_size / map.page_texels, margin = margin_pages;
    std::int64_t const x = page.x - grid.x / map.page_texels, y = page.y - grid.y / map.page_texels;
    return x >= margin && y >= margin && x < size - margin && y < size - margin;
}

// The page that serves a receiver whose pixel covers `pixel` metres: of the finest level that holds it and whose next
// finer texel is no more than half a pixel, so that a texel is at most a pixel and more than half of one wherever the
// window's size does not decide. Level -1: no window holds it.
template <class T>
[[nodiscard]] inline Page page_for(Clipmap<T> const& map, Vec3<T> const& point, T const& pixel,
                                   int margin_pages = 0) noexcept {
    if (!all_finite(&pixel, 1)) return {};
    for (int i = 0; i < map.count; ++i) {
        bool const too_fine = i + 1 < map.count && map.level[static_cast<std::size_t>(i + 1)].texel_metres <= pixel;
        Page const page = page_at(map, i, point);
        if (!too_fine && holds(map, page, margin_pages)) return page;
    }
    return {};
}

}  // namespace v0
}  // namespace shadowmath
