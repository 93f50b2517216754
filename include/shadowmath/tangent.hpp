// SPDX-License-Identifier: MIT
//
// What a projective matrix does to a point and to the small piece of plane around it: the place after the division by
// w, and what that place gains for a metre along a direction. Footprint, bias and filter are all made of these two.
//
// With P = M p and a direction t, the derivative of P.xyz / P.w along t is (Mt.xyz - (P.xyz / P.w) Mt.w) / P.w.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {

// matrix * (point, 1) with its order of sums written out, so that a caster, its receiver, every build of GLM and the
// GLSL twin round alike.
template <class T>
[[nodiscard]] inline Vec4<T> transformed(Mat4<T> const& matrix, Vec3<T> const& point) noexcept {
    return matrix[0] * point.x + (matrix[1] * point.y + (matrix[2] * point.z + matrix[3]));
}

template <class T>
struct Projected {
    Vec3<T> at{T(0)};       // after the division
    T w = T(1);             // before it
    bool in_front = false;  // w exceeds w_min and 0, and `at` is finite; otherwise `at` is 0 and w is 1
};

// Finite for every matrix and point.
template <class T>
[[nodiscard]] inline Projected<T> projected(Mat4<T> const& matrix, Vec3<T> const& point, T w_min = T(0)) noexcept {
    if (!all_finite(matrix) || !all_finite(point)) return {};
    Vec4<T> const clip = transformed(matrix, point);
    if (!(clip.w > T(0)) || !(clip.w > w_min)) return {};
    Vec3<T> const at = Vec3<T>(clip) / clip.w;
    if (!all_finite(at) || !all_finite(&clip.w, 1)) return {};
    return {at, clip.w, true};
}

// The change of `at` for a metre along `direction`, to first order.
template <class T>
[[nodiscard]] inline Vec3<T> gain_along(Mat4<T> const& matrix, Projected<T> const& point,
                                        Vec3<T> const& direction) noexcept {
    Vec4<T> const clip = matrix[0] * direction.x + (matrix[1] * direction.y + matrix[2] * direction.z);
    return (Vec3<T>(clip) - point.at * clip.w) / point.w;
}

template <class T>
struct Tangents {
    Vec3<T> s{T(0)};  // unit, orthogonal to each other and to the normal; zero when `ok` is false
    Vec3<T> t{T(0)};
    bool ok = false;
};

// Two axes of the plane with this normal, of any length but zero.
template <class T>
[[nodiscard]] inline Tangents<T> tangents(Vec3<T> const& normal) noexcept {
    if (!all_finite(normal)) return {};
    Normalized<T> const unit = safe_normalize(normal);
    if (!unit.ok) return {};
    Vec3<T> const& n = unit.direction;
    Vec3<T> const aside = std::abs(n.x) < T(0.5) ? Vec3<T>(T(1), T(0), T(0)) : Vec3<T>(T(0), T(1), T(0));
    Vec3<T> const s = safe_normalize(glm::cross(n, aside)).direction;
    return {s, glm::cross(n, s), true};
}

// Within [-limit, limit] whatever a and b are: a / 0 is the limit with the sign of a, 0 / 0 is 0.
template <class T>
[[nodiscard]] inline T bounded_quotient(T a, T b, T limit) noexcept {
    if (a == T(0)) return T(0);
    if (std::abs(a) < limit * std::abs(b)) return a / b;
    return (a < T(0)) == (b < T(0)) ? limit : -limit;
}

}  // namespace v0
}  // namespace shadowmath
