// SPDX-License-Identifier: MIT
//
// A town as one box, in double, and the words that tests of maps over it share.
#pragma once

#include <shadowmath/bounds.hpp>

#include <limits>

namespace shadowmath::test {

using V2 = glm::dvec2;
using V3 = glm::dvec3;
using V4 = glm::dvec4;

inline constexpr double inf = std::numeric_limits<double>::infinity();
inline constexpr double nan_ = std::numeric_limits<double>::quiet_NaN();

inline Aabb<double> const town{V3(-300, 0, -300), V3(300, 12, 300)};

[[nodiscard]] inline V3 ndc(glm::dmat4 const& clip_from_world, V3 const& point) {
    V4 const at = clip_from_world * V4(point, 1.0);
    return V3(at) / at.w;
}

}  // namespace shadowmath::test
