// SPDX-License-Identifier: MIT
//
// The orders of the colonnade: columns, balustrades, an urn and an obelisk, in the builder's frame, ground at y = 0.
// The caller sets the colour and ends the object.
#pragma once

#include "scenes/mesh_builder.hpp"

namespace shadowmath::scenes {

// A fluted column on a square plinth under a square slab; lower radius is a ninth of the height.
// standing below 1: only that part of the shaft is left, under a slanting break.
void add_column(MeshBuilder& mesh, Random& random, double height, int detail, double standing = 1.0);

// Turned balusters under a rail between two points on the ground, a pedestal at each end.
void add_balustrade(MeshBuilder& mesh, glm::dvec3 from, glm::dvec3 to, int detail);

void add_urn(MeshBuilder& mesh, double height, int detail);
void add_obelisk(MeshBuilder& mesh, double height);

}  // namespace shadowmath::scenes
