// SPDX-License-Identifier: MIT
//
// A view of a scene with the maps of its cascades, and for each map the objects that may cast into it.
#pragma once

#include "backends/backend.hpp"
#include "scenes/scenes.hpp"

#include <shadowmath/cascades.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace shadowmath::image_test {

using namespace shadowmath::backend;

struct CascadedView {
    ScenePass pass;
    std::array<std::vector<std::uint32_t>, max_maps> casters;
    std::array<DepthLayer, max_maps> all_layers;

    [[nodiscard]] std::span<DepthLayer const> layers() const {
        return {all_layers.data(), static_cast<std::size_t>(pass.frame.map_count)};
    }
    [[nodiscard]] DepthPass maps(DrawWay way = DrawWay::pass_per_map) const {
        return {static_cast<int>(pass.frame.map_size), layers(), true, way};
    }

    CascadedView(Scene const& scene, scenes::View const& view, Extent extent, int map_count, int map_size) {
        glm::vec3 const eye(view.eye), forward(view.forward), travel(view.light_travel);
        float const aspect = static_cast<float>(extent.width) / static_cast<float>(extent.height);
        auto const z_near = static_cast<float>(view.z_near);
        auto const fov_y = static_cast<float>(view.fov_y_radians);
        pass.extent = extent;
        FrameConstants& frame = pass.frame;
        frame.clip_from_world = glm::perspectiveRH_ZO(fov_y, aspect, z_near, 2000.0f) *
                                glm::lookAtRH(eye, eye + forward, glm::vec3(view.up));
        frame.eye_position = glm::vec4(eye, 1.0f);
        frame.eye_forward = glm::vec4(forward, 0.0f);
        frame.light = glm::vec4(-travel, 0.0f);
        frame.filter_radius = 1;
        frame.map_size = static_cast<float>(map_size);

        CascadeOptions<float> options;
        options.count = map_count;
        options.map_size = map_size;
        options.shadow_distance = 120.0f;
        options.blend = 0.0f;
        options.pancake = true;
        options.clip = gl_zero_to_one_clip;
        Aabb<float> const bounds{scene.lo, scene.hi};
        auto const pose = pose_looking(eye, forward, glm::vec3(view.up));
        for (Cascade<float> const& cascade : fit_cascades(perspective_view(pose, fov_y, aspect, z_near, 2000.0f),
                                                          directional(travel), bounds, bounds, options)) {
            auto const i = static_cast<std::size_t>(frame.map_count++);
            frame.maps[i].clip_from_world = cascade.map.clip_from_world;
            frame.maps[i].depth_end = frame.maps[i].blend_begin = cascade.range.end;
            frame.maps[i].bias_constant = 1e-4f;
            for (std::uint32_t object = 0; object < scene.objects.size(); ++object)
                if (may_cast(scene.objects[object], cascade.map.clip_from_world)) casters[i].push_back(object);
            all_layers[i] = {cascade.map.clip_from_world, casters[i]};
        }
    }

    CascadedView(CascadedView const&) = delete;  // the layers point into it
    CascadedView& operator=(CascadedView const&) = delete;

private:
    // The object's box meets the map's column of light, which begins at the sun.
    [[nodiscard]] static bool may_cast(Object const& object, glm::mat4 const& clip_from_world) {
        if (!object.casts) return false;
        glm::vec3 lo(std::numeric_limits<float>::max()), hi(-lo);
        for (int corner = 0; corner < 8; ++corner) {
            glm::vec3 const point(((corner & 1) != 0 ? object.hi : object.lo).x,
                                  ((corner & 2) != 0 ? object.hi : object.lo).y,
                                  ((corner & 4) != 0 ? object.hi : object.lo).z);
            glm::vec3 const clip(clip_from_world * glm::vec4(point, 1.0f));
            lo = glm::min(lo, clip);
            hi = glm::max(hi, clip);
        }
        return lo.x <= 1.0f && hi.x >= -1.0f && lo.y <= 1.0f && hi.y >= -1.0f && lo.z <= 1.0f;
    }
};

}  // namespace shadowmath::image_test
