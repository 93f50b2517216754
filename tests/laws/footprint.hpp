// SPDX-License-Identifier: MIT
#pragma once

#include "tangent.hpp"

#include <shadowmath/footprint.hpp>

#include <glm/matrix.hpp>

#include <cmath>

namespace shadowmath::laws {

template <class T>
[[nodiscard]] bool is_footprint(Footprint<T> const& f) {
    return all_finite(&f.major, 1) && all_finite(&f.minor, 1) && f.minor >= T(0) && f.minor <= f.major &&
           f.major <= footprint_limit<T>;
}

template <class T>
[[nodiscard]] bool same(Footprint<T> const& a, Footprint<T> const& b, T relative) {
    return std::abs(a.major - b.major) <= relative * a.major && std::abs(a.minor - b.minor) <= relative * a.major;
}

// d(eye pixels) / d(map texels) on the plane, measured by moving the point: columns are what a texel in x and in y
// gives.
template <class T>
[[nodiscard]] glm::mat<2, 2, long double, glm::defaultp> measured_jacobian(Mat4<T> const& eye,
                                                                           Vec2<T> const& eye_pixels,
                                                                           Mat4<T> const& map, T map_texels,
                                                                           Vec3<T> const& point,
                                                                           Tangents<T> const& plane, long double step) {
    using Mat2 = glm::mat<2, 2, long double, glm::defaultp>;
    using V = Vec2<long double>;
    auto const gains = [&](Mat4<T> const& matrix, V size) {
        return Mat2(V(measured_gain(matrix, point, plane.s, step)) * size * 0.5L,
                    V(measured_gain(matrix, point, plane.t, step)) * size * 0.5L);
    };
    return gains(eye, V(eye_pixels)) * glm::inverse(gains(map, V(static_cast<long double>(map_texels))));
}

}  // namespace shadowmath::laws
