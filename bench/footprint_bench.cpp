// SPDX-License-Identifier: MIT
//
// How large a texel is in the picture. Textbook: four points a millimetre along the surface, projected and subtracted;
// it gives an area only, and little of that in float.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/footprint.hpp>
#include <shadowmath/tangent.hpp>

using namespace shadowmath;

static int const registered = [] {
    bench::Random random;
    textbook::Camera const camera = bench::some_camera(random);
    glm::mat4 const eye = clip_from_world(bench::view_of(camera), gl_zero_to_one_clip);
    glm::mat4 const map = textbook::tight_cascades(camera, bench::sun, 0.5f)[2];
    auto const points = bench::inputs([&] {
        return camera.position + camera.forward * random.between(5, 60) + glm::vec3(random.between(-2, 2), -1.0f, 0.0f);
    });
    bench::time("footprint/ours", points, [eye, map](glm::vec3 const& point) {
        return footprint(eye, glm::vec2(1920, 1080), map, 2048.0f, point, glm::vec3(0, 1, 0));
    });
    bench::time("footprint/textbook", points, [eye, map](glm::vec3 const& point) {
        auto const area = [&point](glm::mat4 const& matrix, glm::vec2 const& half_size) {
            auto const at = [&](glm::vec3 const& p) {
                glm::vec4 const clip = matrix * glm::vec4(p, 1.0f);
                return glm::vec2(clip) / clip.w * half_size;
            };
            glm::vec2 const x = at(point + glm::vec3(1e-3f, 0, 0)) - at(point - glm::vec3(1e-3f, 0, 0));
            glm::vec2 const z = at(point + glm::vec3(0, 0, 1e-3f)) - at(point - glm::vec3(0, 0, 1e-3f));
            return glm::abs(x.x * z.y - x.y * z.x);
        };
        return area(eye, glm::vec2(960, 540)) / area(map, glm::vec2(1024));
    });
    return 0;
}();
