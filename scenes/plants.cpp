// SPDX-License-Identifier: MIT
#include "scenes/plants.hpp"

#include <algorithm>

namespace shadowmath::scenes {

namespace {

constexpr double pi = 3.14159265358979323846;

glm::dvec3 bark(Random& random) {
    static std::array const barks{srgb(0x6B4F3A), srgb(0x7A604A), srgb(0x5D4636), srgb(0x84705C)};
    return tinted(random.pick(barks), random);
}

glm::dvec3 foliage(Random& random) {
    static std::array const greens{srgb(0x5E8A3A), srgb(0x749B43), srgb(0x4B7A39), srgb(0x88A84E), srgb(0x9AA648)};
    return tinted(random.pick(greens), random);
}

glm::dvec3 direction(Random& random) {
    double const y = random.between(-1.0, 1.0);
    double const angle = random.between(0.0, 2.0 * pi);
    double const r = std::sqrt(1.0 - y * y);
    return {r * std::cos(angle), y, r * std::sin(angle)};
}

// A trunk that leans and bends a little; returns its top.
glm::dvec3 add_trunk(MeshBuilder& mesh, Random& random, double height, double radius, int sides) {
    double const lean_x = random.between(-0.06, 0.06) * height;
    double const lean_z = random.between(-0.06, 0.06) * height;
    std::array<glm::dvec3, 5> path;
    for (std::size_t k = 0; k < path.size(); ++k) {
        double const t = static_cast<double>(k) / 4.0;
        double const wobble = random.between(-0.5, 0.5) * radius;
        path[k] = {lean_x * t * t + wobble * t, t * height - (k == 0 ? 0.6 : 0.0), lean_z * t * t - wobble * t};
    }
    mesh.lathe({{radius * 1.9, -0.6}, {radius * 1.25, 0.25}, {radius * 0.8, 0.7}}, circle(sides));  // the root flare
    mesh.tube(path, radius, radius * 0.45, sides);
    return path.back();
}

}  // namespace

void add_broadleaf(MeshBuilder& mesh, Random& random, double height, int detail) {
    mesh.colour = bark(random);
    glm::dvec3 const top = add_trunk(mesh, random, height * 0.55, height * 0.028, 5 + 2 * detail);
    glm::dvec3 const green = foliage(random);
    double const crown = height * random.between(0.24, 0.30);
    int const lumps = 2 + 2 * detail;
    for (int i = 0; i <= lumps; ++i) {
        double const angle = 2.4 * i + random.between(-0.4, 0.4);
        double const away = i == 0 ? 0.0 : crown * random.between(0.55, 0.85);
        double const lift = i == 0 ? crown * 0.75 : random.between(-0.25, 0.45) * crown;
        double const size = crown * (i == 0 ? 1.0 : random.between(0.6, 0.85));
        glm::dvec3 const centre = top + glm::dvec3(std::cos(angle) * away, lift, std::sin(angle) * away);
        mesh.colour = tinted(green, random, 0.14);
        std::uint64_t const seed = random.bits();
        mesh.blob(centre, {size, size * 0.86, size}, 2 + detail, 0.22, seed, false);
    }
}

void add_conifer(MeshBuilder& mesh, Random& random, double height, int detail) {
    mesh.colour = bark(random);
    double const radius = height * 0.022;
    mesh.lathe({{radius * 1.4, -0.6}, {radius, 0.3}, {radius * 0.2, height * 0.9}}, circle(5 + detail));
    glm::dvec3 const green = tinted(srgb(0x44683F), random, 0.22);
    int const tiers = 4 + 2 * detail;
    int const teeth = 6 + 3 * detail;
    double const spread = height * random.between(0.17, 0.22);
    for (int i = 0; i < tiers; ++i) {
        double const t = static_cast<double>(i) / tiers;
        double const y = height * (0.16 + 0.80 * t);
        double const reach = spread * (1.0 - 0.88 * t);
        double const rise = height * 0.26 * (1.0 - 0.45 * t);
        mesh.colour = tinted(green, random, 0.12) * (0.85 + 0.35 * t);
        Ring skirt;
        double const turn = random.between(0.0, pi);
        for (int k = 0; k < 2 * teeth; ++k) {
            double const angle = turn + pi * k / teeth;
            double const tooth = (k % 2 == 0 ? 1.0 : 0.74) * random.between(0.88, 1.06);
            glm::dvec2 const out{std::cos(angle), std::sin(angle)};
            skirt.push_back({out * tooth, out});
        }
        mesh.lathe({{0.0, y + rise * 0.22}, {reach, y}, {0.0, y + rise}}, skirt);
    }
}

void add_cypress(MeshBuilder& mesh, Random& random, double height, int detail) {
    mesh.colour = bark(random);
    mesh.lathe({{0.22, -0.5}, {0.16, height * 0.2}}, circle(6));
    mesh.colour = tinted(srgb(0x3F5F38), random, 0.15);
    double const girth = height * random.between(0.085, 0.11);
    std::uint64_t const seed = random.bits();
    mesh.blob({0.0, height * 0.54, 0.0}, {girth, height * 0.48, girth}, 4 + 2 * detail, 0.16, seed, false);
}

void add_bush(MeshBuilder& mesh, Random& random, double height, int detail) {
    mesh.colour = foliage(random) * 0.9;
    double const wide = height * random.between(0.7, 1.1);
    double const deep = height * random.between(0.7, 1.1);
    std::uint64_t const seed = random.bits();
    mesh.blob({0.0, height * 0.38, 0.0}, {wide, height * 0.62, deep}, 2 + detail, 0.25, seed, false);
}

void add_leafy_tree(MeshBuilder& mesh, Random& random, double height, int leaves, int detail) {
    int const sides = 5 + 3 * detail;
    glm::dvec3 const wood = bark(random);
    mesh.colour = wood;
    double const radius = height * random.between(0.016, 0.026);
    glm::dvec3 const top = add_trunk(mesh, random, height * 0.78, radius, sides);

    struct Cluster {
        glm::dvec3 centre;
        double size;
    };
    std::vector<Cluster> clusters{{top + glm::dvec3(0.0, height * 0.08, 0.0), height * 0.13}};
    int const branches = 5 + detail;
    for (int i = 0; i < branches; ++i) {
        double const t = 0.48 + 0.50 * i / branches;
        double const angle = 2.4 * i + random.between(-0.5, 0.5);
        double const reach = height * random.between(0.16, 0.27) * (1.25 - 0.5 * t);
        glm::dvec3 const from = glm::dvec3(top.x * t * t, top.y * t, top.z * t * t);
        glm::dvec3 const out{std::cos(angle) * reach, reach * random.between(0.35, 0.8), std::sin(angle) * reach};
        std::array const path{from, from + out * 0.5 + glm::dvec3(0.0, -0.06 * reach, 0.0), from + out};
        mesh.tube(path, radius * 0.45, radius * 0.12, std::max(3, sides - 4));
        clusters.push_back({from + out, height * random.between(0.10, 0.14)});
        clusters.push_back({from + out * 0.6, height * random.between(0.07, 0.10)});
    }

    // Fewer leaves are larger ones: the crown keeps its cover.
    double const leaf = 0.5 * height * std::sqrt(1.15 / leaves);
    glm::dvec3 const green = foliage(random);
    for (int i = 0; i < leaves; ++i) {
        Cluster const& cluster = random.pick(clusters);
        glm::dvec3 const away = direction(random);
        double const depth = std::cbrt(random.unit());
        glm::dvec3 const centre = cluster.centre + away * glm::dvec3(1.0, 0.7, 1.0) * (cluster.size * depth);
        glm::dvec3 const any = direction(random);
        glm::dvec3 const face = glm::normalize(away * 0.5 + any + glm::dvec3(0.0, 0.9, 0.0));
        glm::dvec3 const turn = direction(random);
        glm::dvec3 const side_raw = glm::cross(face, turn);
        glm::dvec3 const side = glm::normalize(side_raw + glm::dvec3(1e-6, 0.0, 0.0));
        glm::dvec3 const tip = glm::cross(face, side);
        double const size = leaf * random.between(0.7, 1.3);
        mesh.colour = tinted(green, random, 0.25) * (0.8 + 0.35 * depth);
        mesh.quad(centre - tip * size, centre + side * size * 0.55, centre + tip * size, centre - side * size * 0.55);
    }
}

void add_fern(MeshBuilder& mesh, Random& random, double height, int blades) {
    glm::dvec3 const green = foliage(random);
    double const turn = random.between(0.0, 2.0 * pi);
    for (int i = 0; i < blades; ++i) {
        double const angle = turn + 2.0 * pi * i / blades + random.between(-0.25, 0.25);
        glm::dvec3 const out{std::cos(angle), 0.0, std::sin(angle)};
        glm::dvec3 const side{-out.z, 0.0, out.x};
        double const tall = height * random.between(0.7, 1.1);
        double const width = height * 0.16;
        mesh.colour = tinted(green, random, 0.2);
        glm::dvec3 const root = glm::dvec3(0.0, -0.1, 0.0);
        glm::dvec3 const knee = out * (tall * 0.45) + glm::dvec3(0.0, tall * 0.8, 0.0);
        glm::dvec3 const tip = out * (tall * 1.05) + glm::dvec3(0.0, tall * 0.62, 0.0);
        mesh.quad(root - side * width * 0.3, root + side * width * 0.3, knee + side * width, knee - side * width);
        mesh.triangle(knee - side * width, knee + side * width, tip);
    }
}

}  // namespace shadowmath::scenes
