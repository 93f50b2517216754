// SPDX-License-Identifier: MIT
//
// A map's depths, and receivers in it, for what a shader does to them.
#pragma once

#include "bench/cases.hpp"

#include <shadowmath/shadow_map.hpp>

#include <cstddef>
#include <vector>

namespace bench {

constexpr int map_size = 256;

// Steps of blocks, as walls make them: most kernels agree, some do not.
inline std::vector<float> stored_depths() {
    Random random;
    std::vector<float> depths(std::size_t(map_size) * map_size);
    for (std::size_t y = 0; y < map_size; y += 16)
        for (std::size_t x = 0; x < map_size; x += 16) {
            float const depth = random.between(0.3f, 0.9f);
            for (std::size_t i = 0; i < 256; ++i) depths[(y + i / 16) * map_size + x + i % 16] = depth;
        }
    return depths;
}

// The whole map is a square hundred metres wide, seen along z.
inline shadowmath::ShadowMap<float> square_map() {
    shadowmath::ShadowMap<float> map;
    map.clip_from_world = glm::mat4(1.0f);
    for (int axis = 0; axis < 2; ++axis) map.clip_from_world[axis][axis] = 0.02f;
    map.clip_from_world[2][2] = 0.01f;
    map.clip = shadowmath::gl_zero_to_one_clip;
    map.visible = true;
    return map;
}

inline glm::vec3 some_receiver(Random& random) {
    return {random.between(-45, 45), random.between(-45, 45), random.between(40, 90)};
}

// Texels from u = v = 0, and depth.
inline glm::vec3 in_texels(glm::mat4 const& map, glm::vec3 const& point) {
    glm::vec4 const clip = map * glm::vec4(point, 1.0f);
    glm::vec3 const ndc = glm::vec3(clip) / clip.w;
    return {(ndc.x * 0.5f + 0.5f) * map_size, (ndc.y * 0.5f + 0.5f) * map_size, ndc.z};
}

}  // namespace bench
