// SPDX-License-Identifier: MIT
//
// Every technique that the gallery shows, as one function: view, light and bounds in, maps out. The only place where
// the gallery meets the mathematics; what comes out are matrices and the constants of the receiver shader.
#pragma once

#include "backends/backend.hpp"
#include "scenes/view.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/choose.hpp>

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace shadowmath::gallery {

struct Technique {
    std::string id;      // "uniform-1", "cascades-4-stable", "vdsm": a file-name-safe word, unique
    std::string title;   // a few words for people
    std::string source;  // "GPU Gems 3 ch. 10", "thesis 2002", ...
    int map_size = 1024;
    int maps = 1;  // at most; the maps of a view may be fewer
    bool serves_spots = false;
    bool fits_to_samples = false;  // needs the eye's depth
};

// In the order in which the gallery shows them; quick runs take a few that span the field.
[[nodiscard]] std::vector<Technique> techniques(bool quick);

struct Map {
    glm::dmat4 clip_from_world{1.0};     // what footprints are measured with
    std::vector<std::uint32_t> casters;  // objects of the scene to draw into it
};

struct MapSet {
    std::vector<Map> maps;          // empty: nothing to shadow, everything lit
    backend::FrameConstants frame;  // complete, but for clip_from_world and eye, which are set as well
    int map_size = 1024;
    std::vector<double> splits;  // eye depths of the split planes, metres; empty where there are none
    std::string note;            // what the library had to say: faults in words, fallbacks taken

    // Not empty: the backend makes the maps itself, from the eye's depth and these constants of sdsm_passes.hpp. The
    // others above are then what the C++ makes of the same depth: what the maps should be.
    std::vector<std::byte> device_fit;
    glm::mat4 eye_depth_from_world{1.0f};
};

// Draws the depth that techniques which fit to samples need.
[[nodiscard]] backend::FitPass eye_depth_pass(scenes::View const& view, backend::Extent extent);

// The eye's matrix and the light of the view, with no map: what the G-buffer and the fully lit picture are drawn with.
[[nodiscard]] backend::FrameConstants unshadowed(scenes::View const& view, backend::Extent extent);

[[nodiscard]] MapSet fit(Technique const& technique, backend::Scene const& scene, scenes::View const& view,
                         backend::Extent extent, backend::Image<float> const& eye_depth = {});

// Cascades under way: `last` are those of the frame before, and become this frame's. The gallery sets the options that
// its passes ask for.
[[nodiscard]] MapSet fit_cascade_maps(backend::Scene const& scene, scenes::View const& view, backend::Extent extent,
                                      CascadeOptions<double> options, Cascades<double>& last);

// The options that choose.hpp finds for what is seen of a view.
[[nodiscard]] CascadeOptions<double> choose_cascades(backend::Scene const& scene, scenes::View const& view,
                                                     backend::Extent extent,
                                                     std::span<SurfacePoint<double> const> samples,
                                                     CascadeOptions<double> const& options,
                                                     ChoiceLimits<double> const& limits);

// Objects of the scene that show in each split of a view, by index, and last those beyond the last split.
using SplitObjects = std::vector<std::vector<std::uint32_t>>;

[[nodiscard]] SplitObjects objects_in_splits(MapSet const& set, backend::Scene const& scene, scenes::View const& view,
                                             backend::Extent extent);

// Kernel width of the receiver pass that all techniques share: 0, 1 or 2.
inline constexpr int filter_radius = 1;

}  // namespace shadowmath::gallery
