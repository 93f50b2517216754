// SPDX-License-Identifier: MIT
//
// Laws of the door: what counts as a number, and what is left of a vector's length.
#pragma once

#include <shadowmath/finite.hpp>

#include <cmath>
#include <limits>

namespace shadowmath::laws {

// The bit test agrees with the definition.
template <class T>
[[nodiscard]] bool tells_numbers_apart(T value) {
    return all_finite(&value, 1) == std::isfinite(value) &&
           is_positive_infinity(&value) == (std::isinf(value) && value > T(0));
}

// For every finite vector but zero: unit to 2 ulp, and along the input to 4 ulp. Neither overflow nor underflow.
// Judged in long double, where |v| of the largest double has room.
template <class T>
[[nodiscard]] bool normalizes(Vec3<T> const& v) {
    Normalized<T> const unit = safe_normalize(v);
    if (v == Vec3<T>(T(0))) return !unit.ok && unit.direction == Vec3<T>(T(0)) && unit.length == T(0);
    constexpr long double eps = std::numeric_limits<T>::epsilon();
    Vec3<long double> const wide(v);
    long double const length = std::sqrt(glm::dot(wide, wide));
    Vec3<long double> const direction(unit.direction);
    Vec3<long double> const error = direction - wide / length;
    bool const straight = std::abs(error.x) <= 4 * eps && std::abs(error.y) <= 4 * eps && std::abs(error.z) <= 4 * eps;
    bool const is_unit = std::abs(std::sqrt(glm::dot(direction, direction)) - 1) <= 2 * eps;
    bool const too_long = length > static_cast<long double>(std::numeric_limits<T>::max());
    // Below the smallest normal number the length is rounded to a multiple of the smallest number of all.
    long double const rounding = 4 * eps * length + static_cast<long double>(std::numeric_limits<T>::denorm_min());
    bool const measured = too_long || std::abs(static_cast<long double>(unit.length) - length) <= rounding;
    return unit.ok && straight && is_unit && measured;
}

// The hypotenuse of finite sides, to an ulp; the platform's, whose own last bit is its own, is the judge.
template <class T>
[[nodiscard]] bool is_hypotenuse(T length, T a, T b) {
    long double const wanted = std::hypot(static_cast<long double>(a), static_cast<long double>(b));
    if (wanted > static_cast<long double>(std::numeric_limits<T>::max())) return true;
    constexpr long double eps = std::numeric_limits<T>::epsilon();
    return std::abs(static_cast<long double>(length) - wanted) <=
           eps * wanted + static_cast<long double>(std::numeric_limits<T>::denorm_min());
}

}  // namespace shadowmath::laws
