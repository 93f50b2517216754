// SPDX-License-Identifier: MIT
//
// Nine taps at a receiver, each compared with the plane of its surface and weighted by what the kernel covers of it.
// Textbook: nine taps, one depth, a constant bias, nothing weighted.
#include "bench/depth_picture.hpp"
#include "bench/timed.hpp"

#include <shadowmath/filter.hpp>

using namespace shadowmath;

static int const registered = [] {
    bench::Random random;
    auto const points = bench::inputs([&] { return bench::some_receiver(random); });
    ShadowMap<float> const map = bench::square_map();
    MapBias<float> const bias = bias_for(map, directional(glm::vec3(0, 0, 1)), bench::map_size, BiasOptions<float>{});
    bench::time("filter/ours", points, [=, depths = bench::stored_depths()](glm::vec3 const& point) {
        auto const stored = [&](int x, int y) { return depths[std::size_t(y) * bench::map_size + std::size_t(x)]; };
        return visibility(map, bench::map_size, point, glm::vec3(0, 0, -1), bias, FilterOptions{}, stored);
    });
    bench::time("filter/textbook", points, [=, depths = bench::stored_depths()](glm::vec3 const& point) {
        glm::vec3 const at = bench::in_texels(map.clip_from_world, point);
        float lit = 0.0f;
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                int const x = static_cast<int>(at.x) + i, y = static_cast<int>(at.y) + j;
                lit += at.z - 0.005f <= depths[std::size_t(y) * bench::map_size + std::size_t(x)] ? 1.0f : 0.0f;
            }
        return lit / 9.0f;
    });
    return 0;
}();
