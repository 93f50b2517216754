// SPDX-License-Identifier: MIT
//
// What slices_in_scene.hpp promises: the bounds of what polygon clipping leaves of each slice, and little more.
#pragma once

#include "tests/laws/slices.hpp"

#include <shadowmath/light.hpp>
#include <shadowmath/polytope.hpp>
#include <shadowmath/slices_in_scene.hpp>

#include <cmath>
#include <limits>

namespace shadowmath::laws {

// Metres that planes may be off by: 256 epsilon of what the view reaches and of where it is. Planes are moved outward
// by 16, those that lean by 23; the edges of the box are up to four reaches long, and where one ends is known to some
// ten roundings of that length, each of half an epsilon, and as much again for the slope of a side.
template <class T>
[[nodiscard]] long double scene_rounding(ViewVolume<T> const& view, T farthest) {
    long double const sides = std::abs(static_cast<long double>(view.left)) + std::abs(view.right) +
                              std::abs(view.bottom) + std::abs(view.top);
    long double const reach = view.kind == ViewKind::orthographic ? farthest + sides : farthest * (1 + sides);
    Vec3<T> const& eye = view.pose.position;
    return 256 * static_cast<long double>(std::numeric_limits<T>::epsilon()) *
           (reach + std::abs(eye.x) + std::abs(eye.y) + std::abs(eye.z));
}

// A box and a slice where the eye is the origin, in long double: differences of places are taken once, and exactly.
template <class T>
[[nodiscard]] Aabb<long double> about_eye(ViewVolume<T> const& view, Aabb<T> const& box) {
    Vec3<long double> const eye(view.pose.position);
    return {Vec3<long double>(box.lo) - eye, Vec3<long double>(box.hi) - eye};
}
template <class T>
[[nodiscard]] ViewVolume<long double> about_eye(ViewVolume<T> view, SliceRange<T> const& range) {
    view.pose.position = Vec3<T>(T(0));
    return exact_view(slice(view, range));
}

// By clipping polygons in long double, every plane `slack` metres farther out.
template <class T>
[[nodiscard]] Aabb<long double> clipped_bounds(ViewVolume<T> const& part, LightBasis<T> const& basis,
                                               Aabb<T> const& scene, long double slack) {
    using Real = long double;
    ViewVolume<Real> const exact = exact_view(part);
    LightBasis<Real> const axes{Vec3<Real>(basis.x), Vec3<Real>(basis.y), Vec3<Real>(basis.depth)};
    Aabb<Real> const box{Vec3<Real>(scene.lo), Vec3<Real>(scene.hi)};
    Aabb<Real> bounds;
    for_each_vertex(visible_body(exact, box, slack),
                    [&](Vec3<Real> const& v) { bounds = merge(bounds, in_light(axes, v + exact.pose.position)); });
    return bounds;
}

template <class T>
[[nodiscard]] bool holds(Aabb<T> const& outer, Aabb<long double> const& inner, long double slack) {
    if (is_empty(inner)) return true;
    if (is_empty(outer)) return false;
    for (int axis = 0; axis < 3; ++axis)
        if (!(static_cast<long double>(outer.lo[axis]) - slack <= inner.lo[axis] &&
              inner.hi[axis] <= static_cast<long double>(outer.hi[axis]) + slack))
            return false;
    return true;
}

}  // namespace shadowmath::laws
