// SPDX-License-Identifier: MIT
//
// Laws of lights and of the axes to look along them by. Judged in long double.
#pragma once

#include <shadowmath/light.hpp>

#include <cmath>
#include <limits>

namespace shadowmath::laws {

using Real = long double;

// Unit, orthogonal, right * up = -depth, each to 4 ulp.
template <class T>
[[nodiscard]] bool is_orthonormal(LightBasis<T> const& basis) {
    Vec3<Real> const x(basis.x), y(basis.y), depth(basis.depth);
    auto const is = [](Real value, Real wanted) {
        return std::abs(value - wanted) <= 4 * static_cast<Real>(std::numeric_limits<T>::epsilon());
    };
    Vec3<Real> const turned = glm::cross(x, y) + depth;
    return is(glm::length(x), 1) && is(glm::length(y), 1) && is(glm::length(depth), 1) && is(glm::dot(x, y), 0) &&
           is(glm::dot(y, depth), 0) && is(glm::dot(depth, x), 0) && is(turned.x, 0) && is(turned.y, 0) &&
           is(turned.z, 0);
}

// A small turn of the light turns the axes little. Carrying them along the shortest turn from -y adds tan(angle / 2)
// times the turn, where `angle` is the way from -y: no more than 2 in all up to a right angle, without bound only at
// +y.
template <class T>
[[nodiscard]] bool follows_the_light(Vec3<T> const& travel, Vec3<T> const& turned) {
    LightBasis<T> const a = light_basis(travel), b = light_basis(turned);
    Real const turn = glm::length(Vec3<Real>(travel) - Vec3<Real>(turned));
    auto const slope = [](Vec3<T> const& d) {
        Real const across = std::hypot(static_cast<Real>(d.x), static_cast<Real>(d.z));
        return d.y <= T(0) ? across / (1 - static_cast<Real>(d.y)) : (1 + static_cast<Real>(d.y)) / across;
    };
    Real const steepest = std::fmax(slope(travel), slope(turned));
    // Twice the bound: the turn is finite, and the slope between its ends may exceed that at both. Plus the axes' own 4
    // ulp.
    Real const allowed = 2 * (1 + steepest) * turn + 16 * static_cast<Real>(std::numeric_limits<T>::epsilon());
    return glm::length(Vec3<Real>(a.x) - Vec3<Real>(b.x)) <= allowed &&
           glm::length(Vec3<Real>(a.y) - Vec3<Real>(b.y)) <= allowed;
}

// The one homogeneous point stands for every ray: p + t * travel of a sun keeps its place across the light, and a
// spot's own position is where all its rays meet.
template <class T>
[[nodiscard]] bool is_where_its_rays_meet(Light<T> const& light) {
    Vec4<T> const l = homogeneous(light);
    if (light.kind == LightKind::directional) return Vec3<T>(l) == light.direction && l.w == T(0);
    return Vec3<T>(l) / l.w == light.position && l.w < T(0);
}

// Whatever it was made from, every number in it is one, and a light without the three fatal faults has a unit
// direction.
template <class T>
[[nodiscard]] bool is_usable_or_says_why(Light<T> const& light) {
    bool const numbers = all_finite(light.direction) && all_finite(light.position) &&
                         all_finite(&light.half_angle_radians, 1) && all_finite(&light.range, 1);
    Real const length = glm::length(Vec3<Real>(light.direction));
    bool const is_unit = std::abs(length - 1) <= 4 * static_cast<Real>(std::numeric_limits<T>::epsilon());
    bool const in_range = light.half_angle_radians >= T(1e-3) && light.half_angle_radians <= T(1.5);
    return numbers && is_unit && in_range && (unusable(light) || light.range > T(0)) &&
           (light.faults.any() || !unusable(light));
}

}  // namespace shadowmath::laws
