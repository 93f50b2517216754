// SPDX-License-Identifier: MIT
//
// What the examples shadow: a dozen houses, trees and a fence on a meadow. Some hundred triangles, the same every time.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/view_volume.hpp>

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace shadowmath::example {

struct Triangle {
    std::array<glm::vec3, 3> at;
    glm::vec3 normal;  // unit, the way its corners turn counter-clockwise
    glm::vec3 colour;  // linear
};

struct Village {
    std::vector<Triangle> triangles;
    std::vector<Aabb<float>> objects;  // of each house, tree and post
    Aabb<float> casters;               // around all of them
    Aabb<float> receivers;             // and the meadow
};

[[nodiscard]] Village village();

// From the path at the edge of the village, a picture of 16 to 9.
[[nodiscard]] ViewVolume<float> village_view(float z_far = 120.0f);

// The tops of boxes, two grey triangles each: for scenes that a few boards make.
[[nodiscard]] std::vector<Triangle> boards(std::vector<Aabb<float>> const& boxes);

inline constexpr glm::vec3 afternoon_sun{-0.55f, -0.6f, -0.42f};  // the way it travels

}  // namespace shadowmath::example
