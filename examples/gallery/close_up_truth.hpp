// SPDX-License-Identifier: MIT
//
// What a close-up looks like by rays: hard, for each of a pixel's 32 samples, and soft, to points all over the sun.
#pragma once

#include "examples/gallery/exact_shadows.hpp"
#include "oracle/ray_oracle.hpp"

namespace shadowmath::gallery {

struct CloseUpTruth {
    std::vector<std::uint32_t> dark;     // bit i: the ray from sample i to the middle of the sun is blocked
    std::vector<float> lit;              // share of the samples that are not
    std::vector<float> soft;             // share of the sun that the pixel sees
    std::vector<std::uint8_t> asked;     // 1: a surface that faces the light, within the shadow distance
    std::vector<std::uint8_t> off_edge;  // 1: asked, and no sample of it or its neighbours disagrees
};

// Hard rays start on the pixel's plane itself, and a hit nearer to a triangle's plane than the exact technique's margin
// of contact is none: the same question is asked of both. Soft rays start off the surface, as RayOracle lifts them, one
// of `rays` at each sample in turn, toward a disk of `sun_radius` (tangent of the angular radius).
[[nodiscard]] CloseUpTruth close_up_truth(CloseUpPicture const& picture, backend::Scene const& scene,
                                          oracle::RayOracle const& oracle, ExactShadows const& margins,
                                          double sun_radius, int rays);

}  // namespace shadowmath::gallery
