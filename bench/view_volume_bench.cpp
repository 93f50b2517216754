// SPDX-License-Identifier: MIT
//
// What a view makes: its matrix, and its corners. Textbook: perspective times lookAt, and the inverse of that.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/view_volume.hpp>

#include <glm/gtc/matrix_transform.hpp>

using namespace shadowmath;

static int const registered = [] {
    auto const cameras = bench::cameras();
    auto const views = bench::views_of(cameras);
    bench::time("view_corners/ours", views, [](ViewVolume<float> const& view) { return corners(view); });
    bench::time("view_corners/textbook", cameras, [](textbook::Camera const& camera) {
        return textbook::frustum_corners(camera, camera.z_near, camera.z_far);
    });
    bench::time("view_matrix/ours", views,
                [](ViewVolume<float> const& view) { return clip_from_world(view, gl_zero_to_one_clip); });
    bench::time("view_matrix/textbook", cameras, [](textbook::Camera const& camera) {
        return glm::perspectiveRH_ZO(camera.fov_y, camera.aspect, camera.z_near, camera.z_far) *
               glm::lookAtRH(camera.position, camera.position + camera.forward, camera.up);
    });
    return 0;
}();
