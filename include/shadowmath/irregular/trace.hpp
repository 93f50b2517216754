// SPDX-License-Identifier: MIT
//
// Exact hard shadows: every triangle against the pixels whose light it may take, 32 samples each. No resolution, no
// bias, no filter: a sample is dark when the segment from it to the light meets a triangle.
//
//   storage                    arrays of the caller's, storage_for(...) long
//   list_receivers(...)        once for a picture, or for each part of it
//   trace(buffer, casters)     in any order, any number of times; parts can run on threads of their own
//   write_masks(buffer, out)   one word a pixel: bit i is set where sample i is dark
//
// Use it where shadows must be right to the pixel; on a CPU it is faster than ray tracing as long as every pixel is
// wanted. For a few points, or soft shadows, trace rays instead.
//
// Source: Wyman, Hoetzlein and Lefohn, TVCG 22(10) 2016. Departures: tiles of 4 x 4 pixels are tested at once, first by
// bounds of a byte each, then against all four planes before any sample; triangles are clipped only to find their
// texels; and they are put in the order of the grid, where a node is held against sixteen of its neighbourhood at once.
//
// Against ray tracing (bench/irregular.cpp, 32 samples a pixel, one thread): the whole frame takes a seventh to a
// twelfth of Embree's best, at 100 thousand triangles and at a million; about half of Embree's with one ray a pixel.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/irregular/buffer.hpp>
#include <shadowmath/irregular/casters.hpp>
#include <shadowmath/irregular/chunk.hpp>
#include <shadowmath/irregular/cover.hpp>
#include <shadowmath/irregular/lanes.hpp>
#include <shadowmath/irregular/lists.hpp>
#include <shadowmath/irregular/microquad.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace shadowmath {
inline namespace v0 {

namespace detail {

template <class Lanes, class T = typename Lanes::Scalar>
struct TraceKernel {
    IrregularBuffer<T>& buffer;
    CasterKernel<Lanes> kernel;
    CoverKernel<Lanes> cover;

    using Batch = CasterBatch<Lanes>;
    using Chunk = CasterChunk<Lanes>;
    using Queue = typename CoverKernel<Lanes>::Queue;

    // The list that a triangle begins in, of those whose cells are no narrower than it.
    [[nodiscard]] std::uint32_t list_of(PlaceRange const& places, int extent) const noexcept {
        PlaceRange const texels = texels_of(places, 0);
        if (extent > 1 << most_divisions) {
            int level = 1;
            while (level + 1 < buffer.level_count && extent > 1 << (most_divisions + level_shift * level)) ++level;
            PlaceRange const at = coarser(texels, level_shift * level);
            if (level < buffer.level_count)
                return buffer.level_first[level] +
                       static_cast<std::uint32_t>(at.y0 * level_size(buffer.map_size, level) + at.x0);
        }
        int const texel = texels.y0 * buffer.map_size + texels.x0;
        auto const k = static_cast<int>(buffer.texel_division[texel]);
        int const first = 1 << most_divisions, shift = most_divisions - k;
        int const in_x = (places.x0 & (first - 1)) >> shift, in_y = (places.y0 & (first - 1)) >> shift;
        return buffer.texel_lists[texel] +
               (extent > 1 << shift ? 0u : 1u + static_cast<std::uint32_t>((in_y << k) + in_x));
    }

    // Keeps the triangles that may touch a node, from `begin` on, until there is no room for more. Gives how many were
    // looked at, and how many kept.
    [[nodiscard]] std::uint32_t keep(std::uint32_t begin, std::uint32_t count, Batch& batch,
                                     std::uint32_t& kept) const noexcept {
        std::uint32_t places[4][lane_count];
        Lanes const zero = Lanes::all(T(0)), last = Lanes::all(T((buffer.map_size << most_divisions) - 1));
        Lanes const scale = Lanes::all(T(1 << most_divisions));
        std::uint32_t done = 0, held = 0;
        for (; done < count && held + lane_count <= buffer.caster_room; done += lane_count) {
            kernel.load(begin + done, count - done, nullptr, batch);
            for (int i = 0; i < 4; ++i)
                least(most(Lanes::load(batch.bounds[i]) * scale, zero), last).store_words(places[i]);
            for (std::uint32_t bits = batch.sound; bits != 0; bits &= bits - 1) {
                int const k = lowest_bit(bits);
                PlaceRange const at{static_cast<int>(places[0][k]), static_cast<int>(places[1][k]),
                                    static_cast<int>(places[2][k]), static_cast<int>(places[3][k])};
                int const width = at.x1 - at.x0, height = at.y1 - at.y0, extent = width > height ? width : height;
                PlaceRange const texels = texels_of(at, 0);
                std::uint32_t const list = list_of(at, extent);
                bool const in_block = extent <= 1 << most_divisions;
                T const far_end = buffer.block_depth[texels.y0 * buffer.map_size + texels.x0];
                std::uint32_t const met = !in_block || far_end >= batch.depth[k] ? 1u : 0u;
                buffer.caster[held] = begin + done + static_cast<std::uint32_t>(k);
                buffer.caster_list[held] = list;
                buffer.caster_end[list + 1] += met;
                held += met;
            }
        }
        kept = held;
        return done < count ? done : count;
    }

    // Puts them in the order of their lists: what is next to each other in the grid is then in the caches, however the
    // mesh was laid out.
    void sort(std::uint32_t kept) const noexcept {
        std::uint32_t* const end = buffer.caster_end;
        for (std::uint32_t list = 0; list < buffer.list_count; ++list) end[list + 1] += end[list];
        for (std::uint32_t i = 0; i < kept; ++i) buffer.caster_order[end[buffer.caster_list[i]]++] = buffer.caster[i];
    }

    void search(Chunk const& chunk, std::uint32_t list, Cell<T> const& cell, T far_end, CellCasters<Lanes>& here,
                Queue& queue) const noexcept {
        std::uint32_t const begin = buffer.first[list], end = buffer.first[list + 1];
        if (begin == end) return;
        here.take(chunk.bounds, cell, far_end);
        if (here.bounds.count == 0) return;
        T const* bounds = buffer.bounds + 5 * std::size_t{begin};
        for (std::uint32_t node = begin; node < end; ++node, bounds += 5) {
            std::uint32_t const found = here.find(bounds, cell, queue.next());
            if (found == 0) continue;
            cover.enqueue(buffer.tile[node], found, queue);
            if (queue.full()) cover.cover(chunk.raised, queue);
        }
    }

    // A chunk against the lists of all cells that it may touch.
    void run(Chunk& chunk, CellCasters<Lanes>& here, Queue& queue) const noexcept {
        if (chunk.bounds.count == 0) return;
        T bounds[5];
        chunk.together(bounds);
        T const anywhere = std::numeric_limits<T>::max();
        PlaceRange const places = places_of(bounds, buffer.map_size);
        for (std::uint32_t levels = buffer.levels_used; levels != 0; levels &= levels - 1) {
            int const level = lowest_bit(levels), shift = most_divisions + level_shift * level;
            int const size = level_size(buffer.map_size, level);
            PlaceRange const range = coarser(places, shift);
            for (int y = range.y0; y <= range.y1; ++y)
                for (int x = range.x0; x <= range.x1; ++x) {
                    int const texel = y * size + x;
                    Cell<T> const cell = cell_at<T>(x, y, shift, buffer.map_size);
                    if (level > 0) {
                        search(chunk, buffer.level_first[level] + static_cast<std::uint32_t>(texel), cell, anywhere,
                               here, queue);
                        continue;
                    }
                    T const far_end = buffer.texel_depth[texel];
                    if (far_end < bounds[4] || (buffer.texel_levels[texel] & 1u) == 0) continue;
                    std::uint32_t const lists = buffer.texel_lists[texel];
                    search(chunk, lists, cell, far_end, here, queue);
                    auto const k = static_cast<int>(buffer.texel_division[texel]);
                    PlaceRange const in = divisions_of(places, x, y, k);
                    for (int j = in.y0; j <= in.y1; ++j)
                        for (int i = in.x0; i <= in.x1; ++i)
                            search(chunk, lists + 1 + static_cast<std::uint32_t>((j << k) + i),
                                   cell_at<T>((x << k) + i, (y << k) + j, most_divisions - k, buffer.map_size), far_end,
                                   here, queue);
                }
        }
        cover.cover(chunk.raised, queue);
        chunk.clear();
    }

    // Gives how many triangles were looked at.
    [[nodiscard]] std::uint32_t run_block(std::uint32_t begin, std::uint32_t count) const noexcept {
        constexpr std::uint32_t ahead = 4 * lane_count;
        Batch batch;
        Chunk chunk;
        CellCasters<Lanes> here;
        Queue queue;
        std::memset(buffer.caster_end, 0, (buffer.list_count + 1) * sizeof(std::uint32_t));
        std::uint32_t kept;
        std::uint32_t const done = keep(begin, count, batch, kept);
        sort(kept);
        for (std::uint32_t i = 0; i < kept; i += lane_count) {
            for (std::uint32_t k = i + ahead; k < i + ahead + lane_count && k < kept; ++k)
                kernel.fetch(buffer.caster_order[k]);
            kernel.load(i, kept - i, buffer.caster_order, batch);
            kernel.raise_volumes(batch);
            chunk.add(batch);
            if (chunk.full()) run(chunk, here, queue);
        }
        run(chunk, here, queue);
        return done;
    }
};

}  // namespace detail

// Takes the light of `count` triangles from `first` on out of the buffer's masks; a count of 0 stands for all that
// follow. The masks that remain do not depend on the order of triangles, on the grid, or on how the work is split.
// Triangles with an index beyond the vertices, with a vertex that is not finite or farther than 1e9 m cast nothing.
template <class T, class Lanes = BestLanes<T>>
inline void trace(IrregularBuffer<T>& buffer, Casters<T> const& casters, std::uint32_t first = 0,
                  std::uint32_t count = 0) noexcept {
    if (buffer.levels_used == 0 || first >= casters.triangle_count || casters.vertex_count == 0) return;
    SHADOWMATH_ASSERT(casters.position != nullptr, "casters need positions");
    std::uint32_t const left = casters.triangle_count - first;
    if (count == 0 || count > left) count = left;
    // All along a ray of a sun w is that of the receiver; toward a lamp it falls to 0.
    T const slack = buffer.light.parallel ? T(0.999) : T(1) / T(1 << 20);
    T const wanted = slack * (buffer.light.parallel ? buffer.least_w : buffer.most_w),
            least = std::numeric_limits<T>::min();
    T const w_floor = wanted > least ? wanted : least;  // what is clipped is divided by it
    PixelFrame<Wider<T>> const frame = frame_in<Wider<T>>(buffer.frame);
    detail::TraceKernel<Lanes> const kernel{
        buffer, {buffer, casters, frame, pixel_light(frame, buffer.source), w_floor}, {buffer, frame}};
    for (std::uint32_t done = 0; done < count;) done += kernel.run_block(first + done, count - done);
}

// One word for each pixel of the buffer's part of the picture, row by row, `stride` words apart: 0 for sky. A stride of
// 0 is the width of that part.
template <class T>
inline void write_masks(IrregularBuffer<T> const& buffer, std::uint32_t* masks, int stride = 0) noexcept {
    PixelRect const& rect = buffer.rect;
    if (stride == 0) stride = rect.width;
    for (int row = 0; row < rect.height; ++row) {
        std::uint32_t* const out = masks + static_cast<std::size_t>(row) * static_cast<std::size_t>(stride);
        if (buffer.tile_count == 0) {
            std::memset(out, 0, static_cast<std::size_t>(rect.width) * sizeof(std::uint32_t));
            continue;
        }
        std::uint32_t const* in = buffer.state +
                                  static_cast<std::size_t>(row / tile_side * buffer.tiles_across) * tile_words +
                                  mask_at + row % tile_side * tile_side;
        for (int column = 0; column < rect.width; column += tile_side, in += tile_words) {
            int const columns = rect.width - column < tile_side ? rect.width - column : tile_side;
            std::memcpy(out + column, in, static_cast<std::size_t>(columns) * sizeof(std::uint32_t));
        }
    }
}

}  // namespace v0
}  // namespace shadowmath
