// SPDX-License-Identifier: MIT
//
// A quadrilateral as its four corners: made around pixels, and moved at random. What attainable.cpp anneals.
#pragma once

#include "examples/quality/light_pixels.hpp"

#include <array>
#include <cstddef>
#include <random>
#include <vector>

namespace shadowmath::quality {

using Corners = std::array<glm::dvec2, 4>;  // left bottom, right bottom, left top, right top
using Random = std::mt19937_64;

// The same numbers from every library, unlike std::uniform_real_distribution.
[[nodiscard]] double uniform(Random& random);
[[nodiscard]] double normal(Random& random);

// A pixel that stands for `weight` of them; one of weight 0 has to be held, and no more.
struct Sample {
    LightPixel pixel;
    double weight = 1.0;
};

// Of any warp and any shear.
[[nodiscard]] Quad<double> quad_through(Corners const& corners);

// The quadrilateral of least price around some samples, among sixteen rectangles.
[[nodiscard]] Corners rectangle_around(std::vector<Sample> const& samples, std::vector<std::size_t> const& which,
                                       double usable_texels);

// One corner, one side, or all of it; `step` is the size of the move, as a share of the sides.
[[nodiscard]] Corners moved_at_random(Corners const& corners, double step, Random& random);

}  // namespace shadowmath::quality
