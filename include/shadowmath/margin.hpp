// SPDX-License-Identifier: MIT
//
// How many texels of a map's side are left for the body when a filter must not read outside: the kernel needs a margin
// on either side, and a fit that promises one must take it out of the map.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>

namespace shadowmath {
inline namespace v0 {

// map_too_small where fewer than three texels are left: the body's own, and one to either side that snapping may take.
// A negative margin counts as none (clamped_option).
template <class T>
[[nodiscard]] inline Faults faults_of_margin(int map_size, T const& margin_texels) noexcept {
    if (!all_finite(&margin_texels, 1)) return Fault::not_finite;
    Faults faults;
    if (margin_texels < T(0)) faults |= Fault::clamped_option;
    T const margin = margin_texels > T(0) ? margin_texels : T(0);
    if (!(T(map_size) >= T(3) + T(2) * margin)) faults |= Fault::map_too_small;
    return faults;
}

// Texels between the margins, at least one whatever is given.
template <class T>
[[nodiscard]] inline T usable_texels(int map_size, T const& margin_texels) noexcept {
    if (!all_finite(&margin_texels, 1) || !(margin_texels < T(map_size))) return T(1);
    T const left = T(map_size) - T(2) * (margin_texels > T(0) ? margin_texels : T(0));
    return left > T(1) ? left : T(1);
}

}  // namespace v0
}  // namespace shadowmath
