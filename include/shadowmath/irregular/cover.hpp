// SPDX-License-Identifier: MIT
//
// Which samples of which pixels a triangle covers. Pairs of a triangle and a tile are queued, so that what they need of
// memory is asked for before it is used. First the pixels whose bounds are out of the triangle's reach are left out;
// the others are held against the four planes of its shadow volume, four pixels in four lanes each; samples are looked
// at last, in pixels that a plane crosses.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/irregular/buffer.hpp>
#include <shadowmath/irregular/casters.hpp>
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

// Tiles that the triangles of a batch may touch, triangle after triangle.
struct PairQueue {
    static constexpr std::uint32_t room = 512;
    std::uint32_t tile[room + lane_count];
    std::uint32_t count = 0;
    std::uint32_t begin[lane_count + 1];  // of each triangle
    int triangle[lane_count];
    int triangles = 0;

    void open(int k) noexcept {
        triangle[triangles] = k;
        begin[triangles++] = count;
    }
    // The last triangle touched nothing.
    void drop_empty() noexcept { triangles -= begin[triangles - 1] == count ? 1 : 0; }
    void clear() noexcept {
        count = 0;
        triangles = 0;
    }
};

template <class Lanes, class T = typename Lanes::Scalar>
struct CoverKernel {
    IrregularBuffer<T>& buffer;
    PixelFrame<Wider<T>> const& frame;

    using Real = Wider<T>;
    using Batch = CasterBatch<Lanes>;

    static constexpr std::uint32_t ahead = 8;  // tiles

    // Pixels that remain, as bits.
    struct Remaining {
        std::uint32_t tile[PairQueue::room + lane_count];
        std::uint32_t pixels[PairQueue::room + lane_count];
    };

    struct Planes {
        Real x[4], y[4], a[4], b[4];
        T narrow[3][4];              // x, y and b
        Lanes across, upward, by_q;  // the same, four lanes each
    };

    [[nodiscard]] static Planes planes_of(Batch const& batch, int k) noexcept {
        Planes planes;
        for (int i = 0; i < 4; ++i) {
            planes.narrow[0][i] = static_cast<T>(planes.x[i] = batch.plane[0][i][k]);
            planes.narrow[1][i] = static_cast<T>(planes.y[i] = batch.plane[1][i][k]);
            planes.a[i] = batch.plane[2][i][k];
            planes.narrow[2][i] = static_cast<T>(planes.b[i] = batch.plane[3][i][k]);
        }
        planes.across = Lanes::quadrupled(planes.narrow[0]);
        planes.upward = Lanes::quadrupled(planes.narrow[1]);
        planes.by_q = Lanes::quadrupled(planes.narrow[2]);
        return planes;
    }

    void cover(Batch const& batch, PairQueue& queue) const noexcept {
        Remaining remaining;
        std::uint32_t kept = 0;
        queue.begin[queue.triangles] = queue.count;
        for (std::uint32_t n = 0; n < ahead && n < queue.count; ++n) fetch_bounds(queue.tile[n]);
        for (int t = 0; t < queue.triangles; ++t) {
            int const k = queue.triangle[t];
            T const keys[8] = {batch.bounds[1][k], -batch.bounds[0][k], batch.bounds[3][k], -batch.bounds[2][k],
                               -batch.depth[k]};
            std::uint32_t const first = kept;
            for (std::uint32_t n = queue.begin[t]; n < queue.begin[t + 1]; ++n) {
                if (n + ahead < queue.count) fetch_bounds(queue.tile[n + ahead]);
                std::uint32_t const tile = queue.tile[n];
                remaining.tile[kept] = tile;
                remaining.pixels[kept] = pixels_in_reach(tile, keys);
                kept += remaining.pixels[kept] != 0 ? 1u : 0u;
            }
            queue.begin[t] = first;
        }
        queue.begin[queue.triangles] = kept;
        for (std::uint32_t n = 0; n < ahead / 2 && n < kept; ++n) fetch_quads(remaining.tile[n]);
        for (int t = 0; t < queue.triangles; ++t) {
            std::uint32_t n = queue.begin[t];
            std::uint32_t const end = queue.begin[t + 1];
            if (n == end) continue;
            Planes const planes = planes_of(batch, queue.triangle[t]);
            for (; n < end; ++n) {
                if (n + ahead / 2 < kept) fetch_quads(remaining.tile[n + ahead / 2]);
                test(remaining.tile[n], remaining.pixels[n], planes);
            }
        }
        queue.clear();
    }

    void fetch_bounds(std::uint32_t tile) const noexcept {
        auto const index = static_cast<std::size_t>(tile);
        fetch_soon(buffer.range + index * lane_count);
        fetch_soon(buffer.bounds + index * lane_count);
        fetch_soon(buffer.beyond + index * (lane_count / 4));
        fetch_soon(buffer.alive + index);
    }
    void fetch_quads(std::uint32_t tile) const noexcept {
        T const* const quads = buffer.quad + 3 * lane_count * static_cast<std::size_t>(tile);
        for (int i = 0; i < 3; ++i) fetch_soon(quads + i * lane_count);
        fetch_soon(buffer.mask + lane_count * static_cast<std::size_t>(tile));
    }

    [[nodiscard]] std::uint32_t pixels_in_reach(std::uint32_t tile, T const (&keys)[8]) const noexcept {
        auto const index = static_cast<std::size_t>(tile);
        T const* const base = buffer.range + index * lane_count;
        auto const* const bounds = reinterpret_cast<unsigned char const*>(buffer.bounds + index * lane_count);
        auto const* const beyond = reinterpret_cast<unsigned char const*>(buffer.beyond + index * (lane_count / 4));
        return buffer.alive[tile] & Lanes::reached(keys, base, base + lane_count / 2, bounds, beyond);
    }

    static constexpr std::uint32_t every_lane[lane_count] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

    void test(std::uint32_t tile, std::uint32_t pixels, Planes const& planes) const noexcept {
        auto const tiles_across = static_cast<std::uint32_t>(buffer.tiles_across);
        Real const x =
            Real(static_cast<int>(tile % tiles_across * tile_side) + buffer.rect.x) - Real(frame.width) / Real(2);
        Real const y =
            Real(static_cast<int>(tile / tiles_across * tile_side) + buffer.rect.y) - Real(frame.height) / Real(2);
        auto const tile_q = Real(buffer.tile_q[tile]);
        // Here large terms cancel; what is left is no more than a tile's worth.
        T here[4];
        for (int i = 0; i < 4; ++i)
            here[i] = static_cast<T>(planes.x[i] * x + planes.y[i] * y + (planes.a[i] + planes.b[i] * tile_q));
        T const* const quads = buffer.quad + 3 * lane_count * static_cast<std::size_t>(tile);
        std::uint32_t pixel[lane_count]{};
        std::uint32_t const count = Lanes::compress(pixels, every_lane, pixel);
        std::uint32_t const done =
            count <= 4 ? few(tile, quads, pixel, count, here, planes) : many(tile, quads, pixels, here, planes);
        if (done != 0) buffer.alive[tile] &= ~done;
    }

    // Four pixels: lane 4 i + j is plane i and pixel j.
    [[nodiscard]] std::uint32_t few(std::uint32_t tile, T const* quads, std::uint32_t const* pixel, std::uint32_t count,
                                    T const (&here)[4], Planes const& planes) const noexcept {
        Lanes const zero = Lanes::all(T(0));
        Lanes const q_x = Lanes::picked(quads + lane_count, pixel), q_y = Lanes::picked(quads + 2 * lane_count, pixel);
        Lanes const column = Lanes::picked(tile_columns<T>, pixel), row = Lanes::picked(tile_rows<T>, pixel);
        Lanes const c = fused(planes.by_q, Lanes::picked(quads, pixel),
                              fused(planes.upward, row, fused(planes.across, column, Lanes::quadrupled(here))));
        Lanes const gain_x = fused(planes.by_q, q_x, planes.across);
        Lanes const gain_y = fused(planes.by_q, q_y, planes.upward);
        std::uint32_t const touched = ((1u << count) - 1u) & in_all_planes(highest(c, gain_x, gain_y));
        if (touched == 0) return 0;
        std::uint32_t const full = in_all_planes(at_least((c + least(gain_x, zero)) + least(gain_y, zero), zero));
        T lines[3][lane_count];
        c.store(lines[0]);
        gain_x.store(lines[1]);
        gain_y.store(lines[2]);
        std::uint32_t done = 0;
        for (std::uint32_t bits = touched; bits != 0; bits &= bits - 1) {
            int const place = lowest_bit(bits);
            std::uint32_t dark = every_sample;
            if ((full >> place & 1u) == 0)
                for (int i = place; i < lane_count; i += 4)
                    dark &= half_plane_mask<Lanes>(PixelLine<T>{lines[0][i], lines[1][i], lines[2][i]});
            done |= darken(tile, pixel[place], dark);
        }
        return done;
    }

    // A lane for each pixel.
    [[nodiscard]] std::uint32_t many(std::uint32_t tile, T const* quads, std::uint32_t pixels, T const (&here)[4],
                                     Planes const& planes) const noexcept {
        Lanes const zero = Lanes::all(T(0));
        Lanes const q = Lanes::load(quads), q_x = Lanes::load(quads + lane_count),
                    q_y = Lanes::load(quads + 2 * lane_count);
        Lanes const column = Lanes::load(tile_columns<T>), row = Lanes::load(tile_rows<T>);
        Lanes c[4], gain_x[4], gain_y[4];
        std::uint32_t touched = pixels;
        for (int i = 0; i < 4; ++i) {
            Lanes const across = Lanes::all(planes.narrow[0][i]), upward = Lanes::all(planes.narrow[1][i]),
                        by_q = Lanes::all(planes.narrow[2][i]);
            c[i] = fused(by_q, q, fused(upward, row, fused(across, column, Lanes::all(here[i]))));
            gain_x[i] = fused(by_q, q_x, across);
            gain_y[i] = fused(by_q, q_y, upward);
            touched &= highest(c[i], gain_x[i], gain_y[i]);
        }
        if (touched == 0) return 0;
        std::uint32_t full = touched;
        T lines[4][3][lane_count];
        for (int i = 0; i < 4; ++i) {
            full &= at_least((c[i] + least(gain_x[i], zero)) + least(gain_y[i], zero), zero);
            c[i].store(lines[i][0]);
            gain_x[i].store(lines[i][1]);
            gain_y[i].store(lines[i][2]);
        }
        std::uint32_t done = full;
        for (std::uint32_t bits = full; bits != 0; bits &= bits - 1) mask_of(tile, lowest_bit(bits)) = every_sample;
        for (std::uint32_t bits = touched & ~full; bits != 0; bits &= bits - 1) {
            int const k = lowest_bit(bits);
            std::uint32_t dark = every_sample;
            for (auto const& line : lines)
                dark &= half_plane_mask<Lanes>(PixelLine<T>{line[0][k], line[1][k], line[2][k]});
            done |= darken(tile, static_cast<std::uint32_t>(k), dark);
        }
        return done;
    }

    // Where a half plane may hold a sample, in the order of half_plane_mask: rounding is monotone.
    [[nodiscard]] static std::uint32_t highest(Lanes const& c, Lanes const& gain_x, Lanes const& gain_y) noexcept {
        Lanes const zero = Lanes::all(T(0));
        return at_least((c + most(gain_x, zero)) + most(gain_y, zero), zero);
    }

    [[nodiscard]] std::uint32_t& mask_of(std::uint32_t tile, int pixel) const noexcept {
        return buffer.mask[static_cast<std::size_t>(tile) * lane_count + static_cast<std::size_t>(pixel)];
    }

    // The pixel's bit where no sample is left.
    [[nodiscard]] std::uint32_t darken(std::uint32_t tile, std::uint32_t pixel, std::uint32_t dark) const noexcept {
        std::uint32_t& mask = mask_of(tile, static_cast<int>(pixel));
        mask |= dark;
        return (mask == every_sample ? 1u : 0u) << pixel;
    }

    // Bit k where bits k, 4 + k, 8 + k and 12 + k are set.
    [[nodiscard]] static std::uint32_t in_all_planes(std::uint32_t bits) noexcept {
        bits &= bits >> 8;
        return bits & bits >> 4 & 0xfu;
    }
};

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath
