// SPDX-License-Identifier: MIT
#include "examples/quality/views.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <span>
#include <string>
#include <string_view>

namespace shadowmath::quality {
namespace {

enum class Sun { behind, ahead, aside };  // of the viewer: its light travels with the view, against it, across it

struct Aspect {
    std::string_view place;  // a view of the scene
    int elevation_degrees;
    Sun sun;
    double shadow_distance;
};

constexpr Aspect of_town[] = {
    {"street", 88, Sun::aside, 180},  {"street", 60, Sun::ahead, 120}, {"street", 35, Sun::aside, 180},
    {"street", 20, Sun::behind, 250}, {"street", 8, Sun::ahead, 180},  {"street", 3, Sun::aside, 150},
    {"square", 45, Sun::aside, 150},  {"square", 15, Sun::ahead, 100}, {"square", 70, Sun::behind, 400},
    {"hill", 88, Sun::aside, 800},    {"hill", 35, Sun::ahead, 600},   {"hill", 20, Sun::aside, 800},
    {"hill", 10, Sun::behind, 600},   {"hill", 3, Sun::ahead, 400},    {"down", 60, Sun::aside, 200},
    {"down", 25, Sun::behind, 200},   {"down", 88, Sun::aside, 150},   {"up", 35, Sun::aside, 160},
    {"up", 12, Sun::ahead, 160},      {"up", 70, Sun::behind, 100},    {"side", 30, Sun::ahead, 300},
};
constexpr Aspect of_colonnade[] = {
    {"street", 35, Sun::aside, 110}, {"street", 88, Sun::aside, 110}, {"street", 12, Sun::ahead, 80},
    {"street", 3, Sun::aside, 60},   {"hill", 35, Sun::ahead, 120},   {"hill", 15, Sun::behind, 120},
    {"down", 60, Sun::aside, 80},    {"down", 20, Sun::aside, 80},    {"up", 35, Sun::ahead, 80},
    {"up", 8, Sun::behind, 60},
};
constexpr Aspect of_forest[] = {
    {"street", 60, Sun::aside, 90}, {"street", 35, Sun::behind, 90}, {"street", 12, Sun::ahead, 90},
    {"street", 3, Sun::aside, 60},  {"hill", 35, Sun::aside, 120},   {"hill", 10, Sun::ahead, 120},
    {"down", 88, Sun::behind, 60},  {"down", 30, Sun::aside, 60},    {"up", 50, Sun::ahead, 60},
    {"up", 20, Sun::aside, 60},
};
constexpr Aspect of_model[] = {
    {"front", 35, Sun::aside, 60},
    {"low_sun", 12, Sun::ahead, 60},
};

std::span<Aspect const> aspects_of(std::string_view scene) {
    if (scene == "town") return of_town;
    if (scene == "colonnade") return of_colonnade;
    if (scene == "forest") return of_forest;
    return of_model;
}

glm::dvec3 travel(glm::dvec3 const& forward, Aspect const& aspect) {
    glm::dvec3 const ahead = glm::normalize(glm::dvec3(forward.x, 0.0, forward.z));
    glm::dvec3 const aside(-ahead.z, 0.0, ahead.x);
    glm::dvec3 const level = aspect.sun == Sun::behind ? ahead : aspect.sun == Sun::ahead ? -ahead : aside;
    double const elevation = glm::radians(double(aspect.elevation_degrees));
    return std::cos(elevation) * level - std::sin(elevation) * glm::dvec3(0.0, 1.0, 0.0);
}

std::string_view name_of(Sun sun) {
    return sun == Sun::behind ? "behind" : sun == Sun::ahead ? "ahead" : "aside";
}

}  // namespace

std::vector<scenes::View> study_views(scenes::NamedScene const& named) {
    std::vector<scenes::View> views;
    for (Aspect const& aspect : aspects_of(named.scene.name))
        for (scenes::View view : named.views) {
            if (view.name != aspect.place) continue;
            view.name += "-" + std::to_string(aspect.elevation_degrees) + "-" + std::string(name_of(aspect.sun));
            view.light_travel = travel(view.forward, aspect);
            view.shadow_distance = aspect.shadow_distance;
            views.push_back(view);
        }
    return views;
}

}  // namespace shadowmath::quality
