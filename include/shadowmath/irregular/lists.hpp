// SPDX-License-Identifier: MIT
//
// The lists of the irregular z-buffer: which of them a rectangle of the grid belongs to, and how nodes are sorted into
// them.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/irregular/buffer.hpp>

#include <cstdint>
#include <cstring>

namespace shadowmath {
inline namespace v0 {

namespace detail {

// Places in units of the finest division.
struct PlaceRange {
    int x0, x1, y0, y1;
};

// What lies beside the map belongs to its border.
template <class T>
[[nodiscard]] inline int place_of(T coordinate, T last) noexcept {
    T const place = coordinate * T(1 << most_divisions);
    // Written so that NaN ends at 0.
    T const inside = place > T(0) ? place : T(0);
    return static_cast<int>(inside < last ? inside : last);
}

template <class T>
[[nodiscard]] inline PlaceRange places_of(T const* bounds, int map_size) noexcept {
    T const last = T((map_size << most_divisions) - 1);
    return {place_of(bounds[0], last), place_of(bounds[1], last), place_of(bounds[2], last), place_of(bounds[3], last)};
}

[[nodiscard]] inline PlaceRange coarser(PlaceRange const& range, int shift) noexcept {
    return {range.x0 >> shift, range.x1 >> shift, range.y0 >> shift, range.y1 >> shift};
}

// Texels of a level, 0 being the finest.
[[nodiscard]] inline PlaceRange texels_of(PlaceRange const& places, int level) noexcept {
    return coarser(places, most_divisions + level_shift * level);
}

// The divisions of texel (x, y), divided into 2^k x 2^k, that the places touch.
[[nodiscard]] inline PlaceRange divisions_of(PlaceRange const& places, int x, int y, int k) noexcept {
    int const last = (1 << most_divisions) - 1, left = x << most_divisions, top = y << most_divisions;
    return coarser({places.x0 > left ? places.x0 - left : 0, places.x1 < left + last ? places.x1 - left : last,
                    places.y0 > top ? places.y0 - top : 0, places.y1 < top + last ? places.y1 - top : last},
                   most_divisions - k);
}

template <class T>
inline void add_part(IrregularBuffer<T>& buffer, Parts<T> const& parts, int tile, T const (&bounds)[5]) noexcept {
    std::uint32_t const index = buffer.counts.parts++;
    if (index >= parts.capacity) return;
    T const width = bounds[1] - bounds[0], height = bounds[3] - bounds[2];
    T const extent = width > height ? width : height;
    int level = 0;
    while (level + 1 < buffer.level_count && extent > T(1 << level_shift * level)) ++level;
    buffer.levels_used |= 1u << level;
    PlaceRange const places = places_of(bounds, buffer.map_size);
    for (std::uint32_t i = 0; i < 5; ++i) parts.bounds[5 * index + i] = bounds[i];
    std::uint32_t* const place = parts.place + 3 * index;
    place[0] = static_cast<std::uint32_t>(tile) | static_cast<std::uint32_t>(level) << 28;
    place[1] = static_cast<std::uint32_t>(places.x0) | static_cast<std::uint32_t>(places.x1) << 16;
    place[2] = static_cast<std::uint32_t>(places.y0) | static_cast<std::uint32_t>(places.y1) << 16;
    PlaceRange const texels = texels_of(places, 0);
    for (int y = texels.y0; y <= texels.y1; ++y)
        for (int x = texels.x0; x <= texels.x1; ++x) {
            int const texel = y * buffer.map_size + x;
            buffer.texel_levels[texel] |= 1u << level;
            buffer.texel_depth[texel] = bounds[4] > buffer.texel_depth[texel] ? bounds[4] : buffer.texel_depth[texel];
            if (level == 0) ++buffer.texel_division[texel];
        }
}

// Calls list(i) for each list, by its place in `first`, that part of a tile belongs to.
template <class T, class List>
inline void for_each_list(IrregularBuffer<T> const& buffer, std::uint32_t const* place, List const& list) noexcept {
    PlaceRange const places{static_cast<int>(place[1] & 0xffffu), static_cast<int>(place[1] >> 16),
                            static_cast<int>(place[2] & 0xffffu), static_cast<int>(place[2] >> 16)};
    auto const level = static_cast<int>(place[0] >> 28);
    PlaceRange const texels = texels_of(places, level);
    int const size = level_size(buffer.map_size, level);
    for (int y = texels.y0; y <= texels.y1; ++y)
        for (int x = texels.x0; x <= texels.x1; ++x) {
            auto const texel = static_cast<std::uint32_t>(y * size + x);
            if (level > 0) {
                list(buffer.level_first[level] + texel);
                continue;
            }
            auto const k = static_cast<int>(buffer.texel_division[texel]);
            PlaceRange const in = divisions_of(places, x, y, k);
            std::uint32_t const first = buffer.texel_lists[texel];
            if (k == 0) {
                list(first + 1);
                continue;
            }
            // More than four divisions: listed once, for all triangles of the texel.
            if (in.x1 - in.x0 > 1 || in.y1 - in.y0 > 1)
                list(first);
            else
                for (int j = in.y0; j <= in.y1; ++j)
                    for (int i = in.x0; i <= in.x1; ++i) list(first + 1 + static_cast<std::uint32_t>((j << k) + i));
        }
}

// Divides texels: a division for every four nodes at most.
template <class T>
[[nodiscard]] inline std::uint32_t divide_texels(IrregularBuffer<T>& buffer) noexcept {
    std::uint32_t lists = 0;
    auto const texels = static_cast<std::uint32_t>(buffer.map_size * buffer.map_size);
    for (std::uint32_t texel = 0; texel < texels; ++texel) {
        std::uint32_t const nodes = buffer.texel_division[texel];
        std::uint32_t k = 0;
        while (k < most_divisions && (std::uint32_t(64) << 2 * k) <= nodes) ++k;
        buffer.texel_division[texel] = k;
        buffer.texel_lists[texel] = lists;
        lists += 1 + (1u << 2 * k);
    }
    for (int level = 1; level < buffer.level_count; ++level) {
        int const side = level_size(buffer.map_size, level);
        buffer.level_first[level] = lists;
        lists += static_cast<std::uint32_t>(side * side);
    }
    return lists;
}

template <class T>
inline void find_block_depths(IrregularBuffer<T>& buffer) noexcept {
    int const size = buffer.map_size;
    auto const deeper = [](T a, T b) { return a > b ? a : b; };
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            T const* const row = buffer.texel_depth + y * size;
            T const* const next = y + 1 < size ? row + size : row;
            int const right = x + 1 < size ? x + 1 : x;
            buffer.block_depth[y * size + x] = deeper(deeper(row[x], row[right]), deeper(next[x], next[right]));
        }
}

// False where the nodes are more than four for each part that there is room for.
template <class T>
[[nodiscard]] inline bool sort_parts(IrregularBuffer<T>& buffer, Parts<T> const& parts) noexcept {
    std::uint32_t const lists = buffer.list_count = divide_texels(buffer);
    std::memset(buffer.first, 0, (lists + 2) * sizeof(std::uint32_t));
    std::uint32_t* const end = buffer.first + 1;
    ListCounts& counts = buffer.counts;
    for (std::uint32_t i = 0; i < counts.parts; ++i)
        for_each_list(buffer, parts.place + 3 * i, [end](std::uint32_t list) { ++end[list + 1]; });
    for (std::uint32_t list = 1; list <= lists; ++list) {
        std::uint32_t const length = end[list];
        counts.lists += length > 0 ? 1u : 0u;
        counts.longest = length > counts.longest ? length : counts.longest;
        end[list] = counts.nodes += length;
    }
    if (counts.nodes > 4 * parts.capacity) return false;
    find_block_depths(buffer);
    for (std::uint32_t i = 0; i < counts.parts; ++i) {
        T const* const bounds = parts.bounds + 5 * i;
        std::uint32_t const tile = parts.place[3 * i] & 0x0fffffffu;
        for_each_list(buffer, parts.place + 3 * i, [&](std::uint32_t list) {
            std::uint32_t const node = end[list]++;
            std::memcpy(buffer.bounds + 5 * std::size_t{node}, bounds, 5 * sizeof(T));
            buffer.tile[node] = tile;
        });
    }
    return true;
}

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath
