// SPDX-License-Identifier: MIT
#pragma once

#include "tangent.hpp"

#include <shadowmath/footprint.hpp>

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

// Eye pixels per map texel in one direction of the world, measured by moving the point there.
template <class T>
[[nodiscard]] long double measured_ratio(Mat4<T> const& eye, Vec2<T> const& eye_pixels, Mat4<T> const& map,
                                         T map_texels, Vec3<T> const& point, Vec3<T> const& direction,
                                         long double step) {
    Vec2<long double> const pixels =
        Vec2<long double>(measured_gain(eye, point, direction, step)) * Vec2<long double>(eye_pixels);
    Vec2<long double> const texels =
        Vec2<long double>(measured_gain(map, point, direction, step)) * static_cast<long double>(map_texels);
    return glm::length(pixels) / glm::length(texels);
}

}  // namespace shadowmath::laws
