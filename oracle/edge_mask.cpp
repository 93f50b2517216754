// SPDX-License-Identifier: MIT
#include "oracle/edge_mask.hpp"

#include <algorithm>
#include <cmath>

namespace shadowmath::oracle {

namespace {

struct SampleOffset {
    int x, y;  // from sample (2 * pixel.x, 2 * pixel.y)
};

// Sample (2 px + i) sits at (i - 1/2) / 2 pixels from the centre of pixel px.
std::vector<SampleOffset> offsets_within(double radius_pixels) {
    std::vector<SampleOffset> offsets;
    int const reach = static_cast<int>(std::ceil(2.0 * radius_pixels)) + 1;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x)
            if (std::hypot((x - 0.5) / 2.0, (y - 0.5) / 2.0) <= radius_pixels) offsets.push_back({x, y});
    return offsets;
}

}  // namespace

backend::Image<Judge> edge_mask(backend::Image<Truth> const& centres, backend::Image<Truth> const& samples,
                                double radius_pixels) {
    backend::Image<Judge> mask(centres.extent, Judge::edge);
    if (samples.extent.width != 2 * centres.extent.width || samples.extent.height != 2 * centres.extent.height)
        return mask;
    std::vector<SampleOffset> const offsets = offsets_within(radius_pixels);
    for (int y = 0; y < centres.extent.height; ++y) {
        for (int x = 0; x < centres.extent.width; ++x) {
            Truth const own = centres.at(x, y);
            auto const disagrees = [&](SampleOffset o) {
                int const i = 2 * x + o.x;
                int const j = 2 * y + o.y;
                if (i < 0 || j < 0 || i >= samples.extent.width || j >= samples.extent.height) return false;
                Truth const other = samples.at(i, j);
                return other != Truth::sky && (other == Truth::lit) != (own == Truth::lit);
            };
            mask.at(x, y) = own == Truth::sky                         ? Judge::sky
                            : std::ranges::any_of(offsets, disagrees) ? Judge::edge
                                                                      : Judge::off_edge;
        }
    }
    return mask;
}

}  // namespace shadowmath::oracle
