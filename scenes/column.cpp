// SPDX-License-Identifier: MIT
#include "scenes/column.hpp"

#include <algorithm>

namespace shadowmath::scenes {

void add_column(MeshBuilder& mesh, Random& random, double height, int detail, double standing) {
    double const r = height / 18.0;
    double const plinth = 1.32 * r;
    Ring const round = circle(8 + 14 * detail);
    Ring const shaft = detail == 0 ? circle(12) : fluted(20, 1 + 2 * detail, 0.075);
    mesh.box({-plinth, -0.3, -plinth}, {plinth, 0.35 * r, plinth});
    mesh.lathe({{1.30 * r, 0.34 * r},
                {1.34 * r, 0.48 * r},
                {1.28 * r, 0.62 * r},
                {1.10 * r, 0.68 * r},
                {1.12 * r, 0.80 * r},
                {1.16 * r, 0.88 * r},
                {1.00 * r, 0.98 * r}},
               round);
    double const foot = 0.95 * r;
    double const neck = (height - 1.3 * r) * standing;
    int const drums = 2 + 2 * detail * detail;
    std::vector<ProfilePoint> profile;
    for (int i = 0; i <= drums; ++i) {
        double const t = static_cast<double>(i) / drums * standing;
        double const entasis = r * (1.0 - 0.17 * t * t);  // the shaft swells a little below its middle
        profile.push_back({entasis, foot + (neck - foot) * i / drums});
    }
    mesh.lathe(profile, shaft);
    if (standing < 1.0) {
        double const top = profile.back().radius;
        double const tilt = random.between(0.15, 0.45) * top;
        Ring const ring = circle(12);
        for (std::size_t i = 0; i < ring.size(); ++i) {
            auto const at = [&](RingPoint const& p) {
                return glm::dvec3(p.point.x * top * 0.97,
                                  neck + tilt * (1.0 + p.point.x) + 0.1 * tilt * std::sin(5.0 * p.point.y),
                                  p.point.y * top * 0.97);
            };
            glm::dvec3 const a = at(ring[i]);
            glm::dvec3 const b = at(ring[(i + 1) % ring.size()]);
            mesh.quad({a.x, neck - 0.2, a.z}, a, b, {b.x, neck - 0.2, b.z});
            mesh.triangle({0.0, neck + tilt, 0.0}, b, a);
        }
        return;
    }
    double const cap = height - 1.3 * r;
    mesh.lathe({{0.83 * r, cap - 0.02 * r},
                {0.92 * r, cap + 0.10 * r},
                {0.86 * r, cap + 0.20 * r},
                {0.90 * r, cap + 0.40 * r},
                {1.20 * r, cap + 0.80 * r},
                {1.26 * r, cap + 0.92 * r},
                {0.0, cap + 0.92 * r}},
               round);
    mesh.box({-1.30 * r, cap + 0.90 * r, -1.30 * r}, {1.30 * r, height, 1.30 * r});
}

void add_balustrade(MeshBuilder& mesh, glm::dvec3 from, glm::dvec3 to, int detail) {
    glm::dvec3 const up{0.0, 1.0, 0.0};
    double const length = glm::length(to - from);
    mesh.beam(from + up * 0.06, to + up * 0.06, 0.30, 0.34);
    mesh.beam(from + up * 0.97, to + up * 0.97, 0.32, 0.15);
    for (glm::dvec3 const end : {from, to}) {
        mesh.box(end + glm::dvec3(-0.24, -0.2, -0.24), end + glm::dvec3(0.24, 1.10, 0.24));
        mesh.box(end + glm::dvec3(-0.30, 1.08, -0.30), end + glm::dvec3(0.30, 1.20, 0.30));
    }
    int const balusters = std::max(1, static_cast<int>(length / 0.34));
    Frame const frame = mesh.frame;
    Ring const ring = circle(5 + 3 * detail);
    for (int i = 1; i < balusters; ++i) {
        mesh.frame = frame.moved(from + (to - from) * (static_cast<double>(i) / balusters));
        if (detail == 0)
            mesh.lathe({{0.08, 0.2}, {0.09, 0.4}, {0.04, 0.75}, {0.07, 0.92}}, ring);
        else
            mesh.lathe({{0.085, 0.2},
                        {0.085, 0.27},
                        {0.05, 0.30},
                        {0.095, 0.46},
                        {0.08, 0.56},
                        {0.042, 0.76},
                        {0.07, 0.82},
                        {0.07, 0.92}},
                       ring);
    }
    mesh.frame = frame;
}

void add_urn(MeshBuilder& mesh, double height, int detail) {
    double const h = height;
    mesh.lathe({{0.20 * h, -0.05},
                {0.20 * h, 0.05 * h},
                {0.09 * h, 0.12 * h},
                {0.08 * h, 0.24 * h},
                {0.20 * h, 0.34 * h},
                {0.31 * h, 0.58 * h},
                {0.33 * h, 0.74 * h},
                {0.24 * h, 0.82 * h},
                {0.36 * h, 0.95 * h},
                {0.36 * h, h},
                {0.26 * h, h},
                {0.0, 0.86 * h}},
               circle(10 + 8 * detail));
}

void add_obelisk(MeshBuilder& mesh, double height) {
    double const h = height;
    mesh.box({-0.16 * h, -0.3, -0.16 * h}, {0.16 * h, 0.05 * h, 0.16 * h});
    mesh.box({-0.11 * h, 0.0, -0.11 * h}, {0.11 * h, 0.16 * h, 0.11 * h});
    mesh.box({-0.125 * h, 0.155 * h, -0.125 * h}, {0.125 * h, 0.18 * h, 0.125 * h});
    Frame const frame = mesh.frame;
    mesh.frame = frame.turned(0.78539816339744830962);
    mesh.lathe({{0.095 * h, 0.17 * h}, {0.062 * h, 0.93 * h}, {0.0, h}}, circle(4));
    mesh.frame = frame;
}

}  // namespace shadowmath::scenes
