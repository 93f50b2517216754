// SPDX-License-Identifier: MIT
//
// What every way of adding shadowmath must be able to build.
#include <shadowmath/shadowmath.hpp>

#include <cstdio>

int main() {
    namespace sm = shadowmath;
    sm::Pose<float> pose;
    pose.position = {0.0f, 2.0f, 0.0f};
    sm::Aabb<float> const world{{-50.0f, 0.0f, -50.0f}, {50.0f, 10.0f, 50.0f}};
    auto const view = sm::perspective_view(pose, 1.0f, 1.5f, 0.1f, 100.0f);
    auto const sun = sm::directional(glm::vec3(0.3f, -1.0f, 0.2f));
    auto const cascades = sm::fit_cascades(view, sun, world, world, sm::CascadeOptions<float>());
    std::printf("shadowmath %d.%d.%d: %d maps\n", SHADOWMATH_VERSION_MAJOR, SHADOWMATH_VERSION_MINOR,
                SHADOWMATH_VERSION_PATCH, cascades.count);
    return cascades.count == 4 ? 0 : 1;
}
