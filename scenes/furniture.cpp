// SPDX-License-Identifier: MIT
#include "scenes/furniture.hpp"

#include <algorithm>

namespace shadowmath::scenes {

namespace {

constexpr double pi = 3.14159265358979323846;

glm::dvec3 const iron = srgb(0x3B3F44);
glm::dvec3 const oak = srgb(0x8A6646);
glm::dvec3 const stone = srgb(0xCFC3AA);

glm::dvec3 hanging(glm::dvec3 from, glm::dvec3 to, double sag, double t) {
    return from + (to - from) * t - glm::dvec3(0.0, 4.0 * sag * t * (1.0 - t), 0.0);
}

}  // namespace

void add_lamp_post(MeshBuilder& mesh, int detail) {
    Frame const frame = mesh.frame;
    mesh.colour = iron;
    Ring const ring = circle(5 + 2 * detail);
    mesh.lathe({{0.16, -0.3}, {0.16, 0.25}, {0.10, 0.45}, {0.055, 1.0}, {0.045, 4.4}, {0.0, 4.6}}, ring);
    mesh.beam({0.0, 4.25, -0.25}, {0.0, 4.35, 0.85}, 0.05, 0.06);
    mesh.beam({0.0, 3.75, 0.0}, {0.0, 4.28, 0.5}, 0.03, 0.03);
    mesh.frame = frame.moved({0.0, 3.72, 0.75});
    mesh.lathe({{0.0, 0.62}, {0.03, 0.50}, {0.22, 0.44}, {0.24, 0.40}, {0.0, 0.41}}, ring);
    mesh.lathe({{0.0, -0.02}, {0.12, 0.0}, {0.11, 0.03}, {0.0, 0.03}}, ring);
    mesh.colour = srgb(0xF2E3B4);
    mesh.lathe({{0.0, 0.02}, {0.10, 0.02}, {0.18, 0.405}}, ring);
    mesh.frame = frame;
}

void add_bollard(MeshBuilder& mesh, int detail) {
    mesh.colour = iron;
    mesh.lathe({{0.11, -0.2}, {0.11, 0.12}, {0.075, 0.18}, {0.065, 0.74}, {0.09, 0.78}, {0.07, 0.88}, {0.0, 0.92}},
               circle(5 + 2 * detail));
}

void add_bench(MeshBuilder& mesh) {
    mesh.colour = iron;
    for (double const x : {-0.75, 0.75}) {
        mesh.box({x - 0.03, -0.15, -0.22}, {x + 0.03, 0.42, -0.16});
        mesh.box({x - 0.03, -0.15, 0.16}, {x + 0.03, 0.42, 0.22});
        mesh.beam({x, 0.40, -0.20}, {x, 0.90, -0.36}, 0.05, 0.05);
    }
    mesh.colour = oak;
    for (double const z : {-0.18, -0.06, 0.06, 0.18}) mesh.box({-0.9, 0.41, z - 0.05}, {0.9, 0.45, z + 0.05});
    for (double const k : {0.35, 0.62, 0.89})
        mesh.beam({-0.9, 0.42 + 0.5 * k, -0.18 - 0.16 * k}, {0.9, 0.42 + 0.5 * k, -0.18 - 0.16 * k}, 0.035, 0.09);
}

void add_fountain(MeshBuilder& mesh, int detail) {
    Ring const ring = circle(12 + 12 * detail);
    mesh.colour = stone;
    mesh.lathe({{4.2, -0.4},
                {4.2, 0.18},
                {3.6, 0.18},
                {3.6, 0.36},
                {3.1, 0.36},
                {3.05, 0.95},
                {3.15, 1.05},
                {2.75, 1.05},
                {2.70, 0.5}},
               ring);
    mesh.lathe({{0.75, 0.4},
                {0.6, 0.7},
                {0.32, 1.0},
                {0.28, 2.2},
                {0.5, 2.35},
                {1.5, 2.75},
                {1.55, 2.85},
                {1.4, 2.85},
                {0.3, 2.6},
                {0.2, 2.9},
                {0.16, 3.6},
                {0.35, 3.75},
                {0.62, 3.95},
                {0.55, 3.95},
                {0.1, 3.85},
                {0.07, 4.2},
                {0.0, 4.3}},
               ring);
    mesh.colour = srgb(0x6FA3AD);
    mesh.lathe({{2.74, 0.82}, {0.0, 0.82}}, ring);
}

void add_stall(MeshBuilder& mesh, Random& random, int detail) {
    mesh.colour = oak;
    for (double const x : {-1.4, 1.4})
        for (double const z : {-0.9, 0.9})
            mesh.box({x - 0.04, -0.3, z - 0.04}, {x + 0.04, z > 0.0 ? 2.15 : 2.55, z + 0.04});
    mesh.box({-1.45, 0.85, 0.15}, {1.45, 0.92, 0.95});
    mesh.box({-1.42, -0.2, 0.80}, {1.42, 0.85, 0.85});
    static std::array const cloths{srgb(0xB9483A), srgb(0x3F7A83), srgb(0xD2973B), srgb(0x5F7F4A)};
    glm::dvec3 const cloth = random.pick(cloths);
    int const stripes = 9;
    for (int i = 0; i < stripes; ++i) {
        double const x0 = -1.7 + 3.4 * i / stripes;
        double const x1 = -1.7 + 3.4 * (i + 1) / stripes;
        mesh.colour = i % 2 == 0 ? cloth : srgb(0xF3ECDA);
        mesh.sheet(1, 3 + 2 * detail, [&](double u, double v) {
            double const hang = v > 0.9 ? (v - 0.9) * 2.5 : 0.0;
            return glm::dvec3(x0 + (x1 - x0) * u, 2.62 - 0.5 * v - 0.12 * std::sin(pi * v) - hang, -1.1 + 2.5 * v);
        });
    }
    for (int crate = 0; crate < 4; ++crate) {
        double const x = -1.15 + 0.75 * crate;
        mesh.colour = oak * 1.15;
        mesh.box({x - 0.28, 0.92, 0.30}, {x + 0.28, 1.08, 0.80});
        static std::array const fruits{srgb(0xC8452F), srgb(0xE0922F), srgb(0x8FA63B), srgb(0xD9C04A)};
        mesh.colour = random.pick(fruits);
        for (int k = 0; k < 3 * detail; ++k) {
            double const across = random.between(-0.2, 0.2);
            double const along = random.between(0.38, 0.72);
            mesh.blob({x + across, 1.10, along}, glm::dvec3(0.07), 2, 0.0, 1, true);
        }
    }
}

void add_railing(MeshBuilder& mesh, glm::dvec3 from, glm::dvec3 to, double bar_spacing, int detail) {
    mesh.colour = iron;
    glm::dvec3 const up{0.0, 1.0, 0.0};
    double const length = glm::length(to - from);
    int const sides = 4 + 2 * detail;
    for (double const y : {0.12, 0.98}) {
        std::array const rail{from + up * y, to + up * y};
        mesh.tube(rail, y > 0.5 ? 0.025 : 0.015, y > 0.5 ? 0.025 : 0.015, sides);
    }
    int const bars = std::max(1, static_cast<int>(length / bar_spacing));
    int const per_post = std::max(1, static_cast<int>(1.8 / bar_spacing));
    for (int i = 0; i <= bars; ++i) {
        glm::dvec3 const foot = from + (to - from) * (static_cast<double>(i) / bars);
        bool const post = i % per_post == 0 || i == bars;
        std::array const bar{foot + up * (post ? -0.3 : 0.11), foot + up * (post ? 1.06 : 0.98)};
        mesh.tube(bar, post ? 0.028 : 0.008, post ? 0.028 : 0.008, post ? sides : 4);
    }
}

void add_fence(MeshBuilder& mesh, Random& random, glm::dvec3 from, glm::dvec3 to, int detail) {
    glm::dvec3 const wood = tinted(srgb(0xA8937A), random, 0.15);
    glm::dvec3 const up{0.0, 1.0, 0.0};
    mesh.colour = wood * 0.9;
    for (double const y : {0.35, 0.85}) mesh.beam(from + up * y, to + up * y, 0.04, 0.08);
    double const length = glm::length(to - from);
    int const posts = std::max(1, static_cast<int>(length / 2.5));
    for (int i = 0; i <= posts; ++i) {
        glm::dvec3 const foot = from + (to - from) * (static_cast<double>(i) / posts);
        mesh.box(foot + glm::dvec3(-0.05, -0.6, -0.05), foot + glm::dvec3(0.05, 1.15, 0.05));
    }
    if (detail == 0) return;
    glm::dvec3 const along = (to - from) / length;
    glm::dvec3 const side{-along.z, 0.0, along.x};
    int const pickets = static_cast<int>(length / (detail == 1 ? 0.24 : 0.15));
    for (int i = 1; i < pickets; ++i) {
        glm::dvec3 const foot = from + (to - from) * (static_cast<double>(i) / pickets) + side * 0.035;
        mesh.colour = tinted(wood, random, 0.12);
        double const top = random.between(0.95, 1.05);
        glm::dvec3 const half = along * 0.04;
        mesh.quad(foot - half, foot + half, foot + half + up * top, foot - half + up * top);
    }
}

void add_wire(MeshBuilder& mesh, glm::dvec3 from, glm::dvec3 to, double sag, double radius, int segments, int sides) {
    std::vector<glm::dvec3> path;
    for (int i = 0; i <= segments; ++i) path.push_back(hanging(from, to, sag, static_cast<double>(i) / segments));
    mesh.tube(path, radius, radius, sides);
}

void add_bunting(MeshBuilder& mesh, glm::dvec3 from, glm::dvec3 to, double sag, int flags) {
    mesh.colour = srgb(0xE8E2D2);
    add_wire(mesh, from, to, sag, 0.012, std::max(6, flags / 2), 4);
    static std::array const colours{srgb(0xC2483B), srgb(0xF0E8D4), srgb(0x3E7488), srgb(0xE0A83E)};
    for (int i = 0; i < flags; ++i) {
        double const t = (i + 0.5) / flags;
        double const half = 0.32 / flags;
        glm::dvec3 const a = hanging(from, to, sag, t - half);
        glm::dvec3 const b = hanging(from, to, sag, t + half);
        mesh.colour = colours[static_cast<std::size_t>(i) % colours.size()];
        mesh.triangle(a, (a + b) * 0.5 - glm::dvec3(0.0, 0.42, 0.0), b);
    }
}

void add_flag(MeshBuilder& mesh, Random& random, double width, double height, glm::dvec3 first, glm::dvec3 second,
              int detail) {
    double const phase = random.between(0.0, 2.0 * pi);
    double const wave = random.between(0.10, 0.16) * width;
    int const columns = 6 + 8 * detail;
    for (int band = 0; band < 3; ++band) {
        mesh.colour = band == 1 ? second : first;
        mesh.sheet(columns, 1 + detail, [&](double u, double v) {
            double const down = (band + v) / 3.0 * height;
            double const swing = wave * u * std::sin(phase + 5.5 * u - 0.8 * down / height);
            return glm::dvec3(width * u * 0.93, -down - 0.18 * width * u * u, swing);
        });
    }
}

}  // namespace shadowmath::scenes
