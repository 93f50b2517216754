// SPDX-License-Identifier: MIT
#include "examples/doctor/find.hpp"

#include <shadowmath/bias.hpp>
#include <shadowmath/fit_sphere.hpp>
#include <shadowmath/footprint.hpp>
#include <shadowmath/texel_grid.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace shadowmath::doctor {
namespace {

constexpr double tolerated = 1.3;  // times the texel of the calmest fit that there is

double depth_step(DepthFormat format) {
    return format == DepthFormat::unorm16 ? 0x1p-16 : 0x1p-24;
}

// The eight corners and the ball around them are all that a map of the slice needs.
void find_large_texels(Examination& e, std::size_t m) {
    EngineMap const& map = e.read.frame.maps[m];
    if (!map.range || e.read.frame.light.kind != LightKind::directional || !is_affine(e.maps[m])) return;
    ViewVolume<double> const part = slice(e.read.frame.camera, *map.range);
    Sphere<double> const ball = bounding_sphere(part);
    double const margin = e.read.filter_radius + 1.0;
    if (faults_of_margin(map.size, margin).any() || !(ball.radius > 0.0)) return;
    double const enough = texel_for(ball.radius, map.size, margin);
    double const has = texel_at(e.maps[m], map.size, ball.center);
    if (!(has > enough * tolerated)) return;
    e.fault(Ill::texels_wasted, m,
            "its texels are " + digits(has) + " m long; a ball around its slice, which never shimmers, needs " +
                digits(enough) + " m: " + percent(1.0 - enough * enough / (has * has)) + " of the map is wasted.",
            "fit the map to its own slice of the view, not to the whole view or a rounded radius.");
}

void find_coarse_depth(Examination& e, std::size_t m) {
    if (e.points[m].empty()) return;
    glm::dvec3 const point = e.seen(e.points[m].front()).point;
    double const metre = depth_shift(e.maps[m], e.read.frame.light, point, 1e-3) * 1e3;
    double const texel = texel_at(e.maps[m], e.read.frame.maps[m].size, point);
    if (!(metre > 0.0) || !(depth_step(e.read.depth_format) / metre > 0.25 * texel)) return;
    e.fault(Ill::depth_coarse, m,
            "one step of the stored depth is " + digits(depth_step(e.read.depth_format) / metre) +
                " m, more than a quarter of a texel (" + digits(texel) + " m): surfaces show bands.",
            "shorten the range of depth to what casts and receives, or store more bits.");
}

double used_share(Examination const& e, std::size_t m) {
    constexpr int cells = 32;
    std::array<bool, cells * cells> taken{};
    for (int const i : e.points[m]) {
        glm::dvec3 const at = inside(e.maps[m], e.seen(i).point).at;
        if (!(std::min(at.x, at.y) >= 0.0 && std::max(at.x, at.y) < 1.0)) continue;
        taken[static_cast<std::size_t>(int(at.y * cells) * cells + int(at.x * cells))] = true;
    }
    return double(std::ranges::count(taken, true)) / taken.size();
}

Footprints summary(std::vector<double> const& footprints) {
    return {percentile(footprints, 0.5), percentile(footprints, 0.95), percentile(footprints, 1.0)};
}

}  // namespace

void find_waste(Examination& e) {
    for (std::size_t m = 0; m < e.maps.size(); ++m) {
        if (!e.sound[m]) continue;
        find_large_texels(e, m);
        find_coarse_depth(e, m);
    }
}

void measure(Examination& e) {
    glm::dmat4 const eye = clip_from_world(e.read.frame.camera, ClipSpace{});
    glm::dvec2 const pixels(e.read.picture.width, e.read.picture.height);
    std::vector<double> all;
    for (std::size_t m = 0; m < e.maps.size(); ++m) {
        MapFigures& figures = e.found.maps[m];
        std::vector<double> footprints, texels, depths;
        int const size = e.read.frame.maps[m].size;
        for (int const i : e.points[m]) {
            if (e.found.places[static_cast<std::size_t>(i)].served != Served::yes) continue;
            Seen const& seen = e.seen(i);
            ++figures.points;
            if (!seen.faces_light) continue;
            auto const texel = footprint(eye, pixels, e.maps[m].clip_from_world, double(size), seen.point, seen.normal);
            footprints.push_back(texel.major);
            texels.push_back(texel_at(e.maps[m], size, seen.point));
            double const metre = depth_shift(e.maps[m], e.read.frame.light, seen.point, 1e-3) * 1e3;
            if (metre > 0.0) depths.push_back(1.0 / metre);
        }
        figures.footprint = summary(footprints);
        figures.texel_metres = percentile(texels, 0.5);
        figures.depth_metres = percentile(depths, 0.5);
        figures.used = used_share(e, m);
        all.insert(all.end(), footprints.begin(), footprints.end());
    }
    e.found.footprint = summary(all);
}

}  // namespace shadowmath::doctor
