// SPDX-License-Identifier: MIT
//
// Which of four cascades a receiver is looked up in: the first that holds it. Textbook: the slice that its depth is in.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/sampling.hpp>

#include <array>

using namespace shadowmath;

static int const registered = [] {
    bench::Random random;
    textbook::Camera const camera = bench::some_camera(random);
    textbook::Maps const matrices = textbook::tight_cascades(camera, bench::sun, 0.5f);
    std::array<float, 5> const plane = textbook::splits(camera.z_near, camera.z_far, 0.5f);
    std::array<ShadowMap<float>, 4> maps;
    for (std::size_t i = 0; i < 4; ++i) {
        maps[i].clip_from_world = matrices[i];
        maps[i].clip = gl_zero_to_one_clip;
        maps[i].visible = true;
    }
    auto const points = bench::inputs([&] { return camera.position + camera.forward * random.between(1, 190); });
    bench::time("look_up/ours", points,
                [maps](glm::vec3 const& point) { return by_map(maps.data(), 4, 2048, 2.0f, point); });
    bench::time("look_up/textbook", points, [=](glm::vec3 const& point) {
        float const depth = glm::dot(point - camera.position, camera.forward);
        int map = 0;
        while (map < 3 && depth >= plane[static_cast<std::size_t>(map) + 1]) ++map;
        return map;
    });
    return 0;
}();
