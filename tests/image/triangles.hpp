// SPDX-License-Identifier: MIT
//
// Scenes of loose triangles, each an object, drawn with the identity: their positions are clip coordinates.
#pragma once

#include "backends/backend.hpp"

#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace shadowmath::image_test {

using namespace shadowmath::backend;

[[nodiscard]] inline Scene triangles(std::vector<glm::vec3> const& corners) {
    Scene scene;
    scene.name = "triangles";
    for (glm::vec3 const& corner : corners) scene.vertices.push_back({corner, {0, 0, 1}, {255, 255, 255, 255}});
    for (std::uint32_t i = 0; i < corners.size(); ++i) scene.indices.push_back(i);
    for (std::uint32_t i = 0; i < corners.size(); i += 3) {
        Object object;
        object.first_index = i;
        object.index_count = 3;
        scene.objects.push_back(object);
    }
    return scene;
}

// Corners in [-1, 1] on each axis.
[[nodiscard]] inline Scene random_triangles(std::uint32_t seed, std::size_t count) {
    std::mt19937 random(seed);
    std::vector<glm::vec3> corners(3 * count);
    for (glm::vec3& corner : corners)
        for (int axis = 0; axis < 3; ++axis) corner[axis] = float(random() >> 8) * 0x1p-23f - 1.0f;
    return triangles(corners);
}

[[nodiscard]] inline std::vector<std::uint32_t> all_objects(Scene const& scene) {
    std::vector<std::uint32_t> all(scene.objects.size());
    std::iota(all.begin(), all.end(), 0u);
    return all;
}

[[nodiscard]] inline Image<float> draw_map(Backend& backend, Scene const& scene, int map_size, bool depth_clamp,
                                           std::vector<std::uint32_t> const& objects,
                                           glm::mat4 const& clip_from_world = glm::mat4(1.0f)) {
    backend.upload(scene);
    DepthLayer const layer{clip_from_world, objects};
    backend.draw_depth({map_size, {&layer, 1}, depth_clamp});
    return backend.read_depth(0);
}

}  // namespace shadowmath::image_test
