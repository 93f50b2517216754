// SPDX-License-Identifier: MIT
//
// How the scenes say where a view looks and where its sun stands.
#pragma once

#include "scenes/view.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <utility>

namespace shadowmath::scenes {

// The direction in which sunlight travels. The azimuth is where the sun stands, from +x toward +z.
[[nodiscard]] inline glm::dvec3 sun_travel(double elevation_degrees, double azimuth_degrees) {
    double const elevation = glm::radians(elevation_degrees);
    double const azimuth = glm::radians(azimuth_degrees);
    return -glm::dvec3(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                       std::cos(elevation) * std::sin(azimuth));
}

[[nodiscard]] inline View view_toward(std::string name, glm::dvec3 eye, glm::dvec3 target, double fov_y_degrees,
                                      double shadow_distance, glm::dvec3 light_travel) {
    View view;
    view.name = std::move(name);
    view.eye = eye;
    view.forward = glm::normalize(target - eye);
    if (std::abs(view.forward.y) > 0.95) view.up = {0.0, 0.0, -1.0};
    view.fov_y_radians = glm::radians(fov_y_degrees);
    view.shadow_distance = shadow_distance;
    view.light_travel = light_travel;
    return view;
}

}  // namespace shadowmath::scenes
