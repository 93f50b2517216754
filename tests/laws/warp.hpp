// SPDX-License-Identifier: MIT
//
// What warp.hpp promises beyond the laws of every map: axes that are a basis, whatever the angle of light and view.
#pragma once

#include "tests/laws/map_rows.hpp"

#include <shadowmath/warp.hpp>

#include <cmath>
#include <limits>

namespace shadowmath::laws {

// Orthonormal to 16 roundings, x * y = -depth, y on the side of the view wherever the view has a say.
template <class T>
[[nodiscard]] bool is_a_basis_along_the_view(WarpAxes<T> const& axes, Pose<T> const& eye) {
    Vec3<long double> const x(axes.basis.x), y(axes.basis.y), d(axes.basis.depth);
    long double const noise = 16 * static_cast<long double>(std::numeric_limits<T>::epsilon());
    bool const square =
        std::abs(glm::dot(x, y)) <= noise && std::abs(glm::dot(y, d)) <= noise && std::abs(glm::dot(d, x)) <= noise;
    bool const unit = std::abs(glm::length(x) - 1) <= noise && std::abs(glm::length(y) - 1) <= noise;
    bool const turned = glm::length(glm::cross(x, y) + d) <= 2 * noise;
    bool const ahead = axes.fade == T(0) || glm::dot(y, Vec3<long double>(eye.forward)) > 0;
    return square && unit && turned && ahead && axes.fade >= T(0) && axes.fade <= T(1);
}

// The largest distance, in texels, between where two maps put the same point.
template <class T>
[[nodiscard]] T moved_texels(ShadowMap<T> const& before, ShadowMap<T> const& after, Vec3<T> const& world,
                             int map_size) {
    auto const texel = [&](ShadowMap<T> const& map) {
        Vec4<T> const at = map.clip_from_world * Vec4<T>(world, T(1));
        return Vec2<T>(at) / at.w * (T(map_size) / T(2));
    };
    return glm::length(texel(after) - texel(before));
}

}  // namespace shadowmath::laws
