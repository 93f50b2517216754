// SPDX-License-Identifier: MIT
//
// The size of a picture as people write it.
#pragma once

#include "backends/image.hpp"

#include <charconv>
#include <string>

namespace shadowmath::gallery {

inline constexpr int longest_side = 4096;

// "960x540", `least` to longest_side a side.
[[nodiscard]] inline bool parse_extent(std::string const& text, int least, backend::Extent& extent) {
    std::size_t const cross = text.find('x');
    if (cross == std::string::npos) return false;
    char const* const middle = text.data() + cross;
    char const* const end = text.data() + text.size();
    auto const width = std::from_chars(text.data(), middle, extent.width);
    auto const height = std::from_chars(middle + 1, end, extent.height);
    auto const fits = [least](int side) { return side >= least && side <= longest_side; };
    return width.ec == std::errc{} && width.ptr == middle && height.ec == std::errc{} && height.ptr == end &&
           fits(extent.width) && fits(extent.height);
}

}  // namespace shadowmath::gallery
