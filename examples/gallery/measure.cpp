// SPDX-License-Identifier: MIT
#include "examples/gallery/measure.hpp"

#include <shadowmath/footprint.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace shadowmath::gallery {
namespace {

glm::dvec3 xyz(backend::Texel4 const& texel) {
    return {texel.x, texel.y, texel.z};
}

// Drivers may resolve a silhouette differently; such a pixel shows another surface than the one that was judged.
bool same_surface(glm::dvec3 seen, glm::dvec3 judged, glm::dvec3 eye) {
    return glm::distance(seen, judged) <= 1e-3 * glm::distance(judged, eye);
}

Outcome outcome_of(Question question, bool lit, bool truly_lit) {
    switch (question) {
        case Question::none: return Outcome::unasked;
        case Question::beyond: return Outcome::beyond;
        case Question::near_edge:
            return lit == truly_lit ? Outcome::right : lit ? Outcome::edge_light : Outcome::edge_shadow;
        case Question::off_edge: break;
    }
    return lit == truly_lit ? Outcome::right : lit ? Outcome::false_light : Outcome::false_shadow;
}

// Marks the texels that the filter reads around a point.
void touch(backend::Image<std::uint8_t>& texels, glm::dmat4 const& clip_from_world, glm::dvec3 point) {
    glm::dvec4 const clip = clip_from_world * glm::dvec4(point, 1.0);
    if (!(clip.w > 0.0)) return;
    int const size = texels.extent.width;
    glm::dvec2 const home = glm::floor((glm::dvec2(clip) / clip.w * 0.5 + 0.5) * double(size));
    if (!(std::abs(home.x) < 1e6 && std::abs(home.y) < 1e6)) return;
    auto const reach = [size](double centre, int tap) { return std::clamp(static_cast<int>(centre) + tap, 0, size); };
    for (int y = reach(home.y, -filter_radius); y < reach(home.y, filter_radius + 1); ++y)
        for (int x = reach(home.x, -filter_radius); x < reach(home.x, filter_radius + 1); ++x) texels.at(x, y) = 1;
}

void summarise_footprints(Record& record, std::vector<float> footprints) {
    if (footprints.empty()) return;
    record.footprint_mean =
        std::accumulate(footprints.begin(), footprints.end(), 0.0) / static_cast<double>(footprints.size());
    auto const p95 =
        footprints.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(footprints.size() - 1));
    std::nth_element(footprints.begin(), p95, footprints.end());
    record.footprint_p95 = *p95;
    record.footprint_max = *std::max_element(p95, footprints.end());
}

double share(long part, long whole) {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

}  // namespace

Measurement measure(ViewTruth const& truth, MapSet const& maps, backend::Frame const& frame) {
    backend::Extent const extent = truth.state.extent;
    Measurement result{{}, backend::Image<Outcome>(extent), backend::Image<float>(extent), {}};
    Record& record = result.record;
    record.map_size = maps.map_size;
    record.maps = static_cast<int>(maps.maps.size());
    record.splits = maps.splits;
    record.note = maps.note;
    result.touched.assign(maps.maps.size(), backend::Image<std::uint8_t>({maps.map_size, maps.map_size}));

    glm::dmat4 const eye_clip_from_world(maps.frame.clip_from_world);
    glm::dvec3 const eye(maps.frame.eye_position);
    glm::dvec2 const eye_pixels(extent.width, extent.height);
    std::vector<float> footprints;
    long wrong = 0, wrong_off_edge = 0;
    for (std::size_t i = 0; i < truth.question.pixels.size(); ++i) {
        backend::Texel4 const& position = frame.position.pixels[i];
        backend::Texel4 const& normal = frame.normal.pixels[i];
        glm::dvec3 const point = xyz(position);
        auto const map = static_cast<std::ptrdiff_t>(position.w);
        bool const mapped = map >= 0 && map < static_cast<std::ptrdiff_t>(maps.maps.size());
        glm::dmat4 const* const clip_from_world =
            mapped ? &maps.maps[static_cast<std::size_t>(map)].clip_from_world : nullptr;
        if (mapped) touch(result.touched[static_cast<std::size_t>(map)], *clip_from_world, point);

        Question question = truth.question.pixels[i];
        if (question == Question::off_edge && !same_surface(point, xyz(truth.position.pixels[i]), eye))
            question = Question::near_edge;
        bool const truly_lit = truth.state.pixels[i] == oracle::Truth::lit;
        Outcome const outcome = outcome_of(question, normal.w >= 0.5f, truly_lit);
        result.outcome.pixels[i] = outcome;

        if (question == Question::beyond) ++record.beyond_pixels;
        if (question == Question::none || question == Question::beyond) continue;
        ++record.lit_facing_pixels;
        if (question == Question::off_edge) ++record.off_edge_pixels;
        if (outcome != Outcome::right) ++wrong;
        if (outcome == Outcome::false_shadow || outcome == Outcome::false_light) ++wrong_off_edge;
        if (!mapped) {
            ++record.unmapped_pixels;
            continue;
        }
        auto const texel = footprint(eye_clip_from_world, eye_pixels, *clip_from_world,
                                     static_cast<double>(maps.map_size), point, xyz(normal));
        result.footprint.pixels[i] = static_cast<float>(texel.major);
        footprints.push_back(static_cast<float>(texel.major));
    }

    record.mis_shadowed_fraction = share(wrong, record.lit_facing_pixels);
    record.mis_shadowed_fraction_off_edge = share(wrong_off_edge, record.off_edge_pixels);
    summarise_footprints(record, std::move(footprints));
    long used = 0, all = 0;
    for (auto const& texels : result.touched) {
        used += std::count(texels.pixels.begin(), texels.pixels.end(), std::uint8_t{1});
        all += static_cast<long>(texels.pixels.size());
    }
    record.map_used_fraction = share(used, all);
    return result;
}

long unlike_pixels(backend::Image<backend::Rgba8> const& a, backend::Image<backend::Rgba8> const& b) {
    if (a.pixels.size() != b.pixels.size()) return static_cast<long>(std::max(a.pixels.size(), b.pixels.size()));
    long differing = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        backend::Rgba8 const p = a.pixels[i], q = b.pixels[i];
        if (p.r != q.r || p.g != q.g || p.b != q.b) ++differing;
    }
    return differing;
}

double unlike_fraction(backend::Image<backend::Rgba8> const& a, backend::Image<backend::Rgba8> const& b) {
    return share(unlike_pixels(a, b), static_cast<long>(std::max(a.pixels.size(), b.pixels.size())));
}

}  // namespace shadowmath::gallery
