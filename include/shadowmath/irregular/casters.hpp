// SPDX-License-Identifier: MIT
//
// Triangles that take light, sixteen at once: where they are in the grid, which of them reach a receiver, and their
// shadow volumes.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/irregular/buffer.hpp>
#include <shadowmath/irregular/edge.hpp>
#include <shadowmath/irregular/lanes.hpp>
#include <shadowmath/irregular/microquad.hpp>

#include <cstddef>
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

// Sixteen triangles: where they are, what they may cover of the grid, and, if asked for, their shadow volumes.
template <class Lanes, class T = typename Lanes::Scalar>
struct CasterBatch {
    std::uint32_t sound;               // bit k: triangle k may take light from a receiver
    T vertex[3][3][lane_count];        // world
    T bounds[4][lane_count];           // lo x, hi x, lo y, hi y in texels
    T depth[lane_count];               // the end nearest to the light
    Wider<T> plane[4][4][lane_count];  // x, y, a, b of each of the four half spaces
    Lanes reach;                       // metres from the eye, at most
};

template <class Lanes, class T = typename Lanes::Scalar>
struct CasterKernel {
    IrregularBuffer<T> const& buffer;
    Casters<T> const& casters;
    PixelFrame<Wider<T>> const& frame;
    PixelLight<Wider<T>> light;
    T w_floor;

    using Wide = typename Lanes::Wide;
    using Real = Wider<T>;
    using Batch = CasterBatch<Lanes>;

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

    void fetch(std::uint32_t triangle) const noexcept {
        if (casters.index != nullptr) return;
        T const* const from = casters.position + std::size_t{3} * triangle * static_cast<std::size_t>(casters.stride);
        __builtin_prefetch(from);
        __builtin_prefetch(from + 8);
    }

    // `order` gives the triangles, or they follow each other from `begin` on.
    void load(std::uint32_t begin, std::uint32_t count, std::uint32_t const* order, Batch& batch) const noexcept {
        auto const stride = static_cast<std::size_t>(casters.stride);
        auto const keep = [&batch](int i, auto const& at) {
            Lanes xyz[3];
            Lanes::points(at, xyz);
            for (int axis = 0; axis < 3; ++axis) xyz[axis].store(batch.vertex[i][axis]);
        };
        std::uint32_t sound = 0;
        T const* at[3][lane_count];
        for (std::uint32_t k = 0; k < lane_count; ++k) {
            bool ok = k < count;
            std::size_t const first = std::size_t{3} * (!ok ? 0u : order != nullptr ? order[begin + k] : begin + k);
            if (casters.index == nullptr) {
                ok = ok && first + 2 < casters.vertex_count;
                at[0][k] = casters.position + (ok ? first * stride : 0);
            } else {
                for (std::uint32_t i = 0; i < 3; ++i) {
                    std::size_t const vertex = casters.index[first + i];
                    bool const held = vertex < casters.vertex_count;
                    ok = ok && held;
                    at[i][k] = casters.position + (held ? vertex * stride : 0);
                }
            }
            sound |= (ok ? 1u : 0u) << k;
        }
        batch.sound = sound;
        for (int i = 0; i < 3; ++i) {
            if (casters.index != nullptr)
                keep(i, [&](int k) { return at[i][k]; });
            else
                // Fewer than three vertices in all: the first, three times.
                keep(i, [&at, step = casters.vertex_count < 3 ? 0 : static_cast<std::size_t>(i) * stride](int k) {
                    return at[0][k] + step;
                });
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
            volume.planes[i].x.store(batch.plane[0][i]);
            volume.planes[i].y.store(batch.plane[1][i]);
            volume.planes[i].a.store(batch.plane[2][i]);
            volume.planes[i].b.store(batch.plane[3][i]);
        }
        batch.sound &= at_least(absolute(volume.along), all(Real(std::numeric_limits<T>::min())));
    }
};

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath
