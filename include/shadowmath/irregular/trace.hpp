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
#include <cstring>
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

template <class Lanes, class T = typename Lanes::Scalar>
struct TraceKernel {
    IrregularBuffer<T>& buffer;
    Casters<T> const& casters;
    PixelFrame<Wider<T>> frame;
    PixelLight<Wider<T>> light;
    Lanes column_in_tile, row_in_tile;
    T w_floor;

    using Wide = typename Lanes::Wide;
    using Real = Wider<T>;

    // Sixteen triangles: where they are, what they may cover of the grid, and, if asked for, their shadow volumes.
    struct Batch {
        std::uint32_t sound;           // bit k: triangle k may take light from a receiver
        T vertex[3][3][lane_count];    // world
        T bounds[4][lane_count];       // lo x, hi x, lo y, hi y in texels
        T depth[lane_count];           // the end nearest to the light
        Real plane[4][4][lane_count];  // x, y, a, b of the four half spaces
        Lanes reach;                   // metres from the eye, at most
    };

    // Tiles that a triangle may touch, in the order of its lists, some of them twice.
    struct Queue {
        static constexpr std::uint32_t room = 256;
        std::uint32_t tile[room + lane_count];
        std::uint32_t count = 0;
    };

    // One triangle against sixteen pixels of each tile in the queue. Between two tiles nothing is decided but whether
    // any pixel is touched: a processor that guesses branches has little to guess.
    void test(Queue& queue, Batch const& batch, int k, std::uint32_t stamp) const noexcept {
        std::uint32_t kept = 0;
        for (std::uint32_t i = 0; i < queue.count; ++i) {
            std::uint32_t const tile = queue.tile[i];
            std::uint32_t* const state = buffer.state + 2 * tile;
            queue.tile[kept] = tile;
            kept += state[0] != 0 && state[1] != stamp ? 1u : 0u;
            state[1] = stamp;
        }
        queue.count = 0;
        Lanes const zero = Lanes::all(T(0));
        auto const tiles_across = static_cast<std::uint32_t>(buffer.tiles_across);
        Real const left = Real(buffer.rect.x) - Real(frame.width) / Real(2);
        Real const bottom = Real(buffer.rect.y) - Real(frame.height) / Real(2);
        Real const* const p = &batch.plane[0][0][k];
        Lanes xs[4], ys[4], bs[4];
        for (int i = 0; i < 4; ++i) {
            xs[i] = Lanes::all(static_cast<T>(p[4 * lane_count * i]));
            ys[i] = Lanes::all(static_cast<T>(p[4 * lane_count * i + lane_count]));
            bs[i] = Lanes::all(static_cast<T>(p[4 * lane_count * i + 3 * lane_count]));
        }
        for (std::uint32_t n = 0; n < kept; ++n) {
            std::uint32_t const tile = queue.tile[n];
            T const* const quads = buffer.quad + 3 * lane_count * static_cast<std::size_t>(tile);
            Lanes const q = Lanes::load(quads), q_x = Lanes::load(quads + lane_count),
                        q_y = Lanes::load(quads + 2 * lane_count);
            Real const x = Real(static_cast<int>(tile % tiles_across * tile_side)) + left;
            Real const y = Real(static_cast<int>(tile / tiles_across * tile_side)) + bottom;
            auto const tile_q = Real(buffer.tile_q[tile]);
            Lanes c[4], gain_x[4], gain_y[4];
            std::uint32_t const alive = buffer.state[2 * tile];
            std::uint32_t touched = alive;
            for (int i = 0; i < 4; ++i) {
                // Here large terms cancel; what is left is no more than a tile's worth.
                Real const* const plane = p + 4 * lane_count * i;
                Real const here =
                    plane[0] * x + plane[lane_count] * y + (plane[2 * lane_count] + plane[3 * lane_count] * tile_q);
                c[i] = fused(bs[i], q,
                             fused(ys[i], row_in_tile, fused(xs[i], column_in_tile, Lanes::all(static_cast<T>(here)))));
                gain_x[i] = fused(bs[i], q_x, xs[i]);
                gain_y[i] = fused(bs[i], q_y, ys[i]);
                // In the order of half_plane_mask, where rounding is monotone: no sample lies beyond these.
                touched &= at_least((c[i] + most(gain_x[i], zero)) + most(gain_y[i], zero), zero);
            }
            if (touched != 0) darken(tile, alive, touched, c, gain_x, gain_y);
        }
    }

    // The pixels of a tile that a triangle touches, with their lines.
    void darken(std::uint32_t tile, std::uint32_t alive, std::uint32_t touched, Lanes const (&c)[4],
                Lanes const (&gain_x)[4], Lanes const (&gain_y)[4]) const noexcept {
        Lanes const zero = Lanes::all(T(0));
        std::uint32_t done = touched;
        T lines[4][3][lane_count];
        for (int i = 0; i < 4; ++i) {
            done &= at_least((c[i] + least(gain_x[i], zero)) + least(gain_y[i], zero), zero);
            c[i].store(lines[i][0]);
            gain_x[i].store(lines[i][1]);
            gain_y[i].store(lines[i][2]);
        }
        std::uint32_t* const masks = buffer.mask + static_cast<std::size_t>(tile) * lane_count;
        for (std::uint32_t bits = done; bits != 0; bits &= bits - 1) masks[lowest_bit(bits)] = every_sample;
        for (std::uint32_t crossed = touched & ~done; crossed != 0; crossed &= crossed - 1) {
            int const pixel = lowest_bit(crossed);
            std::uint32_t dark = every_sample;
            for (auto const& line : lines)
                dark &= half_plane_mask<Lanes>(PixelLine<T>{line[0][pixel], line[1][pixel], line[2][pixel]});
            masks[pixel] |= dark;
            done |= (masks[pixel] == every_sample ? 1u : 0u) << pixel;
        }
        buffer.state[2 * tile] = alive & ~done;
    }

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
        std::uint32_t stamp;
    };

    // Queues the tiles of those nodes of [node, end) that the triangle may touch.
    void scan(std::uint32_t node, std::uint32_t end, Probe const& probe, Queue& queue) const noexcept {
        for (; node < end; node += lane_count) {
            std::uint32_t hit = at_least(probe.hi_x, Lanes::load(buffer.lo_x + node)) &
                                at_least(Lanes::load(buffer.hi_x + node), probe.lo_x) &
                                at_least(probe.hi_y, Lanes::load(buffer.lo_y + node)) &
                                at_least(Lanes::load(buffer.hi_y + node), probe.lo_y) &
                                at_least(Lanes::load(buffer.depth + node), probe.depth);
            if (end - node < lane_count) hit &= (1u << (end - node)) - 1u;
            queue.count += Lanes::compress(hit, buffer.tile + node, queue.tile + queue.count);
            if (queue.count >= Queue::room) test(queue, probe.batch, probe.k, probe.stamp);
        }
    }

    // One triangle against the lists of the texels that it may cover.
    void walk(Batch const& batch, int k, std::uint32_t stamp, Queue& queue) const noexcept {
        PlaceRange const places = places_of_triangle(batch, k);
        PlaceRange const texels = texels_of(places, 0);
        std::uint32_t levels = levels_at(texels, batch.depth[k]);
        if (levels == 0) return;
        Probe const probe{Lanes::all(batch.bounds[0][k]),
                          Lanes::all(batch.bounds[1][k]),
                          Lanes::all(batch.bounds[2][k]),
                          Lanes::all(batch.bounds[3][k]),
                          Lanes::all(batch.depth[k]),
                          batch,
                          k,
                          stamp};
        std::uint32_t const* const first = buffer.first;
        if ((levels & 1u) != 0)
            for (int y = texels.y0; y <= texels.y1; ++y)
                for (int x = texels.x0; x <= texels.x1; ++x) {
                    int const texel = y * buffer.map_size + x;
                    if (buffer.texel_depth[texel] < batch.depth[k] || (buffer.texel_levels[texel] & 1u) == 0) continue;
                    auto const division = static_cast<int>(buffer.texel_division[texel]);
                    std::uint32_t const* const lists = first + buffer.texel_lists[texel];
                    PlaceRange const in = divisions_of(places, x, y, division);
                    scan(lists[0], lists[1], probe, queue);
                    for (int j = in.y0; j <= in.y1; ++j) {
                        std::uint32_t const* const row = lists + 1 + (j << division);
                        scan(row[in.x0], row[in.x1 + 1], probe, queue);
                    }
                }
        for (levels &= ~1u; levels != 0; levels &= levels - 1) {
            int const level = lowest_bit(levels);
            int const size = level_size(buffer.map_size, level);
            PlaceRange const range = texels_of(places, level);
            for (int y = range.y0; y <= range.y1; ++y) {
                std::uint32_t const* const row = first + buffer.level_first[level] + y * size;
                scan(row[range.x0], row[range.x1 + 1], probe, queue);
            }
        }
        test(queue, batch, k, stamp);
    }

    // The bounds of the part of a triangle at w >= w_floor: no receiver is in the shadow of the rest.
    [[nodiscard]] bool clip(T const (&at)[3][4], T (&bounds)[4]) const noexcept {
        T const largest_number = std::numeric_limits<T>::max();
        bounds[0] = bounds[2] = largest_number;
        bounds[1] = bounds[3] = -largest_number;
        auto const add = [&bounds](T x, T y) {
            bounds[0] = x < bounds[0] ? x : bounds[0];
            bounds[1] = x > bounds[1] ? x : bounds[1];
            bounds[2] = y < bounds[2] ? y : bounds[2];
            bounds[3] = y > bounds[3] ? y : bounds[3];
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

    // `order` gives the triangles, or they follow each other from `begin` on.
    void load(std::uint32_t begin, std::uint32_t count, std::uint32_t const* order, Batch& batch) const noexcept {
        batch.sound = 0;
        for (std::uint32_t k = 0; k < lane_count; ++k) {
            bool ok = k < count;
            std::size_t const triangle = !ok ? 0 : order != nullptr ? order[begin + k] : begin + k;
            for (std::uint32_t i = 0; i < 3; ++i) {
                std::size_t vertex = 3 * triangle + i;
                if (casters.index != nullptr) vertex = casters.index[vertex];
                ok = ok && vertex < casters.vertex_count;
                T const* const p = casters.position + (ok ? vertex * static_cast<std::size_t>(casters.stride) : 0);
                for (int axis = 0; axis < 3; ++axis) batch.vertex[i][axis][k] = p[axis];
            }
            batch.sound |= (ok ? 1u : 0u) << k;
        }
        find(batch);
    }

    // Bounds in the grid, and which of the sixteen reach a receiver's.
    void find(Batch& batch) const noexcept {
        auto const all = [](T value) { return Lanes::all(value); };
        Lanes const largest_number = all(std::numeric_limits<T>::max()),
                    lowest_number = all(std::numeric_limits<T>::lowest());
        Lanes at[3][4];
        Lanes least_w = largest_number, most_w = lowest_number;
        std::uint32_t sound = batch.sound;
        batch.reach = all(T(0));
        for (int i = 0; i < 3; ++i) {
            Vec3<T> const& eye = buffer.frame.eye;
            Lanes const x = Lanes::load(batch.vertex[i][0]) - all(eye.x),
                        y = Lanes::load(batch.vertex[i][1]) - all(eye.y),
                        z = Lanes::load(batch.vertex[i][2]) - all(eye.z);
            Lanes const away = absolute(x) + absolute(y) + absolute(z);
            sound &= at_least(all(farthest_vertex<T>), away);
            batch.reach = most(batch.reach, away);
            for (int r = 0; r < 4; ++r) {
                Vec4<T> const& row = buffer.row[r];
                at[i][r] = fused(all(row.x), x, fused(all(row.y), y, fused(all(row.z), z, all(row.w))));
            }
            least_w = least(least_w, at[i][3]);
            most_w = most(most_w, at[i][3]);
        }
        Lanes const floor = all(w_floor);
        sound &= at_least(most_w, floor);
        Lanes lo_x = largest_number, hi_x = lowest_number, lo_y = lo_x, hi_y = hi_x, depth = lo_x;
        for (int i = 0; i < 3; ++i) {
            Lanes const inverse = reciprocal(most(at[i][3], floor));
            Lanes const x = at[i][0] * inverse, y = at[i][1] * inverse;
            lo_x = least(lo_x, x);
            hi_x = most(hi_x, x);
            lo_y = least(lo_y, y);
            hi_y = most(hi_y, y);
            depth = least(depth, at[i][2] * inverse);
        }
        std::uint32_t const clipped_ones = sound & ~at_least(least_w, floor);
        if (clipped_ones != 0) {
            // A few triangles in a warped map, and those beside a lamp. Their depths would have to be clipped as well.
            T rows[3][4][lane_count], clipped[4][lane_count];
            for (int i = 0; i < 3; ++i)
                for (int r = 0; r < 4; ++r) at[i][r].store(rows[i][r]);
            depth = chosen(clipped_ones, lowest_number, depth);
            lo_x.store(clipped[0]);
            hi_x.store(clipped[1]);
            lo_y.store(clipped[2]);
            hi_y.store(clipped[3]);
            for (std::uint32_t crossing = clipped_ones; crossing != 0; crossing &= crossing - 1) {
                int const k = lowest_bit(crossing);
                T one[3][4], bounds[4];
                for (int i = 0; i < 3; ++i)
                    for (int r = 0; r < 4; ++r) one[i][r] = rows[i][r][k];
                if (!clip(one, bounds)) sound &= ~(1u << k);
                for (int i = 0; i < 4; ++i) clipped[i][k] = bounds[i];
            }
            lo_x = Lanes::load(clipped[0]);
            hi_x = Lanes::load(clipped[1]);
            lo_y = Lanes::load(clipped[2]);
            hi_y = Lanes::load(clipped[3]);
        }
        // What rounding may add, so that no texel is missed.
        Lanes const steepest = reciprocal(most(least_w, floor));
        Lanes const pad = fused(steepest, fused(batch.reach, all(buffer.texel_error), all(buffer.texel_error_here)),
                                all(T(1) / T(128)));
        lo_x = lo_x - pad;
        hi_x = hi_x + pad;
        lo_y = lo_y - pad;
        hi_y = hi_y + pad;
        depth = depth - steepest * fused(batch.reach, all(buffer.depth_error), all(buffer.depth_error_here));
        sound &= at_least(all(buffer.most_x), lo_x) & at_least(hi_x, all(buffer.least_x)) &
                 at_least(all(buffer.most_y), lo_y) & at_least(hi_y, all(buffer.least_y)) &
                 at_least(all(buffer.most_depth), depth);
        lo_x.store(batch.bounds[0]);
        hi_x.store(batch.bounds[1]);
        lo_y.store(batch.bounds[2]);
        hi_y.store(batch.bounds[3]);
        depth.store(batch.depth);
        batch.sound = sound;
    }

    void raise_volumes(Batch& batch) const noexcept {
        auto const all = [](Real value) { return Wide::all(value); };
        Triple<Wide> p[3];
        for (int i = 0; i < 3; ++i) {
            auto const from_eye = [&](int axis) { return Wide::load(batch.vertex[i][axis]) - all(frame.eye[axis]); };
            Triple<Wide> const v{from_eye(0), from_eye(1), from_eye(2)};
            auto const along = [&](Vec3<Real> const& axis) {
                return inner(Triple<Wide>{all(axis.x), all(axis.y), all(axis.z)}, v);
            };
            p[i] = {along(frame.to_across) - all(frame.origin.x), along(frame.to_upward) - all(frame.origin.y),
                    along(frame.to_inward)};
        }
        T reach[lane_count];
        batch.reach.store(reach);
        Real const share = contact_share<Real>;
        Wide const metres = all(share) * (Wide::load(reach) + all(Real(1) + Real(buffer.contact_reach)));
        ShadowVolume<Wide> const volume = volume_of(frame, light, p, metres, share * Real(buffer.contact_ray), all);
        for (int i = 0; i < 4; ++i) {
            volume.planes[i].x.store(batch.plane[i][0]);
            volume.planes[i].y.store(batch.plane[i][1]);
            volume.planes[i].a.store(batch.plane[i][2]);
            volume.planes[i].b.store(batch.plane[i][3]);
        }
        batch.sound &= at_least(absolute(volume.along), all(Real(std::numeric_limits<T>::min())));
    }

    // At most caster_block triangles, in the order of the texels that they begin in: what is next to each other in the
    // grid is then in the caches, however the mesh was laid out.
    void run_block(std::uint32_t begin, std::uint32_t count, Batch& batch, Queue& queue) const noexcept {
        auto const texels = static_cast<std::uint32_t>(buffer.map_size * buffer.map_size);
        std::uint32_t* const start = buffer.block_count;
        std::memset(start, 0, (texels + 2) * sizeof(std::uint32_t));
        for (std::uint32_t i = 0; i < count; i += lane_count) {
            load(begin + i, count - i, nullptr, batch);
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
            load(i, kept - i, buffer.block_order, batch);
            raise_volumes(batch);
            for (std::uint32_t bits = batch.sound; bits != 0; bits &= bits - 1) {
                int const k = lowest_bit(bits);
                walk(batch, k, buffer.block_order[i + static_cast<std::uint32_t>(k)] + 1u, queue);
            }
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
    T column[lane_count], row[lane_count];
    for (int k = 0; k < lane_count; ++k) {
        column[k] = T(k % tile_side);
        row[k] = T(k / tile_side);
    }
    // All along a ray of a sun w is that of the receiver; toward a lamp it falls to 0.
    T const slack = buffer.light.parallel ? T(0.999) : T(1) / T(1 << 20);
    T const w_floor = slack * (buffer.light.parallel ? buffer.least_w : buffer.most_w);
    PixelFrame<Wider<T>> const frame = frame_in<Wider<T>>(buffer.frame);
    detail::TraceKernel<Lanes> const kernel{
        buffer, casters, frame, pixel_light(frame, buffer.source), Lanes::load(column), Lanes::load(row), w_floor};
    typename detail::TraceKernel<Lanes>::Batch batch;
    typename detail::TraceKernel<Lanes>::Queue queue;
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
