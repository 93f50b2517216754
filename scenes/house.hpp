// SPDX-License-Identifier: MIT
//
// Houses and a church, in the builder's frame: x along the front, z out of the front door, ground at y = 0, the body
// behind z = 0. Walls go down 1.5 m below the ground, so that slopes leave no gap. The caller ends the object.
#pragma once

#include "scenes/mesh_builder.hpp"

namespace shadowmath::scenes {

struct HousePlan {
    double width = 9.0;  // metres
    double depth = 8.0;
    int storeys = 2;
    bool gable_in_front = false;
    int detail = 1;  // 0: panes; 1: sills, shutters, a dormer; 2: frames and bars
};

void add_house(MeshBuilder& mesh, Random& random, HousePlan const& plan);

// Nave, tower with an open belfry and spire, the cross 48 m above the ground; 14 m wide, 40 m deep.
void add_church(MeshBuilder& mesh, Random& random, int detail);

}  // namespace shadowmath::scenes
