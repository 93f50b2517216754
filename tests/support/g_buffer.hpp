// SPDX-License-Identifier: MIT
//
// What an eye of perspective sees of a triangle soup: position and normal of the nearest surface, pixel by pixel. A
// plain z-buffer in double, for tests that must not depend on a driver.
#pragma once

#include "tests/support/caster_scenes.hpp"

#include <shadowmath/irregular/microquad.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace shadowmath::test {

// Six floats a pixel: world position, normal; zeros where there is sky.
inline std::vector<float> g_buffer(CasterScene const& scene, int width, int height) {
    ViewVolume<double> eye;
    eye.pose = {Vec3<double>(scene.eye.pose.position), Vec3<double>(scene.eye.pose.right),
                Vec3<double>(scene.eye.pose.up), Vec3<double>(scene.eye.pose.forward)};
    eye.left = double(scene.eye.left), eye.right = double(scene.eye.right);
    eye.bottom = double(scene.eye.bottom), eye.top = double(scene.eye.top);
    eye.z_near = double(scene.eye.z_near), eye.z_far = double(scene.eye.z_far);
    PixelFrame<double> const frame = pixel_frame(eye, width, height);
    std::vector<double> nearest(std::size_t(width) * std::size_t(height), std::numeric_limits<double>::max());
    std::vector<float> receivers(6 * nearest.size(), 0.0f);
    for (std::size_t t = 0; t + 9 <= scene.positions.size(); t += 9) {
        glm::dvec3 world[3], p[3];
        double lo_x = 1e9, hi_x = -1e9, lo_y = 1e9, hi_y = -1e9;
        for (std::size_t i = 0; i < 3; ++i) {
            float const* const v = &scene.positions[t + 3 * i];
            world[i] = glm::dvec3(v[0], v[1], v[2]);
            p[i] = point_in_pixels(frame, Vec3<double>(world[i]));
            bool const before = p[i].z > 1e-3;
            lo_x = std::min(lo_x, before ? p[i].x / p[i].z : -1e9);
            hi_x = std::max(hi_x, before ? p[i].x / p[i].z : 1e9);
            lo_y = std::min(lo_y, before ? p[i].y / p[i].z : -1e9);
            hi_y = std::max(hi_y, before ? p[i].y / p[i].z : 1e9);
        }
        glm::dvec3 const normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        glm::dvec3 const edge[3] = {glm::cross(p[0], p[1]), glm::cross(p[1], p[2]), glm::cross(p[2], p[0])};
        glm::dvec3 const in_world = glm::cross(world[1] - world[0], world[2] - world[0]);
        double const plane = glm::dot(normal, p[0]);
        auto const first = [](double lo, int half) { return std::clamp(int(std::floor(lo)) + half, 0, 2 * half); };
        for (int y = first(lo_y, height / 2); y < std::min(height, first(hi_y, height / 2) + 1); ++y)
            for (int x = first(lo_x, width / 2); x < std::min(width, first(hi_x, width / 2) + 1); ++x) {
                glm::dvec3 const ray(x + 0.5 - 0.5 * width, y + 0.5 - 0.5 * height, 1.0);
                double const a = glm::dot(edge[0], ray), b = glm::dot(edge[1], ray), c = glm::dot(edge[2], ray);
                if (!((a >= 0.0 && b >= 0.0 && c >= 0.0) || (a <= 0.0 && b <= 0.0 && c <= 0.0))) continue;
                double const depth = plane / glm::dot(normal, ray);
                std::size_t const pixel = std::size_t(y) * std::size_t(width) + std::size_t(x);
                if (!(depth > eye.z_near) || !(depth < nearest[pixel])) continue;
                nearest[pixel] = depth;
                glm::dvec3 const at =
                    glm::dvec3(frame.eye) +
                    (glm::dvec3(frame.across) * ray.x + glm::dvec3(frame.upward) * ray.y + glm::dvec3(frame.inward)) *
                        depth;
                glm::dvec3 const n = glm::normalize(in_world);
                for (int i = 0; i < 3; ++i) {
                    receivers[6 * pixel + std::size_t(i)] = float(at[i]);
                    receivers[6 * pixel + std::size_t(i) + 3] = float(n[i]);
                }
            }
    }
    return receivers;
}

}  // namespace shadowmath::test
