// SPDX-License-Identifier: MIT
//
// The irregular z-buffer over a close-up: which of a pixel's 32 samples are dark, whatever matrix is the grid, and how
// long its lists are with it.
#pragma once

#include "examples/gallery/close_up_picture.hpp"

#include <shadowmath/shadow_map.hpp>

#include <string>
#include <vector>

namespace shadowmath::gallery {

// Maps that share the picture by eye depth: each lists what lies before its end, and before no earlier map's.
struct Grid {
    std::string name;  // "uniform", "cascades", "warp", "vdsm"
    std::string title;
    std::vector<ShadowMap<float>> maps;
    std::vector<float> ends;  // metres of eye depth
};

inline constexpr int grid_size = 64;  // texels along a side

// A uniform map, four cascades, a warp and the view-dependent map.
[[nodiscard]] std::vector<Grid> grids_for(CloseUpPicture const& picture, backend::Scene const& scene);

struct ExactShadows {
    std::vector<std::uint32_t> dark;  // bit i of a pixel: sample i
    double mean_list = 0.0;           // nodes in a list that is not empty; a node is up to sixteen pixels
    std::uint32_t longest_list = 0;
    double nodes_per_pixel = 0.0;
    double bytes_per_pixel = 0.0;  // of the buffer, without the masks
    double ms_list = 0.0, ms_trace = 0.0;
    double contact_reach = 0.0, contact_ray = 0.0;  // as IrregularBuffer has them
    std::string note;                               // faults in words
};

[[nodiscard]] ExactShadows exact_shadows(CloseUpPicture const& picture, backend::Scene const& scene, Grid const& grid);

// Share of a pixel's samples that are lit.
[[nodiscard]] std::vector<float> lit_shares(std::vector<std::uint32_t> const& dark);

}  // namespace shadowmath::gallery
