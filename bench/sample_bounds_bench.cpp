// SPDX-License-Identifier: MIT
//
// A picture's depths, in the light-space box of the split that each belongs to. Textbook: every pixel to the world by
// an inverse matrix, divided by w, and from there to the light.
#include "bench/cases.hpp"

#include <shadowmath/sample_bounds.hpp>

#include <benchmark/benchmark.h>

#include <vector>

using namespace shadowmath;

namespace {

constexpr int width = 320, height = 180;

std::vector<float> eye_depths() {
    bench::Random random;
    std::vector<float> depths;
    for (int i = 0; i < width * height; ++i) depths.push_back(200.0f / random.between(1, 400));
    return depths;
}

textbook::Camera camera() {
    bench::Random random;
    return bench::some_camera(random);
}

void ours(benchmark::State& state) {
    std::vector<float> const depths = eye_depths();
    ViewVolume<float> const view = bench::view_of(camera());
    SampleRays<float> const rays = sample_rays(view, directional(bench::sun), width, height);
    for (auto _ : state) {
        SampleBounds<float> bounds = no_bounds(practical_splits(view.z_near, view.z_far, 4));
        for (int y = 0, i = 0; y < height; ++y)
            for (int x = 0; x < width; ++x, ++i) add(bounds, rays, x, y, depths[static_cast<std::size_t>(i)]);
        benchmark::DoNotOptimize(bounds);
    }
}

void textbooks(benchmark::State& state) {
    std::vector<float> const depths = eye_depths();
    textbook::Camera const eye = camera();
    glm::mat4 const projection = glm::perspectiveRH_ZO(eye.fov_y, eye.aspect, eye.z_near, eye.z_far);
    glm::mat4 const world = glm::inverse(projection * glm::lookAtRH(eye.position, eye.position + eye.forward, eye.up));
    glm::mat4 const light = glm::lookAtRH(-bench::sun, glm::vec3(0.0f), glm::vec3(0.0f, 1.0f, 0.0f));
    std::array<float, 5> const plane = textbook::splits(eye.z_near, eye.z_far, 0.5f);
    for (auto _ : state) {
        std::array<textbook::Box, 4> boxes;
        boxes.fill({glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())});
        for (int y = 0, i = 0; y < height; ++y)
            for (int x = 0; x < width; ++x, ++i) {
                float const depth = depths[static_cast<std::size_t>(i)];
                float const z = (projection[2][2] * -depth + projection[3][2]) / depth;
                glm::vec2 const pixel(2.0f * (static_cast<float>(x) + 0.5f) / width - 1.0f,
                                      2.0f * (static_cast<float>(y) + 0.5f) / height - 1.0f);
                glm::vec4 const at = world * glm::vec4(pixel, z, 1.0f);
                glm::vec3 const lit(light * glm::vec4(glm::vec3(at) / at.w, 1.0f));
                for (std::size_t k = 0; k < 4; ++k)
                    if (depth >= plane[k] && depth < plane[k + 1])
                        boxes[k] = {glm::min(boxes[k].lo, lit), glm::max(boxes[k].hi, lit)};
            }
        benchmark::DoNotOptimize(boxes);
    }
}

}  // namespace

BENCHMARK(ours)->Name("sample_bounds/ours")->Arg(width* height);
BENCHMARK(textbooks)->Name("sample_bounds/textbook")->Arg(width* height);
