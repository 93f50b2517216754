// SPDX-License-Identifier: MIT
//
// A scene as plain data: one vertex array, one index array, and objects that are ranges of it.
// Everything is baked into world space, in metres. No graphics API and no shadow-map mathematics here:
// generators fill it, backends upload it, the ray tracer walks it.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace shadowmath::backend {

struct Vertex {
    glm::vec3 position;      // world, metres
    glm::vec3 normal;        // shading normal, unit
    std::uint8_t albedo[4];  // linear reflectance, 255 = 1; the fourth byte is unused
};
static_assert(sizeof(Vertex) == 28, "backends hand this layout to the graphics API");

struct Object {
    std::uint32_t first_index = 0;                    // into Scene::indices
    std::uint32_t index_count = 0;                    // three a triangle
    glm::vec3 lo{std::numeric_limits<float>::max()};  // world box of its vertices
    glm::vec3 hi{std::numeric_limits<float>::lowest()};
    bool casts = true;
    bool receives = true;
};

struct Scene {
    std::string name;  // a file-name-safe word
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<Object> objects;                      // disjoint, in index order, covering all indices
    glm::vec3 lo{std::numeric_limits<float>::max()};  // union of the object boxes
    glm::vec3 hi{std::numeric_limits<float>::lowest()};
};

}  // namespace shadowmath::backend
