// SPDX-License-Identifier: MIT
//
// Bias at a receiver: how far the plane of its surface rises across the kernel, in the map's own depth. Textbook: a
// constant times the tangent of the light's angle, clamped; it knows neither texels nor kernel.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/bias.hpp>

#include <cmath>

using namespace shadowmath;

static int const registered = [] {
    bench::Random random;
    ShadowMap<float> map;
    map.clip_from_world = textbook::tight_cascades(bench::some_camera(random), bench::sun, 0.5f)[1];
    map.clip = gl_zero_to_one_clip;
    map.visible = true;
    MapBias<float> const bias = bias_for(map, directional(bench::sun), 2048, BiasOptions<float>{});
    glm::vec3 const point(10, 1, -20);
    auto const normals = bench::inputs([&] {
        return glm::normalize(glm::vec3(random.between(-1, 1), random.between(0.2f, 1), random.between(-1, 1)));
    });
    bench::time("bias/ours", normals, [=](glm::vec3 const& normal) {
        return depth_bias(bias, 1.0f, slope(map, 2048, point, normal, bias.slope_limit));
    });
    bench::time("bias/textbook", normals, [](glm::vec3 const& normal) {
        float const cosine = glm::clamp(-glm::dot(normal, bench::sun), 0.0f, 1.0f);
        return glm::clamp(0.005f * std::tan(std::acos(cosine)), 0.0f, 0.01f);
    });
    return 0;
}();
