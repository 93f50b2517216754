// SPDX-License-Identifier: MIT
//
// The rectangle of a map that many boxes need. Textbook: eight corners a box, edges cut at w_min.
#include "bench/cases.hpp"

#include <shadowmath/projected_bounds.hpp>

#include <benchmark/benchmark.h>

using namespace shadowmath;

namespace {

glm::mat4 perspective() {
    bench::Random random;
    return clip_from_world(bench::view_of(bench::some_camera(random)), gl_zero_to_one_clip);
}

glm::mat4 affine() {
    bench::Random random;
    return textbook::stable_cascades(bench::some_camera(random), bench::sun, 0.5f, 2048.0f)[3];
}

void ours(benchmark::State& state, glm::mat4 const& matrix) {
    bench::Boxes const town = bench::town(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) {
        Aabb<float> const bounds = projected_bounds(matrix, town.arrays(), static_cast<int>(state.range(0)), 0.1f);
        benchmark::DoNotOptimize(bounds);
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}

void textbooks(benchmark::State& state, glm::mat4 const& matrix) {
    bench::Boxes const town = bench::town(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) {
        textbook::Box const bounds = textbook::region(matrix, town.boxes, 0.1f);
        benchmark::DoNotOptimize(bounds);
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}

}  // namespace

BENCHMARK_CAPTURE(ours, perspective, perspective())->Name("region_perspective/ours")->Arg(1000)->Arg(100'000);
BENCHMARK_CAPTURE(textbooks, perspective, perspective())->Name("region_perspective/textbook")->Arg(1000)->Arg(100'000);
BENCHMARK_CAPTURE(ours, affine, affine())->Name("region_affine/ours")->Arg(1000)->Arg(100'000);
BENCHMARK_CAPTURE(textbooks, affine, affine())->Name("region_affine/textbook")->Arg(1000)->Arg(100'000);
