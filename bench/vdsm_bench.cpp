// SPDX-License-Identifier: MIT
//
// The vertex transform of the view-dependent map. Textbook: the program of the thesis, a vertex at a
// time. `loop`: the same inlined, for compilers to take several at once; `folded`: with the matrices of eye and light
// multiplied beforehand. `copy` moves as many bytes and computes nothing.
#include "bench/cases.hpp"

#include <shadowmath/points.hpp>
#include <shadowmath/vdsm.hpp>

#include <benchmark/benchmark.h>

#include <cstring>

using namespace shadowmath;

namespace {

struct Vertices {
    std::vector<glm::vec3> points;
    std::vector<glm::vec4> clip;
};

Vertices& vertices(std::int64_t count) {
    static Vertices made;
    bench::Random random;
    while (made.points.size() < static_cast<std::size_t>(count))
        made.points.push_back({random.between(-100, 100), random.between(0, 20), random.between(-100, 100)});
    made.clip.resize(made.points.size());
    return made;
}

textbook::ThesisMap thesis_map() {
    bench::Random random;
    textbook::Camera const camera = bench::some_camera(random);
    textbook::ThesisMap map;
    map.world = glm::mat4(1.0f);
    map.light_view = glm::lookAtRH(-200.0f * bench::sun, glm::vec3(0.0f), glm::vec3(0, 1, 0));
    map.light_projection = glm::orthoRH_ZO(-200.0f, 200.0f, -200.0f, 200.0f, 0.0f, 400.0f);
    map.eye_view = glm::lookAtRH(camera.position, camera.position + camera.forward, camera.up);
    map.eye_projection = glm::perspectiveRH_ZO(camera.fov_y, camera.aspect, camera.z_near, camera.z_far);
    map.light = bench::sun;
    map.plane = glm::vec4(0, 1, 0, 0);
    return map;
}

// The same as one matrix.
glm::mat4 one_matrix(textbook::ThesisMap const& map) {
    textbook::FoldedThesisMap const folded = textbook::folded(map);
    glm::mat4 const seen =
        folded.eye_clip_from_world *
        plane_projection(ShadowPlane<float>{glm::vec3(map.plane), map.plane.w}, glm::vec4(map.light, 0.0f));
    return from_rows(row(seen, 0), row(seen, 1), row(folded.light_clip_from_world, 2), row(seen, 3)) * map.world;
}

template <class Call>
void with_vertices(benchmark::State& state, Call const& call) {
    Vertices& all = vertices(state.range(0));
    for (auto _ : state) {
        call(all);
        benchmark::DoNotOptimize(all.clip.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
    state.SetBytesProcessed(state.iterations() * state.range(0) * 28);
}

void ours(benchmark::State& state) {
    glm::mat4 const matrix = one_matrix(thesis_map());
    with_vertices(state, [&](Vertices& all) {
        clip_points(matrix, all.points.data(), static_cast<int>(state.range(0)), all.clip.data());
    });
}

template <class Map>
void textbooks(benchmark::State& state, Map const& map) {
    with_vertices(state, [&](Vertices& all) {
        auto const count = static_cast<std::size_t>(state.range(0));
        textbook::vertices(map, std::span(all.points).first(count), std::span(all.clip).first(count));
    });
}

// 14 bytes read and 14 written a vertex: as many as 12 and 16.
void copy(benchmark::State& state) {
    std::vector<char> const source(static_cast<std::size_t>(state.range(0)) * 14, 1);
    with_vertices(
        state, [&](Vertices& all) { std::memcpy(static_cast<void*>(all.clip.data()), source.data(), source.size()); });
}

}  // namespace

BENCHMARK(ours)->Name("vdsm_points/ours")->Arg(1 << 20)->Arg(1 << 23);
BENCHMARK_CAPTURE(textbooks, thesis, thesis_map())->Name("vdsm_points/textbook")->Arg(1 << 20)->Arg(1 << 23);
BENCHMARK_CAPTURE(textbooks, loop, textbook::ThesisLoop{thesis_map()})
    ->Name("vdsm_points/loop")
    ->Arg(1 << 20)
    ->Arg(1 << 23);
BENCHMARK_CAPTURE(textbooks, folded, textbook::folded(thesis_map()))
    ->Name("vdsm_points/folded")
    ->Arg(1 << 20)
    ->Arg(1 << 23);
BENCHMARK(copy)->Name("vdsm_points/copy")->Arg(1 << 23);
