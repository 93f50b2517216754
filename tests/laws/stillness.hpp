// SPDX-License-Identifier: MIT
#pragma once

#include <shadowmath/stillness.hpp>

#include <cmath>

namespace shadowmath::laws {

// Whatever the maps: finite, what is left over at most half a texel, and whole texels beside it.
template <class T>
[[nodiscard]] bool is_texel_shift(TexelShift<T> const& shift) {
    auto const is_part = [](T texels, T off_grid) {
        T const whole = texels - off_grid;
        return std::abs(off_grid) <= T(0.5) && whole == std::round(whole);
    };
    if (!all_finite(shift.texels) || !all_finite(shift.off_grid)) return false;
    if (!shift.ok && (shift.texels != Vec2<T>(T(0)) || shift.off_grid != Vec2<T>(T(0)))) return false;
    return is_part(shift.texels.x, shift.off_grid.x) && is_part(shift.texels.y, shift.off_grid.y) &&
           shimmer_texels(shift) >= T(0) && shimmer_texels(shift) <= T(0.5);
}

}  // namespace shadowmath::laws
