// SPDX-License-Identifier: MIT
//
// Pixels put into clusters, by features whose weights are drawn at random: where a search for maps may start.
#pragma once

#include "examples/quality/quad_corners.hpp"

namespace shadowmath::quality {

// For each sample the number of its part, from 0 to parts - 1. A part may be empty.
[[nodiscard]] std::vector<std::size_t> drawn_partition(std::vector<Sample> const& samples, std::size_t parts,
                                                       Random& random);

}  // namespace shadowmath::quality
