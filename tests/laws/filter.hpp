// SPDX-License-Identifier: MIT
#pragma once

#include <shadowmath/filter.hpp>

#include <algorithm>
#include <cmath>

namespace shadowmath::laws {

template <class T>
[[nodiscard]] bool is_share(T visibility) {
    return all_finite(&visibility, 1) && visibility >= T(0) && visibility <= T(1);
}

// Share of the box 2 * radius texels wide around the point that lies over lit texels, by the overlap of rectangles.
template <class T, class IsLit>
[[nodiscard]] T lit_share_of_box(Vec2<T> const& centre, int radius, IsLit const& is_lit) {
    T const half = static_cast<T>(radius);
    auto const overlap = [half](T at, int texel) {
        T const lo = std::max(at - half, static_cast<T>(texel));
        T const hi = std::min(at + half, static_cast<T>(texel + 1));
        return std::max(hi - lo, T(0));
    };
    T lit = T(0);
    int const x0 = static_cast<int>(std::floor(centre.x)), y0 = static_cast<int>(std::floor(centre.y));
    for (int y = y0 - radius - 1; y <= y0 + radius + 1; ++y)
        for (int x = x0 - radius - 1; x <= x0 + radius + 1; ++x)
            if (is_lit(x, y)) lit += overlap(centre.x, x) * overlap(centre.y, y);
    return lit / (T(4) * half * half);
}

}  // namespace shadowmath::laws
