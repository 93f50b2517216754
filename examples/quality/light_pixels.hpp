// SPDX-License-Identifier: MIT
//
// The picture as the light sees it: a place on the light's plane for every pixel, and what a metre there is worth.
#pragma once

#include "backends/image.hpp"
#include "scenes/view.hpp"

#include <shadowmath/judge.hpp>
#include <shadowmath/quad_map.hpp>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <limits>
#include <vector>

namespace shadowmath::quality {

// A pixel as the light sees it: nothing of it is clamped, unlike the samples of the library's own search.
struct LightPixel {
    glm::dvec2 place{0.0};                // metres of the light's plane, from the eye
    glm::dvec2 gain_x{0.0}, gain_y{0.0};  // eye pixels for a metre of the plane along its axes, on the surface
    glm::dvec3 seen{0.0};                 // side x, side y, eye depth
};

// Of surfaces that the eye sees, a pixel each; those that do not face the light are left out.
[[nodiscard]] std::vector<LightPixel> light_pixels(std::vector<SurfacePoint<double>> const& surfaces,
                                                   scenes::View const& view, backend::Extent extent);

// The quadrilateral that a sun's map serves with its middle `share` of texels along a side.
[[nodiscard]] Quad<double> quad_of(glm::dmat4 const& clip_from_world, scenes::View const& view, double share);

inline constexpr double outside = std::numeric_limits<double>::infinity();

// Eye pixels along the longer axis of a texel; `outside` where the quadrilateral does not hold the pixel.
[[nodiscard]] double major_in(Quad<double> const& quad, double usable_texels, LightPixel const& pixel);

}  // namespace shadowmath::quality
