// SPDX-License-Identifier: MIT
//
// Which of the engine's maps serves a point, as the engine's shader finds it; and why none does.
#pragma once

#include "examples/doctor/sight.hpp"

#include <shadowmath/shadow_map.hpp>

namespace shadowmath::doctor {

enum class Served {
    yes,
    between,   // its depth is in no map's range, though within the shadow distance
    outside,   // beyond the sides of the map that its depth chooses; of every map where maps are tried in turn
    past_end,  // within the sides, beyond the far plane
    behind     // w <= 0
};

struct Place {
    Served served = Served::outside;
    int map = -1;  // the one chosen, also where it does not hold the point; -1: none was
};

// The engine's matrix with its convention.
[[nodiscard]] ShadowMap<double> map_of(EngineMap const& map, ClipSpace clip);

// Place in the map: x and y in [0, 1] between its sides, z in [0, 1] from its near to its far end.
struct Inside {
    glm::dvec3 at{0.0};
    bool in_front = false;
};
[[nodiscard]] Inside inside(ShadowMap<double> const& map, glm::dvec3 point);

// Half a texel beyond the sides still counts as inside, for the rounding of points on the map's very side.
[[nodiscard]] Place place_of(Case const& read, Frame const& frame, std::vector<ShadowMap<double>> const& maps,
                             glm::dvec3 point, double eye_depth);

}  // namespace shadowmath::doctor
