// SPDX-License-Identifier: MIT
//
// What everything is timed on: one street, one camera in it, one sun. Made from integers, so that every run and every
// compiler sees the same.
#pragma once

#include "bench/textbook.hpp"

#include <shadowmath/culling.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/view_volume.hpp>

#include <cstdint>
#include <vector>

namespace bench {

class Random {
public:
    float between(float lo, float hi) {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return lo + (hi - lo) * (static_cast<float>(state_ >> 40) * 0x1p-24f);
    }

private:
    std::uint64_t state_ = 20021201;
};

inline glm::vec3 const sun = glm::normalize(glm::vec3(0.4f, -0.8f, 0.3f));

inline textbook::Camera some_camera(Random& random) {
    textbook::Camera camera;
    camera.position = {random.between(-100, 100), random.between(1, 20), random.between(-100, 100)};
    camera.forward = glm::normalize(glm::vec3(random.between(-1, 1), random.between(-0.3f, 0.1f), -1.0f));
    camera.fov_y = random.between(0.7f, 1.2f);
    return camera;
}

inline shadowmath::ViewVolume<float> view_of(textbook::Camera const& camera) {
    return shadowmath::perspective_view(shadowmath::pose_looking(camera.position, camera.forward, camera.up),
                                        camera.fov_y, camera.aspect, camera.z_near, camera.z_far);
}

// As many as no branch predictor learns, always the same.
constexpr std::size_t view_count = 64;

inline std::vector<textbook::Camera> cameras() {
    Random random;
    std::vector<textbook::Camera> made;
    for (std::size_t i = 0; i < view_count; ++i) made.push_back(some_camera(random));
    return made;
}

inline std::vector<shadowmath::ViewVolume<float>> views_of(std::vector<textbook::Camera> const& cameras) {
    std::vector<shadowmath::ViewVolume<float>> views;
    for (textbook::Camera const& camera : cameras) views.push_back(view_of(camera));
    return views;
}

struct Boxes {
    std::vector<textbook::Box> boxes;
    std::vector<float> columns[6];

    [[nodiscard]] shadowmath::BoxArrays<float> arrays() const {
        return {columns[0].data(), columns[1].data(), columns[2].data(),
                columns[3].data(), columns[4].data(), columns[5].data()};
    }
};

// Crates, cars and houses on a square kilometre, most of them out of view.
inline Boxes town(std::size_t count) {
    Boxes town;
    Random random;
    for (std::size_t i = 0; i < count; ++i) {
        glm::vec3 const lo(random.between(-500, 500), 0.0f, random.between(-500, 500));
        glm::vec3 const size(random.between(0.5f, 12), random.between(0.5f, 20), random.between(0.5f, 12));
        town.boxes.push_back({lo, lo + size});
        for (int axis = 0; axis < 3; ++axis) {
            town.columns[axis].push_back(lo[axis]);
            town.columns[axis + 3].push_back(lo[axis] + size[axis]);
        }
    }
    return town;
}

}  // namespace bench
