// SPDX-License-Identifier: MIT
//
// The ball around a slice. Textbook: about the mean of eight corners, as far as the farthest; larger than the least.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/fit_sphere.hpp>

using namespace shadowmath;

static int const registered = [] {
    auto const cameras = bench::cameras();
    auto const views = bench::views_of(cameras);
    bench::time("bounding_sphere/ours", views, [](ViewVolume<float> const& view) { return bounding_sphere(view); });
    bench::time("bounding_sphere/textbook", cameras, [](textbook::Camera const& camera) {
        auto const corners = textbook::frustum_corners(camera, camera.z_near, camera.z_far);
        glm::vec4 ball(textbook::centre_of(corners), 0.0f);
        for (glm::vec3 const& corner : corners) ball.w = glm::max(ball.w, glm::length(corner - glm::vec3(ball)));
        return ball;
    });
    return 0;
}();
