// SPDX-License-Identifier: MIT
//
// PNG files, through libpng. Rows are turned over on the way: row 0 of an image is its bottom row.
#pragma once

#include "backends/backend.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace shadowmath::example {

using Colour = std::array<std::uint8_t, 3>;  // sRGB

// A picture of at most 256 colours: an order of magnitude smaller on disk than one of three channels.
struct IndexedPicture {
    backend::Image<std::uint8_t> indices;  // into the palette
    std::vector<Colour> palette;
};

// Both throw std::runtime_error, one line that starts with the path, when the file cannot be written.
void write_png(std::filesystem::path const& path, backend::Image<backend::Rgba8> const& picture);  // alpha is dropped
void write_png(std::filesystem::path const& path, IndexedPicture const& picture);

}  // namespace shadowmath::example
