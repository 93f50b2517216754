// SPDX-License-Identifier: MIT
//
// What the study tells of maps beside the pixels that are wrong.
#pragma once

#include "examples/gallery/techniques.hpp"
#include "examples/gallery/truth.hpp"
#include "scenes/view.hpp"

namespace shadowmath::quality {

// A footprint is perspective aliasing times cos(eye, normal) / cos(light, normal). The first factor is what maps decide
// (Wimmer et al. 2004); the second is the surface's own, and without bound where the light grazes it.
inline constexpr double lost_pixels = 30.0;  // a texel of so many has lost the shadow (price_of)

struct MapFigures {
    double footprint_median = 0.0;                         // eye pixels a texel, both factors
    double perspective_mean = 0.0, perspective_p95 = 0.0;  // the first alone: on surfaces that lean as far from the eye
                                                           // as from the light
    double capped_mean = 0.0;                              // of both factors, no pixel counting more than lost_pixels
    double texels_most = 0.0;  // share of texels that so many pixels would read if no two of them shared any
    double texels_seen = 0.0;  // share of texels that the filter would read for points all over the pixels, not at
                               // their centres alone: what a picture of any number of pixels would read
};

[[nodiscard]] MapFigures map_figures(gallery::ViewTruth const& truth, gallery::MapSet const& maps,
                                     backend::Frame const& frame, scenes::View const& view);

}  // namespace shadowmath::quality
