// SPDX-License-Identifier: MIT
#pragma once

#include <shadowmath/tangent.hpp>

#include <cmath>

namespace shadowmath::laws {

template <class T>
[[nodiscard]] bool is_finite(Projected<T> const& point) {
    return all_finite(point.at) && all_finite(&point.w, 1) && point.w > T(0);
}

template <class T>
[[nodiscard]] bool span_the_plane(Tangents<T> const& plane, Vec3<T> const& unit_normal, T tolerance) {
    auto const is = [tolerance](T value, T wanted) { return std::abs(value - wanted) <= tolerance; };
    return plane.ok && is(glm::dot(plane.s, plane.s), T(1)) && is(glm::dot(plane.t, plane.t), T(1)) &&
           is(glm::dot(plane.s, plane.t), T(0)) && is(glm::dot(plane.s, unit_normal), T(0)) &&
           is(glm::dot(plane.t, unit_normal), T(0));
}

// The place after the division, in long double.
template <class T>
[[nodiscard]] Vec3<long double> place(Mat4<T> const& matrix, Vec3<long double> const& point) {
    Vec4<long double> const clip = Mat4<long double>(matrix) * Vec4<long double>(point, 1.0L);
    return Vec3<long double>(clip) / clip.w;
}

// Central difference over `step` metres: its error is the square of step over the distance to w = 0.
template <class T>
[[nodiscard]] Vec3<long double> measured_gain(Mat4<T> const& matrix, Vec3<T> const& point, Vec3<T> const& direction,
                                              long double step) {
    Vec3<long double> const p(point), d(direction);
    return (place(matrix, p + d * step) - place(matrix, p - d * step)) / (2 * step);
}

}  // namespace shadowmath::laws
