// SPDX-License-Identifier: MIT
//
// Whether a backend draws what the first one draws, map by map and picture by picture, counted.
#pragma once

#include "backends/backend.hpp"

#include <string>
#include <vector>

namespace shadowmath::gallery {

// What one backend made of one technique in one view.
struct Drawn {
    backend::Image<backend::Rgba8> picture;
    std::vector<backend::Image<float>> maps;
};

// Over every picture of a scene.
struct Parity {
    std::string scene, backend;
    int pictures = 0;
    int maps = 0;
    long covered_texels = 0;    // that hold a caster in the first backend's maps
    long covered_in_one = 0;    // that hold one in either's alone
    long unlike_texels = 0;     // that both cover, at another depth
    long largest_ulp = 0;       // between these depths
    long pixels = 0;            // of the pictures
    long unlike_pixels = 0;     // of another colour, be it by one of 255
    long unlike_off_edges = 0;  // of these, clear of every outline and shadow border of the first backend's picture
};

// Adds one technique in one view. Throws std::invalid_argument where the two are not of one size.
void compare(Parity& parity, Drawn const& first, Drawn const& other);

// The largest difference of a channel, of 255.
[[nodiscard]] int difference(backend::Rgba8 a, backend::Rgba8 b);

// An outline or the border of a shadow runs through the pixel or touches it: shading alone changes less from a pixel
// to the next.
[[nodiscard]] bool is_edge(backend::Image<backend::Rgba8> const& picture, int x, int y);

}  // namespace shadowmath::gallery
