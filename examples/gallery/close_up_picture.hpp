// SPDX-License-Identifier: MIT
//
// A close-up as its eye sees it, before any shadow: the surfaces behind its pixels, and its colours with and without
// the light.
#pragma once

#include "backends/backend.hpp"
#include "examples/gallery/close_up_scenes.hpp"

#include <shadowmath/irregular/microquad.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/view_volume.hpp>

#include <cstdint>
#include <vector>

namespace shadowmath::gallery {

struct CloseUpPicture {
    backend::Extent extent;
    ViewVolume<double> view;  // up to the shadow distance
    Light<double> light;
    PixelFrame<float> frame;
    std::vector<glm::vec3> point;   // world
    std::vector<glm::vec3> normal;  // of the surface; 0 where there is none: sky, and what lies beyond the shadows
    std::vector<float> depth;       // metres along the view's forward axis
    backend::Image<backend::Rgba8> in_light, in_dark;

    [[nodiscard]] std::size_t size() const { return point.size(); }
    [[nodiscard]] bool shows(std::size_t pixel) const { return normal[pixel] != glm::vec3(0.0f); }
    [[nodiscard]] bool faces_light(std::size_t pixel) const {
        return glm::dot(glm::dvec3(normal[pixel]), light.direction) < -1e-3;
    }
};

// Draws on the backend, which has the scene uploaded.
[[nodiscard]] CloseUpPicture close_up_picture(backend::Backend& backend, scenes::View const& view,
                                              backend::Extent extent);

// As the receiver shader shades it, the light cut to `visibility`; one value a pixel, 0 to 1.
[[nodiscard]] backend::Image<backend::Rgba8> shaded(CloseUpPicture const& picture,
                                                    std::vector<float> const& visibility);

// The truth in grey; red where the answer is too dark, blue where it is too light.
[[nodiscard]] backend::Image<backend::Rgba8> visibility_difference(CloseUpPicture const& picture,
                                                                   std::vector<float> const& truth,
                                                                   std::vector<float> const& answer);

}  // namespace shadowmath::gallery
