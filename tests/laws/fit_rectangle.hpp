// SPDX-License-Identifier: MIT
//
// Laws of the rectangle: everything inside, never more area than the box, and no angle that is better.
#pragma once

#include "tests/laws/fit_box.hpp"

#include <shadowmath/fit_rectangle.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace shadowmath::laws {

// At least the margin between every vertex and every side, every depth between the ends. What the farthest vertex is
// rounded by is rounded off the sides, so a near one is held no closer than that.
template <class T>
[[nodiscard]] bool holds_body_and_margin(LightBox<T> const& box, ConvexBody<T> const& body, int map_size,
                                         T margin_texels) {
    long double rounding = 0;
    for_each_vertex(body, [&](Vec3<T> const& v) { rounding = std::max(rounding, light_rounding(v)); });
    bool holds = has_extent(box);
    for_each_vertex(body, [&](Vec3<T> const& v) {
        holds = holds && holds_point_and_margin(box, v, rounding, map_size, margin_texels);
    });
    return holds;
}

// Square metres of the rectangle without margins at the best of `steps` angles, in long double.
template <class T>
[[nodiscard]] long double least_area_of_many(LightBasis<T> const& basis, ConvexBody<T> const& body, int steps) {
    long double least = std::numeric_limits<long double>::max();
    for (int step = 0; step < steps; ++step) {
        long double const angle = 1.57079632679489661923L * step / steps, c = std::cos(angle), s = std::sin(angle);
        Vec3<long double> const x(basis.x), y(basis.y);
        Aabb<long double> bounds;
        for_each_vertex(body, [&](Vec3<T> const& v) {
            Vec3<long double> const p(v);
            bounds = merge(bounds, Vec3<long double>(glm::dot(x * c + y * s, p), glm::dot(y * c - x * s, p), 0));
        });
        least = std::min(least, (bounds.hi.x - bounds.lo.x) * (bounds.hi.y - bounds.lo.y));
    }
    return least;
}

// The axes are those given, turned about the light.
template <class T>
[[nodiscard]] bool is_rolled(LightBasis<T> const& turned, LightBasis<T> const& basis) {
    T const noise = T(16) * std::numeric_limits<T>::epsilon();
    return turned.depth == basis.depth && glm::length(glm::cross(turned.x, turned.y) + basis.depth) <= T(4) * noise &&
           std::abs(glm::dot(turned.x, basis.depth)) <= noise && std::abs(glm::length(turned.x) - T(1)) <= noise;
}

}  // namespace shadowmath::laws
