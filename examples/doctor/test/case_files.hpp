// SPDX-License-Identifier: MIT
//
// The sample cases as they lie in the project.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace shadowmath::doctor {

inline std::filesystem::path const folder = DOCTOR_CASES;

[[nodiscard]] inline std::string text_of(std::filesystem::path const& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

}  // namespace shadowmath::doctor
