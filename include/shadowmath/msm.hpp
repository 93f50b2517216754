// SPDX-License-Identifier: MIT
//
// Moment shadow maps: the sharpest bound on the lit share of a kernel that four moments of depth allow. Exact where the
// kernel holds two depths (an edge over a floor), where VSM still lets light through.
//
// Of all distributions with the given moments the one that darkens the receiver least has an atom at the receiver's
// depth and two more: the roots of a quadratic whose coefficients solve a 3x3 Hankel system. What lies before the
// receiver in it is occluded. Moments are of z = 2 depth - 1.
//
// Source: Peters and Klein, Moment Shadow Mapping, I3D 2015 (the Hamburger problem); packing and bias as in Peters
// et al., JCGT 6(1), 2017. Departure: roots far outside are kept at a bound instead of being infinite, so there is no
// receiver for which it divides by zero.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/moments.hpp>
#include <shadowmath/tangent.hpp>

#include <cmath>
#include <limits>

namespace shadowmath {
inline namespace v0 {

// Share of a fixed distribution (masses 3/16, 5/8, 3/16 at z = -1, 0, 1) that is mixed into the moments, so that what
// rounding made of them is still that of a distribution. It costs as much of the bound: light is at most 1 - bias.
template <class T>
inline constexpr T msm_bias_float = T(3e-6);  // moments kept and blurred in float
template <class T>
inline constexpr T msm_bias_16_bits = T(6e-5);  // packed into four times 16 bits

// z, z^2, z^3, z^4.
template <class T>
[[nodiscard]] inline Vec4<T> msm_moments(T depth) noexcept {
    T const z = all_finite(&depth, 1) ? T(2) * detail::unit_depth(depth) - T(1) : T(1);
    T const square = z * z;
    return Vec4<T>(z, square, square * z, square * square);
}

// Four numbers in [0, 1] to be stored with 16 bits each and filtered as they are: odd and even moments turned so that
// each fills its range, which makes the volume of possible moments, and the room for rounding, as large as it can be.
template <class T>
[[nodiscard]] inline Vec4<T> msm_packed(Vec4<T> const& moments) noexcept {
    constexpr T root3 = T(1.73205080756887729352744634150587237L);
    return Vec4<T>(T(1.5) * moments.x - T(2) * moments.z + T(0.5), T(4) * (moments.y - moments.w),
                   root3 * (moments.x / T(2) - moments.z * (T(2) / T(9))) + T(0.5), (moments.y + moments.w) / T(2));
}

template <class T>
[[nodiscard]] inline Vec4<T> msm_unpacked(Vec4<T> const& stored) noexcept {
    constexpr T root3 = T(1.73205080756887729352744634150587237L);
    T const first = stored.x - T(0.5), second = root3 * (stored.z - T(0.5));
    return Vec4<T>(second - first / T(3), stored.w + stored.y / T(8), T(0.75) * (second - first),
                   stored.w - stored.y / T(8));
}

namespace detail {

// NOTE: no kernel has moments whose divisors are zero, but a texel that was never written may.
template <class T>
[[nodiscard]] inline T quotient_or_zero(T dividend, T divisor) noexcept {
    return divisor != T(0) ? dividend / divisor : T(0);
}

// Coefficients c of 1, z, z^2 with Hankel(b) c = (1, x, x^2), through L D L^T.
template <class T>
[[nodiscard]] inline Vec3<T> solve_hankel(Vec4<T> const& b, T x) noexcept {
    T const variance = b.y - b.x * b.x, skew = b.z - b.x * b.y;
    T const spread = (b.w - b.y * b.y) * variance - skew * skew;  // det: D3 * D2
    T const c1 = x - b.x, c2 = x * x - b.y - quotient_or_zero(skew, variance) * c1;
    T const z = quotient_or_zero(c2 * variance, spread);
    T const y = quotient_or_zero(c1 - skew * z, variance);
    return Vec3<T>(T(1) - b.x * y - b.y * z, y, z);
}

// The mass before x in the distribution with these moments, an atom at x and atoms at low <= high.
template <class T>
[[nodiscard]] inline T mass_before(Vec4<T> const& b, T x, T low, T high) noexcept {
    if (!(x > low)) return T(0);
    if (!(x > high)) return quotient_or_zero(x * high - b.x * (x + high) + b.y, (high - low) * (x - low));
    return T(1) - quotient_or_zero(low * high - b.x * (low + high) + b.y, (x - low) * (x - high));
}

}  // namespace detail

// Never less than (1 - bias) times the share of the kernel at or beyond `depth`, up to the rounding that the bias
// covers; never growing with depth; within `bias` and rounding exact where the kernel holds one or two depths away from
// the receiver's. `bias` is clamped to what keeps the system regular.
template <class T>
[[nodiscard]] inline T msm_visibility(Vec4<T> const& moments, T depth, T bias) noexcept {
    if (!all_finite(moments) || !all_finite(&depth, 1)) return T(1);
    T const least = T(16) * std::numeric_limits<T>::epsilon();
    T const share = all_finite(&bias, 1) && bias > least ? (bias < T(0.1) ? bias : T(0.1)) : least;
    Vec4<T> const b = moments * (T(1) - share) + Vec4<T>(T(0), T(0.375), T(0), T(0.375)) * share;
    T const x = T(2) * detail::unit_depth(depth) - T(1);
    Vec3<T> const c = detail::solve_hankel(b, x);
    // Roots by the formula in which nothing cancels.
    T const discriminant = c.y * c.y - T(4) * c.z * c.x;
    T const root = std::sqrt(discriminant > T(0) ? discriminant : T(0));
    T const sum = (c.y < T(0) ? root - c.y : -root - c.y) / T(2);
    T const farthest = T(1e4);
    T const one = bounded_quotient(sum, c.z, farthest), other = bounded_quotient(c.x, sum, farthest);
    T const occluded = detail::mass_before(b, x, one < other ? one : other, one < other ? other : one);
    return detail::share_or_light(T(1) - occluded);
}

}  // namespace v0
}  // namespace shadowmath
