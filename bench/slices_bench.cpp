// SPDX-License-Identifier: MIT
//
// Four cascades of one view, splits and light axes included. Textbook: inverse matrix, eight corners, lookAt, ortho.
#include "bench/bounds.hpp"
#include "bench/cases.hpp"

#include <shadowmath/shadowmath.hpp>

#include <benchmark/benchmark.h>

using namespace shadowmath;

namespace {

constexpr std::size_t view_count = 64;

std::vector<textbook::Camera> cameras() {
    bench::Random random;
    std::vector<textbook::Camera> made;
    for (std::size_t i = 0; i < view_count; ++i) made.push_back(bench::some_camera(random));
    return made;
}

// Calls with one view after the other.
template <class Call>
void with_views(benchmark::State& state, Call const& call) {
    std::vector<ViewVolume<float>> views;
    for (textbook::Camera const& camera : cameras()) views.push_back(bench::view_of(camera));
    glm::mat4 maps[4];
    std::size_t i = 0;
    for (auto _ : state) {
        call(views[i++ % view_count], maps);
        benchmark::DoNotOptimize(maps);
        benchmark::ClobberMemory();
    }
}

template <class Call>
void with_cameras(benchmark::State& state, Call const& call) {
    std::vector<textbook::Camera> const all = cameras();
    std::size_t i = 0;
    for (auto _ : state) {
        textbook::Maps maps = call(all[i++ % view_count]);
        benchmark::DoNotOptimize(maps);
        benchmark::ClobberMemory();
    }
}

void boxes(benchmark::State& state) {
    with_views(state, [](ViewVolume<float> const& view, glm::mat4* maps) {
        Splits<float> const splits = practical_splits(view.z_near, view.z_far, 4);
        bool const fitted =
            fit_slice_boxes(view, light_basis(bench::sun), splits, 2.0f / 2048, gl_zero_to_one_clip, maps);
        benchmark::DoNotOptimize(fitted);
    });
}

void boxes_bound(benchmark::State& state) {
    with_views(state,
               [](ViewVolume<float> const& view, glm::mat4* maps) { bounds::slice_boxes(view, bench::sun, maps); });
}

void boxes_textbook(benchmark::State& state) {
    with_cameras(state,
                 [](textbook::Camera const& camera) { return textbook::tight_cascades(camera, bench::sun, 0.5f); });
}

}  // namespace

BENCHMARK(boxes)->Name("slice_boxes/ours");
BENCHMARK(boxes_bound)->Name("slice_boxes/bound");
BENCHMARK(boxes_textbook)->Name("slice_boxes/textbook");
