// SPDX-License-Identifier: MIT
//
// The smallest light-space box around a body: up to twice the texels of the sphere's square, at the price of a size and
// a place that change with every turn of the camera, so that shadow edges crawl. For maps that are drawn once, for
// cameras that stand still, and under a temporal filter; else fit_sphere and texel_grid.
//
// Source: any "fit to frustum" since GPU Gems 3 chapter 10. Departure: the filter's margin is part of the fit.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/light_box.hpp>
#include <shadowmath/margin.hpp>
#include <shadowmath/reach.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace shadowmath {
inline namespace v0 {

namespace detail {

// The interval, or where it is shorter, one of this length around its middle.
template <class T>
inline void widen(T& lo, T& hi, T least) noexcept {
    if (hi - lo >= least) return;
    T const middle = lo + (hi - lo) * T(0.5);
    lo = middle - least * T(0.5);
    hi = middle + least * T(0.5);
}

}  // namespace detail

// The body, given by its bounds in light space, lies `margin_texels` texels inside the four sides; depth runs from its
// first point to its last. A flat body is widened to a texel of its largest extent, and to what the scalar type can
// tell apart. Bounds that are empty, not finite or beyond 1e18 m, and axes that are not unit, give the box
// [-1, 1]^2 x [0, 1]; a map without room for the margin (faults_of_margin) is treated as one with one usable texel.
template <class T>
[[nodiscard]] inline LightBox<T> box_around(LightBasis<T> const& basis, Aabb<T> const& body_in_light, int map_size,
                                            T margin_texels) noexcept {
    LightBox<T> box;
    Aabb<T> const& body = body_in_light;
    if (!detail::has_unit_axes(basis) || !all_finite(body) || is_empty(body) ||
        !(detail::largest_of(body) <= T(2) * detail::farthest_metres<T>))
        return box;
    T const largest = detail::largest_of(body.hi - body.lo);
    T const rounding = T(4) * std::numeric_limits<T>::epsilon() * detail::largest_of(body);
    T const texels = map_size > 1 ? T(map_size) : T(1);
    // A micrometre: the one point at the origin has no scale of its own.
    T const least = std::fmax(std::fmax(largest / texels, rounding), T(1e-6));
    box.basis = basis;
    for (int axis = 0; axis < 2; ++axis) {
        T lo = body.lo[axis], hi = body.hi[axis];
        detail::widen(lo, hi, least);
        T const usable = usable_texels(map_size, margin_texels);
        T const margin = T(0.5) * (texels - usable) / usable * (hi - lo);
        // The rounding of the points themselves, which margin 0 would leave outside.
        box.lo[axis] = lo - margin - rounding;
        box.hi[axis] = hi + margin + rounding;
    }
    box.depth_lo = body.lo.z - rounding;
    box.depth_hi = body.hi.z + rounding;
    detail::widen(box.depth_lo, box.depth_hi, std::fmax(rounding, T(1e-6)));
    return box;
}

// box_around the eight corners. Corners that are not finite or beyond 1e18 m give the box [-1, 1]^2 x [0, 1].
template <class T>
[[nodiscard]] inline LightBox<T> fit_box(LightBasis<T> const& basis, std::array<Vec3<T>, 8> const& corners_in_world,
                                         int map_size, T margin_texels) noexcept {
    if (!detail::has_unit_axes(basis)) return {};
    Aabb<T> body;
    for (Vec3<T> const& corner : corners_in_world) {
        if (!all_finite(corner) || !(detail::largest_of(corner) <= detail::farthest_metres<T>)) return {};
        body = merge(body, in_light(basis, corner));
    }
    return box_around(basis, body, map_size, margin_texels);
}

}  // namespace v0
}  // namespace shadowmath
