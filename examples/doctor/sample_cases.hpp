// SPDX-License-Identifier: MIT
//
// The sample cases, made as renderers make their maps: from the recipes that are copied everywhere, in float. One is
// well; each of the others has the fault that its name says.
#pragma once

#include <map>
#include <string>

namespace shadowmath::doctor {

// File name to text: the cases, and the scene that they share.
[[nodiscard]] std::map<std::string, std::string> sample_cases();

}  // namespace shadowmath::doctor
