// SPDX-License-Identifier: MIT
#include "scenes/town_ground.hpp"

#include <glm/common.hpp>

#include <algorithm>

namespace shadowmath::scenes {

namespace {

double to_nearest_street(double at, double pitch, double half) {
    return std::abs(at + half - pitch * std::round((at + half) / pitch));
}

}  // namespace

double TownGround::land(double u, double v) const {
    double const outside = std::max(0.0, std::max(std::abs(u) - half_u(), std::abs(v) - half_v()));
    double const far_out = glm::smoothstep(0.0, 420.0, outside);
    glm::dvec3 const p{u, 0.0, v};
    double const roll = 3.2 * rough_noise(p / 130.0, 2, seed_ + 11);
    double const hills = 58.0 * (rough_noise(p / 340.0, 4, seed_ + 23) + 0.42);
    double const rim = 70.0 * glm::smoothstep(500.0, 1050.0, std::hypot(u, v));
    return roll + far_out * hills + rim;
}

glm::dvec3 TownGround::world(double u, double v, double lift) const {
    return {u + 15.0 * std::sin(v / 62.0 + 0.4), land(u, v) + lift, v + 12.0 * std::sin(u / 71.0 + 1.1)};
}

Frame TownGround::frame(double u, double v, double yaw_radians, double lift) const {
    glm::dvec3 along = world(u + 0.5, v) - world(u - 0.5, v);
    along = glm::normalize(glm::dvec3(along.x, 0.0, along.z));
    Frame frame;
    frame.origin = world(u, v, lift);
    frame.x = along;
    frame.z = {-along.z, 0.0, along.x};
    return frame.turned(yaw_radians);
}

TownGround::Cover TownGround::cover(double u, double v) const {
    double const reach = half_street + pavement;
    bool const inside = std::abs(u) < half_u() + reach && std::abs(v) < half_v() + reach;
    double const du = to_nearest_street(u, pitch_u, half_u());
    double const dv = to_nearest_street(v, pitch_v, half_v());
    bool const high_road = std::abs(u + pitch_u / 2) < half_street;
    if (!inside) return high_road ? Cover::street : Cover::field;
    if (du < half_street || dv < half_street) return Cover::street;
    if (std::abs(u) < pitch_u / 2 && std::abs(v) < pitch_v / 2) return Cover::square;
    if (du < reach || dv < reach) return Cover::pavement;
    return Cover::garden;
}

std::vector<double> TownGround::lines(int blocks, double pitch, int detail) const {
    double const half = 0.5 * blocks * pitch;
    double const step = detail == 0 ? 12.0 : detail == 1 ? 7.0 : 4.5;
    double const growth = detail == 0 ? 1.28 : detail == 1 ? 1.16 : 1.11;
    std::vector<double> at;
    for (int street = 0; street <= blocks; ++street) {
        double const centre = -half + pitch * street;
        for (double const d : {half_street, half_street + pavement}) {
            at.push_back(centre - d);
            at.push_back(centre + d);
        }
        at.push_back(centre);
        if (street == blocks) break;
        double const from = centre + half_street + pavement;
        double const to = centre + pitch - half_street - pavement;
        int const cells = static_cast<int>(std::ceil((to - from) / step));
        for (int i = 1; i < cells; ++i) at.push_back(from + (to - from) * i / cells);
    }
    double grow = step;
    for (double out = half + half_street + pavement + grow; out < edge - grow * 0.6; grow *= growth, out += grow) {
        at.push_back(out);
        at.push_back(-out);
    }
    at.push_back(edge);
    at.push_back(-edge);
    std::ranges::sort(at);
    return at;
}

glm::dvec3 TownGround::colour(Cover cover, double u, double v) const {
    glm::dvec3 const p{u, 0.0, v};
    double const mottle = 1.0 + 0.13 * noise(p / 2.7, seed_ + 5) + 0.10 * noise(p / 17.0, seed_ + 6);
    switch (cover) {
        case Cover::street: return srgb(0x9F978B) * mottle;
        case Cover::pavement: return srgb(0xC2B8A6) * mottle;
        case Cover::square: return srgb(0xCDBD9F) * mottle;
        case Cover::garden:
            return glm::mix(srgb(0x7E9B4E), srgb(0x93A65A), 0.5 + 0.5 * noise(p / 9.0, seed_ + 7)) * mottle;
        case Cover::field: break;
    }
    // Beyond the town, strips of meadow, wheat and fallow; the hills wear plain grass.
    static std::array const crops{srgb(0x8CA454), srgb(0x7C9A4C), srgb(0xCDB869),
                                  srgb(0xA9AE5E), srgb(0xB59A6A), srgb(0x6F9048)};
    auto const strip = static_cast<std::int64_t>(std::floor((u + 0.3 * v) / 85.0)) * 131 +
                       static_cast<std::int64_t>(std::floor((v - 0.2 * u) / 60.0));
    glm::dvec3 const crop =
        crops[static_cast<std::size_t>(mix_bits(static_cast<std::uint64_t>(strip) + seed_) % crops.size())];
    double const wild = glm::smoothstep(380.0, 620.0, std::hypot(u, v) + 60.0 * noise(p / 90.0, seed_ + 8));
    return glm::mix(crop, srgb(0x76914F), wild) * mottle;
}

void TownGround::add_to(MeshBuilder& mesh, int detail) const {
    std::vector<double> const us = lines(blocks_u_, pitch_u, detail);
    std::vector<double> const vs = lines(blocks_v_, pitch_v, detail);
    auto const cover_of = [&](std::size_t i, std::size_t j) {
        return cover(0.5 * (us[i] + us[i + 1]), 0.5 * (vs[j] + vs[j + 1]));
    };
    auto const lift_of = [&](std::size_t i, std::size_t j) {
        Cover const c = cover_of(i, j);
        return c == Cover::street || c == Cover::field ? 0.0 : kerb;
    };
    auto const normal = [&](double u, double v) {
        return glm::normalize(glm::cross(world(u, v + 0.5) - world(u, v - 0.5), world(u + 0.5, v) - world(u - 0.5, v)));
    };
    mesh.frame = {};
    auto const add_cell = [&](std::size_t i, std::size_t j) {
        double const lift = lift_of(i, j);
        Cover const c = cover_of(i, j);
        std::array const u{us[i], us[i + 1]};
        std::array const v{vs[j], vs[j + 1]};
        auto const p = [&](std::size_t a, std::size_t b) { return world(u[a], v[b], lift); };
        auto const n = [&](std::size_t a, std::size_t b) { return normal(u[a], v[b]); };
        auto const k = [&](std::size_t a, std::size_t b) { return colour(c, u[a], v[b]); };
        mesh.coloured_triangle({p(0, 0), p(0, 1), p(1, 1)}, {n(0, 0), n(0, 1), n(1, 1)}, {k(0, 0), k(0, 1), k(1, 1)});
        mesh.coloured_triangle({p(0, 0), p(1, 1), p(1, 0)}, {n(0, 0), n(1, 1), n(1, 0)}, {k(0, 0), k(1, 1), k(1, 0)});
        if (lift == 0.0) return;
        mesh.colour = srgb(0xD6CDBC);  // kerb stones, down to lower neighbours
        auto const q = [&](std::size_t a, std::size_t b) { return world(u[a], v[b]); };
        if (lift_of(i - 1, j) == 0.0) mesh.quad(q(0, 0), q(0, 1), p(0, 1), p(0, 0));
        if (lift_of(i + 1, j) == 0.0) mesh.quad(q(1, 1), q(1, 0), p(1, 0), p(1, 1));
        if (lift_of(i, j - 1) == 0.0) mesh.quad(q(1, 0), q(0, 0), p(0, 0), p(1, 0));
        if (lift_of(i, j + 1) == 0.0) mesh.quad(q(0, 1), q(1, 1), p(1, 1), p(0, 1));
    };
    std::size_t const tile = 14;
    for (std::size_t tj = 0; tj + 1 < vs.size(); tj += tile) {
        for (std::size_t ti = 0; ti + 1 < us.size(); ti += tile) {
            for (std::size_t j = tj; j < std::min(tj + tile, vs.size() - 1); ++j)
                for (std::size_t i = ti; i < std::min(ti + tile, us.size() - 1); ++i) add_cell(i, j);
            mesh.end_object();
        }
    }
}

}  // namespace shadowmath::scenes
