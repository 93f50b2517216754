// SPDX-License-Identifier: MIT
//
// The gallery in one JSON document: results.json, and what the page is built from.
#pragma once

#include "examples/gallery/run.hpp"

#include <string>

namespace shadowmath::gallery {

// {"records": [...], "ways": [...], "parity": [...], "fits": [...], "flights": [...], "judged": true, "broken": [...],
//  "claims": [...], "machine": {...}, "settings": {...}, "techniques": [...], "scenes": [...], "palette": {...}}
[[nodiscard]] std::string results_json(Settings const& settings, std::span<scenes::NamedScene const> scenes,
                                       Backends backends, Results const& results);

}  // namespace shadowmath::gallery
