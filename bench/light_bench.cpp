// SPDX-License-Identifier: MIT
//
// Axes of a light. Textbook: lookAt, which is none for a light from straight above.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/light.hpp>

#include <glm/gtc/matrix_transform.hpp>

using namespace shadowmath;

static int const registered = [] {
    bench::Random random;
    auto const lights = bench::inputs([&] {
        return glm::normalize(glm::vec3(random.between(-1, 1), random.between(-1, -0.2f), random.between(-1, 1)));
    });
    bench::time("light_basis/ours", lights, [](glm::vec3 const& light) { return light_basis(light); });
    bench::time("light_basis/textbook", lights, [](glm::vec3 const& light) {
        return glm::mat3(glm::lookAtRH(glm::vec3(0.0f), light, glm::vec3(0.0f, 1.0f, 0.0f)));
    });
    return 0;
}();
