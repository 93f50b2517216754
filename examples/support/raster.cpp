// SPDX-License-Identifier: MIT
#include "examples/support/raster.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace shadowmath::example {
namespace {

// What is left of a convex polygon in clip space where dot(plane, corner) >= 0.
std::vector<glm::vec4> cut(std::vector<glm::vec4> const& corners, glm::vec4 plane) {
    std::vector<glm::vec4> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        glm::vec4 const a = corners[i], b = corners[(i + 1) % corners.size()];
        float const above_a = glm::dot(plane, a), above_b = glm::dot(plane, b);
        if (above_a >= 0.0f) kept.push_back(a);
        if ((above_a >= 0.0f) != (above_b >= 0.0f)) kept.push_back(a + (b - a) * (above_a / (above_a - above_b)));
    }
    return kept;
}

// Calls fragment(x, y, depth, w) for each pixel whose centre the triangle covers.
template <class Fragment>
void rasterise(glm::mat4 const& clip_from_world, int width, int height, Triangle const& triangle, bool clamp_depth,
               Fragment const& fragment) {
    std::vector<glm::vec4> corners;
    for (glm::vec3 const& p : triangle.at) corners.push_back(clip_from_world * glm::vec4(p, 1.0f));
    corners = cut(corners, glm::vec4(0.0f, 0.0f, 0.0f, 1.0f) - glm::vec4(0.0f, 0.0f, 0.0f, 1e-6f));
    if (!clamp_depth) corners = cut(corners, glm::vec4(0.0f, 0.0f, 1.0f, 0.0f));
    std::vector<glm::vec4> at;  // x and y in pixels, depth, 1 / w
    for (glm::vec4 const& c : corners) {
        glm::vec3 const ndc = glm::vec3(c) / c.w;
        at.emplace_back((ndc.x * 0.5f + 0.5f) * float(width), (ndc.y * 0.5f + 0.5f) * float(height), ndc.z, 1.0f / c.w);
    }
    for (std::size_t i = 1; i + 1 < at.size(); ++i) {
        glm::vec4 const a = at[0], b = at[i], c = at[i + 1];
        float const area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (!(std::abs(area) > 0.0f)) continue;
        auto const first = [](float lowest) {
            return std::max(0, static_cast<int>(std::ceil(std::max(lowest, 0.0f) - 0.5f)));
        };
        auto const last = [](float highest, int size) {
            return std::min(size - 1, static_cast<int>(std::floor(std::min(highest, float(size)) - 0.5f)));
        };
        int const x0 = first(std::min({a.x, b.x, c.x})), x1 = last(std::max({a.x, b.x, c.x}), width);
        int const y0 = first(std::min({a.y, b.y, c.y})), y1 = last(std::max({a.y, b.y, c.y}), height);
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                float const px = float(x) + 0.5f, py = float(y) + 0.5f;
                float const v = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) / area;
                float const u = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / area;
                if (u < 0.0f || v < 0.0f || u + v > 1.0f) continue;
                glm::vec4 const here = a + (b - a) * v + (c - a) * u;
                fragment(x, y, here.z, 1.0f / here.w);
            }
    }
}

}  // namespace

backend::Rgba8 encoded(glm::vec3 linear) {
    auto const byte = [](float share) {
        return static_cast<std::uint8_t>(std::sqrt(std::clamp(share, 0.0f, 1.0f)) * 255.0f + 0.5f);
    };
    return {byte(linear.x), byte(linear.y), byte(linear.z), 255};
}

DepthMap draw_depths(ShadowMap<float> const& map, int size, std::span<Triangle const> triangles, bool clamp_depth) {
    DepthMap drawn{map, size,
                   std::vector<float>(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 1.0f)};
    for (Triangle const& triangle : triangles)
        rasterise(map.clip_from_world, size, size, triangle, clamp_depth, [&](int x, int y, float depth, float) {
            float& stored = drawn.depth[static_cast<std::size_t>(y * size + x)];
            stored = std::min(stored, std::clamp(depth, 0.0f, 1.0f));
        });
    return drawn;
}

std::vector<Surface> surfaces_of(ViewVolume<float> const& view, int width, int height,
                                 std::span<Triangle const> triangles) {
    std::vector<Surface> seen(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    glm::mat4 const clip_from_world = shadowmath::clip_from_world(view, ClipSpace{});
    glm::vec2 const step((view.right - view.left) / float(width), (view.top - view.bottom) / float(height));
    for (Triangle const& triangle : triangles) {
        if (!(glm::dot(triangle.normal, view.pose.position - triangle.at[0]) > 0.0f)) continue;
        rasterise(clip_from_world, width, height, triangle, false, [&](int x, int y, float depth, float w) {
            Surface& pixel = seen[static_cast<std::size_t>(y * width + x)];
            bool const perspective = view.kind == ViewKind::perspective;
            float const metres = perspective ? w : view.z_near + depth * (view.z_far - view.z_near);
            if (pixel.eye_depth > 0.0f && pixel.eye_depth <= metres) return;
            glm::vec3 const point = point_at(view, view.left + step.x * (float(x) + 0.5f),
                                             view.bottom + step.y * (float(y) + 0.5f), metres);
            pixel = {point, triangle.normal, triangle.colour, metres};
        });
    }
    return seen;
}

Picture draw_picture(ViewVolume<float> const& view, int width, int height, std::span<Triangle const> triangles,
                     std::function<glm::vec3(Surface const&)> const& shade) {
    int const wide = 2 * width;
    std::vector<Surface> const seen = surfaces_of(view, wide, 2 * height, triangles);
    Picture picture({width, height});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float const up = float(y) / float(height);
            glm::vec3 const sky =
                glm::mix(glm::vec3(0.62f, 0.72f, 0.8f), glm::vec3(0.2f, 0.4f, 0.72f), std::max(up - 0.4f, 0.0f));
            glm::vec3 sum(0.0f);
            for (int part = 0; part < 4; ++part) {
                Surface const& at = seen[static_cast<std::size_t>((2 * y + part / 2) * wide + 2 * x + part % 2)];
                sum += at.eye_depth > 0.0f ? shade(at) : sky;
            }
            picture.at(x, y) = encoded(sum * 0.25f);
        }
    return picture;
}

glm::vec3 sunlit(Surface const& surface, glm::vec3 sun_travel, float visibility) {
    float const facing = std::max(0.0f, -glm::dot(surface.normal, glm::normalize(sun_travel)));
    glm::vec3 const sky = glm::vec3(0.26f, 0.32f, 0.42f) * (0.75f + 0.25f * surface.normal.y);
    glm::vec3 const lit = surface.colour * (sky + glm::vec3(1.45f, 1.3f, 1.02f) * (facing * visibility));
    return glm::mix(lit, glm::vec3(0.62f, 0.72f, 0.8f), std::min(surface.eye_depth / 320.0f, 0.6f));
}

Picture picture_of(DepthMap const& map) {
    float first = 1.0f, last = 0.0f;
    for (float const depth : map.depth)
        if (depth < 1.0f) first = std::min(first, depth), last = std::max(last, depth);
    Picture picture({map.size, map.size});
    for (int y = 0; y < map.size; ++y)
        for (int x = 0; x < map.size; ++x) {
            float const depth = map(x, y), nearness = (last - depth) / std::max(last - first, 1e-6f);
            glm::vec3 const grey(0.04f + 0.9f * nearness * nearness), nothing(0.022f, 0.06f, 0.14f);
            picture.at(x, y) = encoded(depth < 1.0f ? grey : nothing);
        }
    return picture;
}

std::array<glm::vec3, 4> corners_at(ShadowMap<float> const& map, float depth) {
    glm::mat4 const world_from_texture = glm::inverse(texture_from_world(map));
    auto const at = [&](float u, float v) {
        glm::vec4 const p = world_from_texture * glm::vec4(u, v, depth, 1.0f);
        return glm::vec3(p) / p.w;
    };
    return {at(0.0f, 0.0f), at(1.0f, 0.0f), at(1.0f, 1.0f), at(0.0f, 1.0f)};
}

glm::vec3 heat(float share) {
    constexpr int last = 4;
    glm::vec3 const colour[last + 1] = {
        {0.05f, 0.12f, 0.4f}, {0.03f, 0.38f, 0.42f}, {0.16f, 0.58f, 0.2f}, {0.85f, 0.7f, 0.1f}, {0.8f, 0.12f, 0.05f}};
    float const place = std::clamp(share, 0.0f, 1.0f) * float(last);
    int const i = std::min(static_cast<int>(place), last - 1);
    return glm::mix(colour[i], colour[i + 1], place - float(i));
}

Picture beside(std::span<Picture const> pictures) {
    constexpr int gap = 6;
    int width = -gap;
    for (Picture const& picture : pictures) width += picture.extent.width + gap;
    Picture whole({width, pictures.front().extent.height}, {255, 255, 255, 255});
    int left = 0;
    for (Picture const& picture : pictures) {
        for (int y = 0; y < picture.extent.height; ++y)
            for (int x = 0; x < picture.extent.width; ++x) whole.at(left + x, y) = picture.at(x, y);
        left += picture.extent.width + gap;
    }
    return whole;
}

Picture enlarged(Picture const& picture, int x, int y, int width, int height, int zoom) {
    Picture part({width * zoom, height * zoom});
    for (int row = 0; row < part.extent.height; ++row)
        for (int column = 0; column < part.extent.width; ++column)
            part.at(column, row) = picture.at(x + column / zoom, y + row / zoom);
    return part;
}

}  // namespace shadowmath::example
