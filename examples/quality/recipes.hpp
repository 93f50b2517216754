// SPDX-License-Identifier: MIT
//
// The folk recipes: how engines and tutorials fit four cascades, written down as they are found there and without this
// library's mathematics, so that there is something to be held against. All have practical splits at lambda 1/2, a near
// plane before the first caster of the scene and a far one behind the slice, and a map is chosen by eye depth.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace shadowmath::quality {

struct Camera {
    glm::dvec3 eye{0.0};
    glm::dvec3 right{1.0, 0.0, 0.0}, up{0.0, 1.0, 0.0}, forward{0.0, 0.0, -1.0};
    double slope_x = 1.0, slope_y = 1.0;  // tangents of half the angles of view
    double z_near = 0.1;
    double shadow_distance = 100.0;
};

// A world box: in these recipes all casters, or all receivers, are one.
struct Box {
    glm::dvec3 lo{0.0}, hi{0.0};
};

inline constexpr int recipe_maps = 4;

struct RecipeMap {
    glm::dmat4 clip_from_world{1.0};  // depth 0 to 1
    double begin = 0.0, end = 0.0;    // eye depth
    double w_min = 0.0;
    bool visible = false;
};
using RecipeMaps = std::array<RecipeMap, recipe_maps>;

// One AABB in light space around the eight corners of each slice.
[[nodiscard]] RecipeMaps textbook_box(Camera const& camera, glm::dvec3 travel, Box const& scene, int map_size);

// A sphere around the corners' centroid, its radius rounded up to a sixteenth of a metre, the map snapped to texels.
[[nodiscard]] RecipeMaps centroid_sphere(Camera const& camera, glm::dvec3 travel, Box const& scene, int map_size);

// The slice cut by the box of all receivers; its AABB in a light space whose y runs along the view.
[[nodiscard]] RecipeMaps focus(Camera const& camera, glm::dvec3 travel, Box const& scene, int map_size);

// LiSPSM in each slice, with n_opt as published, around the body that is cut likewise and swept to the light.
[[nodiscard]] RecipeMaps lispsm(Camera const& camera, glm::dvec3 travel, Box const& scene, int map_size);

}  // namespace shadowmath::quality
