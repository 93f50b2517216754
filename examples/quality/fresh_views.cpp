// SPDX-License-Identifier: MIT
#include "examples/quality/fresh_views.hpp"

#include "scenes/random.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace shadowmath::quality {
namespace {

using scenes::Random;
using scenes::View;

constexpr double circle = 6.283185307179586;
constexpr double closest = 0.7;  // metres, of the eye to anything
constexpr glm::dvec3 above{0.0, 1.0, 0.0};

struct Height {
    double metres;
    double lowest_pitch, highest_pitch;  // degrees
};
constexpr std::array<Height, 8> heights{{{1.7, -20, 12},
                                         {1.7, -20, 12},
                                         {1.7, -20, 12},
                                         {1.7, -20, 12},
                                         {6, -30, 0},
                                         {6, -30, 0},
                                         {20, -45, -10},
                                         {45, -70, -15}}};

glm::dvec3 direction(double azimuth, double elevation) {
    return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation), std::cos(elevation) * std::sin(azimuth)};
}

// The lowest surface at a place that only the sky is above.
std::optional<double> open_ground(oracle::RayOracle const& oracle, double x, double z) {
    constexpr double top = 500.0;
    auto const hit = oracle.first_hit({x, top, z}, -above);
    if (!hit) return std::nullopt;
    double const height = top - hit->distance;
    bool const solid = !oracle.first_hit({x, height - 0.05, z}, -above);
    return solid ? std::optional(height) : std::nullopt;
}

bool is_worth_a_look(oracle::RayOracle const& oracle, View const& view) {
    constexpr int across = 16, up = 9;
    glm::dvec3 const right = glm::normalize(glm::cross(view.forward, view.up)), top = glm::cross(right, view.forward);
    double const half_y = std::tan(view.fov_y_radians / 2.0), half_x = half_y * across / up;
    int met = 0;
    for (int j = 0; j < up; ++j)
        for (int i = 0; i < across; ++i) {
            double const x = half_x * (2.0 * (i + 0.5) / across - 1.0), y = half_y * (2.0 * (j + 0.5) / up - 1.0);
            auto const hit = oracle.first_hit(view.eye, glm::normalize(view.forward + right * x + top * y));
            if (!hit) continue;
            if (hit->distance < closest) return false;
            met += hit->distance < view.shadow_distance ? 1 : 0;
        }
    return 3 * met >= across * up;
}

void light(View& view, Random& random, double farthest) {
    double const azimuth = random.between(0.0, circle);
    double const elevation = random.between(glm::radians(3.0), glm::radians(88.0));
    view.light_travel = -direction(azimuth, elevation);
    view.shadow_distance = 60.0 * std::pow(farthest / 60.0, random.unit());
    view.fov_y_radians = glm::radians(random.between(46.0, 66.0));
    view.has_spot = false;
}

std::optional<View> drawn(oracle::RayOracle const& oracle, Random& random, Height const& height, double farthest) {
    View view;
    double const radius = 60.0 * std::sqrt(random.unit()), bearing = random.between(0.0, circle);
    double const x = radius * std::cos(bearing), z = radius * std::sin(bearing);
    double const yaw = random.between(0.0, circle);
    double const pitch = glm::radians(random.between(height.lowest_pitch, height.highest_pitch));
    light(view, random, farthest);
    auto const ground = open_ground(oracle, x, z);
    if (!ground) return std::nullopt;
    view.eye = {x, *ground + height.metres, z};
    view.forward = direction(yaw, pitch);
    return is_worth_a_look(oracle, view) ? std::optional(view) : std::nullopt;
}

std::optional<View> drawn_around(View const& front, oracle::RayOracle const& oracle, Random& random) {
    View view = front;
    double const size = front.eye.z / 2.3;  // as a model's stage places its front view
    double const distance = size * random.between(1.3, 3.0), bearing = random.between(0.0, circle);
    double const elevation = glm::radians(random.between(5.0, 50.0));
    glm::dvec3 const middle = front.eye + front.forward * glm::length(glm::dvec2(0.8, 2.3)) * size;
    glm::dvec3 const target(0.0, std::max(0.2, middle.y), 0.0);
    view.eye = target + direction(bearing, elevation) * distance;
    view.forward = glm::normalize(target - view.eye);
    light(view, random, 60.0);
    return is_worth_a_look(oracle, view) ? std::optional(view) : std::nullopt;
}

}  // namespace

std::vector<View> fresh_views(scenes::NamedScene const& named, oracle::RayOracle const& oracle, std::uint64_t seed) {
    std::uint64_t of_name = seed;
    for (char const c : named.scene.name)
        of_name = scenes::mix_bits(of_name + std::uint64_t(static_cast<unsigned char>(c)));
    Random random(of_name);
    bool const built_in = std::ranges::count(scenes::scene_names(), named.scene.name) > 0;
    double const farthest = named.scene.name == "town" ? 800.0 : 150.0;
    std::vector<View> views;
    auto const add = [&](auto const& draw) {
        constexpr int most = 1000;
        for (int i = 0; i < most; ++i)
            if (std::optional<View> view = draw()) {
                view->name = "fresh-" + std::to_string(views.size() + 1);
                views.push_back(*view);
                return;
            }
        throw std::runtime_error(named.scene.name + ": no place to look from");
    };
    if (built_in)
        for (Height const& height : heights) add([&] { return drawn(oracle, random, height, farthest); });
    else
        add([&] { return drawn_around(named.views.front(), oracle, random); });
    return views;
}

}  // namespace shadowmath::quality
