// SPDX-License-Identifier: MIT
#include "examples/doctor/find.hpp"

#include <shadowmath/tangent.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace shadowmath::doctor {

char const* id(Ill ill) {
    switch (ill) {
        case Ill::singular: return "singular";
        case Ill::transposed: return "transposed";
        case Ill::other_light: return "other-light";
        case Ill::backwards: return "backwards";
        case Ill::wrong_clip: return "wrong-clip";
        case Ill::same_matrix: return "same-matrix";
        case Ill::ranges: return "ranges";
        case Ill::uncovered: return "uncovered";
        case Ill::past_far_end: return "past-far-end";
        case Ill::casters_cut: return "casters-cut";
        case Ill::filter_margin: return "filter-margin";
        case Ill::texels_wasted: return "texels-wasted";
        case Ill::depth_coarse: return "depth-coarse";
        case Ill::precision: return "precision";
        case Ill::shimmer: return "shimmer";
        case Ill::bias_small: return "bias-small";
        case Ill::bias_large: return "bias-large";
    }
    return "";
}

int Diagnosis::faults() const {
    return static_cast<int>(std::ranges::count_if(findings, [](Finding const& finding) { return finding.fault; }));
}

void Examination::fault(Ill ill, std::size_t map, std::string what, std::string mend) {
    found.findings.push_back({ill, static_cast<int>(map), true, std::move(what), std::move(mend)});
}

void Examination::remark(Ill ill, std::size_t map, std::string what, std::string mend) {
    found.findings.push_back({ill, static_cast<int>(map), false, std::move(what), std::move(mend)});
}

double texel_at(ShadowMap<double> const& map, int size, glm::dvec3 point) {
    Projected<double> const at = projected(map.clip_from_world, point);
    if (!at.in_front) return 0.0;
    glm::dvec3 const w(row(map.clip_from_world, 3));
    double const x = glm::length(glm::dvec3(row(map.clip_from_world, 0)) - w * at.at.x) / at.w;
    double const y = glm::length(glm::dvec3(row(map.clip_from_world, 1)) - w * at.at.y) / at.w;
    return bounded_quotient(2.0, size * std::min(x, y), 1e12);
}

bool is_affine(ShadowMap<double> const& map) {
    glm::dvec4 const w = row(map.clip_from_world, 3);
    return glm::length(glm::dvec3(w)) <= 1e-7 * std::abs(w.w);
}

std::string digits(double number) {
    char text[40];
    double const size = std::abs(number);
    int const after = size >= 99.95 || size < 1e-12 ? 0 : size >= 9.995 ? 1 : size >= 0.9995 ? 2 : 3;
    if (size >= 0.00995 || size < 1e-12)
        std::snprintf(text, sizeof text, "%.*f", after, number);
    else
        std::snprintf(text, sizeof text, "%.1e", number);
    return text;
}

std::string percent(double share) {
    return digits(share * 100.0) + " %";
}

Diagnosis diagnose(Case const& read, Sight const& sight) {
    Examination examination{read, sight, {}, {}, {}, {}};
    std::size_t const count = read.frame.maps.size();
    for (EngineMap const& map : read.frame.maps) examination.maps.push_back(map_of(map, read.clip));
    examination.points.resize(count);
    examination.sound.assign(count, true);
    Diagnosis& found = examination.found;
    found.maps.resize(count);
    found.lost_cut.assign(sight.points.size(), false);
    found.acne.assign(sight.points.size(), false);
    for (std::size_t i = 0; i < sight.points.size(); ++i) {
        Seen const& seen = sight.points[i];
        found.places.push_back(place_of(read, read.frame, examination.maps, seen.point, seen.eye_depth));
        int const map = found.places.back().map;
        if (map >= 0) examination.points[static_cast<std::size_t>(map)].push_back(static_cast<int>(i));
    }
    find_law(examination);
    find_coverage(examination);
    find_waste(examination);
    find_shimmer(examination);
    find_bias(examination);
    measure(examination);
    std::ranges::stable_sort(found.findings, {}, [](Finding const& finding) {
        return std::pair(finding.fault ? 0 : 1, static_cast<int>(finding.ill));
    });
    return std::move(examination.found);
}

}  // namespace shadowmath::doctor
