// SPDX-License-Identifier: MIT
//
// Laws of sample masks.
#pragma once

#include <shadowmath/irregular/mask.hpp>

#include <cmath>

namespace shadowmath::laws {

// Pixels from the sample to the line; not finite for a half plane without a border.
template <class T>
[[nodiscard]] double distance_to(PixelLine<T> const& line, int sample) {
    auto const c = static_cast<double>(line.c), x = static_cast<double>(line.x), y = static_cast<double>(line.y);
    double const value = c + x * pixel_samples<double>.u[sample] + y * pixel_samples<double>.v[sample];
    return std::abs(value) / std::hypot(x, y);
}

// Two masks differ only in samples within `reach` pixels of the line.
template <class T>
[[nodiscard]] bool differ_only_near(PixelLine<T> const& line, std::uint32_t a, std::uint32_t b, double reach) {
    for (int i = 0; i < samples_per_pixel; ++i)
        if (((a ^ b) >> i & 1u) != 0 && !(distance_to(line, i) <= reach)) return false;
    return true;
}

}  // namespace shadowmath::laws
