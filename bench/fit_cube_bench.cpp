// SPDX-License-Identifier: MIT
//
// Six maps around a lamp. Textbook: the same perspective and six times lookAt; whole faces, whether they serve or not.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/fit_cube.hpp>

#include <glm/gtc/matrix_transform.hpp>

using namespace shadowmath;

static int const registered = [] {
    bench::Random random;
    Aabb<float> const town{glm::vec3(-120, 0, -120), glm::vec3(120, 30, 120)};
    auto const views = bench::inputs([&] { return bench::view_of(bench::some_camera(random)); });
    bench::time("fit_cube/ours", views, [town](ViewVolume<float> const& view) {
        glm::vec3 const lamp = view.pose.position + view.pose.forward * 10.0f;
        return fit_cube(view, lamp, 40.0f, town, town, 1024, 2.0f, gl_zero_to_one_clip);
    });
    bench::time("fit_cube/textbook", views, [](ViewVolume<float> const& view) {
        glm::vec3 const lamp = view.pose.position + view.pose.forward * 10.0f;
        glm::mat4 const projection = glm::perspectiveRH_ZO(glm::radians(90.0f), 1.0f, 0.1f, 40.0f);
        std::array<glm::mat4, 6> faces;
        for (int i = 0; i < 6; ++i) {
            glm::vec3 axis(0.0f), up(0.0f);
            axis[i / 2] = i % 2 == 0 ? 1.0f : -1.0f;
            up[i / 2 == 1 ? 2 : 1] = 1.0f;
            faces[static_cast<std::size_t>(i)] = projection * glm::lookAtRH(lamp, lamp + axis, up);
        }
        return faces;
    });
    return 0;
}();
