// SPDX-License-Identifier: MIT
#include "examples/doctor/find.hpp"

#include <shadowmath/stillness.hpp>

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace shadowmath::doctor {
namespace {

constexpr double still = 1.0 / 16.0;  // texels: nobody sees less

// Why points moved, of two maps without a perspective of their own.
std::string reason(ShadowMap<double> const& before, ShadowMap<double> const& after, std::string& mend) {
    if (!is_affine(before) || !is_affine(after)) {
        mend = "warped maps always do; fit the maps of a moving camera to spheres, or hide it in a temporal filter.";
        return "the maps are warped";
    }
    glm::dvec3 const a(row(before.clip_from_world, 0)), b(row(after.clip_from_world, 0));
    double const growth = glm::length(a) / glm::length(b) - 1.0;
    double const turn = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    if (std::abs(turn) > 1e-5) {
        mend = "give the map an up vector that is fixed in the world, not the camera's.";
        return "the map turned about the light by " + digits(glm::degrees(turn)) + " degrees";
    }
    if (std::abs(growth) > 1e-6) {
        mend = "keep the map's size from frame to frame: the bounding sphere of the slice does not change when the "
               "camera turns, a box around its corners does.";
        return "its texels became " + percent(std::abs(growth)) + (growth > 0.0 ? " longer" : " shorter");
    }
    mend = "move the map by whole texels: round the light-space centre to a multiple of the texel before the matrix is "
           "built (texel_grid.hpp does).";
    return "the map moved by a part of a texel";
}

void find_moves(Examination& e, std::size_t m, std::vector<ShadowMap<double>> const& next) {
    std::vector<double> shimmer;
    for (int const i : e.points[m]) {
        Seen const& seen = e.seen(i);
        if (e.found.places[static_cast<std::size_t>(i)].served != Served::yes) continue;
        double const depth = eye_depth(e.read.next->camera, seen.point);
        Place const later = place_of(e.read, *e.read.next, next, seen.point, depth);
        if (later.map != static_cast<int>(m)) continue;
        TexelShift<double> const shift = texel_shift(e.maps[m], next[m], e.read.frame.maps[m].size, seen.point);
        if (shift.ok) shimmer.push_back(shimmer_texels(shift));
    }
    double const p95 = percentile(shimmer, 0.95);
    if (shimmer.size() < 10 || p95 <= still) return;
    std::string mend;
    std::string const why = reason(e.maps[m], next[m], mend);
    e.fault(Ill::shimmer, m,
            "shadow edges crawl when the camera moves: between the two frames points moved within their texel by up "
            "to " +
                digits(p95) + " of it (95th percentile); " + why + ".",
            mend);
}

}  // namespace

void find_shimmer(Examination& e) {
    for (std::size_t m = 0; m < e.maps.size(); ++m) {
        if (!e.sound[m] || !is_affine(e.maps[m])) continue;
        double texels = 0.0;
        for (int axis = 0; axis < 2; ++axis)
            texels = std::max(texels, std::abs(row(e.maps[m].clip_from_world, axis).w) * e.read.frame.maps[m].size / 2);
        if (texels < double(1 << 20)) continue;
        e.fault(Ill::precision, m,
                "lies " + digits(texels) +
                    " texels from the world's origin: a float matrix cannot place a point to a "
                    "sixteenth of a texel there.",
                "fit in double and hand the shader positions relative to the camera.");
    }
    if (!e.read.next) return;
    Frame const& later = *e.read.next;
    if (e.read.frame.light.direction != later.light.direction || e.read.frame.light.position != later.light.position) {
        e.found.findings.push_back({Ill::shimmer, -1, false, "the light moved between the frames, so all shadows do.",
                                    "move it in steps, or rarely; state two frames of one light to see what the camera "
                                    "alone does."});
        return;
    }
    std::vector<ShadowMap<double>> next;
    for (EngineMap const& map : later.maps) next.push_back(map_of(map, e.read.clip));
    for (std::size_t m = 0; m < e.maps.size(); ++m)
        if (e.sound[m]) find_moves(e, m, next);
}

}  // namespace shadowmath::doctor
