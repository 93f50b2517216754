// SPDX-License-Identifier: MIT
//
// The table of times on the gallery page, from what scripts/bench wrote; or how to make it, where it has not been run.
#pragma once

#include <filesystem>
#include <string>

namespace shadowmath::gallery {

// HTML. `ratios` is a ratios.json, or no file at all. Throws where it is a file that cannot be read as one.
[[nodiscard]] std::string speed_table(std::filesystem::path const& ratios);

}  // namespace shadowmath::gallery
