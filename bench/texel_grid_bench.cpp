// SPDX-License-Identifier: MIT
//
// A ball's window on the grid of texels. Textbook: the matrix first, and then the origin moved to a whole texel.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/fit_sphere.hpp>
#include <shadowmath/texel_grid.hpp>

#include <glm/gtc/matrix_transform.hpp>

using namespace shadowmath;

static int const registered = [] {
    bench::Random random;
    auto const balls = bench::inputs([&] { return bounding_sphere(bench::view_of(bench::some_camera(random))); });
    LightBasis<float> const basis = light_basis(bench::sun);
    bench::time("texel_grid/ours", balls, [basis](Sphere<float> const& ball) {
        return clip_from_world(texel_grid(basis, ball, 2048, 2.0f), -ball.radius, ball.radius, gl_zero_to_one_clip);
    });
    bench::time("texel_grid/textbook", balls, [](Sphere<float> const& ball) {
        float const radius = std::ceil(ball.radius * 16.0f) / 16.0f;
        glm::mat4 const view =
            glm::lookAtRH(ball.center - bench::sun * radius, ball.center, glm::vec3(0.0f, 1.0f, 0.0f));
        glm::mat4 projection = glm::orthoRH_ZO(-radius, radius, -radius, radius, 0.0f, 2.0f * radius);
        glm::vec2 const origin(projection * view * glm::vec4(0.0f, 0.0f, 0.0f, 1.0f) * 1024.0f);
        glm::vec2 const offset = (glm::round(origin) - origin) * (2.0f / 2048.0f);
        projection[3].x += offset.x;
        projection[3].y += offset.y;
        return projection * view;
    });
    return 0;
}();
