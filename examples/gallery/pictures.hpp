// SPDX-License-Identifier: MIT
//
// The pictures that explain a picture: where it is wrong, which map served whom, how large a texel looks, and the maps
// themselves.
#pragma once

#include "examples/gallery/measure.hpp"
#include "examples/support/png.hpp"

#include <span>

namespace shadowmath::gallery {

using example::Colour;
using example::IndexedPicture;
using example::write_png;

// The truth in grey; wrong pixels in red (false shadow) and blue (false light), pale ones along true edges.
[[nodiscard]] IndexedPicture difference_picture(backend::Image<backend::Rgba8> const& truth,
                                                backend::Image<Outcome> const& outcome);

// The picture, tinted by the map that each pixel reads; grey where none serves.
[[nodiscard]] IndexedPicture overlay_picture(backend::Frame const& frame);

// Footprints from 1/4 to 16 eye pixels a texel on a logarithmic scale; grey where no map is asked.
[[nodiscard]] IndexedPicture footprint_picture(backend::Frame const& frame, backend::Image<float> const& footprint);

// The maps side by side, bottom row at the bottom: depth as grey, near ones bright, each map with its own contrast.
// Texels that some visible pixel reads keep a warm tone, those drawn for nobody are dim and cold.
[[nodiscard]] IndexedPicture maps_picture(std::span<backend::Image<float> const> depths,
                                          std::span<backend::Image<std::uint8_t> const> touched);

// The colours of the heat map, for its legend: from 1/4 (front) to 16 (back) eye pixels a texel.
[[nodiscard]] std::vector<Colour> footprint_scale(int steps);

// The tint of a map in the overlay.
[[nodiscard]] Colour map_tint(int map);

}  // namespace shadowmath::gallery
