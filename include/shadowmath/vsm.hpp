// SPDX-License-Identifier: MIT
//
// Variance shadow maps, plain and exponential: the share of a kernel that is lit is at most
//
//   variance / (variance + (depth - mean)^2)        beyond the mean depth, 1 before it (Cantelli)
//
// whatever the kernel holds. VSM takes two moments of depth; EVSM the same of two growing functions of depth, exp(c z)
// and -exp(-c z), z = 2 depth - 1: order stays, so both bounds hold, and the smaller is far smaller where depths
// overlap. The exponent c is bounded by what squares fit into the format: see largest_exponent_*.
//
// Use EVSM where 128 bits a texel are paid for, VSM with less_bleeding where 64 are; msm.hpp needs 64 and no exponent.
//
// Source: Donnelly and Lauritzen, I3D 2006; Lauritzen and McCool, Graphics Interface 2008. Departure: the least
// variance is given as a deviation of depth, and is carried through the warp by its slope.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/moments.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {

// exp(2 c) must fit: into 3.4e38 with room for what a bound computes of it, and into 65504.
inline constexpr float largest_exponent_float = 42.0f;
inline constexpr float largest_exponent_half = 5.54f;

template <class T>
[[nodiscard]] inline Vec2<T> vsm_moments(T depth) noexcept {
    if (!all_finite(&depth, 1)) return Vec2<T>(T(1));
    T const kept = detail::unit_depth(depth);
    return Vec2<T>(kept, kept * kept);
}

namespace detail {

// Cantelli's bound; `least_deviation` >= 0, of the same quantity.
template <class T>
[[nodiscard]] inline T most_light(T mean, T mean_square, T value, T least_deviation) noexcept {
    if (!(value > mean)) return T(1);
    T const measured = mean_square - mean * mean, least = least_deviation * least_deviation;
    T const variance = measured > least ? measured : least;
    T const distance = value - mean, sum = variance + distance * distance;
    return sum > T(0) ? share_or_light(variance / sum) : T(1);
}

// Beyond a hundredth of the map's depth nothing would be dark, and the squares of EVSM would overflow.
template <class T>
[[nodiscard]] inline T kept_deviation(T const& deviation) noexcept {
    if (!all_finite(&deviation, 1) || !(deviation > T(0))) return T(0);
    return deviation < T(0.01) ? deviation : T(0.01);
}

template <class T>
[[nodiscard]] inline T kept_exponent(T const& exponent) noexcept {
    if (!all_finite(&exponent, 1) || !(exponent > T(0))) return T(0);
    return exponent < T(largest_exponent_float) ? exponent : T(largest_exponent_float);
}

}  // namespace detail

// Never less than the share of the kernel at or beyond `depth`, and never growing with it; exact where the kernel holds
// one depth. `least_deviation` [0, 0.01] is a spread of depth that every kernel is taken to have at least: it hides the
// rounding of the moments, about 3e-4 for float and 4e-3 for 16 bits.
template <class T>
[[nodiscard]] inline T vsm_visibility(Vec2<T> const& moments, T depth, T least_deviation) noexcept {
    if (!all_finite(moments) || !all_finite(&depth, 1)) return T(1);
    return detail::most_light(moments.x, moments.y, detail::unit_depth(depth), detail::kept_deviation(least_deviation));
}

// Exponents of the growing and of the falling warp, each clamped to [0, largest_exponent_float]. The falling one needs
// less: it answers for receivers before the occluders behind them.
template <class T>
struct EvsmExponents {
    T growing = T(40);
    T falling = T(5);
};

// exp(c z) and -exp(-c z), both growing with depth.
template <class T>
[[nodiscard]] inline Vec2<T> evsm_warp(T depth, EvsmExponents<T> const& exponents) noexcept {
    T const z = all_finite(&depth, 1) ? T(2) * detail::unit_depth(depth) - T(1) : T(1);
    return Vec2<T>(std::exp(detail::kept_exponent(exponents.growing) * z),
                   -std::exp(-detail::kept_exponent(exponents.falling) * z));
}

// Of the growing warp and of its square, of the falling one and of its square. Finite in float.
template <class T>
[[nodiscard]] inline Vec4<T> evsm_moments(T depth, EvsmExponents<T> const& exponents) noexcept {
    Vec2<T> const warp = evsm_warp(depth, exponents);
    return Vec4<T>(warp.x, warp.x * warp.x, warp.y, warp.y * warp.y);
}

// As vsm_visibility, and never more than either warp alone allows; `warp` is that of the receiver's depth.
template <class T>
[[nodiscard]] inline T evsm_bound(Vec4<T> const& moments, Vec2<T> const& warp, EvsmExponents<T> const& exponents,
                                  T least_deviation) noexcept {
    if (!all_finite(moments) || !all_finite(warp)) return T(1);
    T const deviation = T(2) * detail::kept_deviation(least_deviation);
    T const growing =
        detail::most_light(moments.x, moments.y, warp.x, deviation * detail::kept_exponent(exponents.growing) * warp.x);
    T const falling = detail::most_light(moments.z, moments.w, warp.y,
                                         -deviation * detail::kept_exponent(exponents.falling) * warp.y);
    return growing < falling ? growing : falling;
}

template <class T>
[[nodiscard]] inline T evsm_visibility(Vec4<T> const& moments, T depth, EvsmExponents<T> const& exponents,
                                       T least_deviation) noexcept {
    if (!all_finite(&depth, 1)) return T(1);
    return evsm_bound(moments, evsm_warp(depth, exponents), exponents, least_deviation);
}

}  // namespace v0
}  // namespace shadowmath
