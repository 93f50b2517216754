// SPDX-License-Identifier: MIT
//
// Builds a Scene out of boxes, turned shapes, tubes, blobs and sheets.
//
// A frame and a colour are set, shapes are added in the frame's own coordinates (metres, y up), end_object() closes
// what was added since the last one into a culling unit, finish() hands the scene over. Faces wind counter-clockwise
// seen from outside. What has no area is left out, so that every normal is a unit vector.
#pragma once

#include "backends/scene.hpp"
#include "scenes/random.hpp"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace shadowmath::scenes {

struct Frame {
    glm::dvec3 origin{0.0};
    glm::dvec3 x{1.0, 0.0, 0.0};
    glm::dvec3 y{0.0, 1.0, 0.0};
    glm::dvec3 z{0.0, 0.0, 1.0};

    [[nodiscard]] glm::dvec3 direction(glm::dvec3 v) const { return x * v.x + y * v.y + z * v.z; }
    [[nodiscard]] glm::dvec3 point(glm::dvec3 p) const { return origin + direction(p); }
    [[nodiscard]] Frame moved(glm::dvec3 offset) const { return {point(offset), x, y, z}; }
    [[nodiscard]] Frame turned(double yaw_radians) const {  // about y, from x toward -z
        double const c = std::cos(yaw_radians);
        double const s = std::sin(yaw_radians);
        return {origin, x * c - z * s, y, z * c + x * s};
    }
};

[[nodiscard]] inline Frame standing_at(glm::dvec3 origin, double yaw_radians = 0.0) {
    Frame frame;
    frame.origin = origin;
    return frame.turned(yaw_radians);
}

// A colour as it is picked on a screen (0xRRGGBB, sRGB), as linear reflectance.
[[nodiscard]] glm::dvec3 srgb(std::uint32_t hex);

// The colour, a little lighter or darker.
[[nodiscard]] glm::dvec3 tinted(glm::dvec3 colour, Random& random, double strength = 0.10);

// A closed outline in the xz plane: a point and the outward normal there, from x toward z.
struct RingPoint {
    glm::dvec2 point;
    glm::dvec2 normal;
};
using Ring = std::vector<RingPoint>;
[[nodiscard]] Ring circle(int sides);
[[nodiscard]] Ring fluted(int flutes, int points_per_flute, double depth);  // a Doric shaft of radius 1

// One point of a turned shape: radius and height.
struct ProfilePoint {
    double radius;
    double height;
};

class MeshBuilder {
public:
    Frame frame;
    glm::dvec3 colour{0.5};

    void triangle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c);
    void triangle(std::array<glm::dvec3, 3> const& corners, std::array<glm::dvec3, 3> const& normals) {
        coloured_triangle(corners, normals, {colour, colour, colour});
    }
    void coloured_triangle(std::array<glm::dvec3, 3> const& corners, std::array<glm::dvec3, 3> const& normals,
                           std::array<glm::dvec3, 3> const& colours);

    // cells x cells squares of two triangles. `point(i, j)` is the place of a grid corner, `normal_at(p)` and
    // `colour_at(p)` are what the surface has there.
    template <class Point, class Normal, class Colour>
    void coloured_patch(int cells, Point const& point, Normal const& normal_at, Colour const& colour_at) {
        for (int j = 0; j < cells; ++j)
            for (int i = 0; i < cells; ++i) {
                std::array const p{point(i, j), point(i, j + 1), point(i + 1, j + 1), point(i + 1, j)};
                for (auto const& k : {std::array<std::size_t, 3>{0, 1, 2}, std::array<std::size_t, 3>{0, 2, 3}})
                    coloured_triangle({p[k[0]], p[k[1]], p[k[2]]},
                                      {normal_at(p[k[0]]), normal_at(p[k[1]]), normal_at(p[k[2]])},
                                      {colour_at(p[k[0]]), colour_at(p[k[1]]), colour_at(p[k[2]])});
            }
    }

    void quad(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d);

    void box(glm::dvec3 lo, glm::dvec3 hi);
    void hexahedron(std::array<glm::dvec3, 8> const& corners);  // corner i: bit 0 is x, bit 1 is y, bit 2 is z
    void beam(glm::dvec3 from, glm::dvec3 to, double width, double height);

    // Turns the profile about y. It runs up the outside; radius 0 at an end closes that end.
    void lathe(std::span<ProfilePoint const> profile, Ring const& ring);
    void lathe(std::initializer_list<ProfilePoint> profile, Ring const& ring) {
        lathe(std::span(profile.begin(), profile.size()), ring);
    }

    // A round tube along a path, closed at both ends.
    void tube(std::span<glm::dvec3 const> path, double first_radius, double last_radius, int sides);

    // A lumpy ellipsoid of 8 * detail^2 triangles; roughness 0 is smooth, 0.3 is a boulder.
    void blob(glm::dvec3 centre, glm::dvec3 radii, int detail, double roughness, std::uint64_t seed, bool smooth);

    // A sheet of columns * rows cells over the unit square, with smooth normals; at(u, v) gives the points.
    template <class PointAt>
    void sheet(int columns, int rows, PointAt&& at) {
        std::vector<glm::dvec3> points;
        for (int j = 0; j <= rows; ++j)
            for (int i = 0; i <= columns; ++i)
                points.push_back(at(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
        sheet_from(points, columns, rows);
    }

    void end_object(bool casts = true);
    [[nodiscard]] std::size_t triangle_count() const { return scene_.indices.size() / 3; }
    [[nodiscard]] backend::Scene finish(std::string name);

private:
    void sheet_from(std::span<glm::dvec3 const> points, int columns, int rows);

    backend::Scene scene_;
    std::size_t object_begin_ = 0;    // first index of the object under construction
    std::size_t vertices_begin_ = 0;  // and its first vertex
};

}  // namespace shadowmath::scenes
