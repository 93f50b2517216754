// SPDX-License-Identifier: MIT
#include "examples/doctor/find.hpp"

#include <shadowmath/map_ray.hpp>

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace shadowmath::doctor {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double least_error = 1e-3;  // radians: a centimetre aside for a caster ten metres away
constexpr std::size_t enough = 200;   // points

// Those that the map should serve; where that is none, all.
std::vector<glm::dvec3> probes(Examination const& e, std::size_t map) {
    std::vector<glm::dvec3> points;
    for (int const i : e.points[map]) points.push_back(e.seen(i).point);
    if (points.empty())
        for (Seen const& seen : e.sight.points) points.push_back(seen.point);
    std::vector<glm::dvec3> few;
    for (std::size_t i = 0; i < points.size(); i += points.size() / enough + 1) few.push_back(points[i]);
    return few;
}

struct Rays {
    std::vector<double> errors;    // radians
    glm::dvec3 at{0.0}, ray{0.0};  // of one of them
};

Rays rays_of(ShadowMap<double> const& map, Light<double> const& light, std::vector<glm::dvec3> const& points) {
    Rays rays;
    for (glm::dvec3 const& point : points) {
        MapRay<double> const ray = map_ray(map, point);
        if (!ray.ok) continue;
        rays.errors.push_back(light_error_radians(map, light, point));
        rays.at = point;
        rays.ray = ray.direction;
    }
    return rays;
}

std::string vector_text(glm::dvec3 v) {
    return "(" + digits(v.x) + ", " + digits(v.y) + ", " + digits(v.z) + ")";
}

// Of the points between the map's sides, the share that lies beyond its near or far end. Casters may be cut off by
// intent, or by mistake; no fit cuts off what it is meant to see.
struct Misfit {
    double share = 0.0;
    int points = 0;
};

Misfit misfit(Examination const& e, std::size_t m, ClipSpace clip) {
    ShadowMap<double> map = e.maps[m];
    map.clip = clip;
    Misfit result;
    int bad = 0;
    for (int const i : e.points[m]) {
        Seen const& seen = e.seen(i);
        Inside const place = inside(map, seen.point);
        if (!place.in_front || std::abs(place.at.x - 0.5) > 0.5 || std::abs(place.at.y - 0.5) > 0.5) continue;
        ++result.points;
        bad += place.at.z < -1e-3 || place.at.z > 1.0 + 1e-3 ? 1 : 0;
    }
    result.share = result.points > 0 ? double(bad) / result.points : 0.0;
    return result;
}

char const* name_of(DepthOrder order) {
    switch (order) {
        case DepthOrder::zero_to_one: return "0 to 1";
        case DepthOrder::one_to_zero: return "1 to 0";
        case DepthOrder::minus_one_to_one: break;
    }
    return "-1 to 1";
}

// Asked of all maps at once: one function made them.
void find_wrong_clip(Examination& e) {
    if (e.read.clip.depth == DepthOrder::one_to_zero) return;
    ClipSpace other = e.read.clip;
    other.depth = other.depth == DepthOrder::zero_to_one ? DepthOrder::minus_one_to_one : DepthOrder::zero_to_one;
    std::vector<std::size_t> fit_other;
    bool is_wrong = false;
    for (std::size_t m = 0; m < e.maps.size(); ++m) {
        if (!e.sound[m]) continue;
        Misfit const stated = misfit(e, m, e.read.clip), tried = misfit(e, m, other);
        if (tried.share <= 0.002) fit_other.push_back(m);
        if (stated.points < 20 || stated.share < 0.05 || tried.share > 0.002) continue;
        is_wrong = true;
        e.fault(Ill::wrong_clip, m,
                "made for another order of depth than the file states. With depth from " +
                    std::string(name_of(e.read.clip.depth)) + ", " + percent(stated.share) +
                    " of the points that it should serve lie beyond its near or far plane; with depth from " +
                    name_of(other.depth) + ", " + percent(tried.share) + ".",
                std::string("build the projection for depth from ") + name_of(e.read.clip.depth) +
                    (other.depth == DepthOrder::minus_one_to_one
                         ? " (glm: orthoRH_ZO instead of ortho; or glClipControl, if this is OpenGL)."
                         : " (glm: orthoRH_NO)."));
    }
    if (is_wrong)
        for (std::size_t const m : fit_other) e.sound[m] = false;
}

void find_same(Examination& e) {
    for (std::size_t m = 1; m < e.maps.size(); ++m)
        for (std::size_t before = 0; before < m; ++before) {
            if (e.maps[m].clip_from_world != e.maps[before].clip_from_world) continue;
            e.fault(Ill::same_matrix, m, "has the very matrix of \"" + e.name(before) + "\".",
                    "look at what is bound when it is drawn: a constant buffer written once for all maps does this.");
            break;
        }
}

}  // namespace

void find_law(Examination& e) {
    Light<double> const& light = e.read.frame.light;
    find_same(e);
    for (std::size_t m = 0; m < e.maps.size(); ++m) {
        std::vector<glm::dvec3> const points = probes(e, m);
        if (points.empty()) continue;
        Rays const rays = rays_of(e.maps[m], light, points);
        double const error = percentile(rays.errors, 0.5);
        if (!rays.errors.empty() && error <= least_error) continue;
        e.sound[m] = false;
        ShadowMap<double> turned = e.maps[m];
        turned.clip_from_world = glm::transpose(turned.clip_from_world);
        Rays const other = rays_of(turned, light, points);
        if (other.errors.size() * 2 > points.size() &&
            std::min(percentile(other.errors, 0.5), pi - percentile(other.errors, 0.5)) <= least_error) {
            e.fault(Ill::transposed, m, "rows and columns are exchanged: its transpose is a map of this light.",
                    "state \"matrices\": the other way; in a shader, exchange mul(v, M) and mul(M, v), or transpose on "
                    "upload.");
        } else if (rays.errors.empty()) {
            e.fault(Ill::singular, m,
                    "the matrix shows none of the points: it is singular there, or they lie behind it (w <= 0).",
                    "a light parallel to the up vector of lookAt does this, and an extent of zero.");
        } else if (error >= pi - least_error) {
            e.fault(Ill::backwards, m, "depth falls along the light: the map keeps what is farthest from the light.",
                    e.read.clip.depth == DepthOrder::one_to_zero
                        ? "either depth is not reversed after all, or \"travel\" is the way to the light: give the way "
                          "it goes."
                        : "either depth is reversed (state \"reversed_depth\": true), or \"travel\" is the way to the "
                          "light: give the way it goes.");
        } else {
            double const aside = std::tan(std::min(error, 1.5)) * 10.0;
            e.fault(Ill::other_light, m,
                    "not a shadow map of this light. At " + vector_text(rays.at) + " it is a map of light that goes " +
                        vector_text(rays.ray) + "; yours goes " + vector_text(-toward(light, rays.at)) + ", " +
                        digits(glm::degrees(error)) + " degrees apart: what stands 10 m away throws its shadow " +
                        digits(aside) + " m aside.",
                    "fit the map to the light of the same frame: one that was not redrawn since the light moved does "
                    "this, and a direction that went through another transformation.");
        }
    }
    find_wrong_clip(e);
}

}  // namespace shadowmath::doctor
