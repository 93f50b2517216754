// SPDX-License-Identifier: MIT
#include "examples/quality/recipes.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace shadowmath::quality {
namespace {

using Points = std::vector<glm::dvec3>;

// Texels that the 3x3 filter may reach beyond the slice.
constexpr double border_texels = 2.0;

std::array<double, recipe_maps + 1> practical_planes(Camera const& camera) {
    std::array<double, recipe_maps + 1> planes{};
    double const n = camera.z_near, f = camera.shadow_distance;
    for (int i = 0; i <= recipe_maps; ++i) {
        double const part = double(i) / recipe_maps;
        planes[std::size_t(i)] = 0.5 * n * std::pow(f / n, part) + 0.5 * (n + (f - n) * part);
    }
    return planes;
}

Points slice_corners(Camera const& camera, double begin, double end) {
    Points corners;
    for (double const z : {begin, end})
        for (double const y : {-1.0, 1.0})
            for (double const x : {-1.0, 1.0})
                corners.push_back(camera.eye + z * (camera.forward + x * camera.slope_x * camera.right +
                                                    y * camera.slope_y * camera.up));
    return corners;
}

struct Axes {
    glm::dvec3 x, y, depth;
    [[nodiscard]] glm::dvec3 of(glm::dvec3 p) const { return {glm::dot(x, p), glm::dot(y, p), glm::dot(depth, p)}; }
};

Axes axes_with_up(glm::dvec3 travel, glm::dvec3 up) {
    if (glm::length(glm::cross(travel, up)) < 1e-3) up = {0.0, 0.0, 1.0};
    glm::dvec3 const x = glm::normalize(glm::cross(travel, up));
    return {x, glm::cross(x, travel), travel};
}

Box bounds_of(Axes const& axes, Points const& points) {
    Box box{glm::dvec3(std::numeric_limits<double>::max()), glm::dvec3(std::numeric_limits<double>::lowest())};
    for (glm::dvec3 const& p : points) {
        box.lo = glm::min(box.lo, axes.of(p));
        box.hi = glm::max(box.hi, axes.of(p));
    }
    return box;
}

Points corners_of(Box const& box) {
    Points corners;
    for (int i = 0; i < 8; ++i)
        corners.emplace_back((i & 1) != 0 ? box.hi.x : box.lo.x, (i & 2) != 0 ? box.hi.y : box.lo.y,
                             (i & 4) != 0 ? box.hi.z : box.lo.z);
    return corners;
}

void widen(Box& box, int map_size) {
    for (int axis = 0; axis < 2; ++axis) {
        double const extent = std::max(box.hi[axis] - box.lo[axis], 1e-3);
        double const border = border_texels * extent / (map_size - 2.0 * border_texels);
        box.lo[axis] -= border;
        box.hi[axis] += border;
    }
}

// Depth from the first corner of the scene to behind the slice.
glm::dmat4 orthographic(Axes const& axes, Box box, Box const& scene) {
    box.lo.z = std::min(box.lo.z, bounds_of(axes, corners_of(scene)).lo.z) - 0.1;
    box.hi.z += 0.1;
    glm::dvec3 const extent = box.hi - box.lo;
    glm::dmat4 rows(0.0);  // column r is row r
    rows[0] = {axes.x * (2.0 / extent.x), -(box.hi.x + box.lo.x) / extent.x};
    rows[1] = {axes.y * (2.0 / extent.y), -(box.hi.y + box.lo.y) / extent.y};
    rows[2] = {axes.depth / extent.z, -box.lo.z / extent.z};
    rows[3] = {0.0, 0.0, 0.0, 1.0};
    return glm::transpose(rows);
}

// What of a polyhedron, given as polygons, lies inside a box: Sutherland and Hodgman, and a cap for each cut.
using Faces = std::vector<Points>;

Faces faces_of(Points const& c) {
    return {{c[0], c[1], c[3], c[2]}, {c[4], c[5], c[7], c[6]}, {c[0], c[1], c[5], c[4]},
            {c[2], c[3], c[7], c[6]}, {c[0], c[2], c[6], c[4]}, {c[1], c[3], c[7], c[5]}};
}

Faces cut(Faces const& faces, int axis, double limit, bool keep_above) {
    auto const inside = [&](glm::dvec3 p) { return keep_above ? p[axis] - limit : limit - p[axis]; };
    Faces kept;
    Points cap;
    for (Points const& face : faces) {
        Points part;
        for (std::size_t i = 0; i < face.size(); ++i) {
            glm::dvec3 const a = face[i], b = face[(i + 1) % face.size()];
            double const at_a = inside(a), at_b = inside(b);
            if (at_a >= 0.0) part.push_back(a);
            if ((at_a >= 0.0) != (at_b >= 0.0)) {
                part.push_back(a + (b - a) * (at_a / (at_a - at_b)));
                cap.push_back(part.back());
            }
        }
        if (part.size() >= 3) kept.push_back(part);
    }
    if (cap.size() < 3) return kept;
    // In order around their middle.
    glm::dvec3 middle(0.0);
    for (glm::dvec3 const& p : cap) middle += p / double(cap.size());
    int const u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::sort(cap.begin(), cap.end(), [&](glm::dvec3 const& a, glm::dvec3 const& b) {
        return std::atan2(a[v] - middle[v], a[u] - middle[u]) < std::atan2(b[v] - middle[v], b[u] - middle[u]);
    });
    kept.push_back(cap);
    return kept;
}

Points inside_of(Points const& corners, Box const& box) {
    Faces faces = faces_of(corners);
    for (int axis = 0; axis < 3; ++axis) {
        faces = cut(faces, axis, box.lo[axis], true);
        faces = cut(faces, axis, box.hi[axis], false);
    }
    Points points;
    for (Points const& face : faces) points.insert(points.end(), face.begin(), face.end());
    return points;
}

glm::dvec3 along_view(Camera const& camera, glm::dvec3 travel) {
    return glm::length(glm::cross(camera.forward, travel)) > 1e-3 ? camera.forward : camera.up;
}

template <class Fit>
RecipeMaps for_each_slice(Camera const& camera, Fit&& fit) {
    auto const planes = practical_planes(camera);
    RecipeMaps maps;
    for (std::size_t i = 0; i < maps.size(); ++i) {
        maps[i].begin = planes[i];
        maps[i].end = planes[i + 1];
        fit(maps[i], slice_corners(camera, planes[i], planes[i + 1]));
    }
    return maps;
}

}  // namespace

RecipeMaps textbook_box(Camera const& camera, glm::dvec3 travel, Box const& scene, int map_size) {
    Axes const axes = axes_with_up(travel, {0.0, 1.0, 0.0});
    return for_each_slice(camera, [&](RecipeMap& map, Points const& corners) {
        Box box = bounds_of(axes, corners);
        widen(box, map_size);
        map.clip_from_world = orthographic(axes, box, scene);
        map.visible = true;
    });
}

RecipeMaps centroid_sphere(Camera const& camera, glm::dvec3 travel, Box const& scene, int map_size) {
    Axes const axes = axes_with_up(travel, {0.0, 1.0, 0.0});
    return for_each_slice(camera, [&](RecipeMap& map, Points const& corners) {
        glm::dvec3 centre(0.0);
        for (glm::dvec3 const& p : corners) centre += p / double(corners.size());
        double radius = 0.0;
        for (glm::dvec3 const& p : corners) radius = std::max(radius, glm::distance(p, centre));
        radius = std::ceil(radius * 16.0) / 16.0;
        double const texel = 2.0 * radius / (map_size - 1.0 - 2.0 * border_texels), half = 0.5 * texel * map_size;
        glm::dvec3 middle = axes.of(centre);
        middle.x = std::floor(middle.x / texel + 0.5) * texel;
        middle.y = std::floor(middle.y / texel + 0.5) * texel;
        Box const box{middle - glm::dvec3(half, half, radius), middle + glm::dvec3(half, half, radius)};
        map.clip_from_world = orthographic(axes, box, scene);
        map.visible = true;
    });
}

RecipeMaps focus(Camera const& camera, glm::dvec3 travel, Box const& scene, int map_size) {
    Axes const axes = axes_with_up(travel, along_view(camera, travel));
    return for_each_slice(camera, [&](RecipeMap& map, Points const& corners) {
        Points const body = inside_of(corners, scene);
        if (body.empty()) return;
        Box box = bounds_of(axes, body);
        widen(box, map_size);
        map.clip_from_world = orthographic(axes, box, scene);
        map.visible = true;
    });
}

RecipeMaps lispsm(Camera const& camera, glm::dvec3 travel, Box const& scene, int map_size) {
    double const sine = glm::length(glm::cross(camera.forward, travel));
    if (sine < 1e-3) return focus(camera, travel, scene, map_size);
    // X, Y = against the light, Z = against the projected view.
    glm::dvec3 const y = -travel, x = glm::normalize(glm::cross(camera.forward, y)), z = glm::cross(x, y);
    return for_each_slice(camera, [&](RecipeMap& map, Points const& corners) {
        Points const seen = inside_of(corners, scene);
        if (seen.empty()) return;
        // B: what is seen, and where its rays to the light leave the scene.
        Points body = seen;
        for (glm::dvec3 const& p : seen) {
            double out = std::numeric_limits<double>::max();
            for (int axis = 0; axis < 3; ++axis) {
                if (std::abs(travel[axis]) < 1e-9) continue;
                double const side = travel[axis] < 0.0 ? scene.hi[axis] : scene.lo[axis];
                out = std::min(out, std::max((side - p[axis]) / -travel[axis], 0.0));
            }
            if (out < std::numeric_limits<double>::max()) body.push_back(p - travel * out);
        }
        glm::dvec3 nearest = seen.front();
        double z0 = std::numeric_limits<double>::max();
        for (glm::dvec3 const& p : seen) {
            double const depth = glm::dot(camera.forward, p - camera.eye);
            if (depth < z0) {
                z0 = depth;
                nearest = p;
            }
        }
        z0 = std::max(z0, camera.z_near);
        double z_max = std::numeric_limits<double>::lowest(), z_min = -z_max;
        for (glm::dvec3 const& p : body) {
            z_max = std::max(z_max, glm::dot(z, p));
            z_min = std::min(z_min, glm::dot(z, p));
        }
        double const d = z_max - z_min;
        if (!(d > 0.0)) return;
        double const n = d / (std::sqrt((z0 + d * sine) / z0) - 1.0), f = n + d;
        glm::dvec3 const centre(glm::dot(x, nearest), glm::dot(y, nearest), z_max + n);
        glm::dvec4 const w(-z, centre.z), one(0.0, 0.0, 0.0, 1.0);
        glm::dvec4 const across = n * glm::dvec4(x, -centre.x);
        glm::dvec4 const along = (w * (f + n) - one * (2.0 * f * n)) / d;
        glm::dvec4 const depth = -n * glm::dvec4(y, -centre.y);
        // The fit: the box of the body's NDC is the map.
        glm::dvec3 lo(std::numeric_limits<double>::max()), hi(std::numeric_limits<double>::lowest());
        for (glm::dvec3 const& p : body) {
            glm::dvec4 const h(p, 1.0);
            glm::dvec3 const ndc =
                glm::dvec3(glm::dot(across, h), glm::dot(along, h), glm::dot(depth, h)) / glm::dot(w, h);
            lo = glm::min(lo, ndc);
            hi = glm::max(hi, ndc);
        }
        Box box{lo, hi};
        widen(box, map_size);
        glm::dvec3 const extent = box.hi - box.lo;
        glm::dmat4 rows(0.0);
        rows[0] = (across * 2.0 - w * (box.hi.x + box.lo.x)) / extent.x;
        rows[1] = (along * 2.0 - w * (box.hi.y + box.lo.y)) / extent.y;
        rows[2] = (depth - w * box.lo.z) / extent.z;
        rows[3] = w;
        map.clip_from_world = glm::transpose(rows) / n;  // w is 1 at the near end
        map.w_min = 0.5;
        map.visible = true;
    });
}

}  // namespace shadowmath::quality
