// SPDX-License-Identifier: MIT
//
// One map around eight corners, along given axes. Textbook: lookAt at their centre, bounds, ortho.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/fit_box.hpp>
#include <shadowmath/light_box.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include <limits>

using namespace shadowmath;

static int const registered = [] {
    bench::Random random;
    auto const bodies = bench::inputs([&] { return corners(bench::view_of(bench::some_camera(random))); });
    LightBasis<float> const basis = light_basis(bench::sun);
    bench::time("fit_box/ours", bodies, [basis](std::array<glm::vec3, 8> const& body) {
        return clip_from_world(fit_box(basis, body, 2048, 2.0f), gl_zero_to_one_clip);
    });
    bench::time("fit_box/textbook", bodies, [](std::array<glm::vec3, 8> const& body) {
        glm::vec3 const centre = textbook::centre_of(body);
        glm::mat4 const view = glm::lookAtRH(centre - bench::sun, centre, glm::vec3(0.0f, 1.0f, 0.0f));
        glm::vec3 lo(std::numeric_limits<float>::max()), hi(std::numeric_limits<float>::lowest());
        for (glm::vec3 const& corner : body) {
            glm::vec3 const at(view * glm::vec4(corner, 1.0f));
            lo = glm::min(lo, at), hi = glm::max(hi, at);
        }
        return glm::orthoRH_ZO(lo.x, hi.x, lo.y, hi.y, -hi.z, -lo.z) * view;
    });
    return 0;
}();
