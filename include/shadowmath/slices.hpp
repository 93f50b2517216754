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
    Lanes<T> slope_hi;  // all four outward by what a coordinate may be rounded by
};

template <class T>
[[nodiscard]] inline T absolute_sum(Vec3<T> const& v) noexcept {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

// False, and `seen` not written, where a number is not finite or beyond 2^60 m, or a side is crossed.
template <class T>
[[nodiscard]] inline bool look(LightBasis<T> const& basis, ViewVolume<T> const& view, ViewInLight<T>& seen) noexcept {
    // NOTE: whole runs of numbers are copied, as vectors are; what is written one by one would wait to be read as one.
    static_assert(sizeof view.pose == 12 * sizeof(T) && sizeof basis == 9 * sizeof(T), "numbers without a gap");
    T of_view[16], of_basis[8];
    std::memcpy(of_view, &view, sizeof of_view);
    std::memcpy(of_basis, &basis, sizeof of_basis);
    auto beyond = beyond_reach(std::abs(basis.depth.z));
    for (int i = 0; i < 16; ++i) beyond |= beyond_reach(std::abs(of_view[i]));
    for (int i = 0; i < 8; ++i) beyond |= beyond_reach(std::abs(of_basis[i]));
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
    Lanes<T> const rounding = all_four(unit * (absolute_sum(pose.position) + (flat ? sides : T(0))));
    Lanes<T> const rounding_slope = all_four(unit * (T(1) + (flat ? T(0) : sides)));
    seen.eye_lo = (flat ? eye + lo : eye) - rounding;
    seen.eye_hi = (flat ? eye + hi : eye) + rounding;
    seen.slope_lo = (flat ? forward : forward + lo) - rounding_slope;
    seen.slope_hi = (flat ? forward : forward + hi) + rounding_slope;
    return true;
}

// Neither so near that a reciprocal overflows nor out of reach; increasing, as all functions make them.
template <class T>
[[nodiscard]] inline bool in_range(Splits<T> const& splits) noexcept {
    T const &first = splits.plane[0], &last = splits.plane[splits.count];
    return splits.count > 0 && all_finite(&first, 1) && all_finite(&last, 1) && first >= T(0) &&
           splits.plane[1] >= least_metres<T> && last <= farthest_metres<T>;
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
// and false, where a number is not finite or beyond 2^60 m, a side is crossed, or the border outside its range.
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
        Lanes const lo = seen.eye_lo + least(n * seen.slope_lo, f * seen.slope_lo);
        Lanes const hi = seen.eye_hi + largest(n * seen.slope_hi, f * seen.slope_hi);
        Lanes const scale = map.extent / (hi - lo);
        detail::write_columns(seen, scale, map.middle - (lo + hi) * detail::all_four(T(0.5)) * scale,
                              clip_from_world[i]);
    }
    return true;
}

}  // namespace v0
}  // namespace shadowmath
