// SPDX-License-Identifier: MIT
//
// The truth about soft shadows: the share of a disk of light that a point sees, by rays to points spread over it.
#pragma once

#include "oracle/ray_oracle.hpp"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace shadowmath::oracle {

struct AreaLight {
    glm::dvec4 centre{0.0, 1.0, 0.0, 0.0};  // (direction toward the light, unit, 0) or (position, 1), world
    glm::dvec3 axis{0.0, 1.0, 0.0};         // the disk is at a right angle to it; of a sun its direction
    double radius = 0.0;                    // metres; of a sun the tangent of its angular radius
};

// The k-th of `count` points spread evenly over the disk (golden angle), as RayOracle takes lights.
[[nodiscard]] glm::dvec4 point_of(AreaLight const& light, int k, int count);

// 0 to 1. Each ray stands for 1 / rays of the light; one that ends behind the surface sees nothing.
[[nodiscard]] double lit_share(RayOracle const& oracle, glm::dvec3 point, glm::dvec3 normal, AreaLight const& light,
                               int rays = 256);

}  // namespace shadowmath::oracle
