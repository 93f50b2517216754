// SPDX-License-Identifier: MIT
//
// How far numbers may reach before arithmetic on them leaves the range of float: the one limit of all fits. What lies
// beyond is not visible; boxes alone may be larger, since they are cut to what is in reach first.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/light.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace shadowmath {
inline namespace v0 {
namespace detail {

// Metres: a hundred light years. Squares stay finite in float.
template <class T>
inline constexpr T farthest_metres = T(1e18);

// Its inverse: lengths below have reciprocals that are too large.
template <class T>
inline constexpr T least_metres = T(1e-18);

// std::fmax of what is not negative; without a call of it, which is what compilers make of that one.
template <class T>
[[nodiscard]] inline T larger(T a, T b) noexcept {
    return b < a || b != b ? a : b;
}

template <class T>
[[nodiscard]] inline T largest_of(Vec3<T> const& v) noexcept {
    return larger(std::abs(v.x), larger(std::abs(v.y), std::abs(v.z)));
}

template <class T>
[[nodiscard]] inline T largest_of(Aabb<T> const& box) noexcept {
    return larger(largest_of(box.lo), largest_of(box.hi));
}

// The top bit is set where a value that is not negative is a NaN, an infinity, or 2^60 and more (above
// farthest_metres). By its bits (finite.hpp) and without a branch, so that many are a few instructions.
[[nodiscard]] inline std::uint32_t beyond_reach(float value) noexcept {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits + (0x80000000u - 0x5d800000u);
}
[[nodiscard]] inline std::uint64_t beyond_reach(double value) noexcept {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits + (0x8000000000000000u - 0x43b0000000000000u);
}
[[nodiscard]] inline std::uint64_t beyond_reach(long double value) noexcept {
    return std::isless(value, 0x1p60L) ? 0 : ~std::uint64_t(0);
}

// The top bit is set where a value is not from `lo` to `hi`, lo > 0; likewise by its bits.
[[nodiscard]] inline std::uint32_t beyond(float value, float lo, float hi) noexcept {
    std::uint32_t bits, least, most;
    std::memcpy(&bits, &value, sizeof bits);
    std::memcpy(&least, &lo, sizeof least);
    std::memcpy(&most, &hi, sizeof most);
    return bits | (bits - least) | (most - bits);
}
[[nodiscard]] inline std::uint64_t beyond(double value, double lo, double hi) noexcept {
    std::uint64_t bits, least, most;
    std::memcpy(&bits, &value, sizeof bits);
    std::memcpy(&least, &lo, sizeof least);
    std::memcpy(&most, &hi, sizeof most);
    return bits | (bits - least) | (most - bits);
}
[[nodiscard]] inline std::uint64_t beyond(long double value, long double lo, long double hi) noexcept {
    return value >= lo && value <= hi ? 0 : ~std::uint64_t(0);
}

// Numbers that are not negative by their bits: these order as the numbers do, and above all of them come infinity and
// NaN. Negative numbers come below all others, but for -0, which is 0.
[[nodiscard]] inline std::int32_t order_of(float value) noexcept {
    std::int32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits == std::numeric_limits<std::int32_t>::min() ? 0 : bits;
}
[[nodiscard]] inline std::int64_t order_of(double value) noexcept {
    std::int64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits == std::numeric_limits<std::int64_t>::min() ? 0 : bits;
}
[[nodiscard]] inline long double order_of(long double value) noexcept {
    constexpr std::uint32_t bits = 0x7f800000u;  // infinity without its name, of which clang warns under -ffast-math
    float infinity;
    std::memcpy(&infinity, &bits, sizeof infinity);
    return value == value ? value : static_cast<long double>(infinity);
}

// Unit to a thousandth, as light_basis makes them for every light that is usable.
template <class T>
[[nodiscard]] inline bool has_unit_axes(LightBasis<T> const& basis) noexcept {
    auto const is_unit = [](Vec3<T> const& axis) {
        return all_finite(axis) && largest_of(axis) < T(2) && std::abs(glm::dot(axis, axis) - T(1)) <= T(1e-3);
    };
    return is_unit(basis.x) && is_unit(basis.y) && is_unit(basis.depth);
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath
