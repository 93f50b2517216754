// SPDX-License-Identifier: MIT
//
// What stands about: the small and thin things that make shadows hard. All in the builder's frame, ground at y = 0,
// sunk a little into it. The caller sets no colour and ends the object.
#pragma once

#include "scenes/mesh_builder.hpp"

namespace shadowmath::scenes {

void add_lamp_post(MeshBuilder& mesh, int detail);              // 4.6 m, the lantern over +z
void add_bollard(MeshBuilder& mesh, int detail);                // 0.9 m
void add_bench(MeshBuilder& mesh);                              // 1.8 m along x
void add_fountain(MeshBuilder& mesh, int detail);               // 8 m across
void add_stall(MeshBuilder& mesh, Random& random, int detail);  // a market stall, 3 m by 2 m, under a striped awning

// Iron railing between two points on the ground: posts, two rails, bars of 16 mm.
void add_railing(MeshBuilder& mesh, glm::dvec3 from, glm::dvec3 to, double bar_spacing_metres, int detail);

// Wooden fence: posts, two rails, pickets where detail > 0.
void add_fence(MeshBuilder& mesh, Random& random, glm::dvec3 from, glm::dvec3 to, int detail);

// A wire that hangs between two points.
void add_wire(MeshBuilder& mesh, glm::dvec3 from, glm::dvec3 to, double sag, double radius, int segments, int sides);

// A wire with small flags in turn of colour.
void add_bunting(MeshBuilder& mesh, glm::dvec3 from, glm::dvec3 to, double sag, int flags);

// A cloth from its staff at x = 0 to x = width, waving along z, hung by its upper corner at the origin.
void add_flag(MeshBuilder& mesh, Random& random, double width, double height, glm::dvec3 first, glm::dvec3 second,
              int detail);

}  // namespace shadowmath::scenes
