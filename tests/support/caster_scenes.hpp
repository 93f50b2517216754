// SPDX-License-Identifier: MIT
//
// Triangle soups of any size that shadows are hard for: rolling ground, boxes on a floor, loose leaves over it. Each
// with an eye and a sun. The same size gives the same bytes everywhere.
#pragma once

#include <shadowmath/light.hpp>
#include <shadowmath/view_volume.hpp>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace shadowmath::test {

struct CasterScene {
    std::string name;
    std::vector<float> positions;  // x, y, z of three vertices a triangle
    ViewVolume<float> eye;
    Light<float> sun;
    float extent = 40.0f;  // everything lies within this of the origin across, and
    float height = 12.0f;  // from -height to height

    [[nodiscard]] std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(positions.size() / 9); }

    void add(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
        for (glm::dvec3 const& p : {a, b, c})
            for (int axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>(p[axis]));
    }
};

// PCG, 32 bits.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : state_(seed) {}
    double operator()(double lo, double hi) {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        auto const mixed = static_cast<std::uint32_t>(((state_ >> 18u) ^ state_) >> 27u);
        auto const turn = static_cast<std::uint32_t>(state_ >> 59u);
        std::uint32_t const drawn = (mixed >> turn) | (mixed << ((32u - turn) & 31u));
        return lo + (hi - lo) * drawn / 4294967296.0;
    }

private:
    std::uint64_t state_;
};

inline ViewVolume<float> standing_eye(float aspect) {
    Pose<float> const pose = pose_looking<float>({-31.0f, 7.5f, 29.0f}, {0.72f, -0.24f, -0.65f}, {0.0f, 1.0f, 0.0f});
    return perspective_view<float>(pose, 1.0f, aspect, 0.1f, 300.0f);
}

inline double ground_height(double x, double z) {
    return 1.9 * std::sin(0.21 * x + 0.4) * std::cos(0.17 * z) + 0.6 * std::sin(0.71 * x - 0.53 * z) +
           0.25 * std::sin(1.9 * x + 1.1 * z) * std::sin(1.7 * z) + 0.06 * std::sin(5.3 * x) * std::cos(6.1 * z);
}

inline CasterScene terrain_scene(std::uint32_t triangles, float aspect) {
    CasterScene scene;
    scene.name = "terrain";
    scene.eye = standing_eye(aspect);
    scene.sun = directional<float>({0.55f, -0.35f, 0.3f});
    int const cells = static_cast<int>(std::sqrt(triangles / 2.0));
    auto const point = [&](int i, int j) {
        double const x = -40.0 + 80.0 * i / cells, z = -40.0 + 80.0 * j / cells;
        return glm::dvec3(x, ground_height(x, z), z);
    };
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            scene.add(point(i, j), point(i, j + 1), point(i + 1, j));
            scene.add(point(i + 1, j), point(i, j + 1), point(i + 1, j + 1));
        }
    return scene;
}

inline void add_floor(CasterScene& scene, int cells) {
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            auto const at = [cells](int a, int b) {
                return glm::dvec3(-40.0 + 80.0 * a / cells, 0.0, -40.0 + 80.0 * b / cells);
            };
            scene.add(at(i, j), at(i, j + 1), at(i + 1, j));
            scene.add(at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
        }
}

inline CasterScene boxes_scene(std::uint32_t triangles, float aspect) {
    CasterScene scene;
    scene.name = "boxes";
    scene.eye = standing_eye(aspect);
    scene.sun = directional<float>({0.5f, -0.6f, 0.25f});
    add_floor(scene, 4);
    Dice dice(7);
    std::uint32_t const boxes = (triangles - scene.triangle_count()) / 12;
    double const size = 0.45 * 80.0 / std::sqrt(static_cast<double>(boxes));
    for (std::uint32_t k = 0; k < boxes; ++k) {
        double const x = dice(-40.0, 40.0), z = dice(-40.0, 40.0), turn = dice(0.0, 6.283);
        double const wide = size * dice(0.3, 1.0), deep = size * dice(0.3, 1.0), tall = size * dice(0.3, 6.0);
        glm::dvec3 corner[8];
        for (int i = 0; i < 8; ++i) {
            double const a = (i & 1) != 0 ? wide : -wide, b = (i & 2) != 0 ? deep : -deep;
            corner[i] = glm::dvec3(x + a * std::cos(turn) - b * std::sin(turn), (i & 4) != 0 ? tall : 0.0,
                                   z + a * std::sin(turn) + b * std::cos(turn));
        }
        int const face[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
        for (auto const& f : face) {
            scene.add(corner[f[0]], corner[f[1]], corner[f[2]]);
            scene.add(corner[f[0]], corner[f[2]], corner[f[3]]);
        }
    }
    return scene;
}

inline CasterScene leaves_scene(std::uint32_t triangles, float aspect) {
    CasterScene scene;
    scene.name = "leaves";
    scene.eye = standing_eye(aspect);
    scene.sun = directional<float>({0.4f, -0.8f, 0.3f});
    add_floor(scene, 4);
    Dice dice(11);
    // Leaves together cover three times the ground, in crowns of 3 m.
    std::uint32_t const leaves = (triangles - scene.triangle_count()) / 2;
    double const size = std::sqrt(0.6 * 6400.0 / leaves);
    glm::dvec3 crown[60];
    for (glm::dvec3& c : crown) c = glm::dvec3(dice(-38.0, 38.0), dice(3.0, 7.0), dice(-38.0, 38.0));
    for (std::uint32_t k = 0; k < leaves; ++k) {
        int const tree = static_cast<int>(dice(0.0, 60.0));
        glm::dvec3 place;
        do place = glm::dvec3(dice(-1.0, 1.0), dice(-1.0, 1.0), dice(-1.0, 1.0));
        while (glm::dot(place, place) > 1.0);
        glm::dvec3 const at = crown[tree] + place * 3.0;
        glm::dvec3 along(dice(-1.0, 1.0), dice(-1.0, 1.0), dice(-1.0, 1.0)),
            side(dice(-1.0, 1.0), dice(-1.0, 1.0), dice(-1.0, 1.0));
        along = glm::normalize(along + glm::dvec3(1e-3, 0.0, 0.0)) * size;
        side = glm::normalize(glm::cross(along, side + glm::dvec3(0.0, 1e-3, 0.0))) * (0.5 * size);
        scene.add(at - along, at - side, at + side);
        scene.add(at + side, at - side, at + along);
    }
    return scene;
}

}  // namespace shadowmath::test
