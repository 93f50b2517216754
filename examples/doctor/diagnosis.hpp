// SPDX-License-Identifier: MIT
//
// What is wrong with an engine's maps: pure functions on the case and on what its camera sees.
#pragma once

#include "examples/doctor/look_up.hpp"

#include <string>
#include <vector>

namespace shadowmath::doctor {

enum class Ill {
    singular,       // the matrix maps everything onto a plane
    transposed,     // rows and columns are exchanged
    other_light,    // a map, but of another light
    backwards,      // depth falls along the light
    wrong_clip,     // made for another order of depth than the case states
    same_matrix,    // two maps with one matrix
    ranges,         // a depth that no map's range holds
    uncovered,      // points outside the map that should serve them
    past_far_end,   // points beyond its far plane
    casters_cut,    // casters beyond its near plane
    filter_margin,  // kernels that read beyond the map's side
    texels_wasted,
    depth_coarse,
    precision,  // coordinates too large for float matrices to keep texels still
    shimmer,
    bias_small,
    bias_large
};

// A word for it that stays the same: what tests and scripts look for.
[[nodiscard]] char const* id(Ill ill);

struct Finding {
    Ill ill;
    int map = -1;       // -1: of all maps together
    bool fault = true;  // false: a remark, which does not count
    std::string what;   // with its figures
    std::string mend;
};

// Percentiles of eye pixels a texel, along its longer side.
struct Footprints {
    double median = 0.0;
    double p95 = 0.0;
    double worst = 0.0;
};

struct MapFigures {
    int points = 0;             // that it serves
    double texel_metres = 0.0;  // across the light, at the median point
    double depth_metres = 0.0;  // from its near to its far end, along the light
    Footprints footprint;
    double used = 0.0;                                // share of the map that any point falls on, in cells of 1/32 side
    double bias_texels = 0.0, bias_metres = 0.0;      // along the light, at the median of lit points
    double needed_texels = 0.0, needed_metres = 0.0;  // so that planes do not shadow themselves
};

struct Diagnosis {
    std::vector<Finding> findings;  // faults first
    std::vector<MapFigures> maps;
    Footprints footprint;        // of all points
    std::vector<Place> places;   // a point of the sight each
    std::vector<bool> lost_cut;  // its shadow is lost because casters are cut off
    std::vector<bool> acne;      // it may shadow itself

    [[nodiscard]] int faults() const;
};

[[nodiscard]] Diagnosis diagnose(Case const& read, Sight const& sight);

}  // namespace shadowmath::doctor
