// SPDX-License-Identifier: MIT
//
// Triangles that are next to each other in the grid, raised to shadow volumes and searched sixteen at once: a cell of
// the grid takes those that reach it, and a node of its list takes those that may darken its tile.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/irregular/buffer.hpp>
#include <shadowmath/irregular/casters.hpp>
#include <shadowmath/irregular/lanes.hpp>
#include <shadowmath/irregular/lists.hpp>

#include <cstdint>
#include <limits>

namespace shadowmath {
inline namespace v0 {

namespace detail {

inline constexpr std::uint32_t chunk_room = 192;

// What a tile needs of a triangle.
template <class T>
struct RaisedTriangle {
    Wider<T> x[4], y[4], a[4], b[4];     // of each of the four half spaces
    T across[4], upward[4], by_q[4];     // x, y and b once more
    T keys[5];                           // see tile.hpp
};

// Bounds in lanes, behind the last of which as many as fill sixteen touch nothing.
template <class Lanes, class T = typename Lanes::Scalar>
struct CasterBounds {
    T lo_x[chunk_room + lane_count], hi_x[chunk_room + lane_count];
    T lo_y[chunk_room + lane_count], hi_y[chunk_room + lane_count];
    T depth[chunk_room + lane_count];  // the end nearest to the light
    std::uint32_t slot[chunk_room + lane_count];
    std::uint32_t count = 0;

    void end() noexcept {
        Lanes const most = Lanes::all(std::numeric_limits<T>::max());
        Lanes const least = Lanes::all(std::numeric_limits<T>::lowest());
        most.store(lo_x + count);
        least.store(hi_x + count);
        most.store(lo_y + count);
        least.store(hi_y + count);
        most.store(depth + count);
    }
    // Those that may touch the rectangle, no farther from the light than `far_end`.
    [[nodiscard]] std::uint32_t touching(std::uint32_t from, Lanes const& x0, Lanes const& x1, Lanes const& y0,
                                         Lanes const& y1, Lanes const& far_end) const noexcept {
        return at_least(Lanes::load(hi_x + from), x0) & at_least(x1, Lanes::load(lo_x + from)) &
               at_least(Lanes::load(hi_y + from), y0) & at_least(y1, Lanes::load(lo_y + from)) &
               at_least(far_end, Lanes::load(depth + from));
    }
};

// A rectangle of the grid in texels; those at its border go on without end.
template <class T>
struct Cell {
    T x0, x1, y0, y1;
};

// Cell (x, y) of cells that are 2^shift places wide.
template <class T>
[[nodiscard]] inline Cell<T> cell_at(int x, int y, int shift, int map_size) noexcept {
    auto const edge = [shift, last = map_size << most_divisions](int cell) {
        int const place = cell << shift;
        if (place <= 0) return std::numeric_limits<T>::lowest();
        return place < last ? T(place) * (T(1) / T(1 << most_divisions)) : std::numeric_limits<T>::max();
    };
    return {edge(x), edge(x + 1), edge(y), edge(y + 1)};
}

// The triangles of a chunk that reach a cell. A pair of a triangle and a node is met in every cell that both touch; it
// counts in that where the rectangle they share begins.
template <class Lanes, class T = typename Lanes::Scalar>
struct CellCasters {
    CasterBounds<Lanes> bounds;
    std::uint32_t begin_x[chunk_room / lane_count];  // bit k: begins no farther left than the cell
    std::uint32_t begin_y[chunk_room / lane_count];

    void take(CasterBounds<Lanes> const& from, Cell<T> const& cell, T far_end) noexcept {
        auto const all = [](T value) { return Lanes::all(value); };
        Lanes const x0 = all(cell.x0), x1 = all(cell.x1), y0 = all(cell.y0), y1 = all(cell.y1), depth = all(far_end);
        std::uint32_t n = 0;
        for (std::uint32_t i = 0; i < from.count; i += lane_count)
            n += Lanes::compress(from.touching(i, x0, x1, y0, y1, depth), from.slot + i, bounds.slot + n);
        bounds.count = n;
        if (n == 0) return;
        for (std::uint32_t i = 0; i < n; ++i) {
            std::uint32_t const slot = bounds.slot[i];
            bounds.lo_x[i] = from.lo_x[slot];
            bounds.hi_x[i] = from.hi_x[slot];
            bounds.lo_y[i] = from.lo_y[slot];
            bounds.hi_y[i] = from.hi_y[slot];
            bounds.depth[i] = from.depth[slot];
        }
        bounds.end();
        for (std::uint32_t i = 0; i < n; i += lane_count) {
            begin_x[i / lane_count] = at_least(Lanes::load(bounds.lo_x + i), x0);
            begin_y[i / lane_count] = at_least(Lanes::load(bounds.lo_y + i), y0);
        }
    }

    // The slots of those that may darken a node, without gaps; sixteen more can be written.
    [[nodiscard]] std::uint32_t find(T const* node, Cell<T> const& cell, std::uint32_t* slots) const noexcept {
        Lanes const lo_x = Lanes::all(node[0]), hi_x = Lanes::all(node[1]), lo_y = Lanes::all(node[2]),
                    hi_y = Lanes::all(node[3]), depth = Lanes::all(node[4]);
        std::uint32_t const any_x = node[0] >= cell.x0 ? 0xffffu : 0u, any_y = node[2] >= cell.y0 ? 0xffffu : 0u;
        std::uint32_t n = 0;
        for (std::uint32_t i = 0; i < bounds.count; i += lane_count) {
            std::uint32_t const g = i / lane_count;
            std::uint32_t const bits = bounds.touching(i, lo_x, hi_x, lo_y, hi_y, depth) & (any_x | begin_x[g]) &
                                       (any_y | begin_y[g]);
            n += Lanes::compress(bits, bounds.slot + i, slots + n);
        }
        return n;
    }
};

template <class Lanes, class T = typename Lanes::Scalar>
struct CasterChunk {
    CasterBounds<Lanes> bounds;
    RaisedTriangle<T> raised[chunk_room];

    void clear() noexcept { bounds.count = 0; }
    [[nodiscard]] bool full() const noexcept { return bounds.count + lane_count > chunk_room; }

    void add(CasterBatch<Lanes> const& batch) noexcept {
        for (std::uint32_t bits = batch.sound; bits != 0; bits &= bits - 1) {
            int const k = lowest_bit(bits);
            std::uint32_t const slot = bounds.count++;
            bounds.slot[slot] = slot;
            RaisedTriangle<T>& one = raised[slot];
            one.keys[1] = -(bounds.lo_x[slot] = batch.bounds[0][k]);
            one.keys[0] = bounds.hi_x[slot] = batch.bounds[1][k];
            one.keys[3] = -(bounds.lo_y[slot] = batch.bounds[2][k]);
            one.keys[2] = bounds.hi_y[slot] = batch.bounds[3][k];
            one.keys[4] = -(bounds.depth[slot] = batch.depth[k]);
            for (int i = 0; i < 4; ++i) {
                one.across[i] = static_cast<T>(one.x[i] = batch.plane[0][i][k]);
                one.upward[i] = static_cast<T>(one.y[i] = batch.plane[1][i][k]);
                one.a[i] = batch.plane[2][i][k];
                one.by_q[i] = static_cast<T>(one.b[i] = batch.plane[3][i][k]);
            }
        }
    }

    // What all of them together may touch, as bounds, and the end nearest to the light.
    void together(T (&all)[5]) const noexcept {
        Lanes lo_x = Lanes::load(bounds.lo_x), hi_x = Lanes::load(bounds.hi_x), lo_y = Lanes::load(bounds.lo_y),
              hi_y = Lanes::load(bounds.hi_y), depth = Lanes::load(bounds.depth);
        for (std::uint32_t i = lane_count; i < bounds.count; i += lane_count) {
            lo_x = least(lo_x, Lanes::load(bounds.lo_x + i));
            hi_x = most(hi_x, Lanes::load(bounds.hi_x + i));
            lo_y = least(lo_y, Lanes::load(bounds.lo_y + i));
            hi_y = most(hi_y, Lanes::load(bounds.hi_y + i));
            depth = least(depth, Lanes::load(bounds.depth + i));
        }
        all[0] = smallest(lo_x);
        all[1] = largest(hi_x);
        all[2] = smallest(lo_y);
        all[3] = largest(hi_y);
        all[4] = smallest(depth);
    }
};

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath
