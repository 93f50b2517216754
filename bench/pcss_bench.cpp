// SPDX-License-Identifier: MIT
//
// Soft edges: 32 taps to find occluders, 32 to filter, four texels each. Textbook: Fernando 2005 with as many taps, a
// texel each, and a constant bias.
#include "bench/depth_picture.hpp"
#include "bench/timed.hpp"

#include <shadowmath/pcss.hpp>
#include <shadowmath/penumbra.hpp>

#include <array>
#include <cmath>

using namespace shadowmath;

namespace {

constexpr float light_radius = 0.05f;  // metres a metre
constexpr float metres_deep = 100.0f, texels_a_metre = 0.01f * bench::map_size;

std::array<glm::vec2, 32> disk() {
    std::array<glm::vec2, 32> taps;
    for (std::size_t i = 0; i < taps.size(); ++i) {
        float const angle = 2.4f * static_cast<float>(i), radius = std::sqrt((static_cast<float>(i) + 0.5f) / 32.0f);
        taps[i] = radius * glm::vec2(std::cos(angle), std::sin(angle));
    }
    return taps;
}

int const registered = [] {
    bench::Random random;
    auto const points = bench::inputs([&] { return bench::some_receiver(random); });
    ShadowMap<float> const map = bench::square_map();
    Light<float> const sun = directional(glm::vec3(0, 0, 1));
    MapBias<float> const bias = bias_for(map, sun, bench::map_size, BiasOptions<float>{});
    MapPenumbra<float> const penumbra = penumbra_for(map, sun, light_radius);
    bench::time("pcss/ours", points, [=, depths = bench::stored_depths()](glm::vec3 const& point) {
        auto const stored = [&](int x, int y) { return depths[std::size_t(y) * bench::map_size + std::size_t(x)]; };
        return soft_visibility(map, bench::map_size, point, glm::vec3(0, 0, -1), bias, penumbra, PcssOptions<float>{},
                               stored)
            .visibility;
    });
    bench::time("pcss/textbook", points, [=, depths = bench::stored_depths(), taps = disk()](glm::vec3 const& point) {
        glm::vec3 const at = bench::in_texels(map.clip_from_world, point);
        auto const stored = [&](glm::vec2 const& offset) {
            glm::ivec2 const t = glm::clamp(glm::ivec2(glm::vec2(at) + offset), 0, bench::map_size - 1);
            return depths[std::size_t(t.y) * bench::map_size + std::size_t(t.x)];
        };
        float const texels_a_depth = light_radius * metres_deep * texels_a_metre;
        float sum = 0.0f, found = 0.0f;
        for (glm::vec2 const& tap : taps) {
            float const depth = stored(tap * (at.z * texels_a_depth));
            if (depth < at.z - 0.005f) sum += depth, found += 1.0f;
        }
        if (!(found > 0.0f)) return 1.0f;
        float const width = (at.z - sum / found) * texels_a_depth;
        float lit = 0.0f;
        for (glm::vec2 const& tap : taps) lit += at.z - 0.005f <= stored(tap * width) ? 1.0f : 0.0f;
        return lit / 32.0f;
    });
    return 0;
}();

}  // namespace
