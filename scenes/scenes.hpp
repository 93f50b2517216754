// SPDX-License-Identifier: MIT
//
// The scenes that shadows are shown and judged on. Generated from a seed: the same name, size and seed give the same
// bytes on every run.
#pragma once

#include "backends/scene.hpp"
#include "scenes/view.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shadowmath::scenes {

// About 20 thousand, 100 thousand and 400 thousand triangles; the large forest has a million.
enum class SceneSize { small, medium, large };

struct NamedScene {
    backend::Scene scene;
    std::vector<View> views;  // at least five: at eye level, above, down, up, along a low sun
};

// A small town with a market square, streets and gardens, on rolling land that reaches 1 km each way.
[[nodiscard]] NamedScene make_town(SceneSize size, std::uint64_t seed);

// A courtyard of fluted columns with balustrades, flags, ropes and wires of 1 to 3 cm; 120 m across.
[[nodiscard]] NamedScene make_colonnade(SceneSize size, std::uint64_t seed);

// Trees of loose leaves on rough ground around a path; 150 m across.
[[nodiscard]] NamedScene make_forest(SceneSize size, std::uint64_t seed);

// The names that make_scene knows: "town", "colonnade", "forest".
[[nodiscard]] std::span<std::string_view const> scene_names();

// Throws std::runtime_error for a name that is not among scene_names().
[[nodiscard]] NamedScene make_scene(std::string_view name, SceneSize size, std::uint64_t seed = 1);

}  // namespace shadowmath::scenes
