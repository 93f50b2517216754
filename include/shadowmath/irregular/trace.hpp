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
// texels.
//
// Against ray tracing (bench/irregular.cpp, 32 samples a pixel, one thread): the whole frame takes a fifth of Embree's
// best at 100 thousand triangles and a quarter at a million, about as long as Embree's with one ray a pixel. At a
// million half of it goes to pairs of a triangle and a tile, most of which end without a sample darkened, and a sixth
// each to loading triangles and to finding their lists.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/irregular/buffer.hpp>
#include <shadowmath/irregular/casters.hpp>
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

    // The levels that have a node which triangle k may touch.
    [[nodiscard]] std::uint32_t levels_at(PlaceRange const& texels, T depth) const noexcept {
        if (texels.x1 - texels.x0 > 3 || texels.y1 - texels.y0 > 3) return buffer.levels_used;
        std::uint32_t levels = 0;
        for (int y = texels.y0; y <= texels.y1; ++y)
            for (int x = texels.x0; x <= texels.x1; ++x) {
                int const texel = y * buffer.map_size + x;
                levels |= buffer.texel_depth[texel] >= depth ? buffer.texel_levels[texel] : 0u;
            }
        return levels;
    }

    [[nodiscard]] PlaceRange places_of_triangle(Batch const& batch, int k) const noexcept {
        T const bounds[4] = {batch.bounds[0][k], batch.bounds[1][k], batch.bounds[2][k], batch.bounds[3][k]};
        return places_of(bounds, buffer.map_size);
    }

    // What a triangle is compared with nodes by.
    struct Probe {
        Lanes lo_x, hi_x, lo_y, hi_y, depth;
        Batch const& batch;
        int k;
    };

    // Queues the tiles of those nodes of [node, end) that the triangle may touch, and that it did not meet in a list
    // before: those that begin at these edges of their cells or later. Nodes up to `all_across` may begin before x.
    void scan(std::uint32_t node, std::uint32_t all_across, std::uint32_t end, T edge_x, T edge_y, Probe const& probe,
              PairQueue& queue) const noexcept {
        for (; node < end; node += lane_count) {
            Lanes const lo_x = Lanes::load(buffer.lo_x + node), lo_y = Lanes::load(buffer.lo_y + node);
            std::uint32_t hit = at_least(probe.hi_x, lo_x) & at_least(Lanes::load(buffer.hi_x + node), probe.lo_x) &
                                at_least(probe.hi_y, lo_y) & at_least(Lanes::load(buffer.hi_y + node), probe.lo_y) &
                                at_least(Lanes::load(buffer.depth + node), probe.depth) &
                                at_least(lo_y, Lanes::all(edge_y)) &
                                (at_least(lo_x, Lanes::all(edge_x)) | first_of(all_across, node));
            hit &= first_of(end, node);
            queue.count += Lanes::compress(hit, buffer.tile + node, queue.tile + queue.count);
            if (queue.count < PairQueue::room) continue;
            cover.cover(probe.batch, queue);
            queue.open(probe.k);
        }
    }

    [[nodiscard]] static std::uint32_t first_of(std::uint32_t end, std::uint32_t begin) noexcept {
        if (end <= begin) return 0;
        return end - begin < lane_count ? (1u << (end - begin)) - 1u : (1u << lane_count) - 1u;
    }

    // One triangle against the lists of the texels that it may cover.
    void walk(Batch const& batch, int k, PairQueue& queue) const noexcept {
        PlaceRange const places = places_of_triangle(batch, k);
        PlaceRange const texels = texels_of(places, 0);
        std::uint32_t levels = levels_at(texels, batch.depth[k]);
        if (levels == 0) return;
        queue.open(k);
        Probe const probe{Lanes::all(batch.bounds[0][k]),
                          Lanes::all(batch.bounds[1][k]),
                          Lanes::all(batch.bounds[2][k]),
                          Lanes::all(batch.bounds[3][k]),
                          Lanes::all(batch.depth[k]),
                          batch,
                          k};
        T const anywhere = std::numeric_limits<T>::lowest();
        std::uint32_t const* const first = buffer.first;
        if ((levels & 1u) != 0)
            for (int y = texels.y0; y <= texels.y1; ++y)
                for (int x = texels.x0; x <= texels.x1; ++x) {
                    int const texel = y * buffer.map_size + x;
                    if (buffer.texel_depth[texel] < batch.depth[k] || (buffer.texel_levels[texel] & 1u) == 0) continue;
                    bool const first_column = x == texels.x0, first_row = y == texels.y0;
                    auto const division = static_cast<int>(buffer.texel_division[texel]);
                    T const side = T(1) / T(1 << division);
                    std::uint32_t const* const lists = first + buffer.texel_lists[texel];
                    PlaceRange const in = divisions_of(places, x, y, division);
                    scan(lists[0], first_column ? lists[1] : 0u, lists[1], T(x), first_row ? anywhere : T(y), probe,
                         queue);
                    T const edge_x = T(x) + T(first_column ? in.x0 + 1 : 0) * side;
                    for (int j = in.y0; j <= in.y1; ++j) {
                        std::uint32_t const* const row = lists + 1 + (j << division);
                        scan(row[in.x0], first_column ? row[in.x0 + 1] : 0u, row[in.x1 + 1], edge_x,
                             first_row && j == in.y0 ? anywhere : T(y) + T(j) * side, probe, queue);
                    }
                }
        for (levels &= ~1u; levels != 0; levels &= levels - 1) {
            int const level = lowest_bit(levels);
            int const size = level_size(buffer.map_size, level);
            T const side = T(1 << level_shift * level);
            PlaceRange const range = texels_of(places, level);
            for (int y = range.y0; y <= range.y1; ++y) {
                std::uint32_t const* const row = first + buffer.level_first[level] + y * size;
                scan(row[range.x0], row[range.x0 + 1], row[range.x1 + 1], T(range.x0 + 1) * side,
                     y == range.y0 ? anywhere : T(y) * side, probe, queue);
            }
        }
        queue.drop_empty();
    }

    // At most caster_block triangles, in the order of the texels that they begin in: what is next to each other in the
    // grid is then in the caches, however the mesh was laid out.
    void run_block(std::uint32_t begin, std::uint32_t count, Batch& batch, PairQueue& queue) const noexcept {
        auto const texels = static_cast<std::uint32_t>(buffer.map_size * buffer.map_size);
        std::uint32_t* const start = buffer.block_count;
        std::memset(start, 0, (texels + 2) * sizeof(std::uint32_t));
        for (std::uint32_t i = 0; i < count; i += lane_count) {
            kernel.load(begin + i, count - i, nullptr, batch);
            for (std::uint32_t k = 0; k < lane_count && i + k < count; ++k) {
                std::uint32_t texel = texels;
                if ((batch.sound >> k & 1u) != 0) {
                    PlaceRange const at = texels_of(places_of_triangle(batch, static_cast<int>(k)), 0);
                    if (levels_at(at, batch.depth[k]) != 0) {
                        texel = static_cast<std::uint32_t>(at.y0 * buffer.map_size + at.x0);
                        ++start[texel + 1];
                    }
                }
                buffer.block_texel[i + k] = texel;
            }
        }
        for (std::uint32_t texel = 0; texel < texels; ++texel) start[texel + 1] += start[texel];
        std::uint32_t const kept = start[texels];
        for (std::uint32_t i = 0; i < count; ++i)
            if (buffer.block_texel[i] != texels) buffer.block_order[start[buffer.block_texel[i]]++] = begin + i;
        for (std::uint32_t i = 0; i < kept; i += lane_count) {
            kernel.load(i, kept - i, buffer.block_order, batch);
            kernel.raise_volumes(batch);
            for (std::uint32_t bits = batch.sound; bits != 0; bits &= bits - 1) walk(batch, lowest_bit(bits), queue);
            cover.cover(batch, queue);
        }
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
    T const w_floor = slack * (buffer.light.parallel ? buffer.least_w : buffer.most_w);
    PixelFrame<Wider<T>> const frame = frame_in<Wider<T>>(buffer.frame);
    detail::TraceKernel<Lanes> const kernel{
        buffer, {buffer, casters, frame, pixel_light(frame, buffer.source), w_floor}, {buffer, frame}};
    detail::CasterBatch<Lanes> batch;
    detail::PairQueue queue;
    for (std::uint32_t done = 0; done < count;) {
        std::uint32_t const block =
            count - done < caster_block ? count - done : static_cast<std::uint32_t>(caster_block);
        kernel.run_block(first + done, block, batch, queue);
        done += block;
    }
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
        std::uint32_t const* in = buffer.mask +
                                  static_cast<std::size_t>(row / tile_side * buffer.tiles_across) * lane_count +
                                  row % tile_side * tile_side;
        for (int column = 0; column < rect.width; column += tile_side, in += lane_count) {
            int const columns = rect.width - column < tile_side ? rect.width - column : tile_side;
            std::memcpy(out + column, in, static_cast<std::size_t>(columns) * sizeof(std::uint32_t));
        }
    }
}

}  // namespace v0
}  // namespace shadowmath
