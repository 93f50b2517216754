// SPDX-License-Identifier: MIT
//
// One warped map of a view in a town. Textbook: LiSPSM of Wimmer, Scherzer and Purgathofer 2004 around the view's eight
// corners; it cuts nothing down to the town, so it has fewer texels for it, and takes no casters in.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/warp.hpp>

#include <cmath>
#include <limits>

using namespace shadowmath;

namespace {

textbook::Box bounds_in(glm::mat4 const& matrix, std::array<glm::vec3, 8> const& body) {
    textbook::Box box{glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())};
    for (glm::vec3 const& corner : body) {
        glm::vec4 const clip = matrix * glm::vec4(corner, 1.0f);
        box.lo = glm::min(box.lo, glm::vec3(clip) / clip.w), box.hi = glm::max(box.hi, glm::vec3(clip) / clip.w);
    }
    return box;
}

// y toward the light, -z along the view; a frustum from its near end on; and what comes of it scaled to the map.
glm::mat4 lispsm(textbook::Camera const& camera) {
    std::array<glm::vec3, 8> const body = textbook::frustum_corners(camera, camera.z_near, camera.z_far);
    glm::vec3 const ahead = camera.forward - bench::sun * glm::dot(camera.forward, bench::sun);
    glm::mat4 const light = glm::lookAtRH(camera.position, camera.position + ahead, -bench::sun);
    textbook::Box const box = bounds_in(light, body);
    float const sine = glm::length(ahead), deep = box.hi.z - box.lo.z, z_near = camera.z_near;
    float const n = (z_near + std::sqrt(z_near * (z_near + deep * sine))) / sine;
    glm::vec3 const centre((box.lo.x + box.hi.x) * 0.5f, (box.lo.y + box.hi.y) * 0.5f, box.hi.z + n);
    glm::mat4 const warped =
        glm::frustumRH_ZO(-1.0f, 1.0f, -1.0f, 1.0f, n, n + deep) * glm::translate(glm::mat4(1.0f), -centre) * light;
    textbook::Box const used = bounds_in(warped, body);
    // The light comes along y: depth is y, turned over.
    glm::mat4 const of_light(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1);
    return glm::orthoRH_ZO(used.lo.x, used.hi.x, used.lo.z, used.hi.z, -used.hi.y, -used.lo.y) * of_light * warped;
}

int const registered = [] {
    Aabb<float> const town{glm::vec3(-120, 0, -120), glm::vec3(120, 30, 120)};
    auto const cameras = bench::cameras();
    bench::time("simple_perspective_map/ours", bench::views_of(cameras), [town](ViewVolume<float> const& view) {
        return simple_perspective_map(view, directional(bench::sun), town, town, WarpOptions<float>{},
                                      gl_zero_to_one_clip);
    });
    bench::time("simple_perspective_map/textbook", cameras, lispsm);
    return 0;
}();

}  // namespace
