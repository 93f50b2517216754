// SPDX-License-Identifier: MIT
//
// A tile of 4 x 4 pixels as the light sees it: the quads of its pixels, their bounds in the grid, and the nodes that it
// is listed by.
//
// The bounds of a pixel are five keys, (lo x, -hi x, lo y, -hi y, -far depth). A caster with the keys (hi x, -lo x,
// hi y, -lo y, -near depth) can take light from it only if none of its keys is less. The pixels' keys are kept in a
// byte each, in steps of a 255th of the tile's range, a step less than they are: more than rounding can add.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/irregular/buffer.hpp>
#include <shadowmath/irregular/lanes.hpp>
#include <shadowmath/irregular/lists.hpp>
#include <shadowmath/irregular/microquad.hpp>

#include <cstdint>
#include <limits>

namespace shadowmath {
inline namespace v0 {

namespace detail {

// Sixteen pixels of the picture: their quads, whether light may reach them, and where the light sees them.
template <class Lanes, class T = typename Lanes::Scalar>
struct TileKernel {
    IrregularBuffer<T>& buffer;
    Receivers<T> const& receivers;
    PixelPlane<T> plane[4];  // the rows of the map
    T w_min;
    T turn;
    Lanes column_in_tile, row_in_tile;
    bool flat, affine;

    struct Seen {
        std::uint32_t alive = 0;
        std::uint32_t away = 0;
        Lanes lo_x, hi_x, lo_y, hi_y, depth, lo_w, hi_w;
        T bounds[5];  // of all that are alive: lo x, hi x, lo y, hi y, the far end of the depths
    };

    struct Surface {
        Lanes normal[3];
        Lanes place[3];  // relative to the eye; or the depth alone
    };

    // Rows of a tile that lies within the part of the picture, or copies of its edge where it does not.
    void gather(int column, int row, Surface& surface) const noexcept {
        PixelFrame<T> const& frame = buffer.frame;
        auto const normal_stride = static_cast<std::size_t>(receivers.normal_stride);
        auto const position_stride = static_cast<std::size_t>(receivers.position_stride);
        bool const placed = receivers.position != nullptr;
        int const columns = buffer.rect.x + buffer.rect.width - column, rows = buffer.rect.y + buffer.rect.height - row;
        std::size_t at[tile_side];
        for (int j = 0; j < tile_side; ++j)
            at[j] = static_cast<std::size_t>(row + (j < rows ? j : 0)) * static_cast<std::size_t>(frame.width) +
                    static_cast<std::size_t>(column);
        if (columns >= tile_side && normal_stride == 3 && (!placed || position_stride == 3)) {
            // Written out: as a loop it is made a vector of addresses.
            auto const from = [&at](T const* array, std::size_t stride, T const*(&row_of)[tile_side]) {
                row_of[0] = array + at[0] * stride;
                row_of[1] = array + at[1] * stride;
                row_of[2] = array + at[2] * stride;
                row_of[3] = array + at[3] * stride;
            };
            T const* row_of[tile_side];
            from(receivers.normal, 3, row_of);
            Lanes::triples(row_of, surface.normal);
            from(placed ? receivers.position : receivers.depth, placed ? 3 : 1, row_of);
            if (placed)
                Lanes::triples(row_of, surface.place);
            else
                surface.place[0] = Lanes::rows(row_of);
        } else {
            T in[6][lane_count]{};
            for (int k = 0; k < lane_count; ++k) {
                int const i = k % tile_side;
                std::size_t const pixel = at[k / tile_side] + static_cast<std::size_t>(i < columns ? i : 0);
                for (int axis = 0; axis < 3; ++axis) {
                    auto const offset = static_cast<std::size_t>(axis);
                    in[axis][k] = receivers.normal[pixel * normal_stride + offset];
                    if (placed) in[3 + axis][k] = receivers.position[pixel * position_stride + offset];
                }
                if (!placed) in[3][k] = receivers.depth[pixel];
            }
            for (int axis = 0; axis < 3; ++axis) {
                surface.normal[axis] = Lanes::load(in[axis]);
                surface.place[axis] = Lanes::load(in[3 + axis]);
            }
        }
        if (placed)
            for (int axis = 0; axis < 3; ++axis)
                surface.place[axis] = surface.place[axis] - Lanes::all(frame.eye[axis]);
    }

    [[nodiscard]] static T middle_of(std::uint32_t part, Lanes const& q) noexcept {
        if (part == 0) return T(0);
        T lane[lane_count];
        q.store(lane);
        return lane[lowest_bit(part)];
    }

    [[nodiscard]] static std::uint32_t lanes_inside(int columns, int rows) noexcept {
        std::uint32_t const in_row = columns < tile_side ? (1u << columns) - 1u : 0xfu;
        std::uint32_t inside = 0;
        for (int j = 0; j < tile_side && j < rows; ++j) inside |= in_row << tile_side * j;
        return inside;
    }

    // The quads of sixteen pixels (micro_quad, of which these are the lanes): q + q_x x + q_y y at the corner of a
    // pixel, which is one over the depth, or the depth itself where the eye is flat.
    struct Quads {
        Lanes x, y;  // of the lower corners, pixels from the middle of the picture
        Lanes normal_x, normal_y, normal_z;
        Lanes toward_middle, facing, depth;
        Lanes middle, to_corner, q, q_x, q_y;
        std::uint32_t sound;  // numbers, in the picture

        [[nodiscard]] Lanes size() const noexcept { return absolute(q) + absolute(q_x) + absolute(q_y); }
    };
    [[nodiscard]] Quads quads_of(Surface const& surface, int column, int row) const noexcept {
        PixelFrame<T> const& frame = buffer.frame;
        auto const all = [](T value) { return Lanes::all(value); };
        Lanes const zero = all(T(0)), one = all(T(1)), half = all(T(0.5)), tiny = all(std::numeric_limits<T>::min());
        Quads quads;
        quads.x = all(T(column) - T(frame.width) / T(2)) + column_in_tile;
        quads.y = all(T(row) - T(frame.height) / T(2)) + row_in_tile;
        auto const dot = [&all](Vec3<T> const& v, Lanes const(&a)[3]) {
            return fused(all(v.x), a[0], fused(all(v.y), a[1], all(v.z) * a[2]));
        };
        Lanes const depth = quads.depth =
            receivers.position != nullptr ? dot(frame.to_inward, surface.place) : surface.place[0];
        Lanes const nx = quads.normal_x = dot(frame.across, surface.normal);
        Lanes const ny = quads.normal_y = dot(frame.upward, surface.normal);
        Lanes const nz = quads.normal_z = dot(frame.inward, surface.normal);
        quads.toward_middle = flat ? nz : fused(nx, quads.x + half, fused(ny, quads.y + half, nz));
        Lanes const facing = quads.facing = flat ? zero - nz : quads.toward_middle;
        Lanes const steep = (absolute(nx) + absolute(ny)) * all(turn);
        Lanes const divisor = with_sign_of(most(absolute(facing), steep), facing);
        // A comparison with NaN is false.
        std::uint32_t sound = at_least(absolute(divisor), tiny);
        if (!flat) sound &= at_least(depth, tiny);
        Lanes const scale = one / chosen(sound, flat ? divisor : divisor * depth, one);
        quads.q_x = nx * scale, quads.q_y = ny * scale;
        quads.middle = flat ? depth : divisor * scale, quads.to_corner = (quads.q_x + quads.q_y) * half;
        quads.q = quads.middle - quads.to_corner;
        sound &= at_least(all(std::numeric_limits<T>::max()), quads.size());
        sound &= lanes_inside(buffer.rect.x + buffer.rect.width - column, buffer.rect.y + buffer.rect.height - row);
        quads.sound = sound;
        return quads;
    }

    // Those whose surface has light and eye on the same side.
    [[nodiscard]] std::uint32_t facing_light(Quads const& quads) const noexcept {
        auto const all = [](T value) { return Lanes::all(value); };
        Lanes const half = all(T(0.5)), tiny = all(std::numeric_limits<T>::min()), under = all(T(0)) - tiny;
        Lanes const &nx = quads.normal_x, &ny = quads.normal_y, &nz = quads.normal_z;
        Lanes travel =
            fused(nx, all(buffer.light.at.x), fused(ny, all(buffer.light.at.y), nz * all(buffer.light.at.z)));
        if (!buffer.light.parallel)
            travel = (flat ? fused(nx, quads.x + half, fused(ny, quads.y + half, nz * quads.depth))
                           : quads.depth * quads.facing) -
                     travel;
        return (at_least(travel, tiny) & at_least(quads.toward_middle, tiny)) |
               (at_least(under, travel) & at_least(under, quads.toward_middle));
    }

    // What the four corners of each quad cover as the light sees them, and more by what rounding may add, so that no
    // triangle misses a texel. Those of `among` of which that can be said are alive.
    void cover(Quads const& quads, std::uint32_t among, Seen& seen) const noexcept {
        auto const all = [](T value) { return Lanes::all(value); };
        Lanes const one = all(T(1)), tiny = all(std::numeric_limits<T>::min());
        // Before an eye of perspective, values are over the depth.
        Lanes at[4], gain_x[4], gain_y[4];
        for (int i = 0; i < 4; ++i) {
            PixelPlane<T> const& p = plane[i];
            at[i] = fused(all(p.x), quads.x, fused(all(p.y), quads.y, fused(all(p.b), quads.q, all(p.a))));
            gain_x[i] = fused(all(p.b), quads.q_x, all(p.x));
            gain_y[i] = fused(all(p.b), quads.q_y, all(p.y));
        }
        Lanes steepest = all(T(0));
        for (int corner = 0; corner < 4; ++corner) {
            Lanes value[4], q_here = quads.q;
            for (int i = 0; i < 4; ++i) {
                value[i] = (corner & 1) != 0 ? at[i] + gain_x[i] : at[i];
                if ((corner & 2) != 0) value[i] = value[i] + gain_y[i];
            }
            if ((corner & 1) != 0) q_here = q_here + quads.q_x;
            if ((corner & 2) != 0) q_here = q_here + quads.q_y;
            among &= at_least(value[3], tiny) & ~at_least(flat ? all(w_min) : all(w_min) * q_here, value[3]);
            Lanes const inverse = reciprocal(chosen(among, value[3], one));
            Lanes const tx = value[0] * inverse, ty = value[1] * inverse, tz = value[2] * inverse;
            Lanes const w = affine ? one : flat ? value[3] : value[3] * reciprocal(chosen(among, q_here, one));
            seen.lo_x = corner == 0 ? tx : least(seen.lo_x, tx);
            seen.hi_x = corner == 0 ? tx : most(seen.hi_x, tx);
            seen.lo_y = corner == 0 ? ty : least(seen.lo_y, ty);
            seen.hi_y = corner == 0 ? ty : most(seen.hi_y, ty);
            seen.depth = corner == 0 ? tz : most(seen.depth, tz);
            seen.lo_w = corner == 0 ? w : least(seen.lo_w, w);
            seen.hi_w = corner == 0 ? w : most(seen.hi_w, w);
            steepest = most(steepest, inverse);
        }
        Lanes const ray = all(buffer.contact_ray);
        Lanes const reach = flat ? all(buffer.contact_reach) + quads.size() : ray;
        Lanes const here = flat ? one : quads.size();
        auto const error = [&](T each_metre, T anywhere) {
            return steepest * fused(reach, all(each_metre), here * all(anywhere));
        };
        Lanes const pad = error(buffer.texel_error, buffer.texel_error_here) + all(T(1) / T(128));
        seen.lo_x = seen.lo_x - pad;
        seen.hi_x = seen.hi_x + pad;
        seen.lo_y = seen.lo_y - pad;
        seen.hi_y = seen.hi_y + pad;
        seen.depth = seen.depth + error(buffer.depth_error, buffer.depth_error_here);
        Lanes const span = absolute(seen.lo_x) + absolute(seen.hi_x) + absolute(seen.lo_y) + absolute(seen.hi_y);
        seen.alive = among & at_least(all(std::numeric_limits<T>::max()), span + absolute(seen.depth));
    }

    void see(int tile, int column, int row, Seen& seen) const noexcept {
        seen.alive = seen.away = 0;
        Surface surface;
        gather(column, row, surface);
        Quads const quads = quads_of(surface, column, row);
        if (quads.sound == 0) return;
        std::uint32_t const lit = facing_light(quads);
        seen.away = quads.sound & ~lit;
        if ((quads.sound & lit) == 0) return;
        cover(quads, quads.sound & lit, seen);
        keep_bounds(tile, seen);
        keep_quads(tile, quads, seen.alive);
    }

    void keep_quads(int tile, Quads const& quads, std::uint32_t alive) const noexcept {
        Lanes const zero = Lanes::all(T(0)), one = Lanes::all(T(1));
        T* const kept = buffer.surface + tile_scalars * static_cast<std::size_t>(tile);
        T const tile_q = kept[tile_q_at] = middle_of(alive, quads.q);
        // The division once more, without its rounding.
        T rest[lane_count];
        (flat ? quads.middle : chosen(alive, quads.depth, one)).store(rest);
        for (T& r : rest) r = static_cast<T>((flat ? Wider<T>(r) : Wider<T>(1) / Wider<T>(r)) - Wider<T>(tile_q));
        Lanes const exact = Lanes::load(rest);
        chosen(alive, exact - quads.to_corner, zero).store(kept);
        chosen(alive, quads.q_x, zero).store(kept + lane_count);
        chosen(alive, quads.q_y, zero).store(kept + 2 * lane_count);
    }

    void keep_bounds(int tile, Seen& seen) const noexcept {
        Lanes const zero = Lanes::all(T(0)), huge = Lanes::all(std::numeric_limits<T>::max());
        Lanes const keys[5] = {seen.lo_x, zero - seen.hi_x, seen.lo_y, zero - seen.hi_y, zero - seen.depth};
        T* const base = buffer.surface + tile_scalars * static_cast<std::size_t>(tile) + key_base_at;
        T* const step = base + (key_step_at - key_base_at);
        auto* const bytes =
            reinterpret_cast<unsigned char*>(buffer.state + tile_words * static_cast<std::size_t>(tile));
        for (int i = 0; i < 5; ++i) {
            base[i] = smallest(chosen(seen.alive, keys[i], huge));
            T const span = largest(chosen(seen.alive, keys[i], zero - huge)) - base[i];
            seen.bounds[i] = i == 0 || i == 2 ? base[i] : -base[i];
            // No range to speak of: all are as the least of them.
            bool const ranged = span > std::abs(base[i]) * (T(1) / T(1 << 14)) && span > T(1e-30) && span < T(1e30);
            step[i] = ranged ? span / T(255) : T(0);
            Lanes const gain = Lanes::all(ranged ? T(255) / span : T(0));
            Lanes const steps = (keys[i] - Lanes::all(base[i])) * gain - Lanes::all(T(1));
            chosen(ranged ? seen.alive : 0u, steps, zero).store_bytes(bytes + i * lane_count);
        }
    }

    // The pixels of `part` as one node, or as several if they lie far apart for what each of them covers.
    void insert(Parts<T> const& parts, int tile, Seen const& seen, std::uint32_t part,
                int pixels_across) const noexcept {
        if (part == 0) return;
        Lanes const huge = Lanes::all(std::numeric_limits<T>::max());
        Lanes const low = Lanes::all(std::numeric_limits<T>::lowest());
        T const bounds[5] = {smallest(chosen(part, seen.lo_x, huge)), largest(chosen(part, seen.hi_x, low)),
                             smallest(chosen(part, seen.lo_y, huge)), largest(chosen(part, seen.hi_y, low)),
                             largest(chosen(part, seen.depth, low))};
        insert(parts, tile, seen, part, pixels_across, bounds);
    }

    void insert(Parts<T> const& parts, int tile, Seen const& seen, std::uint32_t part, int pixels_across,
                T const (&bounds)[5]) const noexcept {
        if (pixels_across > 1) {
            T const width = bounds[1] - bounds[0], height = bounds[3] - bounds[2];
            T const extent = width > height ? width : height;
            if (extent > T(1)) {
                Lanes const low = Lanes::all(std::numeric_limits<T>::lowest());
                Lanes const each = most(seen.hi_x - seen.lo_x, seen.hi_y - seen.lo_y);
                if (extent > largest(chosen(part, each, low)) * T(2 * pixels_across)) {
                    if (pixels_across == tile_side)
                        for (std::uint32_t const quarter : {0x0033u, 0x00ccu, 0x3300u, 0xcc00u})
                            insert(parts, tile, seen, part & quarter, 2);
                    else
                        for (; part != 0; part &= part - 1) insert(parts, tile, seen, part & (~part + 1), 1);
                    return;
                }
            }
        }
        IrregularBuffer<T>& b = buffer;
        b.least_x = bounds[0] < b.least_x ? bounds[0] : b.least_x;
        b.most_x = bounds[1] > b.most_x ? bounds[1] : b.most_x;
        b.least_y = bounds[2] < b.least_y ? bounds[2] : b.least_y;
        b.most_y = bounds[3] > b.most_y ? bounds[3] : b.most_y;
        b.most_depth = bounds[4] > b.most_depth ? bounds[4] : b.most_depth;
        add_part(buffer, parts, tile, bounds);
    }
};

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath
