// SPDX-License-Identifier: MIT
//
// The study: every view through every policy, drawn, and held against ray-traced truth pixel by pixel.
#pragma once

#include "examples/quality/figures.hpp"
#include "examples/quality/policies.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace shadowmath::quality {

struct Settings {
    std::filesystem::path models;  // a folder of OBJ files; need not be there
    std::filesystem::path out = "out/quality";
    std::filesystem::path truth;  // a folder to keep traced truths in between runs; empty: none
    backend::Extent extent{960, 540};
    std::vector<std::string> only_policies;  // empty: all
    std::vector<std::string> only_views;     // parts of "scene/view"; empty: all
    std::optional<std::uint64_t> fresh;      // a seed: views drawn by a rule (fresh_views.hpp), not those of the study
    int search_steps = 0;                    // of a search for what could be had (attainable.hpp); 0: none
    std::string backend = "egl";
    bool pictures = true;
};

// One picture.
struct Score {
    std::string policy;
    double wrong = 0.0;  // share of off-edge pixels on the wrong side of the light
    long off_edge_pixels = 0;
    double footprint_mean = 0.0, footprint_p95 = 0.0;  // eye pixels a texel
    double texels_used = 0.0;                          // share that the filter reads for the pixels' centres
    MapFigures figures;
    long dark_unmapped = 0;  // pixels in no map, and so drawn lit, that are dark in truth
    int maps = 0;
    double fit_milliseconds = 0.0;
    std::string note;
};

// The best that a long search has found, each figure sought for its own sake.
struct Attainable {
    double footprint_mean = 0.0, footprint_p95 = 0.0;
};

struct ViewResult {
    std::string scene, view;
    double shadow_distance = 0.0;
    std::vector<Score> scores;                                  // in the order of the policies
    std::vector<std::pair<std::string, std::string>> pictures;  // policy, file
    std::optional<Attainable> attainable{};
};

struct Results {
    std::vector<Policy> policies;
    std::vector<ViewResult> views;
    std::vector<std::string> absent;  // what was not there to be studied
    std::string driver;
};

[[nodiscard]] Results run_study(Settings const& settings, std::filesystem::path const& folder,
                                std::function<void(std::string const&)> const& tell);

// One policy over all views.
struct Summary {
    Policy policy;
    double mean = 0.0, geometric_mean = 0.0, worst = 0.0;  // of wrong; geometric: nothing wrong counts half a pixel
    std::string worst_view;
    double of_best_folk = 0.0;                         // mean over the least mean of a folk recipe
    double footprint_mean = 0.0, footprint_p95 = 0.0;  // mean of both over the views
    double texels_used = 0.0;
    MapFigures figures;                                              // means over the views
    double footprint_mean_median = 0.0, footprint_p95_median = 0.0;  // of the views, not their mean
    double not_worse = 0.0;           // share of views in which it is not worse than the folk recipe of the least mean
    double not_worse_than_any = 0.0;  // and than the best folk recipe of each view
    long dark_unmapped = 0;
    double fit_milliseconds = 0.0;  // mean
};

[[nodiscard]] std::vector<Summary> summaries(Results const& results);

}  // namespace shadowmath::quality
