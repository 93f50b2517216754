// SPDX-License-Identifier: MIT
//
// Laws of the splits (GPU Gems 3, chapter 10.1). Order and ends are exact; values are judged against long double.
#pragma once

#include <shadowmath/splits.hpp>

#include <cmath>
#include <limits>

namespace shadowmath::laws {

using Real = long double;

// n = C[0] < C[1] < ... < C[m] = f, the ends exactly, nothing behind; or no split at all and a reason, unless none was
// asked for.
template <class T>
[[nodiscard]] bool is_ordered(Splits<T> const& splits, T z_near, T z_far, int asked) {
    if (splits.count == 0) return splits.faults.any() || asked == 0;
    if (splits.count < 0 || splits.count > max_splits || splits.count > asked) return false;
    if (splits.count < asked && !splits.faults.has(Fault::count_clamped)) return false;
    if (splits.plane[0] != z_near || splits.plane[splits.count] != z_far) return false;
    for (int i = 0; i < splits.count; ++i)
        if (!(splits.plane[i] < splits.plane[i + 1])) return false;
    for (int i = splits.count + 1; i <= max_splits; ++i)
        if (splits.plane[i] != T(0)) return false;
    return true;
}

[[nodiscard]] inline Real uniform_plane(Real z_near, Real z_far, int i, int count) {
    return z_near + (z_far - z_near) * i / count;
}

[[nodiscard]] inline Real logarithmic_plane(Real z_near, Real z_far, int i, int count) {
    return z_near * std::pow(z_far / z_near, static_cast<Real>(i) / count);
}

// Each plane within the roundings of the formula: 4 for the uniform part; for the logarithmic one 4 more, and those of
// the exponent i / m, which the power multiplies by ln(f / n).
template <class T>
[[nodiscard]] bool follows_the_formula(Splits<T> const& splits, T z_near, T z_far, T lambda) {
    Real const growth = std::log(static_cast<Real>(z_far) / z_near);
    for (int i = 0; i <= splits.count; ++i) {
        Real const uniform = uniform_plane(z_near, z_far, i, splits.count);
        Real const logarithmic = logarithmic_plane(z_near, z_far, i, splits.count);
        Real const weight = lambda;
        Real const wanted = weight * logarithmic + (1 - weight) * uniform;
        Real const scale = (1 - weight) * uniform * 4 + weight * logarithmic * (4 + growth) + wanted * 2;
        if (!(std::abs(splits.plane[i] - wanted) <= scale * std::numeric_limits<T>::epsilon())) return false;
        // Between the two schemes, by the inequality of the means.
        Real const slack = scale * std::numeric_limits<T>::epsilon();
        if (!(splits.plane[i] >= logarithmic - slack && splits.plane[i] <= uniform + slack)) return false;
    }
    return true;
}

// More logarithm, nearer planes; never the other way round, up to the rounding of the blend.
template <class T>
[[nodiscard]] bool falls_with_lambda(Splits<T> const& less, Splits<T> const& more) {
    if (less.count != more.count) return false;
    for (int i = 0; i <= less.count; ++i)
        if (!(more.plane[i] <= less.plane[i] * (1 + 4 * std::numeric_limits<T>::epsilon()))) return false;
    return true;
}

// The world in other units: a factor of two is exact in every plane but for the power, whose argument is the same
// ratio.
template <class T>
[[nodiscard]] bool is_scaled_by_two(Splits<T> const& splits, Splits<T> const& doubled) {
    if (splits.count != doubled.count) return false;
    for (int i = 0; i <= splits.count; ++i)
        if (doubled.plane[i] != T(2) * splits.plane[i]) return false;
    return true;
}

// Every other plane of twice as many splits is one of these; the fractions 2i / 2m and i / m round alike.
template <class T>
[[nodiscard]] bool is_refined_by(Splits<T> const& splits, Splits<T> const& twice_as_many) {
    if (twice_as_many.count != 2 * splits.count) return false;
    for (int i = 0; i <= splits.count; ++i)
        if (twice_as_many.plane[2 * i] != splits.plane[i]) return false;
    return true;
}

}  // namespace shadowmath::laws
