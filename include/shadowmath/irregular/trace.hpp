// SPDX-License-Identifier: MIT
//
// Exact hard shadows: every triangle against the pixels whose light it may take, 32 samples each. No resolution, no
// bias, no filter: a sample is dark when the segment from it to the light meets a triangle.
//
//   storage                    arrays of the caller's, storage_for(...) long
//   list_receivers(...)        once for a picture, or for each strip of it
//   trace(buffer, casters)     in any order, any number of times; strips can run on threads of their own
//   write_masks(buffer, out)   one word a pixel: bit i is set where sample i is dark
//
// Use it where shadows must be right to the pixel; on a CPU it is faster than ray tracing as long as every pixel is
// wanted. For a few points, or soft shadows, trace rays instead.
//
// Source: Wyman, Hoetzlein and Lefohn, TVCG 22(10) 2016. Departures: tiles of 4 x 4 pixels are tested at once, against
// all four planes before any sample; triangles are clipped only to find their texels.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/irregular/edge.hpp>
#include <shadowmath/irregular/grid.hpp>
#include <shadowmath/irregular/lanes.hpp>
#include <shadowmath/irregular/mask.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

namespace shadowmath {
inline namespace v0 {

// Triangles: three indices each, or three vertices each where there are none.
template <class T>
struct Casters {
    T const* position = nullptr;  // world; three scalars a vertex, `stride` apart
    int stride = 3;
    std::uint32_t vertex_count = 0;
    std::uint32_t const* index = nullptr;
    std::uint32_t triangle_count = 0;
};

// The surface of a receiver is trusted to one part in 2^20 of the coordinates: what a G-buffer in float is worth.
template <class T>
inline constexpr T contact_share = T(1) / T(1 << 20);

namespace detail {

// Vertices beyond are no scene; below, products of three of them stay within a float.
template <class T>
inline constexpr T farthest_vertex = T(1e9);

// What a triangle may cover of the grid: lo x, hi x, lo y, hi y in texels, and its least depth.
template <class T>
struct Footing {
    T bounds[4];
    T depth;
};

template <class Lanes, class T = typename Lanes::Scalar>
struct TraceKernel {
    IrregularBuffer<T>& buffer;
    Casters<T> const& casters;
    Lanes column_in_tile, row_in_tile;
    T w_floor;

    // One triangle against sixteen pixels.
    void test(std::uint32_t tile, ShadowVolume<T> const& volume) const noexcept {
        std::uint32_t const alive = buffer.alive[tile];
        T const* const quads = buffer.quad + 3 * lane_count * static_cast<std::size_t>(tile);
        Lanes const q = Lanes::load(quads), q_x = Lanes::load(quads + lane_count), q_y = Lanes::load(quads + 2 * lane_count);
        auto const tiles_across = static_cast<std::uint32_t>(buffer.tiles_across);
        T const x = T(tile % tiles_across * tile_side) - T(buffer.frame.width) / T(2);
        T const y = T(tile / tiles_across * tile_side) + T(buffer.first_row) - T(buffer.frame.height) / T(2);
        Lanes const zero = Lanes::all(T(0));
        Lanes c[4], gain_x[4], gain_y[4];
        std::uint32_t touched = alive, covered = alive;
        for (int i = 0; i < 4; ++i) {
            PixelPlane<T> const& p = i == 0 ? volume.behind : volume.edge[i - 1];
            Lanes const px = Lanes::all(p.x), py = Lanes::all(p.y), pb = Lanes::all(p.b);
            c[i] = fused(pb, q, fused(py, row_in_tile, fused(px, column_in_tile, Lanes::all(p.x * x + p.y * y + p.a))));
            gain_x[i] = fused(pb, q_x, px);
            gain_y[i] = fused(pb, q_y, py);
            // In the order of half_plane_mask, where rounding is monotone: no sample lies beyond these.
            touched &= at_least((c[i] + most(gain_x[i], zero)) + most(gain_y[i], zero), zero);
            if (touched == 0) return;
            covered &= at_least((c[i] + least(gain_x[i], zero)) + least(gain_y[i], zero), zero);
        }
        std::uint32_t* const masks = buffer.mask + static_cast<std::size_t>(tile) * lane_count;
        std::uint32_t done = covered & touched;
        for (std::uint32_t bits = done; bits != 0; bits &= bits - 1) masks[lowest_bit(bits)] = every_sample;
        std::uint32_t crossed = touched & ~covered;
        if (crossed != 0) {
            T lines[4][3][lane_count];
            for (int i = 0; i < 4; ++i) {
                c[i].store(lines[i][0]);
                gain_x[i].store(lines[i][1]);
                gain_y[i].store(lines[i][2]);
            }
            for (; crossed != 0; crossed &= crossed - 1) {
                int const k = lowest_bit(crossed);
                std::uint32_t dark = every_sample;
                for (int i = 0; i < 4; ++i)
                    dark &= half_plane_mask<Lanes>(PixelLine<T>{lines[i][0][k], lines[i][1][k], lines[i][2][k]});
                masks[k] |= dark;
                if (masks[k] == every_sample) done |= 1u << k;
            }
        }
        if (done != 0) buffer.alive[tile] = alive & ~done;
    }

    [[nodiscard]] static int lowest_bit(std::uint32_t bits) noexcept {
#if defined(__GNUC__)
        return __builtin_ctz(bits);
#else
        int place = 0;
        while ((bits >> place & 1u) == 0) ++place;
        return place;
#endif
    }

    // One triangle against the lists of the texels that it may cover.
    void walk(Footing<T> const& footing, ShadowVolume<T> const& volume, std::uint32_t stamp) const noexcept {
        Lanes const lo_x = Lanes::all(footing.bounds[0]), hi_x = Lanes::all(footing.bounds[1]);
        Lanes const lo_y = Lanes::all(footing.bounds[2]), hi_y = Lanes::all(footing.bounds[3]);
        Lanes const depth = Lanes::all(footing.depth);
        for (std::uint32_t levels = buffer.levels_used; levels != 0; levels &= levels - 1) {
            int const level = lowest_bit(levels);
            auto const size = static_cast<std::uint32_t>(level_size(buffer.map_size, level));
            TexelRange<T> const range = texels_at(footing.bounds, buffer.map_size, level);
            for (int y = range.y0; y <= range.y1; ++y) {
                std::uint32_t const* const first = buffer.first + buffer.texels_before[level] + static_cast<std::uint32_t>(y) * size;
                std::uint32_t const end = first[range.x1 + 1];
                for (std::uint32_t node = first[range.x0]; node < end; node += lane_count) {
                    std::uint32_t hit = at_least(hi_x, Lanes::load(buffer.lo_x + node)) & at_least(Lanes::load(buffer.hi_x + node), lo_x) &
                                        at_least(hi_y, Lanes::load(buffer.lo_y + node)) & at_least(Lanes::load(buffer.hi_y + node), lo_y) &
                                        at_least(Lanes::load(buffer.depth + node), depth);
                    if (end - node < lane_count) hit &= (1u << (end - node)) - 1u;
                    for (; hit != 0; hit &= hit - 1) {
                        std::uint32_t const at = node + static_cast<std::uint32_t>(lowest_bit(hit));
                        std::uint32_t const tile = buffer.tile[at];
                        if (buffer.last_caster[tile] == stamp) continue;
                        buffer.last_caster[tile] = stamp;
                        if (buffer.alive[tile] == 0)
                            buffer.depth[at] = std::numeric_limits<T>::lowest();  // full: off the list
                        else
                            test(tile, volume);
                    }
                }
            }
        }
    }

    // The bounds of the part of a triangle at w >= w_floor: outside it no receiver is.
    [[nodiscard]] bool clip(T const (&at)[3][4], Footing<T>& footing) const noexcept {
        T const largest_number = std::numeric_limits<T>::max();
        footing = {{largest_number, -largest_number, largest_number, -largest_number}, -largest_number};
        auto const add = [&footing](T x, T y) {
            footing.bounds[0] = x < footing.bounds[0] ? x : footing.bounds[0];
            footing.bounds[1] = x > footing.bounds[1] ? x : footing.bounds[1];
            footing.bounds[2] = y < footing.bounds[2] ? y : footing.bounds[2];
            footing.bounds[3] = y > footing.bounds[3] ? y : footing.bounds[3];
        };
        bool any = false;
        for (int i = 0; i < 3; ++i) {
            T const *const a = at[i], *const b = at[(i + 1) % 3];
            T const above = a[3] - w_floor, other = b[3] - w_floor;
            if (above >= T(0)) {
                add(a[0] / a[3], a[1] / a[3]);
                any = true;
            }
            if ((above >= T(0)) == (other >= T(0))) continue;
            T const t = above / (above - other);
            add((a[0] + (b[0] - a[0]) * t) / w_floor, (a[1] + (b[1] - a[1]) * t) / w_floor);
        }
        return any;
    }

    // Sixteen triangles, `begin` and after.
    void run(std::uint32_t begin, std::uint32_t end) const noexcept {
        T v[3][3][lane_count];
        Vec3<T> const& eye = buffer.frame.eye;
        std::uint32_t sound = 0;
        for (std::uint32_t k = 0; k < lane_count; ++k) {
            bool ok = begin + k < end;
            for (std::uint32_t i = 0; i < 3; ++i) {
                std::uint32_t const corner = 3 * (begin + k) + i;
                std::uint32_t const vertex = !ok ? 0 : casters.index != nullptr ? casters.index[corner] : corner;
                ok = ok && vertex < casters.vertex_count;
                T const* const p = casters.position + (ok ? static_cast<std::size_t>(vertex) * static_cast<std::size_t>(casters.stride) : 0);
                for (int axis = 0; axis < 3; ++axis) v[i][axis][k] = p[axis] - eye[axis];
            }
            sound |= (ok ? 1u : 0u) << k;
        }
        auto const all = [](T value) { return Lanes::all(value); };
        Lanes const largest_number = all(std::numeric_limits<T>::max());
        Lanes corner[3][3], at[3][4];
        Lanes reach = all(T(0)), least_w = largest_number, most_w = all(std::numeric_limits<T>::lowest());
        for (int i = 0; i < 3; ++i) {
            for (int axis = 0; axis < 3; ++axis) corner[i][axis] = Lanes::load(v[i][axis]);
            Lanes const far = absolute(corner[i][0]) + absolute(corner[i][1]) + absolute(corner[i][2]);
            sound &= at_least(all(farthest_vertex<T>), far);
            reach = most(reach, far);
            for (int r = 0; r < 4; ++r) {
                Vec4<T> const& row = buffer.row[r];
                at[i][r] = fused(all(row.x), corner[i][0], fused(all(row.y), corner[i][1], fused(all(row.z), corner[i][2], all(row.w))));
            }
            least_w = least(least_w, at[i][3]);
            most_w = most(most_w, at[i][3]);
        }
        Lanes const floor = all(w_floor);
        std::uint32_t const in_front = at_least(least_w, floor);
        sound &= at_least(most_w, floor);
        if (sound == 0) return;

        Lanes lo_x = largest_number, hi_x = all(std::numeric_limits<T>::lowest()), lo_y = lo_x, hi_y = hi_x, depth = lo_x;
        for (int i = 0; i < 3; ++i) {
            Lanes const inverse = all(T(1)) / most(at[i][3], floor);
            Lanes const x = at[i][0] * inverse, y = at[i][1] * inverse;
            lo_x = least(lo_x, x);
            hi_x = most(hi_x, x);
            lo_y = least(lo_y, y);
            hi_y = most(hi_y, y);
            depth = least(depth, at[i][2] * inverse);
        }
        Lanes const widest = all(T(1)) / most(least_w, floor);
        Lanes const pad = fused(widest, fused(reach, all(buffer.texel_error), all(buffer.texel_error_here)), all(T(1) / T(128)));
        depth = depth - widest * fused(reach, all(buffer.depth_error), all(buffer.depth_error_here));

        Footing<T> footings[lane_count];
        T bounds[5][lane_count], pads[lane_count];
        std::uint32_t crossing = sound & ~in_front;
        if (crossing != 0) {
            // A few triangles in a warped map, and those beside a lamp.
            T rows[3][4][lane_count];
            for (int i = 0; i < 3; ++i)
                for (int r = 0; r < 4; ++r) at[i][r].store(rows[i][r]);
            for (std::uint32_t bits = crossing; bits != 0; bits &= bits - 1) {
                int const k = lowest_bit(bits);
                T one[3][4];
                for (int i = 0; i < 3; ++i)
                    for (int r = 0; r < 4; ++r) one[i][r] = rows[i][r][k];
                if (!clip(one, footings[k])) sound &= ~(1u << k);
            }
            crossing &= sound;
        }
        lo_x.store(bounds[0]);
        hi_x.store(bounds[1]);
        lo_y.store(bounds[2]);
        hi_y.store(bounds[3]);
        depth.store(bounds[4]);
        pad.store(pads);
        for (std::uint32_t bits = sound; bits != 0; bits &= bits - 1) {
            int const k = lowest_bit(bits);
            Footing<T>& footing = footings[k];
            if ((crossing >> k & 1u) == 0) footing = {{bounds[0][k], bounds[1][k], bounds[2][k], bounds[3][k]}, bounds[4][k]};
            for (int i = 0; i < 4; ++i) footing.bounds[i] += i % 2 == 0 ? -pads[k] : pads[k];
            bool const apart = footing.bounds[0] > buffer.most_x || footing.bounds[1] < buffer.least_x ||
                               footing.bounds[2] > buffer.most_y || footing.bounds[3] < buffer.least_y ||
                               footing.depth > buffer.most_depth;
            if (apart) continue;
            Vec3<T> p[3];
            T far = T(0);
            for (int i = 0; i < 3; ++i) {
                Vec3<T> const relative(v[i][0][k], v[i][1][k], v[i][2][k]);
                p[i] = direction_in_pixels(buffer.frame, relative) - Vec3<T>(buffer.frame.origin, T(0));
                far = glm::max(far, std::abs(relative.x) + std::abs(relative.y) + std::abs(relative.z));
            }
            ContactMargin<T> const margin{contact_share<T> * (T(1) + far + buffer.contact_reach), contact_share<T> * buffer.contact_ray};
            ShadowVolume<T> const volume = shadow_volume(buffer.frame, buffer.light, p[0], p[1], p[2], margin);
            if (volume.casts) walk(footing, volume, begin + static_cast<std::uint32_t>(k) + 1u);
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
    std::uint32_t const end = first + (count > 0 && count < left ? count : left);
    T column[lane_count], row[lane_count];
    for (int k = 0; k < lane_count; ++k) {
        column[k] = T(k % tile_side);
        row[k] = T(k / tile_side);
    }
    // All along a ray of a sun w is that of the receiver; toward a lamp it falls to 0.
    T const slack = buffer.light.parallel ? T(0.999) : T(1) / T(1 << 20);
    T const w_floor = slack * (buffer.light.parallel ? buffer.least_w : buffer.most_w);
    detail::TraceKernel<Lanes> const kernel{buffer, casters, Lanes::load(column), Lanes::load(row), w_floor};
    for (std::uint32_t begin = first; begin < end; begin += lane_count) kernel.run(begin, end);
}

// One word for each pixel of the buffer's rows, from the first of them on: 0 for sky.
template <class T>
inline void write_masks(IrregularBuffer<T> const& buffer, std::uint32_t* masks) noexcept {
    for (int row = 0; row < buffer.row_count; ++row)
        for (int column = 0; column < buffer.frame.width; ++column) {
            int const tile = row / tile_side * buffer.tiles_across + column / tile_side;
            int const lane = row % tile_side * tile_side + column % tile_side;
            bool const listed = tile < buffer.tile_count;
            masks[static_cast<std::size_t>(row) * static_cast<std::size_t>(buffer.frame.width) + static_cast<std::size_t>(column)] =
                listed ? buffer.mask[static_cast<std::size_t>(tile) * lane_count + static_cast<std::size_t>(lane)] : 0u;
        }
}

}  // namespace v0
}  // namespace shadowmath
