// SPDX-License-Identifier: MIT
//
// Tries ways of aiming shadow cameras inside somebody's engine: the project's scenes, the pictures that the engine
// makes of them, each held against ray-traced truth as the gallery does, and the time that the fit took. What is
// particular to an engine is behind `Engine`; what a reader copies into a renderer is neither, but the one file of glue
// beside each engine's main.cpp.
#pragma once

#include "backends/backend.hpp"
#include "backends/scene.hpp"
#include "scenes/view.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace shadowmath::engines {

inline constexpr int map_size = 1024;

struct SetUp {
    std::string id;     // a file-name-safe word, unique
    std::string title;  // a few words for people
    int maps = 1;       // of map_size squared
    bool ours = false;
    std::string rival{};  // of ours: the engine's own that --check holds it against; empty: none
    // Of casters, as glPolygonOffset takes it, where the engine leaves it to the user: what suits the set-up better of
    // 2 and 1/2. (A warped map is steep wherever w changes, and the slope that hardware offsets by counts that too.)
    float slope_bias = 2.0f;
};

struct Drawn {
    backend::Frame frame;  // position.w: -1, or -2 where there is nothing; normal.w: visibility; normals are not read
    double microseconds = 0.0;  // median, a frame: where the shadow cameras are aimed, all of them
    std::string note;
};

class Engine {
public:
    virtual ~Engine() = default;
    Engine() = default;
    Engine(Engine const&) = delete;
    Engine& operator=(Engine const&) = delete;

    [[nodiscard]] virtual std::string name() const = 0;  // with version and driver
    [[nodiscard]] virtual std::vector<SetUp> set_ups() const = 0;
    virtual void load(backend::Scene const& scene) = 0;  // in place of the one before
    [[nodiscard]] virtual Drawn draw(SetUp const& set_up, scenes::View const& view, backend::Extent extent) = 0;
};

// The program around an engine: command line, truth, pictures, results.json and the table that it prints. `start` is
// called once the truth of all views is found, which is drawn with OpenGL too. Returns what main() should.
int run_trial(int argc, char** argv, std::string const& engine, std::function<std::unique_ptr<Engine>()> const& start);

// The median of many calls.
template <class Call>
[[nodiscard]] double median_microseconds(Call&& call, std::size_t calls = 301) {
    std::vector<double> times;
    for (std::size_t i = 0; i < calls; ++i) {
        auto const begin = std::chrono::steady_clock::now();
        call();
        times.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
    }
    std::nth_element(times.begin(), times.begin() + std::ptrdiff_t(calls / 2), times.end());
    return times[calls / 2];
}

}  // namespace shadowmath::engines
