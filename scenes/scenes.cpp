// SPDX-License-Identifier: MIT
#include "scenes/scenes.hpp"

#include <array>
#include <stdexcept>

namespace shadowmath::scenes {

namespace {
constexpr std::array<std::string_view, 3> names{"town", "colonnade", "forest"};
}

std::span<std::string_view const> scene_names() {
    return names;
}

NamedScene make_scene(std::string_view name, SceneSize size, std::uint64_t seed) {
    if (name == names[0]) return make_town(size, seed);
    if (name == names[1]) return make_colonnade(size, seed);
    if (name == names[2]) return make_forest(size, seed);
    throw std::runtime_error("no scene is called \"" + std::string(name) + "\"; there are town, colonnade, forest");
}

}  // namespace shadowmath::scenes
