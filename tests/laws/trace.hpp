// SPDX-License-Identifier: MIT
//
// Laws of frustum tracing. The truth is a segment and a triangle, in long double, sample by sample.
#pragma once

#include "tests/support/traced.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace shadowmath::laws {

using Real = long double;

enum class Answer { lit, dark, undecided };

inline Real sum_of_parts(Vec3<Real> const& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

// From a point to the light; to a sun, as far as its direction is long.
inline Vec3<Real> way_to(Light<Real> const& light, Vec3<Real> const& from) {
    return light.kind == LightKind::directional ? -light.direction : light.position - from;
}

// A triangle under a light, and what of both is the same for every sample.
struct Caster {
    test::Triangle<Real> corner;
    std::array<Vec3<Real>, 3> side;  // of the plane through an edge and the light
    std::array<Real, 3> edge;        // metres
    Vec3<Real> normal;
    Real area = 0, weight = 0;  // length of the normal; sum of its parts over that
    Real distances = 0;         // of the three corners from the origin, added
};

template <class T>
Caster caster_of(test::Triangle<T> const& triangle, Light<Real> const& light) {
    Caster caster;
    test::Triangle<Real>& t = caster.corner;
    for (std::size_t i = 0; i < 3; ++i) t[i] = Vec3<Real>(triangle[i]);
    for (std::size_t i = 0; i < 3; ++i) {
        Vec3<Real> const edge = t[(i + 1) % 3] - t[i];
        caster.side[i] = glm::cross(edge, way_to(light, t[i]));
        caster.edge[i] = glm::length(edge);
        caster.distances += glm::length(t[i]);
    }
    caster.normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    caster.area = glm::length(caster.normal);
    if (caster.area > 0) caster.weight = sum_of_parts(caster.normal) / caster.area;
    return caster;
}

// Does the segment from the sample to the light meet the caster? Undecided where moving anything by `slack` metres
// could change that; `contact` is how far off its plane the sample must be.
inline Answer meets(Vec3<Real> const& sample, Light<Real> const& light, Caster const& caster, Real contact,
                    Real slack) {
    Vec3<Real> const& normal = caster.normal;
    Vec3<Real> const way = way_to(light, sample);
    if (!(caster.area > 0)) return Answer::undecided;
    Real const turn = glm::dot(normal, way) < 0 ? Real(-1) : Real(1);
    Answer answer = Answer::dark;
    for (std::size_t i = 0; i < 3; ++i) {
        Vec3<Real> const to_corner = caster.corner[i] - sample;
        // The volume that sample, edge and way span, positive on the inner side of the edge. Its change with the
        // sample: no more than the edge's length times the way's.
        Real const volume = glm::dot(caster.side[i], to_corner) * turn;
        auto const margin_at = [&](Real distance, Real reach) {
            return slack * (caster.edge[i] + distance * Real(1e-3)) * reach;
        };
        // A sum of parts is no less than the length and takes no root: it decides nearly always.
        bool const decided = std::abs(volume) > margin_at(sum_of_parts(to_corner), sum_of_parts(way));
        Real const margin = decided ? Real(0) : margin_at(glm::length(to_corner), glm::length(way));
        if (volume < -margin) return Answer::lit;
        if (volume <= margin) answer = Answer::undecided;
    }
    Real const behind = -glm::dot(normal, sample - caster.corner[0]) * turn / caster.area;
    if (behind < -slack) return Answer::lit;
    // Within the margin of contact either answer will do: its exact extent is no law.
    if (behind < 2 * caster.weight * contact + slack) answer = Answer::undecided;
    if (light.kind == LightKind::spot) {
        Real const lamp = glm::dot(normal, light.position - caster.corner[0]) * turn / caster.area;
        if (lamp < -slack) return Answer::lit;
        if (lamp < slack) answer = Answer::undecided;
    }
    return answer;
}

// Every bit of the mask is what the truth says, wherever the truth is decided.
template <class T>
[[nodiscard]] bool agrees_with_segments(test::PlanePicture<T> const& picture, std::vector<std::uint32_t> const& masks,
                                        std::vector<test::Triangle<T>> const& casters, Light<T> const& light,
                                        ShadowMap<T> const& grid) {
    PixelFrame<Real> const frame = frame_in<Real>(picture.frame);
    Light<Real> exact;
    exact.kind = light.kind;
    exact.direction = Vec3<Real>(light.direction);
    exact.position = Vec3<Real>(light.position);
    std::vector<Caster> prepared;
    for (test::Triangle<T> const& caster : casters) prepared.push_back(caster_of(caster, exact));
    Real const eps = std::numeric_limits<T>::epsilon();
    Vec4<Real> const row_of_w(row(grid.clip_from_world, 3));
    for (std::size_t pixel = 0; pixel < masks.size(); ++pixel) {
        if (!(picture.depth[pixel] > T(0))) {
            if (masks[pixel] != 0) return false;
            continue;
        }
        auto const column = static_cast<int>(pixel % static_cast<std::size_t>(picture.frame.width));
        auto const row = static_cast<int>(pixel / static_cast<std::size_t>(picture.frame.width));
        Vec3<Real> const normal(picture.normal);
        MicroQuad<Real> const quad = micro_quad(frame, column, row, Real(picture.depth[pixel]), normal);
        // In the middle of the pixel the quad is on the plane even where it had to be turned.
        Vec3<Real> const middle = point_on(frame, quad, column, row, Real(0.5), Real(0.5));
        // An orthographic eye sees along its axis, wherever it stands.
        bool const flat = frame.kind == ViewKind::orthographic;
        Vec3<Real> const to_eye = flat ? -frame.inward : frame.eye - middle;
        Real const lit_side = glm::dot(normal, toward(exact, middle)) * glm::dot(normal, to_eye);
        if (std::abs(lit_side) < 1e-4L * glm::length(to_eye)) continue;
        // A pixel that reaches behind the map's light is not the map's.
        bool held = true;
        for (int corner = 0; corner < 4; ++corner) {
            Vec3<Real> const at = point_on(frame, quad, column, row, Real(corner % 2), Real(corner / 2));
            held = held && glm::dot(row_of_w, Vec4<Real>(at, Real(1))) > 1e-3L;
        }
        if (!held) continue;
        for (int s = 0; s < samples_per_pixel; ++s) {
            Vec3<Real> const at =
                point_on(frame, quad, column, row, pixel_samples<Real>.u[s], pixel_samples<Real>.v[s]);
            Real out_there = glm::length(at) + glm::length(at - frame.eye) + glm::length(frame.eye);
            Answer wanted = Answer::lit;
            for (Caster const& caster : prepared) {
                Real const reach = out_there + caster.distances;
                Answer const answer = meets(at, exact, caster, 4 * contact_share<Real> * (1 + reach), 64 * eps * reach);
                if (answer == Answer::dark) wanted = Answer::dark;
                if (answer == Answer::undecided && wanted == Answer::lit) wanted = Answer::undecided;
                if (wanted == Answer::dark) break;
            }
            bool const dark = (masks[pixel] >> s & 1u) != 0;
            if (lit_side < 0) wanted = Answer::dark;
            if (wanted != Answer::undecided && dark != (wanted == Answer::dark)) return false;
        }
    }
    return true;
}

// No bit of `fewer` is missing in `more`.
[[nodiscard]] inline bool only_adds(std::vector<std::uint32_t> const& fewer, std::vector<std::uint32_t> const& more) {
    for (std::size_t i = 0; i < fewer.size(); ++i)
        if ((fewer[i] & ~more[i]) != 0) return false;
    return fewer.size() == more.size();
}

}  // namespace shadowmath::laws
