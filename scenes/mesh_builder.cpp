// SPDX-License-Identifier: MIT
#include "scenes/mesh_builder.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <cstring>
#include <unordered_map>
#include <utility>

namespace shadowmath::scenes {

namespace {

constexpr double pi = 3.14159265358979323846;

std::uint8_t to_byte(double reflectance) {
    return static_cast<std::uint8_t>(std::lround(glm::clamp(reflectance, 0.0, 1.0) * 255.0));
}

glm::dvec3 unit_or(glm::dvec3 v, glm::dvec3 fallback) {
    double const length = glm::length(v);
    return length > 1e-12 ? v / length : fallback;
}

struct HashBytes {
    std::size_t operator()(backend::Vertex const& v) const {
        std::array<std::uint32_t, sizeof(backend::Vertex) / 4> words{};
        std::memcpy(words.data(), &v, sizeof v);
        std::uint64_t h = 0;
        for (std::uint32_t const word : words) h = mix_bits(h + word);
        return static_cast<std::size_t>(h);
    }
};

struct EqualBytes {
    bool operator()(backend::Vertex const& a, backend::Vertex const& b) const {
        return std::memcmp(&a, &b, sizeof a) == 0;
    }
};

// Lets triangles share the vertices that agree in every bit.
void weld(backend::Scene& scene, std::size_t first_index, std::size_t first_vertex) {
    std::unordered_map<backend::Vertex, std::uint32_t, HashBytes, EqualBytes> seen;
    std::size_t kept = first_vertex;
    for (std::size_t i = first_index; i < scene.indices.size(); ++i) {
        backend::Vertex const v = scene.vertices[scene.indices[i]];
        auto const [entry, fresh] = seen.try_emplace(v, static_cast<std::uint32_t>(kept));
        if (fresh) scene.vertices[kept++] = v;
        scene.indices[i] = entry->second;
    }
    scene.vertices.resize(kept);
}

}  // namespace

glm::dvec3 srgb(std::uint32_t hex) {
    auto const channel = [&](int shift) {
        double const v = static_cast<double>((hex >> shift) & 255u) / 255.0;
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    return {channel(16), channel(8), channel(0)};
}

glm::dvec3 tinted(glm::dvec3 colour, Random& random, double strength) {
    return colour * (1.0 + strength * random.between(-1.0, 1.0));
}

Ring circle(int sides) {
    Ring ring;
    for (int i = 0; i < sides; ++i) {
        double const angle = 2.0 * pi * i / sides;
        glm::dvec2 const out{std::cos(angle), std::sin(angle)};
        ring.push_back({out, out});
    }
    return ring;
}

Ring fluted(int flutes, int points_per_flute, double depth) {
    Ring ring;
    int const count = flutes * points_per_flute;
    for (int i = 0; i < count; ++i) {
        double const angle = 2.0 * pi * i / count;
        double const phase = pi * (i % points_per_flute) / points_per_flute;
        double const radius = 1.0 - depth * std::sin(phase);
        double const slope = -depth * std::cos(phase) * flutes * 0.5;  // of the radius, along the angle
        glm::dvec2 const out{std::cos(angle), std::sin(angle)};
        glm::dvec2 const along{-out.y, out.x};
        ring.push_back({out * radius, glm::normalize(out * radius - along * (phase == 0.0 ? 0.0 : slope))});
    }
    return ring;
}

void MeshBuilder::coloured_triangle(std::array<glm::dvec3, 3> const& corners, std::array<glm::dvec3, 3> const& normals,
                                    std::array<glm::dvec3, 3> const& colours) {
    std::array<glm::vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = glm::vec3(frame.point(corners[i]));
    // NOTE: judged after rounding to float, where slivers of the double world may have collapsed.
    glm::dvec3 const area = glm::cross(glm::dvec3(p[1]) - glm::dvec3(p[0]), glm::dvec3(p[2]) - glm::dvec3(p[0]));
    if (!(glm::length(area) > 1e-10)) return;
    for (std::size_t i = 0; i < 3; ++i) {
        backend::Vertex v{};
        v.position = p[i];
        v.normal = glm::vec3(unit_or(frame.direction(normals[i]), glm::normalize(area)));
        for (int k = 0; k < 3; ++k) v.albedo[k] = to_byte(colours[i][k]);
        v.albedo[3] = 255;
        scene_.indices.push_back(static_cast<std::uint32_t>(scene_.vertices.size()));
        scene_.vertices.push_back(v);
    }
}

void MeshBuilder::triangle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    glm::dvec3 const n = glm::cross(b - a, c - a);
    triangle({a, b, c}, {n, n, n});
}

void MeshBuilder::quad(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d) {
    triangle(a, b, c);
    triangle(a, c, d);
}

void MeshBuilder::hexahedron(std::array<glm::dvec3, 8> const& c) {
    quad(c[0], c[4], c[6], c[2]);
    quad(c[1], c[3], c[7], c[5]);
    quad(c[0], c[1], c[5], c[4]);
    quad(c[2], c[6], c[7], c[3]);
    quad(c[0], c[2], c[3], c[1]);
    quad(c[4], c[5], c[7], c[6]);
}

void MeshBuilder::box(glm::dvec3 lo, glm::dvec3 hi) {
    std::array<glm::dvec3, 8> corners;
    for (unsigned i = 0; i < 8; ++i)
        corners[i] = {(i & 1u) != 0 ? hi.x : lo.x, (i & 2u) != 0 ? hi.y : lo.y, (i & 4u) != 0 ? hi.z : lo.z};
    hexahedron(corners);
}

void MeshBuilder::beam(glm::dvec3 from, glm::dvec3 to, double width, double height) {
    glm::dvec3 const along = unit_or(to - from, {0.0, 0.0, 1.0});
    glm::dvec3 const side = unit_or(glm::cross({0.0, 1.0, 0.0}, along), {1.0, 0.0, 0.0});
    glm::dvec3 const above = glm::cross(along, side);
    std::array<glm::dvec3, 8> corners;
    for (unsigned i = 0; i < 8; ++i)
        corners[i] = ((i & 4u) != 0 ? to : from) + side * ((i & 1u) != 0 ? width : -width) * 0.5 +
                     above * ((i & 2u) != 0 ? height : -height) * 0.5;
    hexahedron(corners);
}

void MeshBuilder::lathe(std::span<ProfilePoint const> profile, Ring const& ring) {
    for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
        auto const [r0, y0] = profile[k];
        auto const [r1, y1] = profile[k + 1];
        auto const point = [](RingPoint const& p, double r, double y) {
            return glm::dvec3(p.point.x * r, y, p.point.y * r);
        };
        auto const normal = [&, dr = r1 - r0, dy = y1 - y0](RingPoint const& p) {
            return glm::dvec3(p.normal.x * dy, -dr, p.normal.y * dy);
        };
        for (std::size_t i = 0; i < ring.size(); ++i) {
            RingPoint const& p = ring[i];
            RingPoint const& q = ring[(i + 1) % ring.size()];
            triangle({point(p, r0, y0), point(p, r1, y1), point(q, r1, y1)}, {normal(p), normal(p), normal(q)});
            triangle({point(p, r0, y0), point(q, r1, y1), point(q, r0, y0)}, {normal(p), normal(q), normal(q)});
        }
    }
}

void MeshBuilder::tube(std::span<glm::dvec3 const> path, double first_radius, double last_radius, int sides) {
    if (path.size() < 2) return;
    glm::dvec3 const start = path[1] - path[0];
    glm::dvec3 side = std::abs(start.y) < 0.9 * glm::length(start) ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    struct Station {
        glm::dvec3 centre, u, v;
        double radius;
    };
    std::vector<Station> stations;
    for (std::size_t k = 0; k < path.size(); ++k) {
        glm::dvec3 const along = unit_or(path[std::min(k + 1, path.size() - 1)] - path[k == 0 ? 0 : k - 1], {0, 1, 0});
        side = unit_or(side - along * glm::dot(side, along), {along.y, -along.x, 0.0});
        double const t = static_cast<double>(k) / static_cast<double>(path.size() - 1);
        stations.push_back({path[k], side, glm::cross(along, side), first_radius + (last_radius - first_radius) * t});
    }
    auto const out = [&](Station const& s, int i) {
        double const angle = 2.0 * pi * i / sides;
        return s.u * std::cos(angle) + s.v * std::sin(angle);
    };
    auto const at = [&](Station const& s, int i) { return s.centre + out(s, i) * s.radius; };
    Station const& first = stations.front();
    Station const& last = stations.back();
    for (int i = 0; i < sides; ++i) {
        for (std::size_t k = 0; k + 1 < stations.size(); ++k) {
            Station const& a = stations[k];
            Station const& b = stations[k + 1];
            triangle({at(a, i), at(a, i + 1), at(b, i + 1)}, {out(a, i), out(a, i + 1), out(b, i + 1)});
            triangle({at(a, i), at(b, i + 1), at(b, i)}, {out(a, i), out(b, i + 1), out(b, i)});
        }
        if (i >= 2) {
            triangle(at(first, 0), at(first, i), at(first, i - 1));
            triangle(at(last, 0), at(last, i - 1), at(last, i));
        }
    }
}

void MeshBuilder::blob(glm::dvec3 centre, glm::dvec3 radii, int detail, double roughness, std::uint64_t seed,
                       bool smooth) {
    // An octahedron, each face cut into detail^2: its points depend on their direction alone, so faces meet.
    for (unsigned face = 0; face < 8; ++face) {
        glm::dvec3 const sign{(face & 1u) != 0 ? -1 : 1, (face & 2u) != 0 ? -1 : 1, (face & 4u) != 0 ? -1 : 1};
        bool const turned = sign.x * sign.y * sign.z < 0.0;
        auto const out = [&](int i, int j) {
            glm::dvec3 const on_face{static_cast<double>(i), static_cast<double>(j),
                                     static_cast<double>(detail - i - j)};
            return glm::normalize(on_face * sign);
        };
        auto const at = [&](int i, int j) {
            glm::dvec3 const d = out(i, j);
            return centre + d * radii * (1.0 + roughness * rough_noise(d * 1.7, 2, seed) * 1.5);
        };
        auto const add = [&](std::array<glm::ivec2, 3> k) {
            if (turned) std::swap(k[1], k[2]);
            std::array<glm::dvec3, 3> p, n;
            for (std::size_t c = 0; c < 3; ++c) {
                p[c] = at(k[c].x, k[c].y);
                n[c] = out(k[c].x, k[c].y) / radii;
            }
            if (smooth)
                triangle(p, n);
            else
                triangle(p[0], p[1], p[2]);
        };
        for (int i = 0; i < detail; ++i) {
            for (int j = 0; i + j < detail; ++j) {
                add({glm::ivec2(i, j), glm::ivec2(i + 1, j), glm::ivec2(i, j + 1)});
                if (i + j + 1 < detail) add({glm::ivec2(i + 1, j), glm::ivec2(i + 1, j + 1), glm::ivec2(i, j + 1)});
            }
        }
    }
}

void MeshBuilder::sheet_from(std::span<glm::dvec3 const> points, int columns, int rows) {
    auto const at = [&](int i, int j) {
        int const x = glm::clamp(i, 0, columns);
        int const y = glm::clamp(j, 0, rows);
        return points[static_cast<std::size_t>(y * (columns + 1) + x)];
    };
    auto const normal = [&](int i, int j) {
        return glm::cross(at(i + 1, j) - at(i - 1, j), at(i, j + 1) - at(i, j - 1));
    };
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            triangle({at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                     {normal(i, j), normal(i + 1, j), normal(i + 1, j + 1)});
            triangle({at(i, j), at(i + 1, j + 1), at(i, j + 1)},
                     {normal(i, j), normal(i + 1, j + 1), normal(i, j + 1)});
        }
    }
}

void MeshBuilder::end_object(bool casts) {
    std::size_t const end = scene_.indices.size();
    if (end == object_begin_) return;
    backend::Object object;
    object.first_index = static_cast<std::uint32_t>(object_begin_);
    object.index_count = static_cast<std::uint32_t>(end - object_begin_);
    object.casts = casts;
    weld(scene_, object_begin_, vertices_begin_);
    vertices_begin_ = scene_.vertices.size();
    for (std::size_t i = object_begin_; i < end; ++i) {
        object.lo = glm::min(object.lo, scene_.vertices[scene_.indices[i]].position);
        object.hi = glm::max(object.hi, scene_.vertices[scene_.indices[i]].position);
    }
    scene_.lo = glm::min(scene_.lo, object.lo);
    scene_.hi = glm::max(scene_.hi, object.hi);
    scene_.objects.push_back(object);
    object_begin_ = end;
}

backend::Scene MeshBuilder::finish(std::string name) {
    end_object();
    scene_.name = std::move(name);
    object_begin_ = 0;
    vertices_begin_ = 0;
    return std::exchange(scene_, {});
}

}  // namespace shadowmath::scenes
