// SPDX-License-Identifier: MIT
//
// What sweep.hpp promises: all of the way to the light is inside, and nothing that is not on the way.
#pragma once

#include "tests/laws/shadow_map.hpp"

#include <shadowmath/sweep.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace shadowmath::laws {

template <class T>
[[nodiscard]] bool inside(HalfSpaces<T> const& planes, Vec3<T> const& point, T slack) {
    return std::all_of(planes.begin(), planes.end(),
                       [&](Vec4<T> const& plane) { return glm::dot(plane, Vec4<T>(point, T(1))) >= -slack; });
}

// The point has the body below it: somewhere on its ray away from the light it is in all of the body's half-spaces,
// each moved outward by `slack` of its normal's length.
template <class T>
[[nodiscard]] bool casts_on(ConvexBody<T> const& body, Vec4<T> const& source, Vec3<T> const& point, T slack) {
    T first = T(0), last = std::numeric_limits<T>::max();
    // For a spot the ray away from the light at point p runs along p - light: (source.xyz + p) there, as w is -1.
    Vec3<T> const ray = Vec3<T>(source) - point * source.w;
    for (int i = 0; i < body.face_count; ++i) {
        Vec4<T> const& h = body.half_space[static_cast<std::size_t>(i)];
        T const at = glm::dot(h, Vec4<T>(point, T(1))) + slack * glm::length(Vec3<T>(h));
        T const slope = glm::dot(Vec3<T>(h), ray);
        if (slope > T(0)) first = std::max(first, -at / slope);
        if (slope < T(0)) last = std::min(last, at / -slope);
        if (slope == T(0) && at < T(0)) return false;
    }
    return first <= last;
}

}  // namespace shadowmath::laws
