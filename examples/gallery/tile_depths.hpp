// SPDX-License-Identifier: MIT
//
// What a renderer's depth pyramid holds: the nearest and farthest eye depth in each tile of a picture.
#pragma once

#include "backends/image.hpp"

#include <shadowmath/choose_maps.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace shadowmath::gallery {

class TileDepths {
public:
    TileDepths(backend::Extent tiles, backend::Extent pixels)
        : tiles_(tiles), pixels_(pixels), nearest_(count(), std::numeric_limits<double>::max()),
          farthest_(count(), std::numeric_limits<double>::lowest()) {}

    void add(int x, int y, double depth) {
        int const i = int((x + 0.5) * tiles_.width / pixels_.width);
        int const j = int((y + 0.5) * tiles_.height / pixels_.height);
        auto const tile = std::size_t(j) * std::size_t(tiles_.width) + std::size_t(i);
        nearest_[tile] = std::min(nearest_[tile], depth);
        farthest_[tile] = std::max(farthest_[tile], depth);
    }

    // The pixel in the middle of its tile stands for the tile's surface.
    [[nodiscard]] bool is_middle(int x, int y) const {
        auto const is_middle_of = [](int pixel, int pixels, int tiles) {
            int const tile = int((pixel + 0.5) * tiles / pixels);
            return pixel == int((tile + 0.5) * pixels / tiles);
        };
        return is_middle_of(x, pixels_.width, tiles_.width) && is_middle_of(y, pixels_.height, tiles_.height);
    }

    // Valid as long as this lives.
    [[nodiscard]] DepthTiles<double> tiles() const {
        return {nearest_.data(), farthest_.data(), tiles_.width, tiles_.height};
    }

private:
    [[nodiscard]] std::size_t count() const { return std::size_t(tiles_.width) * std::size_t(tiles_.height); }

    backend::Extent tiles_, pixels_;
    std::vector<double> nearest_, farthest_;
};

}  // namespace shadowmath::gallery
