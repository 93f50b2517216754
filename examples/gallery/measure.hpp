// SPDX-License-Identifier: MIT
//
// One picture against the truth, pixel by pixel: where it is wrong, how large its texels look, how much of its maps
// anyone reads.
#pragma once

#include "examples/gallery/record.hpp"
#include "examples/gallery/techniques.hpp"
#include "examples/gallery/truth.hpp"

namespace shadowmath::gallery {

enum class Outcome : std::uint8_t {
    unasked,  // sky, or a surface that does not face the light
    beyond,   // farther than shadows are drawn
    right,
    edge_shadow,  // in shadow where the truth is light, within a pixel or so of a true edge
    edge_light,   // in light where the truth is shadow, there
    false_shadow,
    false_light
};

struct Measurement {
    Record record;  // the figures; names and times are the caller's to fill in
    backend::Image<Outcome> outcome;
    backend::Image<float> footprint;                    // eye pixels along a texel's longer axis; 0 where no map serves
    std::vector<backend::Image<std::uint8_t>> touched;  // a map each: 1 where a pixel's lookup reads the texel
};

// A pixel is mis-shadowed when (visibility >= 1/2) is not what ray tracing says; frame has the extent of the truth.
[[nodiscard]] Measurement measure(ViewTruth const& truth, MapSet const& maps, backend::Frame const& frame);

// Pixels that differ in colour; all of the larger where the extents do.
[[nodiscard]] long unlike_pixels(backend::Image<backend::Rgba8> const& a, backend::Image<backend::Rgba8> const& b);

// Their share.
[[nodiscard]] double unlike_fraction(backend::Image<backend::Rgba8> const& a, backend::Image<backend::Rgba8> const& b);

}  // namespace shadowmath::gallery
