// SPDX-License-Identifier: MIT
//
// What the camera sees of the scene, and what stands between that and the light: traced rays, or points spread through
// the view where the case has no scene.
#pragma once

#include "backends/scene.hpp"
#include "examples/doctor/case.hpp"

#include <span>

namespace shadowmath::doctor {

struct Seen {
    int pixel = 0;  // of the sight's extent, row by row from the bottom
    glm::dvec3 point{0.0};
    glm::dvec3 normal{0.0};  // unit, toward the eye
    double eye_depth = 0.0;  // metres
    bool faces_light = false;
    bool dark = false;         // it faces the light, and something stands in the way
    std::size_t blockers = 0;  // what stands there: first_blocker and so many more of Sight::blockers
    std::size_t first_blocker = 0;
};

struct Sight {
    backend::Extent extent;
    bool traced = false;  // false: there is no scene, and points lie where nothing is known to be
    std::vector<Seen> points;
    std::vector<double> blockers;  // metres from a point toward the light, the nearest to the point first

    [[nodiscard]] std::span<double const> blockers_of(Seen const& seen) const {
        return std::span(blockers).subspan(seen.first_blocker, seen.blockers);
    }
};

// The case's OBJ file and boxes as one scene. Throws std::runtime_error "FILE: what".
[[nodiscard]] backend::Scene scene_of(Case const& read);

// Points of the first frame that its light can reach, up to the shadow distance; `width` rays a row.
[[nodiscard]] Sight look(Case const& read, backend::Scene const& scene, int width);

}  // namespace shadowmath::doctor
