// SPDX-License-Identifier: MIT
//
// A level view over flat ground under a light overhead: the case in which warps have closed forms.
#pragma once

#include "tests/support/town.hpp"

#include <shadowmath/light.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/view_volume.hpp>

#include <cmath>

namespace shadowmath::test {

inline Aabb<double> const flat_world{V3(-3000, 0, -3000), V3(3000, 0, 3000)};
inline Light<double> const overhead = directional(V3(0, -1, 0));

[[nodiscard]] inline ViewVolume<double> level_view(double z_far = 200.0) {
    return perspective_view(pose_looking(V3(0, 1.7, 0), V3(0, 0, -1), V3(0, 1, 0)), 1.0, 1.6, 0.1, z_far);
}

// d(map share) / dz / z on the ground below the view axis: the error along the view, by the exact derivative.
[[nodiscard]] inline double error_along(ShadowMap<double> const& map, double z) {
    glm::dmat4 const& m = map.clip_from_world;
    V4 const at = m * V4(0, 0, -z, 1), slope = m * V4(0, 0, -1, 0);
    double const ndc_per_metre = (slope.y * at.w - at.y * slope.w) / (at.w * at.w);
    return 1.0 / (z * std::abs(ndc_per_metre) / 2.0);
}

// Eye depth at which the lower edge of the level view meets the ground.
[[nodiscard]] inline double first_ground(ViewVolume<double> const& view) {
    return view.pose.position.y / -view.bottom;
}

}  // namespace shadowmath::test
