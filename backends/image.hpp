// SPDX-License-Identifier: MIT
//
// A picture as plain data. Row 0 is the row of NDC y = -1 (the bottom row), in every backend;
// whoever writes a file turns it over once.
#pragma once

#include <cstddef>
#include <vector>

namespace shadowmath::backend {

struct Extent {
    int width = 0;
    int height = 0;
};

template <class Pixel>
struct Image {
    Extent extent;
    std::vector<Pixel> pixels;  // row by row, extent.width * extent.height of them

    Image() = default;
    Image(Extent e, Pixel const& fill = Pixel{})
        : extent(e), pixels(static_cast<std::size_t>(e.width) * static_cast<std::size_t>(e.height), fill) {}

    [[nodiscard]] Pixel& at(int x, int y) { return pixels[index(x, y)]; }
    [[nodiscard]] Pixel const& at(int x, int y) const { return pixels[index(x, y)]; }

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(extent.width) + static_cast<std::size_t>(x);
    }
};

}  // namespace shadowmath::backend
