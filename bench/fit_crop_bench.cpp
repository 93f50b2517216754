// SPDX-License-Identifier: MIT
//
// A spot's map, cut down to what the eye sees. Textbook: the corners of the view divided by w in the light's clip
// space, and a crop to their bounds; wrong as soon as one of them lies behind the light.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/fit_crop.hpp>

#include <limits>

using namespace shadowmath;

static int const registered = [] {
    Aabb<float> const town{glm::vec3(-120, 0, -120), glm::vec3(120, 30, 120)};
    auto const cameras = bench::cameras();
    auto const lamp_of = [](glm::vec3 const& eye) { return eye + glm::vec3(0, 15, 10); };
    glm::vec3 const down = glm::normalize(glm::vec3(0, -0.6f, -1));
    bench::time("fit_spot/ours", bench::views_of(cameras), [=](ViewVolume<float> const& view) {
        Light<float> const lamp = spot(lamp_of(view.pose.position), down, 0.5f, 60.0f);
        return fit_spot(view, lamp, town, town, 1024, 2.0f, gl_zero_to_one_clip);
    });
    bench::time("fit_spot/textbook", cameras, [=](textbook::Camera const& camera) {
        glm::vec3 const lamp = lamp_of(camera.position);
        glm::mat4 const light = glm::perspectiveRH_ZO(1.0f, 1.0f, 0.1f, 60.0f) *
                                glm::lookAtRH(lamp, lamp + down, glm::vec3(0.0f, 1.0f, 0.0f));
        glm::vec3 lo(std::numeric_limits<float>::max()), hi(std::numeric_limits<float>::lowest());
        for (glm::vec3 const& corner : textbook::frustum_corners(camera, camera.z_near, camera.z_far)) {
            glm::vec4 const clip = light * glm::vec4(corner, 1.0f);
            lo = glm::min(lo, glm::vec3(clip) / clip.w), hi = glm::max(hi, glm::vec3(clip) / clip.w);
        }
        lo = glm::max(lo, glm::vec3(-1.0f)), hi = glm::min(hi, glm::vec3(1.0f));
        glm::mat4 crop(1.0f);
        for (int axis = 0; axis < 2; ++axis) {
            crop[axis][axis] = 2.0f / (hi[axis] - lo[axis]);
            crop[3][axis] = -(hi[axis] + lo[axis]) / (hi[axis] - lo[axis]);
        }
        return crop * light;
    });
    return 0;
}();
