// SPDX-License-Identifier: MIT
//
// Every way to draw the maps of parallel splits, on one view: what each hands over and takes, and whether its maps are
// those of one pass a map.
#pragma once

#include "backends/backend.hpp"
#include "examples/gallery/techniques.hpp"

#include <string>
#include <vector>

namespace shadowmath::gallery {

struct WayRecord {
    std::string scene, view, backend;  // the caller's to fill in
    std::string way;
    bool with_picture = false;  // the receivers are drawn too: split by split knows no maps without them
    int map_size = 0;           // texels along a side
    int maps = 0;
    int maps_in_memory = 0;  // at once
    backend::DrawWork work;  // of the fastest run

    // Against the first way of its kind on the same backend: maps against maps, picture against picture.
    long texels = 0, unlike_texels = 0;
    double largest_difference = 0.0;  // of depth, [0, 1]
    long pixels = 0, unlike_pixels = 0;
};

// The ways that the backend has, one pass a map first; then, with the picture, all maps at once and split by split.
// Nothing where the set has no map. The maps are chosen by depth and not blended, for split by split can do no other.
// The scene of the maps must be there.
[[nodiscard]] std::vector<WayRecord> measure_ways(backend::Backend& backend, MapSet const& set,
                                                  SplitObjects const& shown, backend::Extent extent, int runs);

}  // namespace shadowmath::gallery
