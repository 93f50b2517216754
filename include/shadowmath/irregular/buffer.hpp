// SPDX-License-Identifier: MIT
//
// What the irregular z-buffer is made of, and the storage that holds it: plain arrays of the caller's.
//
// Memory, in floats, with the capacity that storage_for takes by itself: 51 bytes a pixel, 29 a texel of the grid, 1
// MiB for sorting triangles; nothing for each triangle. A capacity known from the frame before spares a fifth of it.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/irregular/edge.hpp>
#include <shadowmath/irregular/lanes.hpp>
#include <shadowmath/irregular/microquad.hpp>
#include <shadowmath/light.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace shadowmath {
inline namespace v0 {

inline constexpr int tile_side = 4;
inline constexpr int level_shift = 2;  // a texel is 4 x 4 of the next finer level
inline constexpr int most_levels = 8;
inline constexpr int most_divisions = 5;  // of a texel of the finest level: 2^5 x 2^5 parts
inline constexpr int largest_grid = 1 << 11;

// What the eye sees, row by row, `width` pixels each. Sky is a pixel whose normal is zero, whose depth is not positive,
// or of which anything is not finite.
template <class T>
struct Receivers {
    T const* position = nullptr;  // world; three scalars a pixel, `position_stride` apart
    int position_stride = 3;
    T const* depth = nullptr;   // instead of positions: metres along the view's forward axis, one a pixel
    T const* normal = nullptr;  // of the surface, not for shading; any length and sign
    int normal_stride = 3;
};

// Part of a picture; a width or height of 0 stands for all that follows.
struct PixelRect {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

// What the lists of a buffer came to.
struct ListCounts {
    std::uint32_t tiles = 0;  // with a pixel that light may reach
    std::uint32_t parts = 0;  // tiles, and parts of those that straddle a silhouette: what `capacity` must hold
    std::uint32_t nodes = 0;
    std::uint32_t lists = 0;    // texels that are not empty
    std::uint32_t longest = 0;  // nodes in one texel
};

struct StorageSize {
    std::size_t scalars = 0;
    std::size_t words = 0;
};

// The two arrays of a buffer, at least as long as storage_for says.
template <class T>
struct Storage {
    T* scalars = nullptr;
    std::uint32_t* words = nullptr;
    StorageSize size;
};

// A picture's part as the light sees it. Everything is indexed with 32 bits and laid out in arrays of one kind, so that
// it can be handed to a GPU as it is.
template <class T>
struct IrregularBuffer {
    PixelFrame<T> frame;
    PixelLight<T> light;
    Light<Wider<T>> source;
    PixelRect rect;
    Vec4<T> row[4];             // texel x, texel y, depth and w of a point, from its place relative to the eye
    T texel_error = T(0);       // what rounding may add to a texel coordinate times w, for each metre from the eye
    T texel_error_here = T(0);  // and whatever the distance
    T depth_error = T(0);
    T depth_error_here = T(0);
    T contact_reach = T(0);  // metres, and share of the depth, that margins of contact are a part of; see trace.hpp
    T contact_ray = T(0);
    int tiles_across = 0;
    int tile_count = 0;
    int map_size = 0;
    int level_count = 0;
    std::uint32_t level_first[most_levels]{};  // place in `first` of the levels from 1 on
    std::uint32_t levels_used = 0;             // bit l: level l has a node

    // Tiles: sixteen pixels each, four rows of four; tile_scalars and tile_words of each, see below.
    T* surface = nullptr;
    std::uint32_t* state = nullptr;

    // Nodes, sorted by list: lo x, hi x, lo y, hi y in texels of the finest level, the far end of the depths; the tile.
    T* bounds = nullptr;
    std::uint32_t* tile = nullptr;
    std::uint32_t* first = nullptr;  // node of each list, one more at the end
    std::uint32_t list_count = 0;

    // Texels of the finest level.
    T* texel_depth = nullptr;                 // far end over the nodes that touch it
    T* block_depth = nullptr;                 // the same over 2 x 2 texels, of which this is the first
    std::uint32_t* texel_levels = nullptr;    // bit l: level l has a node here
    std::uint32_t* texel_lists = nullptr;     // place in `first`: nodes too wide for its divisions, then the divisions
    std::uint32_t* texel_division = nullptr;  // k: it is divided into 2^k x 2^k; in the making, how many nodes touch it

    // For trace: triangles are put in the order of the lists, a block at a time.
    std::uint32_t* caster = nullptr;
    std::uint32_t* caster_list = nullptr;
    std::uint32_t* caster_order = nullptr;
    std::uint32_t* caster_end = nullptr;  // of each list
    std::uint32_t caster_room = 0;

    // Over all nodes.
    T least_x = T(0), most_x = T(0), least_y = T(0), most_y = T(0), most_depth = T(0), least_w = T(0), most_w = T(0);

    ListCounts counts;
    Faults faults;
};

// Texels along a side of the level.
[[nodiscard]] constexpr int level_size(int map_size, int level) noexcept {
    return ((map_size - 1) >> level_shift * level) + 1;
}

// What is kept of a tile. Its scalars: the q of each pixel less the tile's, q_x, q_y; then the tile's q, near those of
// its pixels, so that the differences are known to far more digits; and for each of the five keys of tile.hpp, where
// its bytes begin and how long a step of theirs is. Its words: four keys of each pixel, a byte each, and the fifth; which
// pixels light may reach that have a sample not yet covered, a bit each; the masks.
inline constexpr int tile_scalars = 64, tile_words = 48;
inline constexpr int tile_q_at = 48, key_base_at = 49, key_step_at = 54;
inline constexpr int alive_at = 20, mask_at = 32;

// Tiles begin where a line of the caches does: what may be left out before the first, in words and in scalars.
inline constexpr std::size_t cache_line = 64;
inline constexpr std::size_t line_slack = cache_line / 4 - 1;

// What a buffer needs for width x height pixels, a grid of map_size^2 texels and `capacity` parts of tiles. Parts are
// one and a half times as many as tiles in ordinary pictures and 16 times as many at most: three times as many are
// taken where capacity is 0. A map_size outside [1, 2^11] is no grid; 64 to 256 is a good one.
[[nodiscard]] constexpr StorageSize storage_for(int width, int height, int map_size, int capacity = 0) noexcept {
    if (width < 1 || height < 1 || map_size < 1 || map_size > largest_grid) return {};
    auto const tiles_along = [](int size) { return static_cast<std::size_t>((size - 1) / tile_side + 1); };
    std::size_t const tiles = tiles_along(width) * tiles_along(height);
    std::size_t const parts = capacity > 0 ? static_cast<std::size_t>(capacity) : 3 * tiles;
    std::size_t const texels = static_cast<std::size_t>(map_size) * static_cast<std::size_t>(map_size);
    std::size_t coarser = 0;
    for (int level = 1, side = map_size; side != 1; ++level) {
        side = level_size(map_size, level);
        coarser += static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    }
    // Every four nodes that touch a texel pay for a division. As many triangles as pixels are put in order at once.
    std::size_t const nodes = 4 * parts, lists = 2 * texels + coarser + parts + 2;
    return {tile_scalars * tiles + 5 * nodes + 5 * parts + 2 * texels + line_slack,
            tile_words * tiles + nodes + 3 * parts + 2 * lists + 3 * texels + 3 * lane_count * tiles + line_slack};
}

namespace detail {

// Places of the pixels in their tile.
template <class T>
inline constexpr T tile_columns[lane_count] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
template <class T>
inline constexpr T tile_rows[lane_count] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

// The parts of a buffer that only its making sees.
template <class T>
struct Parts {
    T* bounds = nullptr;             // lo x, hi x, lo y, hi y, depth of each
    std::uint32_t* place = nullptr;  // tile and level; first and last place in x, in y, 16 bits each
    std::uint32_t capacity = 0;
};

template <class T>
[[nodiscard]] inline std::size_t scalars_to_line(T const* from) noexcept {
    return (cache_line - reinterpret_cast<std::uintptr_t>(from) % cache_line) % cache_line / sizeof(T);
}

// The arrays of a buffer, cut from what the caller gave. No capacity where not even the tiles fit.
template <class T>
[[nodiscard]] inline Parts<T> lay_out(IrregularBuffer<T>& buffer, Storage<T> const& storage) noexcept {
    Parts<T> parts;
    // What one part more adds: one of its own and four nodes of each array.
    StorageSize const least = storage_for(buffer.rect.width, buffer.rect.height, buffer.map_size, 1);
    if (storage.scalars == nullptr || storage.words == nullptr || storage.size.scalars < least.scalars ||
        storage.size.words < least.words)
        return parts;
    std::size_t const by_scalars = (storage.size.scalars - least.scalars) / 25;
    std::size_t const by_words = (storage.size.words - least.words) / 9;
    std::size_t const capacity = 1 + (by_scalars < by_words ? by_scalars : by_words);
    // Nodes are counted with 32 bits, tiles with 28.
    parts.capacity = static_cast<std::uint32_t>(capacity < 1u << 28 ? capacity : 1u << 28);
    auto const tiles = static_cast<std::size_t>(buffer.tile_count);
    auto const texels = static_cast<std::size_t>(buffer.map_size) * static_cast<std::size_t>(buffer.map_size);
    std::size_t const nodes = 4 * std::size_t{parts.capacity};
    buffer.caster_room = static_cast<std::uint32_t>(lane_count * tiles);
    T* scalars = storage.scalars;
    std::uint32_t* words = storage.words;
    auto const take = [](auto*& from, std::size_t count) {
        auto* const taken = from;
        from += count;
        return taken;
    };
    scalars += scalars_to_line(scalars);
    words += scalars_to_line(words);
    buffer.surface = take(scalars, tile_scalars * tiles);
    buffer.bounds = take(scalars, 5 * nodes);
    buffer.texel_depth = take(scalars, texels);
    buffer.block_depth = take(scalars, texels);
    parts.bounds = scalars;
    buffer.state = take(words, tile_words * tiles);
    for (std::uint32_t** array : {&buffer.caster, &buffer.caster_list, &buffer.caster_order})
        *array = take(words, buffer.caster_room);
    buffer.tile = take(words, nodes);
    for (std::uint32_t** array : {&buffer.texel_levels, &buffer.texel_lists, &buffer.texel_division})
        *array = take(words, texels);
    parts.place = take(words, 3 * std::size_t{parts.capacity});
    std::size_t const lists = (static_cast<std::size_t>(storage.words + storage.size.words - words)) / 2;
    buffer.first = take(words, lists);
    buffer.caster_end = words;
    std::memset(buffer.texel_levels, 0, texels * sizeof(std::uint32_t));
    std::memset(buffer.texel_division, 0, texels * sizeof(std::uint32_t));
    for (std::size_t texel = 0; texel < texels; ++texel) buffer.texel_depth[texel] = std::numeric_limits<T>::lowest();
    return parts;
}

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath
