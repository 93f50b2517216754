// SPDX-License-Identifier: MIT
//
// What every backend asks of a scene and a pass before it hands them to a driver, said once for all of them.
// Each function gives one sentence about the first fault it finds, or an empty string when there is none.
// The null backend reports that sentence as a message; those that draw throw it.
#pragma once

#include "backends/backend.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace shadowmath::backend {

[[nodiscard]] inline bool is_finite(glm::mat4 const& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row])) return false;
    return true;
}

[[nodiscard]] inline std::string fault_of(Scene const& scene) {
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        Object const& object = scene.objects[i];
        std::string const who = "scene '" + scene.name + "': object " + std::to_string(i);
        if (object.index_count % 3 != 0) return who + " does not consist of whole triangles";
        if (std::size_t{object.first_index} + object.index_count > scene.indices.size())
            return who + " reaches past the last index";
    }
    for (std::uint32_t const index : scene.indices)
        if (index >= scene.vertices.size())
            return "scene '" + scene.name + "': index " + std::to_string(index) + " has no vertex";
    return {};
}

[[nodiscard]] inline std::string fault_of(DepthPass const& pass, std::size_t object_count) {
    if (pass.map_size <= 0) return "depth pass: map_size is " + std::to_string(pass.map_size);
    if (pass.layers.empty() || pass.layers.size() > std::size_t{max_maps})
        return "depth pass: " + std::to_string(pass.layers.size()) + " layers, not 1 to " + std::to_string(max_maps);
    for (std::size_t i = 0; i < pass.layers.size(); ++i) {
        std::string const who = "depth pass: layer " + std::to_string(i);
        if (!is_finite(pass.layers[i].clip_from_world)) return who + " has a matrix that is not finite";
        for (std::uint32_t const object : pass.layers[i].objects)
            if (object >= object_count) return who + " draws object " + std::to_string(object) + ", which is not there";
    }
    return {};
}

[[nodiscard]] inline std::string fault_of(ScenePass const& pass, int layers_drawn) {
    FrameConstants const& frame = pass.frame;
    if (pass.extent.width <= 0 || pass.extent.height <= 0) return "scene pass: the extent is empty";
    if (!is_finite(frame.clip_from_world)) return "scene pass: the eye's matrix is not finite";
    if (frame.filter_radius < 0 || frame.filter_radius > 2) return "scene pass: filter_radius is not 0, 1 or 2";
    if (frame.map_count < 0 || frame.map_count > layers_drawn)
        return "scene pass: reads " + std::to_string(frame.map_count) + " maps, but " + std::to_string(layers_drawn) +
               " are drawn";
    for (int i = 0; i < frame.map_count; ++i)
        if (!is_finite(frame.maps[static_cast<std::size_t>(i)].clip_from_world))
            return "scene pass: map " + std::to_string(i) + " has a matrix that is not finite";
    return {};
}

[[nodiscard]] inline std::string fault_of(DepthPass const& maps, ScenePass const& view, std::size_t object_count) {
    if (std::string const fault = fault_of(maps, object_count); !fault.empty()) return fault;
    if (std::string const fault = fault_of(view, static_cast<int>(maps.layers.size())); !fault.empty()) return fault;
    if (std::size_t(view.frame.map_count) != maps.layers.size())
        return "split by split: " + std::to_string(maps.layers.size()) + " maps are drawn, but " +
               std::to_string(view.frame.map_count) + " are read";
    if (maps.fitted || view.fitted) return "split by split: the splits of a fit are known to the device alone";
    if (view.frame.choice != MapChoice::by_depth) return "split by split: the maps are not chosen by depth";
    if (!view.shown.empty() && view.shown.size() != maps.layers.size() + 1)
        return "split by split: " + std::to_string(view.shown.size()) +
               " lists of what is shown, not one a map and one";
    for (auto const& shown : view.shown)
        for (std::uint32_t const object : shown)
            if (object >= object_count)
                return "split by split: shows object " + std::to_string(object) + ", which is not there";
    return {};
}

[[nodiscard]] inline std::string fault_of(FitPass const& pass) {
    if (pass.extent.width <= 0 || pass.extent.height <= 0) return "fit: the extent is empty";
    if (!is_finite(pass.clip_from_world)) return "fit: the eye's matrix is not finite";
    for (ComputeStep const& step : pass.steps)
        if (step.shader == nullptr) return "fit: a step has no shader";
    return {};
}

[[nodiscard]] inline std::string fault_of_fitted(bool fitted, bool there_is_a_fit) {
    return fitted && !there_is_a_fit ? "a pass takes fitted maps, but none were fitted" : std::string();
}

[[nodiscard]] inline std::string fault_of(DrawWay way, std::span<DrawWay const> ways) {
    if (std::ranges::find(ways, way) != ways.end()) return {};
    return std::string("depth pass: this driver cannot draw maps by ") + name_of(way);
}

// For backends that draw.
inline void demand_none(std::string const& fault) {
    if (!fault.empty()) throw std::runtime_error(fault);
}

}  // namespace shadowmath::backend
