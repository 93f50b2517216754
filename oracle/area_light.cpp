// SPDX-License-Identifier: MIT
#include "oracle/area_light.hpp"

#include <glm/geometric.hpp>

#include <cmath>

namespace shadowmath::oracle {

glm::dvec4 point_of(AreaLight const& light, int k, int count) {
    constexpr double golden_angle = 2.39996322972865332;
    glm::dvec3 const n = glm::normalize(light.axis);
    glm::dvec3 const aside = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    glm::dvec3 const s = glm::normalize(glm::cross(n, aside)), t = glm::cross(n, s);
    double const reach = light.radius * std::sqrt((k + 0.5) / count), angle = golden_angle * k;
    return light.centre + glm::dvec4(s * (reach * std::cos(angle)) + t * (reach * std::sin(angle)), 0.0);
}

double lit_share(RayOracle const& oracle, glm::dvec3 point, glm::dvec3 normal, AreaLight const& light, int rays) {
    int lit = 0;
    for (int k = 0; k < rays; ++k) lit += oracle.lit(point, normal, point_of(light, k, rays)) ? 1 : 0;
    return rays > 0 ? static_cast<double>(lit) / rays : 1.0;
}

}  // namespace shadowmath::oracle
