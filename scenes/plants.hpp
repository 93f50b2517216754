// SPDX-License-Identifier: MIT
//
// Trees and bushes, standing at the origin of the builder's frame. detail 0, 1, 2: tens, hundreds, thousands of
// triangles. The caller ends the object.
#pragma once

#include "scenes/mesh_builder.hpp"

namespace shadowmath::scenes {

void add_broadleaf(MeshBuilder& mesh, Random& random, double height, int detail);  // crown of rounded masses
void add_conifer(MeshBuilder& mesh, Random& random, double height, int detail);    // tiers of jagged skirts
void add_cypress(MeshBuilder& mesh, Random& random, double height, int detail);    // a dark flame
void add_bush(MeshBuilder& mesh, Random& random, double height, int detail);

// Trunk, branches and this many loose leaves, each one quad: light falls through it in dapples.
void add_leafy_tree(MeshBuilder& mesh, Random& random, double height, int leaves, int detail);

// A tuft of arching blades.
void add_fern(MeshBuilder& mesh, Random& random, double height, int blades);

}  // namespace shadowmath::scenes
