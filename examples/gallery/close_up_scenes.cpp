// SPDX-License-Identifier: MIT
#include "examples/gallery/close_up_scenes.hpp"

#include "scenes/mesh_builder.hpp"
#include "scenes/scenes.hpp"
#include "scenes/sun.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace shadowmath::gallery {
namespace {

using scenes::MeshBuilder;
using scenes::sun_travel;
using scenes::view_toward;

constexpr double shadow_distance = 60.0;  // metres
constexpr int light_rays = 64;
constexpr int post_rays = 256;

// A small car along x, its wheels on y = 0.
void add_car(MeshBuilder& mesh) {
    scenes::Frame const car = mesh.frame;
    auto const slab = [&](double x0, double x1, double x2, double x3, double y0, double y1, double low, double high) {
        mesh.hexahedron({{{x0, y0, -low}, {x1, y0, -low}, {x2, y1, -high}, {x3, y1, -high},
                          {x0, y0, low}, {x1, y0, low}, {x2, y1, high}, {x3, y1, high}}});
    };
    mesh.colour = scenes::srgb(0xA8322A);
    slab(-1.95, 1.95, -2.0, 2.0, 0.24, 0.50, 0.76, 0.82);
    slab(-2.0, 2.0, -1.9, 1.85, 0.50, 0.86, 0.82, 0.78);
    mesh.colour = scenes::srgb(0x27313A);
    slab(-1.75, 0.95, -1.35, 0.35, 0.86, 1.38, 0.76, 0.60);
    mesh.colour = scenes::srgb(0xA8322A);
    slab(-1.37, 0.37, -1.30, 0.30, 1.38, 1.43, 0.61, 0.58);
    mesh.colour = scenes::srgb(0xB9BEC2);
    for (double const end : {-1.0, 1.0})
        mesh.box({end * 2.0 - 0.06, 0.28, -0.78}, {end * 2.0 + 0.06, 0.42, 0.78});
    for (double const x : {-1.25, 1.25})
        for (double const z : {-0.72, 0.72}) {
            scenes::Frame const hub = car.moved({x, 0.31, z});
            mesh.frame = {hub.origin, hub.x, -hub.z, hub.y};
            mesh.colour = scenes::srgb(0x1E1F21);
            mesh.lathe({{0.20, -0.10}, {0.29, -0.11}, {0.31, -0.07}, {0.31, 0.07}, {0.29, 0.11}, {0.20, 0.10}},
                       scenes::circle(32));
            mesh.colour = scenes::srgb(0xB9BEC2);
            mesh.lathe({{0.0, -0.07}, {0.21, -0.08}, {0.21, 0.08}, {0.0, 0.07}}, scenes::circle(24));
        }
    mesh.frame = car;
    mesh.end_object();
}

void append(backend::Scene& scene, backend::Scene const& more) {
    auto const first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
    auto const first_index = static_cast<std::uint32_t>(scene.indices.size());
    scene.vertices.insert(scene.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (std::uint32_t const index : more.indices) scene.indices.push_back(first_vertex + index);
    for (backend::Object object : more.objects) {
        object.first_index += first_index;
        scene.objects.push_back(object);
    }
    scene.lo = glm::min(scene.lo, more.lo);
    scene.hi = glm::max(scene.hi, more.hi);
}

CloseUpScene railing(Settings const& settings) {
    auto named = scenes::make_scene("colonnade", scenes::SceneSize::medium, settings.seed);
    return {"railing", "A railing of 16 mm bars", std::move(named.scene),
            view_toward("railing", {9.0, 1.5, 14.2}, {10.6, 0.35, 17.6}, 46.0, shadow_distance, sun_travel(33.0, 60.0)),
            light_rays};
}

CloseUpScene leaves(Settings const& settings) {
    auto named = scenes::make_scene("forest", scenes::SceneSize::medium, settings.seed);
    return {"leaves", "Leaves over the forest floor", std::move(named.scene),
            view_toward("leaves", {-1.0, 2.2, 11.0}, {-3.0, 0.2, 7.5}, 46.0, shadow_distance, sun_travel(48.0, 200.0)),
            light_rays};
}

CloseUpScene car(Settings const& settings) {
    auto named = scenes::make_scene("town", scenes::SceneSize::medium, settings.seed);
    MeshBuilder mesh;
    add_car(mesh);
    append(named.scene, mesh.finish("car"));
    return {"car", "Where a car stands", std::move(named.scene),
            view_toward("car", {2.4, 1.3, 3.4}, {0.5, 0.35, 0.4}, 46.0, shadow_distance, sun_travel(38.0, 70.0)),
            light_rays};
}

// The post of three metres that penumbrae are checked with: no other caster, so its shadow has all widths.
CloseUpScene post(Settings const&) {
    MeshBuilder mesh;
    mesh.colour = scenes::srgb(0xA79C8A);
    mesh.quad({-60, 0, -60}, {-60, 0, 60}, {60, 0, 60}, {60, 0, -60});
    mesh.end_object();
    mesh.colour = scenes::srgb(0x8A4B36);
    mesh.box({-0.2, 0.0, -0.2}, {0.2, 3.0, 0.2});
    mesh.end_object();
    return {"post", "The penumbra of a post", mesh.finish("post"),
            view_toward("post", {4.6, 2.9, 3.6}, {1.6, 0.35, -0.3}, 46.0, shadow_distance, sun_travel(45.0, 155.0)),
            post_rays};
}

struct Entry {
    char const* scene;  // that it is a part of; null: its own
    bool quick;
    CloseUpScene (*make)(Settings const&);
};

constexpr std::array<Entry, 4> entries{{{"colonnade", false, railing},
                                        {"forest", false, leaves},
                                        {"town", false, car},
                                        {nullptr, true, post}}};

}  // namespace

std::vector<CloseUpScene> close_up_scenes(Settings const& settings) {
    auto const asked = [&](Entry const& entry) {
        return entry.scene == nullptr || std::ranges::find(settings.scenes, entry.scene) != settings.scenes.end();
    };
    std::vector<CloseUpScene> made;
    for (Entry const& entry : entries)
        if ((entry.quick || !settings.quick) && asked(entry)) made.push_back(entry.make(settings));
    return made;
}

}  // namespace shadowmath::gallery
