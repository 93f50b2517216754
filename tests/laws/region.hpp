// SPDX-License-Identifier: MIT
//
// What region.hpp promises: lo and hi land on the map's corners and nothing else changes, and regions compose.
#pragma once

#include "tests/laws/shadow_map.hpp"

#include <shadowmath/region.hpp>

#include <cmath>
#include <limits>

namespace shadowmath::laws {

// Four roundings make a row (two differences, a quotient, a sum), three a product with it; the terms are as large as
// (|lo| + |hi|) / (hi - lo).
template <class T>
[[nodiscard]] bool fills_the_map(Region<T> const& region) {
    Mat4<T> const matrix = region_matrix(region);
    auto const lands = [&](Vec2<T> const& from, long double wanted) {
        Vec4<long double> const at = image_of(matrix, Vec4<T>(from, T(0.25), T(1)));
        for (int axis = 0; axis < 2; ++axis) {
            long double const lo = static_cast<long double>(region.lo[axis]);
            long double const hi = static_cast<long double>(region.hi[axis]);
            long double const noise =
                8 * std::numeric_limits<T>::epsilon() * (std::abs(lo) + std::abs(hi)) / (hi - lo) + 1e-30L;
            if (!(std::abs(at[axis] - wanted) <= noise)) return false;
        }
        return at.z == 0.25L && at.w == 1.0L;
    };
    return lands(region.lo, -1) && lands(region.hi, 1);
}

}  // namespace shadowmath::laws
