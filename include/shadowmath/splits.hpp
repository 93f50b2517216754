// SPDX-License-Identifier: MIT
//
// Where to cut the view along its depth: n = C[0] < C[1] < ... < C[m] = f, in metres of eye depth.
//
//   uniform      C = n + (f - n) i/m         what one plain map does; starved near the eye
//   logarithmic  C = n (f/n)^(i/m)           optimal for perspective aliasing; the near maps hold almost nothing
//   practical    lambda * log + (1 - lambda) * uniform, lambda = 1/2 by default: use this
//   pinned       the first split ends where you say (a first-person weapon, a cockpit), practical behind it
//   explicit     your own list
//
// Source: Zhang, Sun, Nyman, "Parallel-Split Shadow Maps on Programmable GPUs", GPU Gems 3, chapter 10.1 (2007).
// Traps met in tutorials that retell it, each with the right value:
//   - lambda weights the LOGARITHM here and in the chapter; some code weights the uniform scheme. They agree only at
//     1/2.
//   - i/m in integers is 0 until i = m: every split lands on n.
//   - m splits have m + 1 planes. n = 1, f = 1000, m = 4, lambda = 1/2 gives
//     1, 128.18670662595, 266.06138830084, 464.03897050195, 1000 (not 128.185, 266.05, 463.625).
//   - n = 1, f = 1000, m = 3, logarithmic: the first two splits END at 1 % and 10 % of f; they OCCUPY 0.9009 % and
//     9.009 % of the range.
//   - the logarithmic map parameter is ln(z/n) / ln(f/n); without the division by n it is right for n = 1 only.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/reach.hpp>

#include <cmath>
#include <limits>

namespace shadowmath {
inline namespace v0 {

// The most splits that any function here makes; renderers use three to five, virtual clip maps more.
inline constexpr int max_splits = 16;

template <class T>
struct Splits {
    T plane[max_splits + 1] = {};  // plane[0] = n, plane[count] = f, exactly; the rest is zero
    int count = 0;                 // splits, one fewer than planes; 0: nothing to see
    Faults faults;
};

namespace detail {

// n and f as they can be used, and how many splits fit.
template <class T>
[[nodiscard]] inline Splits<T> open_splits(T const& z_near, T const& z_far, int count) noexcept {
    Splits<T> splits;
    if (!all_finite(&z_near, 1) || !all_finite(&z_far, 1)) {
        splits.faults = Fault::not_finite;
        return splits;
    }
    if (!(z_near >= T(0)) || !(z_near < z_far)) {
        splits.faults = Fault::empty_range;
        return splits;
    }
    splits.count = count < 0 ? 0 : (count > max_splits ? max_splits : count);
    if (splits.count != count) splits.faults |= Fault::count_clamped;
    return splits;
}

// Ends exact whatever the powers rounded to, planes strictly increasing: where rounding or a range of few representable
// numbers makes neighbours equal, the later one goes.
template <class T>
inline void close_splits(Splits<T>& splits, T z_near, T z_far) noexcept {
    if (splits.count == 0) return;
    splits.plane[0] = z_near;
    splits.plane[splits.count] = z_far;
    bool ordered = true;
    for (int i = 0; i < splits.count; ++i) ordered = ordered & (splits.plane[i] < splits.plane[i + 1]);
    if (ordered) return;
    int kept = 0;
    for (int i = 1; i < splits.count; ++i)
        if (splits.plane[i] > splits.plane[kept] && splits.plane[i] < z_far) splits.plane[++kept] = splits.plane[i];
    splits.plane[++kept] = z_far;
    splits.faults |= Fault::count_clamped;
    for (int i = kept + 1; i <= splits.count; ++i) splits.plane[i] = T(0);
    splits.count = kept;
}

// power[i] = ratio^(i / count), 0 < i < count. Where count is a power of two, from square roots alone: a pow costs more
// than all else in a fit. Twice as many hold the same values at every other place, to the bit.
template <class T>
inline void powers_of_ratio(T ratio, int count, T* power) noexcept {
    if ((count & (count - 1)) != 0) {
        for (int i = 1; i < count; ++i) power[i] = std::pow(ratio, T(i) / T(count));
        return;
    }
    power[0] = T(1);
    T root = ratio;
    for (int step = count / 2; step > 0; step /= 2) {
        root = std::sqrt(root);
        for (int i = step; i < count; i += 2 * step) power[i] = power[i - step] * root;
    }
}

template <class T>
[[nodiscard]] inline T clamped_lambda(T const& lambda, Faults& faults) noexcept {
    if (all_finite(&lambda, 1) && lambda >= T(0) && lambda <= T(1)) return lambda;
    faults |= Fault::clamped_option;
    return all_finite(&lambda, 1) ? (lambda > T(1) ? T(1) : T(0)) : T(0.5);
}

// Any case of practical_splits.
template <class T>
[[nodiscard]] inline Splits<T> any_practical_splits(T const& z_near, T const& z_far, int count,
                                                    T const& lambda) noexcept {
    Splits<T> splits = open_splits(z_near, z_far, count);
    T const weight = clamped_lambda(lambda, splits.faults);
    if (splits.count == 0) return splits;
    bool const has_ratio = z_near > z_far * T(0x1p-64);
    if (weight > T(0) && !has_ratio) splits.faults |= Fault::near_clamped;
    T const ratio = has_ratio ? z_far / z_near : T(1 << 20);
    T const log_near = has_ratio ? z_near : z_far / ratio;
    auto const blended = [&](T fraction, T power) {
        return weight * (log_near * power) + (T(1) - weight) * (z_near + (z_far - z_near) * fraction);
    };
    if (weight > T(0)) powers_of_ratio(ratio, splits.count, splits.plane);
    for (int i = 1; i < splits.count; ++i) splits.plane[i] = blended(T(i) / T(splits.count), splits.plane[i]);
    close_splits(splits, z_near, z_far);
    return splits;
}

// What most renderers ask for: four splits between ordinary distances. False where any of that is not so, and then
// `splits` is not to be used. The same bits as in any case.
template <class T>
[[nodiscard, gnu::always_inline]] inline bool four_practical_splits(T const& z_near, T const& z_far, T const& lambda,
                                                                    T (&plane)[max_splits + 1]) noexcept {
    auto const n = order_of(z_near), f = order_of(z_far), weight = order_of(lambda);
    auto const endless = order_of(std::numeric_limits<T>::max()) + 1, one = order_of(T(1));
    if (!((n > 0) & (n < f) & (f < endless) & (weight > 0) & (weight <= one)) || !(z_near > z_far * T(0x1p-64)))
        return false;
    T const ratio = z_far / z_near, half = std::sqrt(ratio), quarter = std::sqrt(half);
    auto const blended = [&](T fraction, T power) {
        return lambda * (z_near * power) + (T(1) - lambda) * (z_near + (z_far - z_near) * fraction);
    };
    plane[0] = z_near;
    plane[1] = blended(T(0.25), quarter);
    plane[2] = blended(T(0.5), half);
    plane[3] = blended(T(0.75), half * quarter);
    plane[4] = z_far;
    return (plane[0] < plane[1]) & (plane[1] < plane[2]) & (plane[2] < plane[3]) & (plane[3] < plane[4]);
}

}  // namespace detail

// Ends exact, strictly increasing, between the uniform and the logarithmic planes; lambda = 1 is logarithmic, 0
// uniform. z_near and z_far in metres, 0 <= z_near < z_far < infinity; count from 1 to max_splits (0 gives no split and
// no fault). Where no ratio of distances exists (z_near = 0, or below 2^-64 of z_far) the logarithmic part starts at
// 2^-20 of z_far (near_clamped).
template <class T>
[[nodiscard, gnu::always_inline]] inline Splits<T> practical_splits(T z_near, T z_far, int count,
                                                                    T lambda = T(0.5)) noexcept {
    // NOTE: one object and one return, or it is copied before it has left the store buffer.
    Splits<T> splits;
    if (count == 4 && detail::four_practical_splits(z_near, z_far, lambda, splits.plane))
        splits.count = 4;
    else
        splits = detail::any_practical_splits(z_near, z_far, count, lambda);
    return splits;
}

template <class T>
[[nodiscard]] inline Splits<T> uniform_splits(T z_near, T z_far, int count) noexcept {
    return practical_splits(z_near, z_far, count, T(0));
}

template <class T>
[[nodiscard]] inline Splits<T> logarithmic_splits(T z_near, T z_far, int count) noexcept {
    return practical_splits(z_near, z_far, count, T(1));
}

// As practical_splits, with plane[1] = first_end exactly. A first_end outside (z_near, z_far) is clamped_option, and
// the splits are practical throughout.
template <class T>
[[nodiscard]] inline Splits<T> pinned_splits(T z_near, T z_far, int count, T first_end, T lambda = T(0.5)) noexcept {
    bool const numbers = all_finite(&z_near, 1) && all_finite(&z_far, 1) && all_finite(&first_end, 1);
    bool const inside = numbers && first_end > z_near && first_end < z_far;
    if (count < 2 || !inside) {
        Splits<T> splits = practical_splits(z_near, z_far, count, lambda);
        if (!inside) splits.faults |= Fault::clamped_option;
        return splits;
    }
    Splits<T> splits = detail::open_splits(z_near, z_far, count);
    if (splits.count < 2) return splits;
    Splits<T> const behind = practical_splits(first_end, z_far, splits.count - 1, lambda);
    splits.faults |= behind.faults;
    for (int i = 0; i < behind.count; ++i) splits.plane[i + 1] = behind.plane[i];
    splits.count = behind.count + 1;
    detail::close_splits(splits, z_near, z_far);
    return splits;
}

// The caller's own inner planes, metres, increasing: `planes` holds count - 1 values. Those not inside (z_near, z_far)
// or not above their forerunner are left out (count_clamped).
template <class T>
[[nodiscard]] inline Splits<T> explicit_splits(T z_near, T z_far, T const* planes, int count) noexcept {
    SHADOWMATH_ASSERT(planes != nullptr || count <= 1, "explicit_splits needs count - 1 planes");
    Splits<T> splits = detail::open_splits(z_near, z_far, count);
    if (splits.count > 1 && !all_finite(planes, splits.count - 1)) {
        splits.faults |= Fault::not_finite;
        splits.count = 0;
    }
    for (int i = 1; i < splits.count; ++i) splits.plane[i] = planes[i - 1];
    detail::close_splits(splits, z_near, z_far);
    return splits;
}

// The lambda for which practical_splits puts its first inner plane at `first_end`; clamped to [0, 1] where none does.
template <class T>
[[nodiscard]] inline T lambda_for_first_split(T z_near, T z_far, int count, T first_end) noexcept {
    Splits<T> const uniform = uniform_splits(z_near, z_far, count), log = logarithmic_splits(z_near, z_far, count);
    if (uniform.count < 2 || log.count < 2 || !all_finite(&first_end, 1)) return T(0.5);
    T const span = uniform.plane[1] - log.plane[1];
    T const lambda = span > T(0) ? (uniform.plane[1] - first_end) / span : T(0.5);
    return lambda < T(0) ? T(0) : (lambda > T(1) ? T(1) : lambda);
}

}  // namespace v0
}  // namespace shadowmath
