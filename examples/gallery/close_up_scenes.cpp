// SPDX-License-Identifier: MIT
#include "examples/gallery/close_up_scenes.hpp"

#include "oracle/ray_oracle.hpp"
#include "scenes/mesh_builder.hpp"
#include "scenes/plants.hpp"
#include "scenes/scenes.hpp"
#include "scenes/sun.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace shadowmath::gallery {
namespace {

using scenes::MeshBuilder;
using scenes::sun_travel;
using scenes::view_toward;

constexpr double shadow_distance = 150.0;  // metres
constexpr int light_rays = 64;
constexpr int post_rays = 256;

// A small car along x, its wheels on y = 0.
void add_car(MeshBuilder& mesh) {
    scenes::Frame const car = mesh.frame;
    auto const slab = [&](double x0, double x1, double x2, double x3, double y0, double y1, double low, double high) {
        mesh.hexahedron({{{x0, y0, -low},
                          {x1, y0, -low},
                          {x2, y1, -high},
                          {x3, y1, -high},
                          {x0, y0, low},
                          {x1, y0, low},
                          {x2, y1, high},
                          {x3, y1, high}}});
    };
    mesh.colour = scenes::srgb(0xA8322A);
    slab(-1.95, 1.95, -2.0, 2.0, 0.24, 0.50, 0.76, 0.82);
    slab(-2.0, 2.0, -1.9, 1.85, 0.50, 0.86, 0.82, 0.78);
    mesh.colour = scenes::srgb(0x27313A);
    slab(-1.75, 0.95, -1.35, 0.35, 0.86, 1.38, 0.76, 0.60);
    mesh.colour = scenes::srgb(0xA8322A);
    slab(-1.37, 0.37, -1.30, 0.30, 1.38, 1.43, 0.61, 0.58);
    mesh.colour = scenes::srgb(0xB9BEC2);
    for (double const end : {-1.0, 1.0}) mesh.box({end * 2.0 - 0.06, 0.28, -0.78}, {end * 2.0 + 0.06, 0.42, 0.78});
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

// The ground below a place, as its triangles have it.
class Ground {
public:
    explicit Ground(backend::Scene const& scene) : oracle_(scene), high_(double(scene.hi.y) + 1.0) {}

    [[nodiscard]] glm::dvec3 at(double x, double z, double lift = 0.0) const {
        auto const hit = oracle_.first_hit({x, high_, z}, {0.0, -1.0, 0.0});
        return {x, (hit ? high_ - hit->distance : 0.0) + lift, z};
    }

    // With its y axis across the ground under four wheels.
    [[nodiscard]] scenes::Frame under(double x, double z, double half_length, double half_width) const {
        glm::dvec3 const along = at(x + half_length, z) - at(x - half_length, z);
        glm::dvec3 const aside = at(x, z + half_width) - at(x, z - half_width);
        scenes::Frame frame;
        frame.origin = 0.5 * (at(x + half_length, z) + at(x - half_length, z));
        frame.x = glm::normalize(along);
        frame.y = glm::normalize(glm::cross(aside, along));
        frame.z = glm::cross(frame.x, frame.y);
        return frame;
    }

private:
    oracle::RayOracle oracle_;
    double high_;
};

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
    return {
        "railing", "A railing of 16 mm bars", std::move(named.scene),
        view_toward("railing", {9.9, 1.4, -18.5}, {11.7, 0.1, -16.9}, 46.0, shadow_distance, sun_travel(42.0, 70.0)),
        light_rays};
}

CloseUpScene leaves(Settings const& settings) {
    auto named = scenes::make_scene("forest", scenes::SceneSize::medium, settings.seed);
    Ground const ground(named.scene);
    MeshBuilder mesh;
    scenes::Random random(settings.seed);
    for (glm::dvec2 const place : {glm::dvec2(-1.9, 9.5), glm::dvec2(-2.7, 9.1)}) {
        mesh.frame = scenes::standing_at(ground.at(place.x, place.y));
        scenes::add_fern(mesh, random, 0.6, 13);
        mesh.end_object();
    }
    append(named.scene, mesh.finish("ferns"));
    return {"leaves", "Leaves of a fern", std::move(named.scene),
            view_toward("leaves", ground.at(-0.9, 10.9, 1.15), ground.at(-2.3, 9.2, 0.1), 46.0, shadow_distance,
                        sun_travel(48.0, 200.0)),
            light_rays};
}

CloseUpScene car(Settings const& settings) {
    auto named = scenes::make_scene("town", scenes::SceneSize::medium, settings.seed);
    Ground const ground(named.scene);
    MeshBuilder mesh;
    mesh.frame = ground.under(0.3, 0.0, 1.25, 0.72);
    add_car(mesh);
    append(named.scene, mesh.finish("car"));
    return {"car", "Where a car stands", std::move(named.scene),
            view_toward("car", ground.at(2.6, 3.0, 0.9), ground.at(0.7, 0.3, 0.3), 46.0, shadow_distance,
                        sun_travel(42.0, -115.0)),
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
            view_toward("post", {2.7, 1.9, 1.9}, {1.25, 0.2, -0.45}, 50.0, shadow_distance, sun_travel(45.0, 155.0)),
            post_rays};
}

struct Entry {
    char const* scene;  // that it is a part of; null: its own
    bool quick;
    CloseUpScene (*make)(Settings const&);
};

constexpr std::array<Entry, 4> entries{
    {{"colonnade", false, railing}, {"forest", false, leaves}, {"town", false, car}, {nullptr, true, post}}};

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
