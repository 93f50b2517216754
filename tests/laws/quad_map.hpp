// SPDX-License-Identifier: MIT
//
// What four sides make of the light's plane.
#pragma once

#include <shadowmath/quad_map.hpp>

#include <cmath>
#include <limits>

namespace shadowmath::laws {

// Each side lies on its side of the square, and w is between its least and 1 at the corners. Within 2^10 roundings of
// what a corner's coordinates are: it is where two sides meet, at an angle that most_shear and most_warp bound.
template <class T>
[[nodiscard]] bool fills_the_square(Quad<T> const& quad) {
    T const rounding = T(1024) * std::numeric_limits<T>::epsilon();
    for (unsigned i = 0; i < 4; ++i) {
        Vec3<T> const p(quad.corner[i], T(1));
        T const w = glm::dot(quad.w, p), x = glm::dot(quad.x, p), y = glm::dot(quad.y, p);
        Vec2<T> const sizes(std::abs(quad.x.z) + glm::length(Vec2<T>(quad.x)) * glm::length(quad.corner[i]),
                            std::abs(quad.y.z) + glm::length(Vec2<T>(quad.y)) * glm::length(quad.corner[i]));
        T const wanted_x = (i & 1u) == 0 ? -w : w, wanted_y = (i & 2u) == 0 ? -w : w;
        if (!(std::abs(x - wanted_x) <= rounding * (sizes.x + w))) return false;
        if (!(std::abs(y - wanted_y) <= rounding * (sizes.y + w))) return false;
        if (!(w >= quad.w_least * (T(1) - rounding) && w <= T(1) + rounding)) return false;
    }
    return true;
}

}  // namespace shadowmath::laws
