// SPDX-License-Identifier: MIT
//
// The loop that every benchmark of one call is: over inputs that are too many to be guessed, and kept.
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <vector>

namespace bench {

constexpr std::size_t input_count = 64;

template <class Make>
[[nodiscard]] auto inputs(Make const& make) {
    std::vector<decltype(make())> made;
    for (std::size_t i = 0; i < input_count; ++i) made.push_back(make());
    return made;
}

// Names CASE/VARIANT what `call` takes for one input after the other.
template <class Input, class Call>
void time(char const* name, std::vector<Input> const& inputs, Call const& call) {
    benchmark::RegisterBenchmark(name, [inputs, call](benchmark::State& state) {
        std::size_t i = 0;
        for (auto _ : state) {
            auto result = call(inputs[i++ % input_count]);
            benchmark::DoNotOptimize(result);
        }
    });
}

}  // namespace bench
