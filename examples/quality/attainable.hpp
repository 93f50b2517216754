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

#include "examples/gallery/techniques.hpp"
#include "scenes/view.hpp"

#include <shadowmath/judge.hpp>
#include <shadowmath/quad_map.hpp>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace shadowmath::quality {

// A pixel as the light sees it: nothing of it is clamped, unlike the samples of the library's own search.
struct LightPixel {
    glm::dvec2 place{0.0};                // metres of the light's plane, from the eye
    glm::dvec2 gain_x{0.0}, gain_y{0.0};  // eye pixels for a metre of the plane along its axes, on the surface
    glm::dvec3 seen{0.0};                 // side x, side y, eye depth
};

// Of every pixel that faces the light within the shadow distance.
[[nodiscard]] std::vector<LightPixel> light_pixels(std::vector<SurfacePoint<double>> const& surfaces,
                                                   scenes::View const& view, backend::Extent extent);

// The quadrilateral that a sun's map serves with its middle `share` of texels along a side.
[[nodiscard]] Quad<double> quad_of(glm::dmat4 const& clip_from_world, scenes::View const& view, double share);

enum class Aim : std::uint8_t {
    mean,         // of the footprints
    p95,          // their 95th percentile
    fewest_wrong  // the mean of price_of
};

struct Found {
    std::vector<Quad<double>> maps;  // finest first
    double mean = 0.0, p95 = 0.0;    // eye pixels a texel, over all pixels; those in no map are left out
    double price = 0.0;
    double unmapped = 0.0;  // share of pixels
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
