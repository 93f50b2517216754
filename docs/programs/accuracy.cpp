// SPDX-License-Identifier: MIT
//
//   accuracy TABLE PICTURE     how far float is from long double, function by function
//
// Each function is computed twice from the same float inputs: with T = float and with T = long double. TABLE gets the
// rows of docs/accuracy.md, PICTURE the same as a drawing. The cases are the same every time.
#include "examples/support/drawing.hpp"

#include <shadowmath/bias.hpp>
#include <shadowmath/cascades.hpp>
#include <shadowmath/footprint.hpp>
#include <shadowmath/msm.hpp>
#include <shadowmath/stored_depth.hpp>
#include <shadowmath/vdsm.hpp>
#include <shadowmath/vsm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sm = shadowmath;
using Exact = long double;
using Vec = sm::Vec3<Exact>;

namespace {

constexpr int case_count = 4000, map_size = 2048;
constexpr Exact epsilon = 0x1p-23L;

struct Random {
    std::uint64_t state = 2024;
    float between(float lo, float hi) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return lo + (hi - lo) * (static_cast<float>(state >> 40) * 0x1p-24f);
    }
    glm::vec3 vector(float size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
};

// What a renderer gives the library, in floats.
struct Case {
    sm::ViewVolume<float> view;
    sm::Light<float> sun;
    sm::Light<float> lamp;
    sm::Aabb<float> casters, receivers;
    glm::vec3 point, normal;  // in view, and facing eye and sun
    float depth;
};

template <class T>
sm::ViewVolume<T> in(sm::ViewVolume<float> const& view) {
    sm::Pose<T> const pose{sm::Vec3<T>(view.pose.position), sm::Vec3<T>(view.pose.right), sm::Vec3<T>(view.pose.up),
                           sm::Vec3<T>(view.pose.forward)};
    return {pose, view.left, view.right, view.bottom, view.top, view.z_near, view.z_far, view.kind};
}
template <class T>
sm::Light<T> in(sm::Light<float> const& light) {
    return {
        light.kind,  sm::Vec3<T>(light.direction), sm::Vec3<T>(light.position), light.half_angle_radians, light.range,
        light.faults};
}
template <class T>
sm::Aabb<T> in(sm::Aabb<float> const& box) {
    return {sm::Vec3<T>(box.lo), sm::Vec3<T>(box.hi)};
}

Case drawn(Random& random) {
    Case made;
    glm::vec3 const eye = random.vector(100.0f) * glm::vec3(1.0f, 0.1f, 1.0f) + glm::vec3(0.0f, 12.0f, 0.0f);
    glm::vec3 const forward(random.between(-1, 1), random.between(-0.5f, 0.1f), random.between(-1, 1));
    made.view = sm::perspective_view(sm::pose_looking(eye, forward, glm::vec3(0, 1, 0)), random.between(0.6f, 1.5f),
                                     random.between(1.0f, 2.2f), random.between(0.1f, 1.0f), random.between(80, 400));
    made.sun = sm::directional(glm::vec3(random.between(-1, 1), random.between(-1, -0.3f), random.between(-1, 1)));
    made.depth = random.between(1.0f, 60.0f);
    float const x = random.between(-0.9f, 0.9f), y = random.between(-0.9f, 0.9f);
    made.point = sm::point_at(made.view, made.view.right * x, made.view.top * y, made.depth);
    made.normal = glm::normalize(glm::normalize(eye - made.point) - made.sun.direction + 0.3f * random.vector(1.0f));
    made.lamp = sm::spot(made.point + glm::vec3(random.between(-6, 6), 20.0f, random.between(-6, 6)),
                         glm::vec3(random.between(-0.2f, 0.2f), -1.0f, random.between(-0.2f, 0.2f)), 0.6f, 60.0f);
    made.receivers = {glm::vec3(-600, -40, -600), glm::vec3(600, 60, 600)};
    made.casters = made.receivers;
    return made;
}

Exact distance(sm::Vec3<float> const& rounded, Vec const& exact) {
    return glm::length(Vec(rounded) - exact);
}

// Texels between where the two maps have the point; nothing where the map does not hold it. Still maps may stand whole
// texels apart.
std::optional<Exact> texels_apart(sm::ShadowMap<float> const& rounded, sm::ShadowMap<Exact> const& exact,
                                  Case const& at, bool still = false) {
    if (!rounded.visible || !exact.visible) return {};
    auto const a = sm::projected(sm::texture_from_world(rounded), at.point, rounded.w_min);
    auto const b = sm::projected(sm::texture_from_world(exact), Vec(at.point), exact.w_min);
    if (!a.in_front || !b.in_front || std::abs(b.at.x - 0.5L) > 0.5L || std::abs(b.at.y - 0.5L) > 0.5L) return {};
    auto apart = (sm::Vec2<Exact>(a.at) - sm::Vec2<Exact>(b.at)) * Exact(map_size);
    if (still) apart -= glm::round(apart);
    return std::max(std::abs(apart.x), std::abs(apart.y));
}

template <class T>
sm::ShadowMap<T> first_cascade(Case const& at, sm::CascadeFit kind) {
    sm::CascadeOptions<T> options;
    options.count = 1;
    options.fit = kind;
    options.map_size = map_size;
    options.shadow_distance = T(80);
    return sm::fit_cascades(in<T>(at.view), in<T>(at.sun), in<T>(at.casters), in<T>(at.receivers), options).at[0].map;
}
template <class T>
sm::ShadowMap<T> on_ground(Case const& at) {
    sm::VdsmOptions<T> options;
    options.map_size = map_size;
    auto const ground = sm::plane_through(sm::Vec3<T>(T(0)), sm::Vec3<T>(T(0), T(1), T(0)));
    return sm::view_dependent_map(in<T>(at.view), in<T>(at.sun), ground, in<T>(at.casters), in<T>(at.receivers),
                                  options, sm::gl_zero_to_one_clip);
}
template <class T>
sm::ShadowMap<T> under_lamp(Case const& at) {
    return sm::fit_spot(in<T>(at.view), in<T>(at.lamp), in<T>(at.casters), in<T>(at.receivers), map_size, T(2),
                        sm::gl_zero_to_one_clip);
}
template <class T>
T length_of_footprint(Case const& at) {
    auto const map = first_cascade<T>(at, sm::CascadeFit::tight);
    return sm::footprint(sm::clip_from_world(in<T>(at.view), sm::ClipSpace{}), sm::Vec2<T>(T(1920), T(1080)),
                         map.clip_from_world, T(map_size), sm::Vec3<T>(at.point), sm::Vec3<T>(at.normal))
        .major;
}

struct Row {
    char const* function;
    char const* unit;
    std::function<std::optional<Exact>(Case const&)> error;
};

std::vector<Row> const rows = {
    {"`safe_normalize`", "ε",
     [](Case const& c) {
         return distance(sm::safe_normalize(c.point).direction, sm::safe_normalize(Vec(c.point)).direction) / epsilon;
     }},
    {"`light_basis`", "ε",
     [](Case const& c) {
         auto const a = sm::light_basis(c.sun.direction);
         auto const b = sm::light_basis(Vec(c.sun.direction));
         return std::max(distance(a.x, b.x), distance(a.y, b.y)) / epsilon;
     }},
    {"`corners` of a view", "ε of the way from the origin by the eye",
     [](Case const& c) {
         auto const a = sm::corners(c.view);
         auto const b = sm::corners(in<Exact>(c.view));
         Exact const way = glm::length(Vec(c.view.pose.position)) + glm::length(b[7] - Vec(c.view.pose.position));
         return distance(a[7], b[7]) / way / epsilon;
     }},
    {"`practical_splits`", "ε of the plane",
     [](Case const& c) {
         auto const a = sm::practical_splits(c.view.z_near, c.view.z_far, 4);
         auto const b = sm::practical_splits<Exact>(c.view.z_near, c.view.z_far, 4);
         Exact worst = 0;
         for (int i = 1; i < 4; ++i) worst = std::max(worst, std::abs(a.plane[i] / b.plane[i] - 1));
         return worst / epsilon;
     }},
    {"`bounding_sphere`, radius", "ε of the radius",
     [](Case const& c) {
         return std::abs(sm::bounding_sphere(c.view).radius / sm::bounding_sphere(in<Exact>(c.view)).radius - 1) /
                epsilon;
     }},
    {"`decoded_depth`, reversed, far at infinity", "ε of the depth",
     [](Case const& c) {
         auto endless = c.view;
         endless.z_far = std::numeric_limits<float>::infinity();
         float const stored = c.view.z_near / c.depth;
         Exact const a = sm::decoded_depth(sm::depth_code(endless, sm::reversed(sm::gl_clip)), stored);
         Exact const b =
             sm::decoded_depth(sm::depth_code(in<Exact>(endless), sm::reversed(sm::gl_clip)), Exact(stored));
         return std::abs(a / b - 1) / epsilon;
     }},
    {"`fit_cascades`, tight: place of a point", "texels of 2048",
     [](Case const& c) {
         return texels_apart(first_cascade<float>(c, sm::CascadeFit::tight),
                             first_cascade<Exact>(c, sm::CascadeFit::tight), c);
     }},
    {"`fit_cascades`, stable: place within a texel", "texels of 2048",
     [](Case const& c) {
         return texels_apart(first_cascade<float>(c, sm::CascadeFit::stable),
                             first_cascade<Exact>(c, sm::CascadeFit::stable), c, true);
     }},
    {"`fit_cascades`, warped: place of a point", "texels of 2048",
     [](Case const& c) {
         return texels_apart(first_cascade<float>(c, sm::CascadeFit::warped),
                             first_cascade<Exact>(c, sm::CascadeFit::warped), c);
     }},
    {"`view_dependent_map`: place of a point", "texels of 2048",
     [](Case const& c) { return texels_apart(on_ground<float>(c), on_ground<Exact>(c), c); }},
    {"`fit_spot`: place of a point", "texels of 2048",
     [](Case const& c) { return texels_apart(under_lamp<float>(c), under_lamp<Exact>(c), c); }},
    {"`footprint`, major axis", "ε of the axis",
     [](Case const& c) -> std::optional<Exact> {
         Exact const a = length_of_footprint<float>(c), b = length_of_footprint<Exact>(c);
         if (!(b > 0) || b >= sm::footprint_limit<Exact>) return {};
         return std::abs(a / b - 1) / epsilon;
     }},
    {"`vsm_visibility`", "share of light",
     [](Case const& c) {
         float const depth = c.depth / 64.0f, other = c.normal.y * 0.25f + 0.5f;
         auto const mean = (sm::vsm_moments(depth) + sm::vsm_moments(other)) * 0.5f;
         auto const exact = (sm::vsm_moments<Exact>(depth) + sm::vsm_moments<Exact>(other)) * 0.5L;
         return std::abs(Exact(sm::vsm_visibility(mean, 0.8f, 3e-4f)) - sm::vsm_visibility<Exact>(exact, 0.8f, 3e-4f));
     }},
    {"`msm_visibility`", "share of light",
     [](Case const& c) {
         float const depth = c.depth / 64.0f, other = c.normal.y * 0.25f + 0.5f;
         auto const mean = (sm::msm_moments(depth) + sm::msm_moments(other)) * 0.5f;
         auto const exact = (sm::msm_moments<Exact>(depth) + sm::msm_moments<Exact>(other)) * 0.5L;
         Exact const bias = sm::msm_bias_float<float>;
         return std::abs(Exact(sm::msm_visibility(mean, 0.8f, float(bias))) -
                         sm::msm_visibility<Exact>(exact, 0.8f, bias));
     }},
};

// Two digits, as people write them.
std::string two_digits(Exact value) {
    char text[32];
    int const places = value > 0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(value))), 0, 9) : 0;
    if (value > 0 && value < 1e-3L)
        std::snprintf(text, sizeof text, "%.1Le", value);
    else
        std::snprintf(text, sizeof text, "%.*Lf", places, value);
    return text;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc != 3) throw std::runtime_error("accuracy TABLE PICTURE");
        std::ofstream table(argv[1], std::ios::binary);
        table << "| function | unit | in the middle | 99 of 100 | worst | cases |\n|---|---|---|---|---|---|\n";
        sm::example::Drawing drawing("From the middle to the worst of 4000 cases: float against long double",
                                     {-9.9, -0.4 - double(rows.size())}, {2.4, 0.9}, 720, 460);
        for (int decade = -6; decade <= 2; decade += 2) {
            drawing.line({decade, 0.2}, {decade, -double(rows.size())}, "faint");
            drawing.label({decade, 0.2}, decade == 0 ? "1" : "1e" + std::to_string(decade), "middle", {0, -4}, "small");
        }
        double place = -0.5;
        for (Row const& row : rows) {
            Random random;
            std::vector<Exact> errors;
            for (int i = 0; i < case_count; ++i)
                if (auto const error = row.error(drawn(random))) errors.push_back(*error);
            if (errors.size() < 200) throw std::runtime_error(std::string(row.function) + ": hardly a case counts");
            std::sort(errors.begin(), errors.end());
            auto const at = [&](std::size_t percent) { return errors[(errors.size() - 1) * percent / 100]; };
            table << "| " << row.function << " | " << row.unit << " | " << two_digits(at(50)) << " | "
                  << two_digits(at(99)) << " | " << two_digits(at(100)) << " | " << errors.size() << " |\n";
            auto const x = [](Exact error) { return std::clamp(std::log10(double(error) + 1e-12), -7.0, 2.3); };
            drawing.box({x(at(50)), place - 0.25}, {x(at(99)), place + 0.25}, "c0");
            drawing.line({x(at(99)), place}, {x(at(100)), place}, "s0");
            std::string name = row.function;
            name.erase(std::remove(name.begin(), name.end(), '`'), name.end());
            drawing.label({-9.8, place}, name.substr(0, name.find(": place")), "start", {0, 4}, "small");
            place -= 1.0;
        }
        drawing.write(argv[2]);
        table.close();
        if (!table) throw std::runtime_error(std::string(argv[1]) + ": cannot be written");
        return EXIT_SUCCESS;
    } catch (std::exception const& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return EXIT_FAILURE;
    }
}
