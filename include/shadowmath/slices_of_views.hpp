// SPDX-License-Identifier: MIT
//
// The slices of thousands of views at once: what fit_slice_boxes gives for each, at a third of the cost. For simulators
// and for tools that try many cameras under one sun.
//
// Eight views are eight lanes: what they have in common is done once for all of them, and each operation is one
// instruction for all eight.
#pragma once

#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/lanes.hpp>
#include <shadowmath/light.hpp>
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

    // Rows: position, right, up, forward, sides; near and far. False where not all views are perspective.
    [[gnu::always_inline]] bool gather(Row (&of_views)[18]) const noexcept {
        bool perspective = true;
        for (int first = 0; first < n; first += 4) {
            ViewVolume<T> const &a = views[first], &b = views[first + 1], &c = views[first + 2], &d = views[first + 3];
            T const* pose[4] = {&a.pose.position.x, &b.pose.position.x, &c.pose.position.x, &d.pose.position.x};
            gather({pose[0], pose[1], pose[2], pose[3]}, of_views, first);
            gather({pose[0] + 4, pose[1] + 4, pose[2] + 4, pose[3] + 4}, of_views + 4, first);
            gather({pose[0] + 8, pose[1] + 8, pose[2] + 8, pose[3] + 8}, of_views + 8, first);
            gather({&a.left, &b.left, &c.left, &d.left}, of_views + 12, first);
            Lanes<T> const z_near = Lanes<T>::of(a.z_near, b.z_near, c.z_near, d.z_near);
            Lanes<T> const z_far = Lanes<T>::of(a.z_far, b.z_far, c.z_far, d.z_far);
            std::memcpy(of_views[16] + first, &z_near, sizeof z_near);
            std::memcpy(of_views[17] + first, &z_far, sizeof z_far);
            perspective = perspective & (a.kind == ViewKind::perspective) & (b.kind == ViewKind::perspective) &
                          (c.kind == ViewKind::perspective) & (d.kind == ViewKind::perspective);
        }
        return perspective;
    }

    [[gnu::always_inline]] static bool in_reach(Row const (&of_views)[18]) noexcept {
        decltype(beyond_reach(T(0))) any = 0;
        for (int row = 0; row < 16; ++row) {
            Row const& of = of_views[row];
            for (int i = 0; i < n; ++i) any |= beyond_reach(std::abs(of[i]));
        }
        for (int i = 0; i < n; ++i)
            any |= beyond(of_views[16][i], least_metres<T>, farthest_metres<T>) |
                   beyond(of_views[17][i], least_metres<T>, farthest_metres<T>);
        return any >> (8 * sizeof any - 1) == 0;
    }

    [[gnu::always_inline]] static void roots_of(Row const& of, Row& roots) noexcept {
        for (int first = 0; first < n; first += 4) {
            Lanes<T> const four = root(four_at(of + first));
            std::memcpy(roots + first, &four, sizeof four);
        }
    }

    [[gnu::always_inline]] void operator()() const noexcept {
        Row in[18];
        ordinary = gather(in) && in_reach(in);
        if (!ordinary) return;

        Row plane[5], ratio, half, quarter, slope;
        for (int i = 0; i < n; ++i) ratio[i] = in[17][i] / in[16][i];
        roots_of(ratio, half);
        roots_of(half, quarter);
        std::uint32_t good[n];
        constexpr T unit = T(8) * std::numeric_limits<T>::epsilon();
        for (int i = 0; i < n; ++i) {
            T const near_end = in[16][i], far_end = in[17][i], length = far_end - near_end, rest = T(1) - lambda;
            plane[0][i] = near_end;
            plane[1][i] = lambda * (near_end * quarter[i]) + rest * (near_end + length * T(0.25));
            plane[2][i] = lambda * (near_end * half[i]) + rest * (near_end + length * T(0.5));
            plane[3][i] = lambda * (near_end * (half[i] * quarter[i])) + rest * (near_end + length * T(0.75));
            plane[4][i] = far_end;
            slope[i] =
                unit * (T(1) + (std::abs(in[12][i]) + std::abs(in[13][i]) + std::abs(in[14][i]) + std::abs(in[15][i])));
        }
        for (int i = 0; i < n; ++i)
            good[i] = ((plane[0][i] < plane[1][i]) & (plane[1][i] < plane[2][i]) & (plane[2][i] < plane[3][i]) &
                       (plane[3][i] < plane[4][i]) & (in[12][i] < in[13][i]) & (in[14][i] < in[15][i]) &
                       (in[16][i] > in[17][i] * T(0x1p-64)))
                          ? ~0u
                          : 0u;
        std::uint32_t all_good = ~0u;
        for (int i = 0; i < n; ++i) all_good &= good[i];
        ordinary = all_good != 0;
        if (!ordinary) return;

        Row eye_lo[3], eye_hi[3], slope_lo[3], slope_hi[3];
        for (int axis = 0; axis < 3; ++axis) {
            Vec3<T> const a = axis == 0 ? basis.x : (axis == 1 ? basis.y : basis.depth);
            Row &e0 = eye_lo[axis], &e1 = eye_hi[axis], &s0 = slope_lo[axis], &s1 = slope_hi[axis];
            for (int i = 0; i < n; ++i) {
                T const eye = a.x * in[0][i] + a.y * in[1][i] + a.z * in[2][i];
                T const right = a.x * in[3][i] + a.y * in[4][i] + a.z * in[5][i];
                T const up = a.x * in[6][i] + a.y * in[7][i] + a.z * in[8][i];
                T const ahead = a.x * in[9][i] + a.y * in[10][i] + a.z * in[11][i];
                T const b = right * in[12][i], c = right * in[13][i], d = up * in[14][i], e = up * in[15][i];
                T const rounding = unit * (std::abs(in[0][i]) + std::abs(in[1][i]) + std::abs(in[2][i]));
                e0[i] = eye - rounding;
                e1[i] = eye + rounding;
                s0[i] = ahead + (less(b, c) + less(d, e));
                s1[i] = ahead + (more(b, c) + more(d, e));
            }
        }
        ViewInLight<T> columns;
        columns.x = Lanes<T>::of(basis.x.x, basis.y.x, basis.depth.x, T(0));
        columns.y = Lanes<T>::of(basis.x.y, basis.y.y, basis.depth.y, T(0));
        columns.z = Lanes<T>::of(basis.x.z, basis.y.z, basis.depth.z, T(0));
        for (int slice = 0; slice < 4; ++slice) {
            Row scale[3], offset[3];
            Row const &from = plane[slice], &to = plane[slice + 1];
            for (int axis = 0; axis < 3; ++axis) {
                T const extent = map.extent[axis], middle = map.middle[axis];
                Row const &e0 = eye_lo[axis], &e1 = eye_hi[axis], &s0 = slope_lo[axis], &s1 = slope_hi[axis];
                Row &wide = scale[axis], &moved = offset[axis];
                for (int i = 0; i < n; ++i) {
                    T const rounding = to[i] * slope[i];
                    T const lo = e0[i] + (less(from[i] * s0[i], to[i] * s0[i]) - rounding);
                    T const hi = e1[i] + (more(from[i] * s1[i], to[i] * s1[i]) + rounding);
                    T const of_map = extent / (hi - lo);
                    wide[i] = of_map;
                    moved[i] = middle - (lo + hi) * T(0.5) * of_map;
                }
            }
            for (int first = 0; first < n; first += 4) {
                Lanes<T> of_four[4] = {four_at(scale[0] + first), four_at(scale[1] + first), four_at(scale[2] + first),
                                       all_four(T(0))};
                Lanes<T> moved[4] = {four_at(offset[0] + first), four_at(offset[1] + first), four_at(offset[2] + first),
                                     all_four(T(1))};
                transpose(of_four);
                transpose(moved);
                Mat4<T>* const maps = clip_from_world + 4 * first + slice;
                write_columns(columns, of_four[0], moved[0], maps[0]);
                write_columns(columns, of_four[1], moved[1], maps[4]);
                write_columns(columns, of_four[2], moved[2], maps[8]);
                write_columns(columns, of_four[3], moved[3], maps[12]);
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
    bool const in_reach = detail::largest_of(basis.x) < T(4) && detail::largest_of(basis.y) < T(4) &&
                          detail::largest_of(basis.depth) < T(4) && all_finite(basis.x) && all_finite(basis.y) &&
                          all_finite(basis.depth);
    bool const fast = splits == 4 && in_reach && weight > 0 && weight <= detail::order_of(T(1)) &&
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
