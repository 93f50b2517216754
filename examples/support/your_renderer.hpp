// SPDX-License-Identifier: MIT
//
// A renderer of one's own, for the example that brings one: a ray tracer of twenty lines, five balls, a chequered
// floor. It knows neither maps nor shadowmath; only the type of its pixels is that of the PNG files here.
#pragma once

#include "backends/image.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace your_renderer {

using glm::vec2, glm::vec3;

struct Ball {
    vec3 centre;
    float radius;
};
inline constexpr Ball balls[] = {
    {{-2.2f, 1.2f, -7}, 1.0f}, {{1.6f, 0.8f, -9}, 0.8f}, {{-4, 3, -17}, 2}, {{5, 2, -22}, 2}, {{-1, 2.5f, -38}, 2.5f}};

struct Ray {
    vec3 from, way;
};
inline Ray between(vec3 from, vec3 to) {
    return {from, to - from};
}
struct Hit {
    float t = 1.0f;  // of the way; 1 where nothing is
    vec3 normal{0.0f};
    [[nodiscard]] bool on_floor() const { return normal.y == 1.0f; }
};

// What a ray meets first, not farther than its way.
inline Hit first_hit(Ray const& ray) {
    auto const& [from, way] = ray;
    Hit hit;
    if (way.y < 0.0f && -from.y / way.y < 1.0f) hit = {-from.y / way.y, vec3(0, 1, 0)};
    for (Ball const& ball : balls) {
        vec3 const to = from - ball.centre;
        float const a = glm::dot(way, way), b = glm::dot(way, to), c = glm::dot(to, to) - ball.radius * ball.radius;
        float const t = (-b - std::sqrt(std::max(b * b - a * c, 0.0f))) / a;
        if (b * b > a * c && t > 0.0f && t < hit.t) hit = {t, (to + way * t) / ball.radius};
    }
    return hit;
}

// Row by row from the bottom one, what `pixel_of` makes of a pixel's place in [-1, 1]^2, its ray and what that meets.
template <class RayAt, class PixelOf>
auto drawn(int width, int height, RayAt const& ray_at, PixelOf const& pixel_of) {
    std::vector<decltype(pixel_of(vec2(), Ray(), Hit()))> pixels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            vec2 const at = (vec2(x, y) + 0.5f) / vec2(width, height) * 2.0f - 1.0f;
            Ray const ray = ray_at(at);
            pixels.push_back(pixel_of(at, ray, first_hit(ray)));
        }
    return pixels;
}

// `height` is that of the pixel in the picture, from -1 to 1.
inline shadowmath::backend::Rgba8 shaded(Hit const& hit, vec3 point, float sunlight, float height) {
    vec3 colour = glm::mix(vec3(0.85f, 0.9f, 0.94f), vec3(0.45f, 0.65f, 0.9f), height);
    if (hit.t < 1.0f) {
        bool const odd = (int(std::floor(point.x)) + int(std::floor(point.z))) % 2 != 0;
        vec3 const surface = hit.on_floor() ? vec3(odd ? 0.62f : 0.7f) : vec3(0.85f, 0.45f, 0.25f);
        colour = surface * (0.35f + 0.75f * sunlight);
    }
    auto const byte = [](float c) { return std::uint8_t(std::sqrt(glm::clamp(c, 0.0f, 1.0f)) * 255.0f); };
    return {byte(colour.x), byte(colour.y), byte(colour.z), 255};
}

}  // namespace your_renderer
