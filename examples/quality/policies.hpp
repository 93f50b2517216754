// SPDX-License-Identifier: MIT
//
// What the study compares: every policy of the library and every folk recipe, each as one function from the same view,
// light, boxes and coarse depth buffer to maps. All get four maps of 1024 texels squared, one bias rule and one filter.
#pragma once

#include "backends/backend.hpp"
#include "examples/gallery/techniques.hpp"
#include "examples/gallery/tile_depths.hpp"
#include "scenes/view.hpp"

#include <shadowmath/bounds.hpp>
#include <shadowmath/judge.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/view_volume.hpp>

#include <string>
#include <vector>

namespace shadowmath::quality {

inline constexpr int map_size = 1024;
inline constexpr int map_count = 4;

enum class Family { folk, library, chosen };

struct Policy {
    std::string id;     // a file-name-safe word
    std::string title;  // for people
    Family family = Family::library;
    bool by_depth = false;    // maps are chosen by eye depth; else the first that holds the point
    bool sees_depth = false;  // is given the coarse depth buffer
};

[[nodiscard]] std::vector<Policy> const& policies();

// A coarse picture of the view: what a renderer reads back, or keeps of its last frame. In each tile the surface in its
// middle, and the depths of the nearest and the farthest one that faces the light: three samples a tile.
struct Coarse {
    explicit Coarse(backend::Extent picture) : depths({120, 68}, picture) {}

    std::vector<SurfacePoint<double>> points;  // within the shadow distance
    gallery::TileDepths depths;                // of the surfaces that face the light
};

[[nodiscard]] Coarse coarse_of(backend::Frame const& frame, scenes::View const& view);

struct Made {
    gallery::MapSet maps;
    double milliseconds = 0.0;  // of the fit alone
};

// `picture`: the extent that footprints are meant for.
[[nodiscard]] Made make_maps(Policy const& policy, backend::Scene const& scene, scenes::View const& view,
                             backend::Extent picture, Coarse const& coarse);

}  // namespace shadowmath::quality
