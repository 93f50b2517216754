// SPDX-License-Identifier: MIT
//
// A place to look from and a light to look by, as plain numbers: what a scene suggests to whoever renders it.
#pragma once

#include <glm/vec3.hpp>

#include <string>

namespace shadowmath::scenes {

struct View {
    std::string name;                    // a file-name-safe word: "street", "hill", "down", "up"
    glm::dvec3 eye{0.0};                 // world, metres
    glm::dvec3 forward{0.0, 0.0, -1.0};  // viewing direction, unit
    glm::dvec3 up{0.0, 1.0, 0.0};        // rough up, not parallel to forward
    double fov_y_radians = 1.0;
    double z_near = 0.1;                      // metres
    double shadow_distance = 200.0;           // eye depth, metres, up to which shadows are drawn
    glm::dvec3 light_travel{0.0, -1.0, 0.0};  // direction in which the sun's light travels, unit
    bool has_spot = false;                    // when true, the light is the spot below instead of the sun
    glm::dvec3 spot_position{0.0};
    glm::dvec3 spot_axis{0.0, -1.0, 0.0};  // unit
    double spot_half_angle_radians = 0.6;
    double spot_range = 30.0;  // metres
};

}  // namespace shadowmath::scenes
