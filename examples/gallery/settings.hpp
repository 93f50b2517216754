// SPDX-License-Identifier: MIT
//
// What the user asked for.
#pragma once

#include "backends/image.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace shadowmath::gallery {

struct Settings {
    std::vector<std::filesystem::path> models;  // OBJ files
    std::vector<std::string> scenes;            // built-in scenes by name
    std::filesystem::path out = "out/gallery";
    std::filesystem::path ratios = "out/bench/ratios.json";  // of scripts/bench; need not be there
    std::string backend = "all";                             // "egl", "osmesa", "vulkan" or "all"
    backend::Extent extent{960, 540};
    std::uint64_t seed = 1;
    bool quick = false;
    bool validate = false;  // Vulkan under its validation layers

    // Of every way to draw the maps: the first one also compiles.
    [[nodiscard]] int way_runs() const { return quick ? 1 : 2; }

    int flight = 0;  // frames; 0: as the run is
    [[nodiscard]] int flight_frames() const { return flight > 0 ? flight : (quick ? 12 : 300); }
    [[nodiscard]] int flight_map_size() const { return quick ? 512 : 1024; }
};

}  // namespace shadowmath::gallery
