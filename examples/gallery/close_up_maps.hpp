// SPDX-License-Identifier: MIT
//
// Shadow maps under a close-up: four stable cascades drawn by a backend, and what the library's filters make of them on
// the CPU.
#pragma once

#include "examples/gallery/close_up_picture.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/pcss.hpp>

namespace shadowmath::gallery {

struct CloseUpMaps {
    Cascades<double> cascades;
    std::vector<backend::Image<float>> depth;
    double ms_draw = 0.0;
    int map_size = 0;
};

// The backend has the scene uploaded.
[[nodiscard]] CloseUpMaps close_up_maps(backend::Backend& backend, CloseUpPicture const& picture,
                                        backend::Scene const& scene);

// As the receiver shader: 3 x 3 taps of the first map that holds the point.
[[nodiscard]] std::vector<float> pcf(CloseUpPicture const& picture, CloseUpMaps const& maps);

// One a pixel, from the first map that holds the point.
[[nodiscard]] std::vector<SoftShadow<float>> pcss(CloseUpPicture const& picture, CloseUpMaps const& maps,
                                                  double sun_radius);

// Exact in contact, PCSS where its occluders are `soft_gap` metres away and more; `lit` is the exact share of a pixel.
[[nodiscard]] std::vector<float> hfts(std::vector<float> const& lit, std::vector<SoftShadow<float>> const& soft,
                                      float soft_gap);

}  // namespace shadowmath::gallery
