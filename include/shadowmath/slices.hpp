// SPDX-License-Identifier: MIT
//
// All slices of a view at once, and nothing but the slices: what fit_box and fit_sphere with texel_grid give, twenty
// times as fast as from an inverse matrix and eight corners. For thousands of views, and for renderers whose casters
// are drawn with depth clamp; where scene bounds are to decide how deep a map is, use fit_cascades.
//
//   Along a light axis a, what is seen from depth n to f spans      a.eye + [min(n k, f k), max(n K, f K)],
//   k = a.forward + the least of a.right * side_x + a.up * side_y,  K with the largest.
//
// Four dot products an axis therefore serve every slice, no corner is computed, and the three axes are the lanes of one
// vector: the loops over `axis` below are one instruction a line.
//
// Source: ours; the closed forms of the spheres are those of fit_sphere.
#pragma once

#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fit_sphere.hpp>
#include <shadowmath/lanes.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/margin.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/splits.hpp>
#include <shadowmath/view_volume.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace shadowmath {
inline namespace v0 {

namespace detail {

// A view in light space. Lanes are the light's axes: x, y, depth; the fourth is zero.
template <class T>
struct ViewInLight {
    Lanes<T> x, y, z;   // columns of the rotation into light space
    Lanes<T> eye_lo;    // at depth 0, the least
    Lanes<T> eye_hi;    // and the largest
    Lanes<T> slope_lo;  // by which they grow with depth
    Lanes<T> slope_hi;
    T rounding;  // of a coordinate at depth 0, metres
    T rounding_slope;
};

template <class T>
[[nodiscard]] inline T absolute_sum(Vec3<T> const& v) noexcept {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

// False, and `seen` not written, where a number is not finite or beyond 2^60 m, an axis of the light longer than 2, or a
// side crossed.
template <class T>
[[nodiscard]] inline bool look(LightBasis<T> const& basis, ViewVolume<T> const& view, ViewInLight<T>& seen) noexcept {
    // NOTE: whole runs of numbers are copied, as vectors are; what is written one by one would wait to be read as one.
    static_assert(sizeof view.pose == 12 * sizeof(T) && sizeof basis == 9 * sizeof(T), "numbers without a gap");
    T of_view[16], of_basis[8];
    std::memcpy(of_view, &view, sizeof of_view);
    std::memcpy(of_basis, &basis, sizeof of_basis);
    // NOTE: with longer axes the rounding that is allowed for would be too little, and a map without extent.
    auto beyond = beyond_reach(std::abs(basis.depth.z) * T(0x1p59));
    for (int i = 0; i < 16; ++i) beyond |= beyond_reach(std::abs(of_view[i]));
    for (int i = 0; i < 8; ++i) beyond |= beyond_reach(std::abs(of_basis[i]) * T(0x1p59));
    if (beyond >> (8 * sizeof beyond - 1) != 0 || !(view.left < view.right) || !(view.bottom < view.top)) return false;
    seen.x = Lanes<T>::of(basis.x.x, basis.y.x, basis.depth.x, T(0));
    seen.y = Lanes<T>::of(basis.x.y, basis.y.y, basis.depth.y, T(0));
    seen.z = Lanes<T>::of(basis.x.z, basis.y.z, basis.depth.z, T(0));
    auto const along = [&seen](Vec3<T> const& v) {
        return seen.x * all_four(v.x) + seen.y * all_four(v.y) + seen.z * all_four(v.z);
    };
    Pose<T> const& pose = view.pose;
    Lanes<T> const eye = along(pose.position), forward = along(pose.forward);
    Lanes<T> const right = along(pose.right), up = along(pose.up);
    Lanes<T> const a = right * all_four(view.left), b = right * all_four(view.right);
    Lanes<T> const c = up * all_four(view.bottom), d = up * all_four(view.top);
    Lanes<T> const lo = least(a, b) + least(c, d), hi = largest(a, b) + largest(c, d);
    bool const flat = view.kind == ViewKind::orthographic;
    T const sides = std::abs(view.left) + std::abs(view.right) + std::abs(view.bottom) + std::abs(view.top);
    constexpr T unit = T(8) * std::numeric_limits<T>::epsilon();
    seen.rounding = unit * (absolute_sum(pose.position) + (flat ? sides : T(0)));
    seen.rounding_slope = unit * (T(1) + (flat ? T(0) : sides));
    seen.eye_lo = flat ? eye + lo : eye;
    seen.eye_hi = flat ? eye + hi : eye;
    seen.slope_lo = flat ? forward : forward + lo;
    seen.slope_hi = flat ? forward : forward + hi;
    return true;
}

// Neither so near that a reciprocal overflows nor out of reach; increasing, as all functions make them.
template <class T>
[[nodiscard]] inline bool in_range(Splits<T> const& splits) noexcept {
    if (splits.count < 1 || splits.count > max_splits || !all_finite(splits.plane, splits.count + 1)) return false;
    bool increasing = splits.plane[0] >= T(0);
    for (int i = 0; i < splits.count; ++i) increasing = increasing & (splits.plane[i] < splits.plane[i + 1]);
    return increasing && splits.plane[1] >= least_metres<T> && splits.plane[splits.count] <= farthest_metres<T>;
}

// As bounding_sphere asks of a slice.
template <class T>
[[nodiscard]] inline bool ball_in_reach(ViewVolume<T> const& view, T farthest) noexcept {
    T const side = std::fmax(std::fmax(std::abs(view.left), std::abs(view.right)),
                             std::fmax(std::abs(view.bottom), std::abs(view.top)));
    return view.kind == ViewKind::orthographic || (side <= T(1e9) && side * farthest <= farthest_metres<T>);
}

// Extent of the map on each axis, and its middle, in the convention.
template <class T>
struct MapInLanes {
    Lanes<T> extent;
    Lanes<T> middle;  // 1 in the fourth: w
};

// `side`: how much of [-1, 1] is used.
template <class T>
[[nodiscard]] inline MapInLanes<T> map_in_lanes(ClipSpace clip, T side) noexcept {
    T const y = clip.ndc_y == YAxis::up ? side : -side;
    T depth = T(1), middle = T(0.5);
    if (clip.depth == DepthOrder::one_to_zero) depth = T(-1);
    if (clip.depth == DepthOrder::minus_one_to_one) depth = T(2), middle = T(0);
    return {Lanes<T>::of(side, y, depth, T(0)), Lanes<T>::of(T(0), T(0), middle, T(1))};
}

template <class T>
inline void write_columns(ViewInLight<T> const& seen, Lanes<T> const& scale, Lanes<T> const& offset,
                          Mat4<T>& clip_from_world) noexcept {
    Lanes<T> const columns[4] = {seen.x * scale, seen.y * scale, seen.z * scale, offset};
    static_assert(sizeof columns == sizeof clip_from_world, "columns without a gap");
    std::memcpy(&clip_from_world, columns, sizeof columns);
}

}  // namespace detail

// clip_from_world[i] is the map of slice i: the smallest light-space box around it, and no depth but the slice's own.
// Each corner of each slice is inside. `border` is the part of the map's side that is kept free on each of the four
// sides, for filters: 2.0f / 2048 for two texels; [0, 0.49]. Writes splits.count matrices and says true; or nowhere()
// and false, where a number is not finite or beyond 2^60 m, an axis is no axis, a side crossed, or the border outside
// its range.
template <class T>
[[nodiscard]] inline bool fit_slice_boxes(ViewVolume<T> const& view, LightBasis<T> const& basis,
                                          Splits<T> const& splits, T border, ClipSpace clip,
                                          Mat4<T>* clip_from_world) noexcept {
    using Lanes = detail::Lanes<T>;
    detail::ViewInLight<T> seen;
    if (!detail::look(basis, view, seen) || !detail::in_range(splits) || !(border >= T(0) && border <= T(0.49))) {
        for (int i = 0; i < splits.count; ++i) clip_from_world[i] = nowhere<T>();
        return false;
    }
    detail::MapInLanes<T> const map = detail::map_in_lanes(clip, T(2) - T(4) * border);
    for (int i = 0; i < splits.count; ++i) {
        Lanes const n = detail::all_four(splits.plane[i]), f = detail::all_four(splits.plane[i + 1]);
        Lanes const rounding = detail::all_four(seen.rounding + seen.rounding_slope * splits.plane[i + 1]);
        Lanes const lo = seen.eye_lo + least(n * seen.slope_lo, f * seen.slope_lo) - rounding;
        Lanes const hi = seen.eye_hi + largest(n * seen.slope_hi, f * seen.slope_hi) + rounding;
        Lanes const scale = map.extent / (hi - lo);
        detail::write_columns(seen, scale, map.middle - (lo + hi) * detail::all_four(T(0.5)) * scale,
                              clip_from_world[i]);
    }
    return true;
}

// As fit_slice_boxes, with the window of the slice's bounding sphere on the texel grid (texel_grid.hpp) for sides: what
// casts no shimmering shadows. Nothing of the sphere is lost in x and y, and no corner of the slice in depth. False as
// well where the margin leaves no texel, or the view is so far out that its texels cannot be counted.
template <class T>
[[nodiscard]] inline bool fit_slice_spheres(ViewVolume<T> const& view, LightBasis<T> const& basis,
                                            Splits<T> const& splits, int map_size, T margin_texels, ClipSpace clip,
                                            Mat4<T>* clip_from_world) noexcept {
    using Lanes = detail::Lanes<T>;
    using Exact = decltype(T() + double());
    detail::ViewInLight<T> seen;
    Faults const margin = faults_of_margin(map_size, margin_texels);
    bool good = detail::look(basis, view, seen) && detail::in_range(splits) && !margin.has(Fault::not_finite) &&
                !margin.has(Fault::map_too_small) && detail::ball_in_reach(view, splits.plane[splits.count]);
    if (!good) {
        for (int i = 0; i < splits.count; ++i) clip_from_world[i] = nowhere<T>();
        return false;
    }
    detail::MapInLanes<T> const map = detail::map_in_lanes(clip, T(1));
    T const radii =
        (T(2) + T(16) * std::numeric_limits<T>::epsilon()) / (usable_texels(map_size, margin_texels) - T(1));
    Exact const size = Exact(map_size), per_side = 1 / size;
    auto const exact = [](Vec3<T> const& axis, Vec3<T> const& v) {
        return Exact(axis.x) * Exact(v.x) + Exact(axis.y) * Exact(v.y) + Exact(axis.z) * Exact(v.z);
    };
    Pose<T> const& pose = view.pose;
    bool const centred = view.left == -view.right && view.bottom == -view.top;
    Exact const eye_x = exact(basis.x, pose.position), eye_y = exact(basis.y, pose.position);
    Exact const forward_x = exact(basis.x, pose.forward), forward_y = exact(basis.y, pose.forward);
    ViewVolume<T> part = view;
    for (int i = 0; i < splits.count; ++i) {
        part.z_near = splits.plane[i], part.z_far = splits.plane[i + 1];
        detail::BallInView<T> const ball = detail::ball_in_view(part);
        Exact const unit = Exact(ball.unit), depth = Exact(ball.center.z) * unit;
        Exact x = eye_x + forward_x * depth, y = eye_y + forward_y * depth;
        if (!centred) {
            x += (exact(basis.x, pose.right) * Exact(ball.center.x) + exact(basis.x, pose.up) * Exact(ball.center.y)) *
                 unit;
            y += (exact(basis.y, pose.right) * Exact(ball.center.x) + exact(basis.y, pose.up) * Exact(ball.center.y)) *
                 unit;
        }
        T const texel = ball.radius_metres * radii;
        Exact const texels = 1 / Exact(texel), middle = Exact(0.5) - size * Exact(0.5);
        Exact const left = x * texels + middle, bottom = y * texels + middle;
        if (!(std::abs(left) < Exact(0x1p51) && std::abs(bottom) < Exact(0x1p51)) ||
            !(texel >= detail::least_metres<T>)) {
            clip_from_world[i] = nowhere<T>();
            good = false;
            continue;
        }
        auto const whole = [](Exact value) {
            auto const truncated = static_cast<std::int64_t>(value);
            return truncated - (Exact(truncated) > value ? 1 : 0);
        };
        T const across = T(2 * per_side * texels);
        T const offset_x = T(-(2 * Exact(whole(left)) * per_side + 1));
        T const offset_y = T(-(2 * Exact(whole(bottom)) * per_side + 1));
        T const n = part.z_near, f = part.z_far;
        T const n_lo = n * seen.slope_lo[2], f_lo = f * seen.slope_lo[2];
        T const n_hi = n * seen.slope_hi[2], f_hi = f * seen.slope_hi[2];
        T const rounding = seen.rounding + seen.rounding_slope * f;
        T const lo = seen.eye_lo[2] + (n_lo < f_lo ? n_lo : f_lo) - rounding;
        T const hi = seen.eye_hi[2] + (n_hi > f_hi ? n_hi : f_hi) + rounding;
        T const along = map.extent[2] / (hi - lo), up = map.extent[1];
        detail::write_columns(seen, Lanes::of(across, across * up, along, T(0)),
                              Lanes::of(offset_x, offset_y * up, map.middle[2] - (lo + hi) * T(0.5) * along, T(1)),
                              clip_from_world[i]);
    }
    return good;
}

}  // namespace v0
}  // namespace shadowmath
