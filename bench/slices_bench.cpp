// SPDX-License-Identifier: MIT
//
// Four cascades of one view, splits and light axes included. Textbook: inverse matrix, eight corners, lookAt, ortho.
#include "bench/bounds.hpp"
#include "bench/cases.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/slices.hpp>
#include <shadowmath/slices_in_scene.hpp>
#include <shadowmath/slices_of_views.hpp>

#include <benchmark/benchmark.h>

using namespace shadowmath;

namespace {

using bench::cameras;
using bench::view_count;

// Calls with one view after the other.
template <class Call>
void with_views(benchmark::State& state, Call const& call) {
    auto const views = bench::views_of(cameras());
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

void spheres(benchmark::State& state) {
    with_views(state, [](ViewVolume<float> const& view, glm::mat4* maps) {
        Splits<float> const splits = practical_splits(view.z_near, view.z_far, 4);
        bool const fitted =
            fit_slice_spheres(view, light_basis(bench::sun), splits, 2048, 2.0f, gl_zero_to_one_clip, maps);
        benchmark::DoNotOptimize(fitted);
    });
}

void spheres_bound(benchmark::State& state) {
    with_views(state, [](ViewVolume<float> const& view, glm::mat4* maps) {
        bounds::slice_spheres(view, bench::sun, 2048.0f, maps);
    });
}

void spheres_textbook(benchmark::State& state) {
    with_cameras(state, [](textbook::Camera const& camera) {
        return textbook::stable_cascades(camera, bench::sun, 0.5f, 2048.0f);
    });
}

// A walled town around all cameras, which ends before their views do.
Aabb<float> const town{glm::vec3(-120, 0, -120), glm::vec3(120, 30, 120)};

void focus(benchmark::State& state) {
    with_views(state, [](ViewVolume<float> const& view, glm::mat4* maps) {
        Splits<float> const splits = practical_splits(view.z_near, view.z_far, 4);
        std::uint32_t const seen =
            fit_slice_focus(view, light_basis(bench::sun), splits, town, 2.0f / 2048, gl_zero_to_one_clip, maps);
        benchmark::DoNotOptimize(seen);
    });
}

// Polygons clipped in double (polytope.hpp), slice by slice, and the box around what is left along the light's axes.
void focus_polygons(benchmark::State& state) {
    Aabb<double> const box{glm::dvec3(town.lo), glm::dvec3(town.hi)};
    std::vector<ViewVolume<double>> views;
    for (textbook::Camera const& camera : cameras())
        views.push_back(perspective_view(
            pose_looking(glm::dvec3(camera.position), glm::dvec3(camera.forward), glm::dvec3(camera.up)),
            double(camera.fov_y), double(camera.aspect), double(camera.z_near), double(camera.z_far)));
    std::size_t k = 0;
    for (auto _ : state) {
        ViewVolume<double> const& view = views[k++ % view_count];
        Splits<double> const splits = practical_splits(view.z_near, view.z_far, 4);
        LightBasis<double> const basis = light_basis(glm::dvec3(bench::sun));
        glm::dmat4 maps[4];
        for (int i = 0; i < 4; ++i) {
            ViewVolume<double> const part = slice(view, slice_range(splits, i));
            Aabb<double> bounds;
            for_each_vertex(visible_body(part, box), [&](glm::dvec3 const& v) {
                bounds = merge(bounds, in_light(basis, v + part.pose.position));
            });
            if (is_empty(bounds)) continue;
            maps[i] = clip_from_world(box_around(basis, bounds, 2048, 2.0), gl_zero_to_one_clip);
        }
        benchmark::DoNotOptimize(maps);
    }
}

// The one call, which also bounds each map's depth by a scene and checks everything.
template <CascadeFit fit>
void one_call(benchmark::State& state) {
    CascadeOptions<float> options;
    options.fit = fit;
    Aabb<float> const scene{glm::vec3(-500, 0, -500), glm::vec3(500, 30, 500)};
    with_views(state, [&](ViewVolume<float> const& view, glm::mat4* maps) {
        Cascades<float> const cascades = fit_cascades(view, directional(bench::sun), scene, scene, options);
        for (int i = 0; i < 4; ++i) maps[i] = cascades.at[i].map.clip_from_world;
    });
}

void many_boxes(benchmark::State& state) {
    bench::Random random;
    std::vector<ViewVolume<float>> views;
    for (std::int64_t i = 0; i < state.range(0); ++i) views.push_back(bench::view_of(bench::some_camera(random)));
    std::vector<glm::mat4> maps(4 * views.size());
    LightBasis<float> const basis = light_basis(bench::sun);
    for (auto _ : state) {
        int const fitted = fit_slice_boxes_of(views.data(), static_cast<int>(views.size()), basis, 4, 0.5f, 0.0f,
                                              gl_zero_to_one_clip, maps.data());
        benchmark::DoNotOptimize(fitted);
        benchmark::ClobberMemory();
    }
}

void many_boxes_textbook(benchmark::State& state) {
    bench::Random random;
    std::vector<textbook::Camera> all;
    for (std::int64_t i = 0; i < state.range(0); ++i) all.push_back(bench::some_camera(random));
    std::vector<textbook::Maps> maps(all.size());
    for (auto _ : state) {
        for (std::size_t i = 0; i < all.size(); ++i) maps[i] = textbook::tight_cascades(all[i], bench::sun, 0.5f);
        benchmark::ClobberMemory();
    }
}

}  // namespace

BENCHMARK(spheres)->Name("slice_spheres/ours");
BENCHMARK(spheres_bound)->Name("slice_spheres/bound");
BENCHMARK(spheres_textbook)->Name("slice_spheres/textbook");
BENCHMARK(focus)->Name("slice_focus/ours");
BENCHMARK(focus_polygons)->Name("slice_focus/polygons");
BENCHMARK(one_call<CascadeFit::tight>)->Name("fit_cascades_tight/ours");
BENCHMARK(boxes_textbook)->Name("fit_cascades_tight/textbook");
BENCHMARK(one_call<CascadeFit::stable>)->Name("fit_cascades_stable/ours");
BENCHMARK(spheres_textbook)->Name("fit_cascades_stable/textbook");
BENCHMARK(many_boxes)->Name("many_views/ours")->Arg(10'000);
BENCHMARK(many_boxes_textbook)->Name("many_views/textbook")->Arg(10'000);
BENCHMARK(boxes)->Name("slice_boxes/ours");
BENCHMARK(boxes_bound)->Name("slice_boxes/bound");
BENCHMARK(boxes_textbook)->Name("slice_boxes/textbook");
