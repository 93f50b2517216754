// SPDX-License-Identifier: MIT
//
// Objects of three triangles all over every map, each listed in a set of maps of its own: none, one, a range, or one
// with holes. An object drawn where it is not listed would be seen.
#pragma once

#include "tests/image/triangles.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <vector>

namespace shadowmath::image_test {

struct ListedObjects {
    Scene scene;
    std::array<std::vector<std::uint32_t>, max_maps> objects;
    std::array<DepthLayer, max_maps> layers;
    std::uint64_t triangles_in_maps = 0;      // once for each map that they are listed in
    std::uint64_t triangles_in_some_map = 0;  // once, if listed at all

    ListedObjects(std::uint32_t seed, std::size_t map_count)
        : scene(random_triangles(seed, 300)), map_count_(map_count) {
        std::mt19937 random(seed);
        scene.objects.clear();
        for (std::uint32_t object = 0; object < 100; ++object) {
            scene.objects.push_back({9 * object, 9});
            auto const maps = static_cast<std::uint32_t>(random() >> 8) & ((1u << map_count) - 1u);
            for (std::size_t map = 0; map < map_count; ++map)
                if ((maps >> map & 1u) != 0u) objects[map].push_back(object);
            triangles_in_maps += 3u * static_cast<std::uint64_t>(std::popcount(maps));
            triangles_in_some_map += maps != 0u ? 3u : 0u;
        }
        for (std::size_t map = 0; map < map_count; ++map) {
            float const angle = 0.4f * float(map);
            layers[map].clip_from_world = glm::perspectiveRH_ZO(1.2f - 0.05f * float(map), 1.0f, 0.3f, 4.0f) *
                                          glm::lookAtRH(glm::vec3(std::sin(angle), 0.9f, 1.6f * std::cos(angle)),
                                                        glm::vec3(0.0f), glm::vec3(0, 1, 0));
            layers[map].objects = objects[map];
        }
    }
    ListedObjects(ListedObjects const&) = delete;  // the layers point into it
    ListedObjects& operator=(ListedObjects const&) = delete;

    [[nodiscard]] DepthPass pass(DrawWay way, int map_size = 256, bool depth_clamp = true) const {
        return {map_size, {layers.data(), map_count_}, depth_clamp, way};
    }

    // A scene of one map's objects and no other.
    [[nodiscard]] Scene objects_of_map(std::size_t map) const {
        Scene some = scene;
        some.objects.clear();
        for (std::uint32_t const object : objects[map]) some.objects.push_back(scene.objects[object]);
        return some;
    }

private:
    std::size_t map_count_;
};

[[nodiscard]] inline std::vector<std::vector<float>> draw_maps(Backend& backend, DepthPass const& pass) {
    backend.draw_depth(pass);
    std::vector<std::vector<float>> maps;
    for (int map = 0; map < static_cast<int>(pass.layers.size()); ++map) maps.push_back(backend.read_depth(map).pixels);
    return maps;
}

}  // namespace shadowmath::image_test
