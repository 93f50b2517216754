// SPDX-License-Identifier: MIT
//
// Whether the maps that a backend fits itself, and draws and reads without a look by the CPU, are those that the C++
// makes of the depth that it saw: matrix by matrix, map by map, picture by picture, counted.
#pragma once

#include "examples/gallery/parity.hpp"
#include "examples/gallery/techniques.hpp"

#include <span>
#include <string>

namespace shadowmath::gallery {

// Over every picture of a scene.
struct FitRecord {
    std::string scene, backend;
    int pictures = 0;
    int maps = 0;
    int unlike_maps = 0;     // with a bit of the matrix or of a range that is not the C++'s
    long texels = 0;         // of the maps
    long unlike_texels = 0;  // of another depth than the map drawn with the C++'s matrix
    long pixels = 0;         // of the pictures
    long unlike_pixels = 0;  // of another colour: biases agree to some ulp only, and that may turn a comparison
};

// Adds one picture: what the device fitted and drew with it, and what the C++ made of the same depth and drew.
void compare(FitRecord& record, std::span<backend::MapConstants const> fitted, Drawn const& on_device,
             MapSet const& cpp, Drawn const& from_cpp);

}  // namespace shadowmath::gallery
