// SPDX-License-Identifier: MIT
//
// A shader as programs carry it: embed.cmake writes one such constant for each file.
#pragma once

#include <cstdint>
#include <span>

namespace shadowmath::backend::shaders {

struct Shader {
    char const* text;                      // GLSL
    std::span<std::uint32_t const> spirv;  // the same compiled, entry point main; empty without glslangValidator
};

}  // namespace shadowmath::backend::shaders
