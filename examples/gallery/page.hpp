// SPDX-License-Identifier: MIT
//
// The gallery page: one HTML file that opens from disk, with its style, script, charts and data inside and its pictures
// beside it.
#pragma once

#include "examples/gallery/run.hpp"

#include <string>

namespace shadowmath::gallery {

// `speed` is HTML (speed.hpp).
[[nodiscard]] std::string page(std::span<Technique const> techniques, Results const& results, std::string const& json,
                               std::string const& speed);

}  // namespace shadowmath::gallery
