// SPDX-License-Identifier: MIT
//
// Masks of four cascades for many boxes. Textbook: six planes a map, one box after the other, out at the first plane.
#include "bench/cases.hpp"

#include <shadowmath/culling.hpp>

#include <benchmark/benchmark.h>

#include <cstring>

using namespace shadowmath;

namespace {

textbook::Maps const& maps() {
    static textbook::Maps const made = [] {
        bench::Random random;
        return textbook::stable_cascades(bench::some_camera(random), bench::sun, 0.5f, 2048.0f);
    }();
    return made;
}

bench::Boxes const& town(std::int64_t count) {
    static std::vector<std::pair<std::int64_t, bench::Boxes>> towns;
    for (auto const& [size, made] : towns)
        if (size == count) return made;
    towns.reserve(8);
    return towns.emplace_back(count, bench::town(static_cast<std::size_t>(count))).second;
}

void ours(benchmark::State& state) {
    bench::Boxes const& boxes = town(state.range(0));
    CasterMaps<float> casters;
    for (glm::mat4 const& matrix : maps()) add_map(casters, ShadowMap<float>{matrix, gl_zero_to_one_clip, 0, true, {}});
    std::vector<MapMask> masks(boxes.boxes.size());
    for (auto _ : state) {
        caster_masks(casters, boxes.arrays(), static_cast<int>(masks.size()), masks.data());
        benchmark::DoNotOptimize(masks.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
    state.SetBytesProcessed(state.iterations() * state.range(0) * 24);
}

void textbooks(benchmark::State& state) {
    bench::Boxes const& boxes = town(state.range(0));
    std::array<textbook::Frustum, 4> frustums;
    for (std::size_t i = 0; i < 4; ++i) frustums[i] = textbook::frustum_of(maps()[i]);
    std::vector<std::uint16_t> masks(boxes.boxes.size());
    for (auto _ : state) {
        textbook::masks(frustums, boxes.boxes, masks);
        benchmark::DoNotOptimize(masks.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}

// Reads what the masks are made from, and does next to nothing with it; as wide as the machine can in either build.
struct Read {
    std::vector<float> const& column;
    std::uint32_t (&seen)[64];

    [[gnu::always_inline]] void operator()() const noexcept {
        for (std::size_t i = 0; i + 64 <= column.size(); i += 64)
            for (std::size_t j = 0; j < 64; ++j) {
                std::uint32_t bits;
                std::memcpy(&bits, &column[i + j], sizeof bits);
                seen[j] |= bits;
            }
    }
};

void read(benchmark::State& state) {
    bench::Boxes const& boxes = town(state.range(0));
    for (auto _ : state) {
        std::uint32_t seen[64] = {};
        for (std::vector<float> const& column : boxes.columns) detail::run_widely(Read{column, seen});
        benchmark::DoNotOptimize(seen);
    }
    state.SetBytesProcessed(state.iterations() * state.range(0) * 24);
}

}  // namespace

BENCHMARK(ours)->Name("caster_masks/ours")->Arg(10'000)->Arg(1'000'000)->Arg(1 << 22);
BENCHMARK(read)->Name("caster_masks/read")->Arg(1 << 22);
BENCHMARK(textbooks)->Name("caster_masks/textbook")->Arg(10'000)->Arg(1'000'000);
