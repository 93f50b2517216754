// SPDX-License-Identifier: MIT
//
// Exact and soft shadows where they matter, close to the eye: PCF, PCSS, the exact mask and HFTS against rays, and what
// each grid makes of the exact one's lists.
#pragma once

#include "backends/backend.hpp"
#include "examples/gallery/settings.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace shadowmath::gallery {

struct CloseUpTechnique {
    std::string id;  // "pcf", "exact", "pcss", "hfts": of its pictures
    std::string title;
    std::string truth;               // "hard" or "soft": what its difference picture is against
    long wrong_off_edge = 0;         // pixels on the wrong side of one half, of off_edge_pixels, against the hard truth
    double wrong_samples_ppm = 0.0;  // of the 32 a pixel, millionths; the exact technique's alone
    double error_hard = 0.0;         // mean of |visibility - share of the samples that are lit|, over asked_pixels
    double error = 0.0;              // mean of |visibility - truth| against the area light, over asked_pixels
    double error_in_penumbra = 0.0;  // over those that see a part of the light
    double ms = 0.0;                 // on one thread of the CPU; its maps come on top
    double bytes_per_pixel = 0.0;    // of what it keeps: maps, or the irregular buffer
};

struct CloseUpGrid {
    std::string name, title;
    double mean_list = 0.0, nodes_per_pixel = 0.0;
    long longest_list = 0;
    double ms_list = 0.0, ms_trace = 0.0;
    long unlike_masks = 0;  // pixels whose mask is not that of the first grid
    std::string note;
};

struct CloseUp {
    std::string name, title;
    int width = 0, height = 0;
    long triangles = 0;
    long asked_pixels = 0;     // a surface that faces the light, within the shadow distance
    long off_edge_pixels = 0;  // of those, clear of every true hard edge
    long penumbra_pixels = 0;  // of those asked, how many see a part of the light
    int light_rays = 0;
    double sun_radius = 0.0, soft_gap = 0.0;
    double ms_maps = 0.0;  // until the driver had drawn them
    std::vector<CloseUpTechnique> techniques;
    std::vector<CloseUpGrid> grids;
};

// Pictures go below folder as images/close-ups/NAME/KIND.png: "hard", "soft", and TECHNIQUE-picture and
// TECHNIQUE-difference for each. `tell` is called with a line for each close-up, and may throw.
[[nodiscard]] std::vector<CloseUp> show_close_ups(Settings const& settings, backend::Backend& backend,
                                                  std::filesystem::path const& folder,
                                                  std::function<void(std::string const&)> const& tell);

}  // namespace shadowmath::gallery
