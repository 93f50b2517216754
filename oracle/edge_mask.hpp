// SPDX-License-Identifier: MIT
//
// Which pixels a shadow picture may be judged on. Where the border between light and dark passes through a pixel,
// both answers are right; away from it only one is. The border is looked for on a grid of 2x2 samples a pixel.
#pragma once

#include "oracle/ray_oracle.hpp"

namespace shadowmath::oracle {

enum class Judge : std::uint8_t {
    off_edge,  // no sample around the pixel's centre disagrees with it: a picture must agree
    edge,      // one does: a picture may say either
    sky        // nothing is there
};

// Dark is shadowed or facing away; sky samples count for neither side.
// centres: the truth at the pixel centres. samples: the truth on the grid of twice the width and height.
// Samples within radius_pixels of the pixel's centre are asked; those outside the picture do not exist.
// Where the extents do not fit together every pixel is edge: nothing can be judged.
[[nodiscard]] backend::Image<Judge> edge_mask(backend::Image<Truth> const& centres,
                                              backend::Image<Truth> const& samples, double radius_pixels = 1.25);

}  // namespace shadowmath::oracle
