// SPDX-License-Identifier: MIT
//
// The smallest scene whose shadow is known exactly: a square of side 2 floats 2 m above a floor, lit by a slanted sun.
// The map's matrix is written out by hand, so that nothing of shadowmath is needed to test a backend.
#pragma once

#include "backends/backend.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cmath>
#include <numeric>

namespace shadowmath::image_test {

using namespace shadowmath::backend;

struct QuadOverFloor {
    static constexpr float height_metres = 2.0f;
    static constexpr float half_side_metres = 1.0f;
    static constexpr float half_map_metres = 8.0f;  // the map covers 16 m
    static constexpr std::uint32_t floor = 0, quad = 1;

    glm::vec3 light_travel = glm::normalize(glm::vec3(0.5f, -1.0f, 0.25f));
    glm::vec3 eye{1.0f, 6.0f, 8.0f};
    Scene scene;

    QuadOverFloor() {
        scene.name = "quad_over_floor";
        add_square(6.0f, 0.0f, {150, 160, 140, 255});
        add_square(half_side_metres, height_metres, {210, 90, 60, 255});
    }

    [[nodiscard]] glm::mat4 clip_from_world_of_sun() const {
        glm::vec3 const x = glm::normalize(glm::cross(light_travel, glm::vec3(0, 0, 1)));
        glm::vec3 const y = glm::cross(x, light_travel);
        glm::mat4 rows(glm::vec4(x / half_map_metres, 0.0f), glm::vec4(y / half_map_metres, 0.0f),
                       glm::vec4(light_travel / (2.0f * half_map_metres), 0.5f), glm::vec4(0, 0, 0, 1));
        return glm::transpose(rows);
    }

    // A frame that looks at the scene and reads one map of it, without any bias.
    [[nodiscard]] ScenePass pass(Extent extent, int map_size) const {
        glm::vec3 const target(0.5f, 0.0f, 0.0f);
        float const aspect = static_cast<float>(extent.width) / static_cast<float>(extent.height);
        ScenePass pass{extent, {}};
        pass.frame.clip_from_world =
            glm::perspectiveRH_ZO(0.9f, aspect, 0.1f, 100.0f) * glm::lookAtRH(eye, target, glm::vec3(0, 1, 0));
        pass.frame.eye_position = glm::vec4(eye, 1.0f);
        pass.frame.eye_forward = glm::vec4(glm::normalize(target - eye), 0.0f);
        pass.frame.light = glm::vec4(-light_travel, 0.0f);
        pass.frame.map_count = 1;
        pass.frame.map_size = static_cast<float>(map_size);
        pass.frame.maps[0].clip_from_world = clip_from_world_of_sun();
        pass.frame.maps[0].depth_end = 1000.0f;
        pass.frame.maps[0].blend_begin = 1000.0f;
        return pass;
    }

    // How deep a point of the floor lies in the quad's shadow: metres to the shadow's edge, negative outside.
    [[nodiscard]] float metres_into_shadow(glm::vec3 floor_point) const {
        glm::vec3 const at_quad = floor_point + light_travel * ((height_metres - floor_point.y) / light_travel.y);
        return half_side_metres - std::fmax(std::fabs(at_quad.x), std::fabs(at_quad.z));
    }

private:
    void add_square(float half_side, float y, std::array<std::uint8_t, 4> albedo) {
        auto const first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
        auto const first_index = static_cast<std::uint32_t>(scene.indices.size());
        for (int corner = 0; corner < 4; ++corner) {
            float const x = corner == 0 || corner == 3 ? -half_side : half_side;
            float const z = corner < 2 ? half_side : -half_side;
            scene.vertices.push_back({{x, y, z}, {0, 1, 0}, {albedo[0], albedo[1], albedo[2], albedo[3]}});
        }
        for (std::uint32_t const offset : {0u, 1u, 2u, 0u, 2u, 3u}) scene.indices.push_back(first_vertex + offset);
        scene.objects.push_back({first_index, 6u, {-half_side, y, -half_side}, {half_side, y, half_side}, true, true});
    }
};

// Draws every map of the frame with all objects, then the frame.
inline Frame draw_quad_over_floor(Backend& backend, QuadOverFloor const& world, ScenePass const& pass) {
    std::array<std::uint32_t, 2> const both{QuadOverFloor::floor, QuadOverFloor::quad};
    std::array<DepthLayer, max_maps> layers;
    for (int i = 0; i < pass.frame.map_count; ++i)
        layers[std::size_t(i)] = {pass.frame.maps[std::size_t(i)].clip_from_world, both};
    backend.upload(world.scene);
    backend.draw_depth({int(pass.frame.map_size), {layers.data(), std::size_t(pass.frame.map_count)}, true});
    backend.draw_scene(pass);
    return backend.read_frame();
}

[[nodiscard]] inline bool is_sky(Texel4 const& position) {
    return position.w == -2.0f;
}
[[nodiscard]] inline bool is_floor(Texel4 const& position) {
    return !is_sky(position) && position.y < 0.5f;
}

}  // namespace shadowmath::image_test
