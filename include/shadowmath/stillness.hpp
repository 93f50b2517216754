// SPDX-License-Identifier: MIT
//
// How a point moves through the texels from one frame's map to the next. Edges of shadows stand still as long as every
// point moves by whole texels, and shimmer by what is left over. For watching maps at run time, any technique's: those
// on a texel grid (texel_grid.hpp) have nothing left over, all others crawl, and this says by how much.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/tangent.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct TexelShift {
    Vec2<T> texels{T(0)};    // from its place in the first map to that in the second
    Vec2<T> off_grid{T(0)};  // of them, what is left beside the nearest whole number: [-1/2, 1/2]
    bool ok = false;         // false: one of the maps does not hold the point (w), and both are 0
};

// Exact to the rounding of the two places. Both maps are map_size texels along a side; where the point lies beyond
// them, the grid goes on.
template <class T>
[[nodiscard]] inline TexelShift<T> texel_shift(ShadowMap<T> const& before, ShadowMap<T> const& after, int map_size,
                                               Vec3<T> const& point) noexcept {
    Projected<T> const a = projected(texture_from_world(before), point, before.w_min);
    Projected<T> const b = projected(texture_from_world(after), point, after.w_min);
    if (!a.in_front || !b.in_front || map_size < 1) return {};
    Vec2<T> const moved = (Vec2<T>(b.at) - Vec2<T>(a.at)) * T(map_size);
    if (!all_finite(moved)) return {};
    return {moved, moved - Vec2<T>(std::round(moved.x), std::round(moved.y)), true};
}

// The longer of the two parts that are left over, [0, 1/2]: 0 is still. 0 where the shift is not ok.
template <class T>
[[nodiscard]] inline T shimmer_texels(TexelShift<T> const& shift) noexcept {
    return std::fmax(std::abs(shift.off_grid.x), std::abs(shift.off_grid.y));
}

}  // namespace v0
}  // namespace shadowmath
