// SPDX-License-Identifier: MIT
//
// A picture's depths, a bin each. Textbook: a histogram by logarithms, which keeps counts and no bounds.
#include "bench/cases.hpp"

#include <shadowmath/sample_depths.hpp>

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <vector>

using namespace shadowmath;

namespace {

std::vector<float> picture(std::size_t count) {
    bench::Random random;
    std::vector<float> depths;
    for (std::size_t i = 0; i < count; ++i) depths.push_back(200.0f / random.between(1, 400));
    return depths;
}

void ours(benchmark::State& state) {
    std::vector<float> const depths = picture(static_cast<std::size_t>(state.range(0)));
    auto const bins = std::make_unique<SampleDepths<float>>(no_depths(0.1f, 200.0f));
    for (auto _ : state) {
        for (float const depth : depths) add(*bins, depth);
        benchmark::ClobberMemory();
    }
}

void textbooks(benchmark::State& state) {
    std::vector<float> const depths = picture(static_cast<std::size_t>(state.range(0)));
    std::vector<unsigned> bins(512);
    float const scale = 512.0f / std::log(200.0f / 0.1f);
    for (auto _ : state) {
        for (float const depth : depths) {
            float const bin = std::log(depth / 0.1f) * scale;
            if (bin >= 0.0f && bin < 512.0f) ++bins[static_cast<std::size_t>(bin)];
        }
        benchmark::ClobberMemory();
    }
}

}  // namespace

BENCHMARK(ours)->Name("sample_depths/ours")->Arg(320 * 180);
BENCHMARK(textbooks)->Name("sample_depths/textbook")->Arg(320 * 180);
