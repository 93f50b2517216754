// SPDX-License-Identifier: MIT
//
// What the source documents claim, measured: a claim that does not hold is reported so, with the reason found.
#pragma once

#include "backends/backend.hpp"

#include <string>
#include <vector>

namespace shadowmath::gallery {

struct Claim {
    std::string id;         // "000-near-footprint"
    std::string source;     // "GPU Gems 3 ch. 10.1"
    std::string statement;  // the claim in one sentence
    std::string measured;   // the figures, in words with units
    bool holds = false;
    std::string reason;  // why not, when it does not hold; what it depends on, when it does
};

// Renders what it needs on the given backend; a minute at most, some seconds when `quick`.
[[nodiscard]] std::vector<Claim> measure_claims(backend::Backend& backend, bool quick);

}  // namespace shadowmath::gallery
