// SPDX-License-Identifier: MIT
//
// The smallest renderer that can draw a shadow map and the picture that reads it: triangles through a matrix, a depth
// buffer, and a function that says what colour a point has. It knows no technique.
//
// Matrices are in the convention of backends/backend.hpp: depth 0 to 1, y up, row 0 at the bottom.
#pragma once

#include "backends/backend.hpp"
#include "examples/support/village.hpp"

#include <shadowmath/shadow_map.hpp>

#include <glm/mat4x4.hpp>

#include <array>
#include <functional>
#include <span>

namespace shadowmath::example {

// A map and the depths that were drawn with it.
struct DepthMap {
    ShadowMap<float> map;
    int size = 0;
    std::vector<float> depth;  // row by row, 1 where nothing is

    [[nodiscard]] float operator()(int x, int y) const {
        return depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)];
    }
};

// `clamp_depth`: what is nearer than the near end is drawn flat at 0 instead of being cut.
[[nodiscard]] DepthMap draw_depths(ShadowMap<float> const& map, int size, std::span<Triangle const> triangles,
                                   bool clamp_depth = false);

// What a pixel sees.
struct Surface {
    glm::vec3 point, normal, colour;  // world; the normal on the side of the eye
    float eye_depth = 0.0f;           // metres; 0 where nothing is seen
};

// Row by row from the bottom one, at the centres of pixels.
[[nodiscard]] std::vector<Surface> surfaces_of(ViewVolume<float> const& view, int width, int height,
                                               std::span<Triangle const> triangles);

using Picture = backend::Image<backend::Rgba8>;

// Each pixel is the mean of four; `shade` gives linear colours. Where nothing is seen, sky.
[[nodiscard]] Picture draw_picture(ViewVolume<float> const& view, int width, int height,
                                   std::span<Triangle const> triangles,
                                   std::function<glm::vec3(Surface const&)> const& shade);

// Sun and sky on a matt surface, `visibility` of the sun from 0 to 1, and some haze.
[[nodiscard]] glm::vec3 sunlit(Surface const& surface, glm::vec3 sun_travel, float visibility);

// As a pixel: gamma 2, since a square root is the same on every machine.
[[nodiscard]] backend::Rgba8 encoded(glm::vec3 linear);

// Depths as grey: near the light bright, nothing blue.
[[nodiscard]] Picture picture_of(DepthMap const& map);

// The corners of the map's square in the world, at this depth of it.
[[nodiscard]] std::array<glm::vec3, 4> corners_at(ShadowMap<float> const& map, float depth);

// From 0 to 1, by way of green and yellow: for numbers that are laid over a picture.
[[nodiscard]] glm::vec3 heat(float share);

// Pictures of one height, side by side.
[[nodiscard]] Picture beside(std::span<Picture const> pictures);

// A part of a picture, each of its pixels `zoom` times as large.
[[nodiscard]] Picture enlarged(Picture const& picture, int x, int y, int width, int height, int zoom);

}  // namespace shadowmath::example
