// SPDX-License-Identifier: MIT
//
// The study in words: one table, a JSON document, and a page.
#pragma once

#include "examples/quality/study.hpp"

#include <string>

namespace shadowmath::quality {

[[nodiscard]] std::string table(Results const& results);
[[nodiscard]] std::string results_json(Settings const& settings, Results const& results);
[[nodiscard]] std::string page(Settings const& settings, Results const& results);

}  // namespace shadowmath::quality
