// SPDX-License-Identifier: MIT
//
// What vdsm.hpp promises beyond the laws of every map: a projection onto the plane, along the light.
#pragma once

#include "tests/laws/map_rows.hpp"

#include <shadowmath/vdsm.hpp>

#include <cmath>
#include <limits>

namespace shadowmath::laws {

// Pi l = 0 and pi . (Pi p) = 0, p and its image on one ray. Entries are at most 1 + |l| |pi| / |pi . l|, each of a few
// roundings.
template <class T>
[[nodiscard]] bool projects_onto(ShadowPlane<T> const& plane, Vec4<T> const& light, Vec3<T> const& point) {
    Mat4<T> const projection = plane_projection(plane, light);
    Vec4<long double> const pi(Vec4<T>(plane.normal, plane.offset)), l(light), p(Vec4<T>(point, T(1)));
    long double const entry = 1 + glm::length(l) * glm::length(pi) / std::abs(glm::dot(pi, l));
    // The height itself is a sum of four products.
    long double const noise = 32 * static_cast<long double>(std::numeric_limits<T>::epsilon()) * entry * entry;
    Vec4<long double> const image = Mat4<long double>(projection) * p;
    Vec4<long double> const of_light = Mat4<long double>(projection) * l;
    Vec4<long double> const moved = image - p;
    // p - Pi p is a multiple of l.
    Vec4<long double> const aside = moved - l * (glm::dot(moved, l) / glm::dot(l, l));
    return std::abs(glm::dot(pi, image)) <= noise * glm::length(pi) * glm::length(p) &&
           glm::length(of_light) <= noise * glm::length(l) && glm::length(aside) <= noise * glm::length(p);
}

}  // namespace shadowmath::laws
