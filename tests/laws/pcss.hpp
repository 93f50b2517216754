// SPDX-License-Identifier: MIT
#pragma once

#include <shadowmath/pcss.hpp>

#include <cmath>

namespace shadowmath::laws {

template <class T>
[[nodiscard]] bool is_soft_shadow(SoftShadow<T> const& shadow) {
    bool const share = all_finite(&shadow.visibility, 1) && shadow.visibility >= T(0) && shadow.visibility <= T(1);
    bool const gap = all_finite(&shadow.gap, 1) && shadow.gap >= T(0) && shadow.gap <= widest_gap<T>;
    return share && gap && (shadow.blocked || (shadow.visibility == T(1) && shadow.gap == T(0)));
}

// Share of a disk on the light's side of a straight edge that passes its centre at `x` radii.
template <class T>
[[nodiscard]] T share_of_disk(T x) {
    T const chord = x < T(-1) ? T(-1) : (x > T(1) ? T(1) : x);
    return T(0.5) + (chord * std::sqrt(T(1) - chord * chord) + std::asin(chord)) / T(3.14159265358979323846L);
}

}  // namespace shadowmath::laws
