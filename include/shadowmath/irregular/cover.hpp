// SPDX-License-Identifier: MIT
//
// Which samples of a tile the triangles of a chunk cover. First the pixels whose bounds are out of a triangle's reach
// are left out; the others are held against the four planes of its shadow volume; samples are looked at last, in pixels
// that a plane crosses. Tiles are queued, so that what they need of memory is asked for before it is used; and each step
// is done for all triangles of a tile before the next, so that none waits for what is found of another.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/irregular/buffer.hpp>
#include <shadowmath/irregular/chunk.hpp>
#include <shadowmath/irregular/lanes.hpp>
#include <shadowmath/irregular/mask.hpp>
#include <shadowmath/irregular/microquad.hpp>

#include <cstddef>
#include <cstdint>

namespace shadowmath {
inline namespace v0 {

namespace detail {

inline void fetch_soon(void const* line) noexcept {
#if defined(__GNUC__)
    __builtin_prefetch(line);
#else
    static_cast<void>(line);
#endif
}

template <class Lanes, class T = typename Lanes::Scalar>
struct CoverKernel {
    IrregularBuffer<T>& buffer;
    PixelFrame<Wider<T>> const& frame;

    using Real = Wider<T>;
    using Wide = typename Lanes::Wide;

    // Tiles that wait, and the slots of the triangles that may darken each.
    struct Queue {
        static constexpr std::uint32_t most_tiles = 16, most_slots = 512;
        std::uint32_t tile[most_tiles];
        std::uint32_t begin[most_tiles + 1];
        std::uint32_t slot[most_slots + chunk_room + lane_count];
        std::uint32_t tiles = 0;
        std::uint32_t slots = 0;

        [[nodiscard]] std::uint32_t* next() noexcept { return slot + slots; }
        [[nodiscard]] bool full() const noexcept { return tiles == most_tiles || slots >= most_slots; }
    };

    // Pairs of a tile and a triangle that remain.
    struct Pairs {
        static constexpr std::uint32_t room = Queue::most_slots + chunk_room;
        std::uint32_t tile[room];
        std::uint32_t slot[room];
        std::uint32_t pixels[room];
        T here[room + 3][4];  // the four planes' values at the corner of the tile
        std::uint32_t count = 0;
    };

    struct Quads {
        Lanes q, q_x, q_y, column, row;
    };

    // A plane as a line across each pixel: inside where c + x u + y v >= 0.
    struct Lines {
        Lanes c, x, y;
    };

    // Takes the next `count` slots of the queue for a tile.
    void enqueue(std::uint32_t tile, std::uint32_t count, Queue& queue) const noexcept {
        queue.tile[queue.tiles] = tile;
        queue.begin[queue.tiles++] = queue.slots;
        queue.slots += count;
        T const* const surface = surface_of(tile);
        std::uint32_t const* const state = state_of(tile);
        for (std::size_t i = 0; i < tile_scalars; i += cache_line / sizeof(T)) fetch_soon(surface + i);
        for (std::size_t i = 0; i < tile_words; i += cache_line / sizeof(std::uint32_t)) fetch_soon(state + i);
    }

    void cover(RaisedTriangle<T> const* raised, Queue& queue) const noexcept {
        Pairs pairs;
        queue.begin[queue.tiles] = queue.slots;
        for (std::uint32_t i = 0; i < queue.tiles; ++i) {
            std::uint32_t const first = pairs.count;
            leave_out(queue.tile[i], raised, queue.slot + queue.begin[i], queue.begin[i + 1] - queue.begin[i], pairs);
            place(queue.tile[i], raised, first, pairs);
        }
        queue.tiles = queue.slots = 0;
        std::uint32_t crossing[Pairs::room];
        std::uint32_t const crossings = cross(raised, pairs, crossing);
        for (std::uint32_t i = 0; i < crossings; ++i) {
            std::uint32_t const n = crossing[i], tile = pairs.tile[n];
            std::uint32_t* const state = state_of(tile);
            state[alive_at] &= ~darken(quads_of(tile), raised[pairs.slot[n]], pairs.here[n], pairs.pixels[n], state + mask_at);
        }
    }

    [[nodiscard]] Quads quads_of(std::uint32_t tile) const noexcept {
        T const* const surface = surface_of(tile);
        return {Lanes::load(surface), Lanes::load(surface + lane_count), Lanes::load(surface + 2 * lane_count),
                Lanes::load(tile_columns<T>), Lanes::load(tile_rows<T>)};
    }

    [[nodiscard]] T* surface_of(std::uint32_t tile) const noexcept {
        return buffer.surface + tile_scalars * static_cast<std::size_t>(tile);
    }
    [[nodiscard]] std::uint32_t* state_of(std::uint32_t tile) const noexcept {
        return buffer.state + tile_words * static_cast<std::size_t>(tile);
    }

    // Keeps the triangles that reach the bounds of a pixel.
    void leave_out(std::uint32_t tile, RaisedTriangle<T> const* raised, std::uint32_t const* slots, std::uint32_t count,
                   Pairs& pairs) const noexcept {
        std::uint32_t const* const state = state_of(tile);
        T const* const base = surface_of(tile) + key_base_at;
        T const* const step = surface_of(tile) + key_step_at;
        auto const* const bytes = reinterpret_cast<unsigned char const*>(state);
        auto const bound = [=](int i) {
            return fused(Lanes::load_bytes(bytes + i * lane_count), Lanes::all(step[i]), Lanes::all(base[i]));
        };
        Lanes const bounds[5] = {bound(0), bound(1), bound(2), bound(3), bound(4)};
        std::uint32_t const alive = state[alive_at];
        std::uint32_t kept = pairs.count;
        for (std::uint32_t n = 0; n < count; ++n) {
            T const(&keys)[5] = raised[slots[n]].keys;
            std::uint32_t pixels = alive;
            for (int i = 0; i < 5; ++i) pixels &= at_least(Lanes::all(keys[i]), bounds[i]);
            pairs.tile[kept] = tile;
            pairs.slot[kept] = slots[n];
            pairs.pixels[kept] = pixels;
            kept += pixels != 0 ? 1u : 0u;
        }
        pairs.count = kept;
    }

    // The planes' values at the corner of the tile, of four triangles at once. Here large terms cancel; what is left is no
    // more than a tile's worth.
    void place(std::uint32_t tile, RaisedTriangle<T> const* raised, std::uint32_t first, Pairs& pairs) const noexcept {
        auto const tiles_across = static_cast<std::uint32_t>(buffer.tiles_across);
        auto const all = [](Real value) { return Wide::all(value); };
        Wide const x = all(Real(static_cast<int>(tile % tiles_across * tile_side) + buffer.rect.x) -
                           Real(frame.width) / Real(2));
        Wide const y = all(Real(static_cast<int>(tile / tiles_across * tile_side) + buffer.rect.y) -
                           Real(frame.height) / Real(2));
        Wide const q = all(Real(surface_of(tile)[tile_q_at]));
        for (std::uint32_t n = first; n < pairs.count; n += 4) {
            // Past the last, the tile's first once more.
            RaisedTriangle<T> const* four[4];
            for (std::uint32_t j = 0; j < 4; ++j) four[j] = raised + pairs.slot[n + j < pairs.count ? n + j : first];
            auto const rows = [&four](Real const (RaisedTriangle<T>::*plane)[4]) {
                Real const* const row[4] = {four[0]->*plane, four[1]->*plane, four[2]->*plane, four[3]->*plane};
                return Wide::rows(row);
            };
            using Raised = RaisedTriangle<T>;
            Lanes::narrow(fused(rows(&Raised::x), x, fused(rows(&Raised::y), y, fused(rows(&Raised::b), q, rows(&Raised::a)))))
                .store(pairs.here[n]);
        }
    }

    [[nodiscard]] static Lines lines_of(Quads const& quads, RaisedTriangle<T> const& planes, int i,
                                        T const (&here)[4]) noexcept {
        Lanes const across = Lanes::all(planes.across[i]), upward = Lanes::all(planes.upward[i]),
                    by_q = Lanes::all(planes.by_q[i]);
        return {fused(by_q, quads.q, fused(upward, quads.row, fused(across, quads.column, Lanes::all(here[i])))),
                fused(by_q, quads.q_x, across), fused(by_q, quads.q_y, upward)};
    }

    // Pixels of which a sample may be inside, in the order of half_plane_mask: rounding is monotone.
    [[nodiscard]] static std::uint32_t touched(Lines const& lines) noexcept {
        Lanes const zero = Lanes::all(T(0));
        return at_least((lines.c + most(lines.x, zero)) + most(lines.y, zero), zero);
    }

    // Leaves the pixels of which a sample may be within all four planes, and gives the pairs that have some. The
    // triangle's own plane comes first: half of what it does not shadow lies before it.
    [[nodiscard]] std::uint32_t cross(RaisedTriangle<T> const* raised, Pairs& pairs,
                                      std::uint32_t* crossing) const noexcept {
        std::uint32_t behind = 0;
        for (std::uint32_t n = 0; n < pairs.count; ++n) {
            std::uint32_t const pixels =
                pairs.pixels[n] &
                touched(lines_of(quads_of(pairs.tile[n]), raised[pairs.slot[n]], 0, pairs.here[n]));
            pairs.pixels[n] = pixels;
            crossing[behind] = n;
            behind += pixels != 0 ? 1u : 0u;
        }
        std::uint32_t kept = 0;
        for (std::uint32_t m = 0; m < behind; ++m) {
            std::uint32_t const n = crossing[m];
            Quads const quads = quads_of(pairs.tile[n]);
            std::uint32_t pixels = pairs.pixels[n];
            for (int i = 1; i < 4; ++i) pixels &= touched(lines_of(quads, raised[pairs.slot[n]], i, pairs.here[n]));
            pairs.pixels[n] = pixels;
            crossing[kept] = n;
            kept += pixels != 0 ? 1u : 0u;
        }
        return kept;
    }

    // Gives the pixels that have no sample left.
    [[nodiscard]] static std::uint32_t darken(Quads const& quads, RaisedTriangle<T> const& planes, T const (&here)[4],
                                              std::uint32_t pixels, std::uint32_t* masks) noexcept {
        T stored[4][3][lane_count];
        for (int i = 0; i < 4; ++i) {
            Lines const lines = lines_of(quads, planes, i, here);
            lines.c.store(stored[i][0]);
            lines.x.store(stored[i][1]);
            lines.y.store(stored[i][2]);
        }
        std::uint32_t done = 0;
        for (std::uint32_t bits = pixels; bits != 0; bits &= bits - 1) {
            int const k = lowest_bit(bits);
            PixelLine<T> lines_here[4];
            for (int i = 0; i < 4; ++i) lines_here[i] = {stored[i][0][k], stored[i][1][k], stored[i][2][k]};
            std::uint32_t const dark = masks[k] |= half_planes_mask<Lanes>(lines_here);
            done |= (dark == every_sample ? 1u : 0u) << k;
        }
        return done;
    }
};

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath
