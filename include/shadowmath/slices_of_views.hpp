// SPDX-License-Identifier: MIT
//
// The slices of thousands of views at once: what fit_slice_boxes gives for each, at a third of the cost. For simulators
// and for tools that try many cameras under one sun.
//
// Views are lanes: what they have in common is done once for all of them, and each operation is one instruction for as
// many as a register holds.
#pragma once

#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/lanes.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/long_lanes.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/slices.hpp>
#include <shadowmath/splits.hpp>
#include <shadowmath/view_volume.hpp>
#include <shadowmath/wide.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace shadowmath {
inline namespace v0 {
namespace detail {

inline constexpr int views_at_once = 32;

// Four slices of each of views_at_once views, where all of these are ordinary perspective views; otherwise nothing is
// written, and `ordinary` is false.
template <class T>
struct SlicesOfViews {
    ViewVolume<T> const* views;
    LightBasis<T> const& basis;
    T lambda;
    MapInLanes<T> const& map;
    Mat4<T>* clip_from_world;
    bool& ordinary;

    static constexpr int n = views_at_once;
    using Row = T[views_at_once];

    [[gnu::always_inline]] static T less(T a, T b) noexcept { return a < b ? a : b; }
    [[gnu::always_inline]] static T more(T a, T b) noexcept { return a > b ? a : b; }

    // Four numbers of four views, from `from` on, each into its own row.
    [[gnu::always_inline]] static void gather(T const* const (&from)[4], Row* rows, int first) noexcept {
        Lanes<T> four[4] = {four_at(from[0]), four_at(from[1]), four_at(from[2]), four_at(from[3])};
        transpose(four);
        std::memcpy(rows[0] + first, &four[0], sizeof four[0]);
        std::memcpy(rows[1] + first, &four[1], sizeof four[1]);
        std::memcpy(rows[2] + first, &four[2], sizeof four[2]);
        std::memcpy(rows[3] + first, &four[3], sizeof four[3]);
    }

    // Rows: position, right, up, forward, sides; near and far; the roots of far / near, taken here, as processors move
    // numbers meanwhile. False where not all views are perspective.
    [[gnu::always_inline]] bool gather(Row (&in)[20]) const noexcept {
        bool perspective = true;
        for (int first = 0; first < n; first += 4) {
            ViewVolume<T> const &a = views[first], &b = views[first + 1], &c = views[first + 2], &d = views[first + 3];
            T const* pose[4] = {&a.pose.position.x, &b.pose.position.x, &c.pose.position.x, &d.pose.position.x};
            gather({pose[0], pose[1], pose[2], pose[3]}, in, first);
            gather({pose[0] + 4, pose[1] + 4, pose[2] + 4, pose[3] + 4}, in + 4, first);
            gather({pose[0] + 8, pose[1] + 8, pose[2] + 8, pose[3] + 8}, in + 8, first);
            gather({&a.left, &b.left, &c.left, &d.left}, in + 12, first);
            Lanes<T> const z_near = Lanes<T>::of(a.z_near, b.z_near, c.z_near, d.z_near);
            Lanes<T> const z_far = Lanes<T>::of(a.z_far, b.z_far, c.z_far, d.z_far);
            auto const metres = [](Lanes<T> const& z) { return between(z, least_metres<T>, farthest_metres<T>); };
            Lanes<T> const half = root(metres(z_far) / metres(z_near)), quarter = root(half);
            std::memcpy(in[16] + first, &z_near, sizeof z_near);
            std::memcpy(in[17] + first, &z_far, sizeof z_far);
            std::memcpy(in[18] + first, &half, sizeof half);
            std::memcpy(in[19] + first, &quarter, sizeof quarter);
            perspective = perspective & (a.kind == ViewKind::perspective) & (b.kind == ViewKind::perspective) &
                          (c.kind == ViewKind::perspective) & (d.kind == ViewKind::perspective);
        }
        return perspective;
    }

    // Of each view, sums of coordinates regardless of sign, by which roundings are measured.
    struct Lengths {
        Row eye, sides;
    };

    // False where a number is beyond reach, or a little sooner: where sums of them are.
    [[gnu::always_inline]] static bool measure(Row const (&in)[20], Lengths& of) noexcept {
        decltype(beyond_reach(T(0))) any = 0;
        for (int i = 0; i < n; ++i) {
            of.eye[i] = std::abs(in[0][i]) + std::abs(in[1][i]) + std::abs(in[2][i]);
            of.sides[i] = std::abs(in[12][i]) + std::abs(in[13][i]) + std::abs(in[14][i]) + std::abs(in[15][i]);
        }
        for (int i = 0; i < n; ++i) {
            T const right = std::abs(in[3][i]) + std::abs(in[4][i]) + std::abs(in[5][i]);
            T const up = std::abs(in[6][i]) + std::abs(in[7][i]) + std::abs(in[8][i]);
            T const ahead = std::abs(in[9][i]) + std::abs(in[10][i]) + std::abs(in[11][i]);
            any |= beyond_reach(of.eye[i] + of.sides[i] + (right + up + ahead)) |
                   beyond(in[16][i], least_metres<T>, farthest_metres<T>) |
                   beyond(in[17][i], least_metres<T>, farthest_metres<T>);
        }
        return any >> (8 * sizeof any - 1) == 0;
    }

    // False where the planes of a view are not in order, or its sides.
    [[gnu::always_inline]] bool split(Row const (&in)[20], Row (&plane)[5]) const noexcept {
        Row const &half = in[18], &quarter = in[19];
        for (int i = 0; i < n; ++i) {
            T const near_end = in[16][i], far_end = in[17][i], length = far_end - near_end, rest = T(1) - lambda;
            plane[0][i] = near_end;
            plane[1][i] = lambda * (near_end * quarter[i]) + rest * (near_end + length * T(0.25));
            plane[2][i] = lambda * (near_end * half[i]) + rest * (near_end + length * T(0.5));
            plane[3][i] = lambda * (near_end * (half[i] * quarter[i])) + rest * (near_end + length * T(0.75));
            plane[4][i] = far_end;
        }
        std::uint32_t good[n], all_good = ~0u;
        for (int i = 0; i < n; ++i)
            good[i] = ((plane[0][i] < plane[1][i]) & (plane[1][i] < plane[2][i]) & (plane[2][i] < plane[3][i]) &
                       (plane[3][i] < plane[4][i]) & (in[12][i] < in[13][i]) & (in[14][i] < in[15][i]) &
                       (in[16][i] > in[17][i] * T(0x1p-64)))
                          ? ~0u
                          : 0u;
        for (int i = 0; i < n; ++i) all_good &= good[i];
        return all_good != 0;
    }

    // What the maps of all slices do to one axis of the light.
    struct OnAxis {
        Row scale[4], offset[4];
    };

    // `axis`, and so all that it is multiplied with, is halved, which is exact: the middle of two is then their sum.
    [[gnu::always_inline]] static void fit(Row const (&in)[20], Lengths const& of, Row const (&plane)[5],
                                           Vec3<T> const& axis, T extent, T middle, OnAxis& maps) noexcept {
        constexpr T half_unit = T(4) * std::numeric_limits<T>::epsilon();
        Vec3<T> const a = axis * T(0.5);
        Row eye_lo, eye_hi, slope_lo, slope_hi;
        for (int i = 0; i < n; ++i) {
            T const eye = a.x * in[0][i] + a.y * in[1][i] + a.z * in[2][i];
            T const right = a.x * in[3][i] + a.y * in[4][i] + a.z * in[5][i];
            T const up = a.x * in[6][i] + a.y * in[7][i] + a.z * in[8][i];
            T const ahead = a.x * in[9][i] + a.y * in[10][i] + a.z * in[11][i];
            T const b = right * in[12][i], c = right * in[13][i], d = up * in[14][i], e = up * in[15][i];
            T const rounding = half_unit * of.eye[i];
            eye_lo[i] = eye - rounding, slope_lo[i] = ahead + (less(b, c) + less(d, e));
            eye_hi[i] = eye + rounding, slope_hi[i] = ahead + (more(b, c) + more(d, e));
        }
        for (int i = 0; i < n; ++i) {
            T const growth = half_unit * (T(1) + of.sides[i]);
            T from_lo = plane[0][i] * slope_lo[i], from_hi = plane[0][i] * slope_hi[i];
            auto const add = [&](int slice) {
                T const to = plane[slice + 1][i], to_lo = to * slope_lo[i], to_hi = to * slope_hi[i];
                T const lo = eye_lo[i] + (less(from_lo, to_lo) - to * growth);
                T const hi = eye_hi[i] + (more(from_hi, to_hi) + to * growth);
                T const scale = extent * T(0.5) / (hi - lo);
                maps.scale[slice][i] = scale;
                maps.offset[slice][i] = middle - (lo + hi) * scale;
                from_lo = to_lo, from_hi = to_hi;
            };
            add(0), add(1), add(2), add(3);
        }
    }

    // As write_columns, in as few stores as the machine has. Of a few maps they would gain nothing: most of them reach
    // across a cache line.
    [[gnu::always_inline]] static void write_whole(ViewInLight<T> const& seen, Lanes<T> const& scale,
                                                   Lanes<T> const& offset, Mat4<T>& clip_from_world) noexcept {
        using Long = LongLanes<T>;
        if constexpr (Long::fours == 1) {
            write_columns(seen, scale, offset, clip_from_world);
        } else {
            Lanes<T> const column[4] = {seen.x, seen.y, seen.z, offset};
            Long const scales = repeated<Long>(scale);
            for (int i = 0; i < 4; i += Long::fours) {
                Long const scaled = joined<Long>(column + i) * scales;
                store_long(&clip_from_world[0].x + 4 * i, i + Long::fours < 4 ? scaled : with_last(scaled, offset));
            }
        }
    }

    [[gnu::always_inline]] void operator()() const noexcept {
        Row in[20], plane[5];
        Lengths of;
        ordinary = gather(in) && measure(in, of) && split(in, plane);
        if (!ordinary) return;

        OnAxis x, y, depth;
        fit(in, of, plane, basis.x, map.extent[0], map.middle[0], x);
        fit(in, of, plane, basis.y, map.extent[1], map.middle[1], y);
        fit(in, of, plane, basis.depth, map.extent[2], map.middle[2], depth);

        ViewInLight<T> columns;
        columns.x = Lanes<T>::of(basis.x.x, basis.y.x, basis.depth.x, T(0));
        columns.y = Lanes<T>::of(basis.x.y, basis.y.y, basis.depth.y, T(0));
        columns.z = Lanes<T>::of(basis.x.z, basis.y.z, basis.depth.z, T(0));
        Mat4<T>* to = clip_from_world;
        for (int first = 0; first < n; first += 4, to += 16) {
            for (int slice = 0; slice < 4; ++slice) {
                auto const four = [first, slice](Row const(&of_slices)[4]) {
                    return four_at(of_slices[slice] + first);
                };
                Lanes<T> scale[4] = {four(x.scale), four(y.scale), four(depth.scale), all_four(T(0))};
                Lanes<T> offset[4] = {four(x.offset), four(y.offset), four(depth.offset), all_four(T(1))};
                transpose(scale);
                transpose(offset);
                write_whole(columns, scale[0], offset[0], to[slice]);
                write_whole(columns, scale[1], offset[1], to[slice + 4]);
                write_whole(columns, scale[2], offset[2], to[slice + 8]);
                write_whole(columns, scale[3], offset[3], to[slice + 12]);
            }
        }
    }
};

}  // namespace detail

// clip_from_world[splits * i + k] is the map of slice k of view i: what fit_slice_boxes gives for the practical splits
// of the view from z_near to z_far, to a few roundings; maps of slices that there are not, or of views that none can be
// made for, are nowhere(). Says for how many views all maps are there. Four splits are the fast case; views that are
// orthographic or have anything odd are made one by one, and so are those beside them.
template <class T>
[[nodiscard]] inline int fit_slice_boxes_of(ViewVolume<T> const* views, int view_count, LightBasis<T> const& basis,
                                            int splits, T lambda, T border, ClipSpace clip,
                                            Mat4<T>* clip_from_world) noexcept {
    SHADOWMATH_ASSERT(view_count <= 0 || (views != nullptr && clip_from_world != nullptr),
                      "fit_slice_boxes_of needs views, and room for their maps");
    SHADOWMATH_ASSERT(splits >= 1 && splits <= max_splits, "fit_slice_boxes_of makes one to max_splits maps a view");
    auto const weight = detail::order_of(lambda), free = detail::order_of(border);
    detail::BeyondReach<T> beyond;
    for (Vec3<T> const* axis : {&basis.x, &basis.y, &basis.depth})
        beyond.look_at_parts(detail::Lanes<T>::of(axis->x, axis->y, axis->z, T(0)));
    bool const fast = splits == 4 && !beyond.any() && weight > 0 && weight <= detail::order_of(T(1)) &&
                      free >= detail::order_of(T(0)) && free <= detail::order_of(T(0.49));
    detail::MapInLanes<T> const map = detail::map_in_lanes(clip, fast ? T(2) - T(4) * border : T(2));
    int fitted = 0;
    for (int first = 0; first < view_count; first += detail::views_at_once) {
        int const count = view_count - first < detail::views_at_once ? view_count - first : detail::views_at_once;
        Mat4<T>* const maps = clip_from_world + static_cast<std::ptrdiff_t>(first) * splits;
        bool ordinary = false;
        if (fast && count == detail::views_at_once)
            detail::run_widely(detail::SlicesOfViews<T>{views + first, basis, lambda, map, maps, ordinary});
        if (ordinary) {
            fitted += count;
            continue;
        }
        for (int i = 0; i < count; ++i) {
            ViewVolume<T> const& view = views[first + i];
            Splits<T> const planes = practical_splits(view.z_near, view.z_far, splits, lambda);
            bool const good = fit_slice_boxes(view, basis, planes, border, clip, maps + i * splits);
            for (int k = planes.count; k < splits; ++k) maps[i * splits + k] = nowhere<T>();
            if (good && planes.count == splits) ++fitted;
        }
    }
    return fitted;
}

}  // namespace v0
}  // namespace shadowmath
