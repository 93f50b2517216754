// SPDX-License-Identifier: MIT
//
// What a view would look like with perfect hard shadows, and which of its pixels a technique can be judged by.
// Found once for each view: every technique and backend is held against the same answer.
#pragma once

#include "backends/backend.hpp"
#include "oracle/edge_mask.hpp"
#include "oracle/ray_oracle.hpp"
#include "scenes/view.hpp"

namespace shadowmath::gallery {

enum class Question : std::uint8_t {
    none,       // sky, a surface turned away from the light, or one outside the spot light's cone
    beyond,     // farther than shadows are drawn
    near_edge,  // the true border between light and shadow passes within a pixel or so: both answers are right
    off_edge    // only one answer is
};

struct ViewTruth {
    backend::Image<oracle::Truth> state;
    backend::Image<Question> question;
    backend::Image<backend::Texel4> position;  // of the G-buffer that was judged
    backend::Image<backend::Rgba8> picture;    // shaded as the backends shade, the light cut by ray tracing
};

// Draws the G-buffer on the backend, which has the oracle's scene uploaded, at one and at four samples a pixel.
[[nodiscard]] ViewTruth true_view(backend::Backend& backend, oracle::RayOracle const& oracle, scenes::View const& view,
                                  backend::Extent extent);

}  // namespace shadowmath::gallery
