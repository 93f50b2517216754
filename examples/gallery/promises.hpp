// SPDX-License-Identifier: MIT
//
// What every run must show, whatever its scenes: drivers that share a rasteriser draw the same maps and pictures, every
// way to draw the maps gives the same maps and processes a triangle once for each map that its object casts into, and
// the device fits the maps that the C++ fits. And stable maps do not crawl.
#pragma once

#include "examples/gallery/run.hpp"

#include <string>
#include <vector>

namespace shadowmath::gallery {

// True where every driver is one of Mesa's software ones. Others may round otherwise: what they do is told, not judged.
[[nodiscard]] bool share_a_rasteriser(Backends backends);

// What did not hold, one sentence each.
[[nodiscard]] std::vector<std::string> broken_promises(Results const& results);

}  // namespace shadowmath::gallery
