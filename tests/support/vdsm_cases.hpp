// SPDX-License-Identifier: MIT
//
// A walker over level ground in the morning: the case that view-dependent maps are for.
#pragma once

#include "tests/support/town.hpp"

#include <shadowmath/light.hpp>
#include <shadowmath/vdsm.hpp>
#include <shadowmath/view_volume.hpp>

namespace shadowmath::test {

inline ShadowPlane<double> const ground{V3(0, 1, 0), 0.0};
inline Aabb<double> const level_ground{V3(-300, 0, -300), V3(300, 0, 300)};
inline Light<double> const morning = directional(V3(0.4, -1.0, 0.3));

[[nodiscard]] inline ViewVolume<double> walker() {
    return perspective_view(pose_looking(V3(0, 1.7, 0), V3(0.3, -0.1, -1), V3(0, 1, 0)), 1.0, 1.6, 0.1, 200.0);
}

}  // namespace shadowmath::test
