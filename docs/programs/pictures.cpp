// SPDX-License-Identifier: MIT
//
//   pictures FOLDER     the pictures of those pages that no example draws
//
// Nothing is drawn from memory: every number comes out of the headers.
#include "examples/support/drawing.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/gpu.hpp>

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <string>

namespace sm = shadowmath;
using sm::example::Drawing;

namespace {

std::string number(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

// What each named convention does to the same picture: where y and v count from, and what depths the two ends have.
void conventions(std::filesystem::path const& folder) {
    struct {
        char const* name;
        sm::ClipSpace clip;
    } const all[] = {{"gl_clip", sm::gl_clip},
                     {"gl_zero_to_one_clip", sm::gl_zero_to_one_clip},
                     {"vulkan_clip", sm::vulkan_clip},
                     {"d3d_clip, metal, webgpu", sm::d3d_clip},
                     {"reversed(vulkan_clip)", sm::reversed(sm::vulkan_clip)}};
    Drawing drawing("One picture in five conventions: NDC y, texture v, depth", {0, -2.1}, {25.5, 5.0}, 900);
    double x = 0.4;
    for (auto const& [name, clip] : all) {
        glm::mat4 const clip_from_canonical = sm::clip_from_canonical<float>(clip);
        float const top = (clip_from_canonical * glm::vec4(0, 1, 0, 1)).y;
        float const first = (clip_from_canonical * glm::vec4(0, 0, 0, 1)).z;
        float const last = (clip_from_canonical * glm::vec4(0, 0, 1, 1)).z;
        float const v_at_top = (sm::texture_from_clip<float>(clip) * glm::vec4(0, top, 0, 1)).y;
        drawing.box({x, 0}, {x + 4.2, 3.2}, "ground");
        auto const arrow = [&](double at, bool up, char const* css_class) {
            double const head = up ? 2.8 : 0.4, tail = up ? 0.4 : 2.8, back = up ? -0.3 : 0.3;
            drawing.line({at, tail}, {at, head}, css_class);
            drawing.path({{at - 0.18, head + back}, {at, head}, {at + 0.18, head + back}}, css_class);
        };
        arrow(x + 1.0, top > 0, "s0");
        arrow(x + 2.6, v_at_top > 0.5f, "s1");
        drawing.label({x + 1.0, 1.5}, "y", "start", {6, 4});
        drawing.label({x + 2.6, 1.5}, "v", "start", {6, 4});
        drawing.label({x, 3.2}, name, "start", {0, -8});
        drawing.label({x, 0}, "near " + number(first) + ", far " + number(last), "start", {0, 18}, "small");
        drawing.label({x, 0}, "cleared to " + number(sm::far_depth<float>(clip)), "start", {0, 34}, "small");
        x += 5.0;
    }
    drawing.write(folder / "conventions.svg");
}

// How wrong the far corners are: from four sides, and from the inverse of a view-projection.
void view_volume(std::filesystem::path const& folder) {
    Drawing drawing("Error of the far corner, as a part of the far distance (near 0.1 m, float)", {1.4, -7.6},
                    {7.6, 0.6}, 720, 340);
    std::vector<glm::dvec2> sides, inverse;
    for (double decade = 2.0; decade <= 7.01; decade += 0.25) {
        auto const far_metres = static_cast<float>(std::pow(10.0, decade));
        sm::Pose<float> const pose =
            sm::pose_looking(glm::vec3(3, 2, 5), glm::vec3(0.3f, -0.2f, -1), glm::vec3(0, 1, 0));
        auto const view = sm::perspective_view(pose, 1.0f, 1.6f, 0.1f, far_metres);
        sm::ViewVolume<double> exact{
            {glm::dvec3(pose.position), glm::dvec3(pose.right), glm::dvec3(pose.up), glm::dvec3(pose.forward)},
            view.left,
            view.right,
            view.bottom,
            view.top,
            view.z_near,
            view.z_far};
        glm::vec4 const unprojected = glm::inverse(sm::clip_from_world(view, sm::gl_clip)) * glm::vec4(1, 1, 1, 1);
        auto const error = [&](glm::vec3 corner) {
            double const apart = glm::length(glm::dvec3(corner) - sm::corners(exact)[7]) / double(far_metres);
            return std::isfinite(apart) ? std::clamp(std::log10(apart + 1e-9), -7.5, 0.5) : 0.5;
        };
        sides.emplace_back(decade, error(sm::corners(view)[7]));
        inverse.emplace_back(decade, error(glm::vec3(unprojected) / unprojected.w));
    }
    for (int decade = 2; decade <= 7; ++decade) {
        drawing.line({decade, -7.2}, {decade, 0.4}, "faint");
        drawing.label({decade, -7.2}, "far 1e" + std::to_string(decade), "middle", {0, 14}, "small");
    }
    for (int decade = -6; decade <= 0; decade += 2)
        drawing.label({1.5, decade}, "1e" + std::to_string(decade), "start", {0, 4}, "small");
    drawing.path(inverse, "s1");
    drawing.path(sides, "s0");
    drawing.label(inverse[10], "inverse of the view-projection", "end", {-8, -6});
    drawing.label(sides[10], "sides of the view", "middle", {0, -10});
    drawing.write(folder / "view_volume.svg");
}

// The first axis of light space while the sun passes the zenith, a little beside it.
void light(std::filesystem::path const& folder) {
    Drawing drawing("A sun passes the zenith by half a degree: how far the map has turned", {-11, -20}, {13.5, 205},
                    720, 320);
    std::vector<glm::dvec2> ours, usual;
    constexpr double degree = 0.017453292519943295;
    glm::dvec3 our_first(0.0), usual_first(0.0);
    auto const turned = [&](glm::dvec3 const& axis, glm::dvec3& first) {
        if (first == glm::dvec3(0.0)) first = axis;
        return std::acos(std::clamp(glm::dot(axis, first), -1.0, 1.0)) / degree;
    };
    for (double angle = -10.0; angle <= 10.01; angle += 0.125) {
        glm::dvec3 const travel =
            glm::normalize(glm::dvec3(std::sin(angle * degree), -std::cos(angle * degree), std::sin(0.5 * degree)));
        ours.emplace_back(angle, turned(sm::light_basis(travel).x, our_first));
        usual.emplace_back(angle, turned(glm::normalize(glm::cross(travel, glm::dvec3(0, 1, 0))), usual_first));
    }
    for (int degrees = 0; degrees <= 180; degrees += 90) {
        drawing.line({-10, degrees}, {10, degrees}, "faint");
        drawing.label({-10, degrees}, std::to_string(degrees) + " degrees", "start", {0, -4}, "small");
    }
    for (int angle = -10; angle <= 10; angle += 5)
        drawing.label({angle, 0}, std::to_string(angle), "middle", {0, 16}, "small");
    drawing.path(usual, "s1");
    drawing.path(ours, "s0");
    drawing.label({10, usual.back().y}, "cross(light, up)", "end", {0, -8});
    drawing.label({10, ours.back().y}, "light_basis", "end", {0, -8});
    drawing.write(folder / "light.svg");
}

// sm_Cascade as it lies in memory.
void gpu(std::filesystem::path const& folder) {
    struct {
        char const* name;
        std::size_t begin, end;
    } const members[] = {{"clip_from_world", 0, offsetof(sm::GpuShadowMap, w_min)},
                         {"w_min", offsetof(sm::GpuShadowMap, w_min), offsetof(sm::GpuShadowMap, depth_order)},
                         {"depth_order", offsetof(sm::GpuShadowMap, depth_order), offsetof(sm::GpuShadowMap, flip_v)},
                         {"flip_v", offsetof(sm::GpuShadowMap, flip_v), offsetof(sm::GpuShadowMap, visible)},
                         {"visible", offsetof(sm::GpuShadowMap, visible), sizeof(sm::GpuShadowMap)},
                         {"constant", offsetof(sm::GpuCascade, bias),
                          offsetof(sm::GpuCascade, bias) + offsetof(sm::GpuMapBias, per_inverse_w)},
                         {"per_inverse_w", offsetof(sm::GpuCascade, bias) + 4, offsetof(sm::GpuCascade, bias) + 8},
                         {"slope_texels", offsetof(sm::GpuCascade, bias) + 8, offsetof(sm::GpuCascade, bias) + 12},
                         {"slope_limit", offsetof(sm::GpuCascade, bias) + 12, sizeof(sm::GpuCascade)}};
    Drawing drawing("sm_Cascade, bytes in std140 and std430 alike: rows of sixteen", {-1.5, -0.4}, {16.4, 6.4}, 720,
                    300);
    int colour = 0;
    for (auto const& [name, begin, end] : members) {
        for (std::size_t row = begin / 16; row * 16 < end; ++row) {
            double const left = double(std::max(begin, row * 16) - row * 16),
                         right = double(std::min(end, row * 16 + 16) - row * 16);
            double const top = 6.0 - double(row);
            drawing.box({left, top - 1}, {right, top},
                        "c" + std::to_string(begin < sizeof(sm::GpuShadowMap) ? colour % 2 : 2 + colour % 2));
            bool const rows_of_matrix = end - begin > 16;
            drawing.label({0.5 * (left + right), top - 0.5},
                          rows_of_matrix ? std::string(name) + "[" + std::to_string(row) + "]" : name, "middle", {0, 4},
                          "small");
            if (begin % 16 == 0 || rows_of_matrix)
                drawing.label({-0.2, top - 0.5}, std::to_string(row * 16), "end", {0, 4}, "small");
        }
        ++colour;
    }
    drawing.write(folder / "gpu.svg");
}

// What four cascades make of bad data.
void fault(std::filesystem::path const& folder) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    Drawing drawing("What four cascades make of bad data: maps that serve, and what is said", {0, -0.3}, {24, 10.3},
                    760, 400);
    double row = 9.4;
    auto const show = [&](char const* what, auto const& spoil) {
        auto const pose = sm::pose_looking(glm::vec3(0, 2, 0), glm::vec3(0, 0, -1), glm::vec3(0, 1, 0));
        auto view = sm::perspective_view(pose, 1.0f, 1.6f, 0.1f, 200.0f);
        auto sun = sm::directional(glm::vec3(0.4f, -1, 0.2f));
        sm::Aabb<float> casters{glm::vec3(-50, 0, -200), glm::vec3(50, 20, 10)};
        sm::CascadeOptions<float> options;
        spoil(view, sun, casters, options);
        auto const cascades = sm::fit_cascades(view, sun, casters, casters, options);
        drawing.label({0.2, row}, what, "start", {0, 4});
        for (int i = 0; i < 4; ++i) {
            bool const serves = i < cascades.count && cascades.at[i].map.visible;
            drawing.box({9.6 + 0.8 * i, row - 0.32}, {10.2 + 0.8 * i, row + 0.32}, serves ? "c2" : "ground");
        }
        drawing.label({13.2, row}, sm::describe(cascades.faults), "start", {0, 4}, "small");
        row -= 1.0;
    };
    show("nothing wrong", [](auto&, auto&, auto&, auto&) {});
    show("an eye at NaN", [](auto& view, auto&, auto&, auto&) { view.pose.position.x = nan; });
    show("a light without direction", [](auto&, auto& sun, auto&, auto&) { sun = sm::directional(glm::vec3(0.0f)); });
    show("a light straight up the up axis",
         [](auto&, auto& sun, auto&, auto&) { sun = sm::directional(glm::vec3(0, 1, 0)); });
    show("near = 0", [](auto& view, auto&, auto&, auto&) { view.z_near = 0.0f; });
    show("far = infinity", [](auto& view, auto&, auto&, auto&) { view.z_far = infinity; });
    show("near beyond far", [](auto& view, auto&, auto&, auto&) { view.z_near = 300.0f; });
    show("a window of no width", [](auto& view, auto&, auto&, auto&) { view.left = view.right = 0.0f; });
    show("a map of 4 texels", [](auto&, auto&, auto&, auto& options) { options.map_size = 4; });
    show("no casters", [](auto&, auto&, auto& casters, auto&) { casters = {}; });
    drawing.write(folder / "fault.svg");
}

}  // namespace

int main(int argc, char** argv) {
    try {
        std::filesystem::path const folder = argc > 1 ? argv[1] : ".";
        for (auto const draw : {conventions, view_volume, light, gpu, fault}) draw(folder);
        return EXIT_SUCCESS;
    } catch (std::exception const& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return EXIT_FAILURE;
    }
}
