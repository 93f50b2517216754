// SPDX-License-Identifier: MIT
//
// What could be had at all: four free homographies, searched for on the picture itself for as long as one likes. No fit
// for use, but a bound to hold fits against: what it does not find is hardly to be found by a fit in milliseconds.
//
// A sun's map is a homography of the light's plane (light_samples.hpp), so four of them are sixteen corners. The search
// anneals these: from partitions drawn at random (clusters of pixels by place, depth and lean of the surface) and from
// maps that somebody else has made. Every pixel of the sample stays inside a map, and is judged in the one that looks
// finest there: no rule of selection does better. Neither bias nor a limit of warp is asked for.
#pragma once

#include "examples/quality/light_pixels.hpp"

#include <cstdint>
#include <vector>

namespace shadowmath::quality {

enum class Aim : std::uint8_t {
    mean,  // of the footprints
    p95    // their 95th percentile
};

struct Found {
    std::vector<Quad<double>> maps;  // finest first
    double mean = 0.0, p95 = 0.0;    // eye pixels a texel, over all pixels; those in no map are left out
    double unmapped = 0.0;           // share of pixels
};

struct SearchEffort {
    int restarts = 6;    // beside one from the given maps
    int steps = 40000;   // of each
    int samples = 3000;  // pixels that it looks at
    std::uint64_t seed = 1;
};

// The given maps are a start, and none need be given.
[[nodiscard]] Found searched(std::vector<LightPixel> const& pixels, std::vector<Quad<double>> const& given, Aim aim,
                             int maps, double usable_texels, SearchEffort const& effort);

// Figures of any maps over all pixels, each in the map that looks finest there.
[[nodiscard]] Found measured(std::vector<LightPixel> const& pixels, std::vector<Quad<double>> const& maps,
                             double usable_texels);

}  // namespace shadowmath::quality
