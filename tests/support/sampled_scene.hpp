// SPDX-License-Identifier: MIT
//
// A view, a sun, and an eye depth for every pixel of a small picture: steps, slopes, gaps, sky and NaN. What maps that
// are fitted to samples are tried on.
#pragma once

#include "tests/support/gen.hpp"

#include <shadowmath/sdsm.hpp>

#include <limits>
#include <vector>

namespace shadowmath::test {

template <class T>
struct SampledScene {
    ViewVolume<T> view;
    Light<T> light;
    int width = 1, height = 1;
    std::vector<T> depth;  // row by row
};

template <class T>
void showValue(SampledScene<T> const& scene, std::ostream& out) {
    showValue(scene.view, out);
    out << "\nlight ";
    showValue(scene.light, out);
    out << "\n" << scene.width << " x " << scene.height << ":";
    out.precision(std::numeric_limits<T>::max_digits10);
    for (T const depth : scene.depth) out << " " << depth;
}

// A view with z_far at most 1e4 z_near, within `radius` of the origin, at most 3 m wide a metre.
template <class T>
rc::Gen<ViewVolume<T>> sampled_view(T radius) {
    return rc::gen::exec([=] {
        ViewVolume<T> view = *view_volume<T>();
        view.pose = *pose<T>(radius);
        view.z_far = view.z_near * *log_uniform<T>(T(2), T(1e4));
        T const widest = view.kind == ViewKind::perspective ? T(3) : view.z_far;
        T largest = T(0);
        for (T const side : {view.left, view.right, view.bottom, view.top})
            largest = std::abs(side) > largest ? std::abs(side) : largest;
        if (largest > widest)
            for (T* const side : {&view.left, &view.right, &view.bottom, &view.top}) *side *= widest / largest;
        return view;
    });
}

template <class T>
rc::Gen<SampledScene<T>> sampled_scene(T radius) {
    return rc::gen::exec([=] {
        SampledScene<T> scene;
        scene.view = *sampled_view<T>(radius);
        scene.light = *sun<T>();
        scene.width = static_cast<int>(1 + *below(12));
        scene.height = static_cast<int>(1 + *below(12));
        T const z_near = scene.view.z_near, z_far = scene.view.z_far;
        T const surface[] = {*log_uniform<T>(z_near, z_far), *log_uniform<T>(z_near, z_far),
                             *log_uniform<T>(z_near, z_far)};
        for (int i = 0; i < scene.width * scene.height; ++i) {
            std::uint64_t const kind = *below(12);
            T const relief = *uniform<T>(T(1), T(1.2));
            T depth = surface[kind % 3] * relief;
            if (kind == 9) depth = std::numeric_limits<T>::infinity();
            if (kind == 10) depth = *log_uniform<T>(z_near, z_far);
            if (kind == 11) depth = *nasty<T>();
            scene.depth.push_back(depth);
        }
        return scene;
    });
}

// Both passes over all pixels.
template <class T>
struct Sampled {
    SampleDepths<T> depths;
    SampleRays<T> rays;
    SampleBounds<T> bounds;
};

template <class T>
[[nodiscard]] Sampled<T> sampled(SampledScene<T> const& scene, int count, SampleSplits kind, T blend = T(0)) {
    Sampled<T> result;
    result.depths = no_depths(scene.view.z_near, scene.view.z_far);
    for (T const depth : scene.depth) add(result.depths, depth);
    result.bounds = no_bounds(sample_splits(result.depths, count, kind), blend);
    result.rays = sample_rays(scene.view, scene.light, scene.width, scene.height);
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x)
            add(result.bounds, result.rays, x, y, scene.depth[static_cast<std::size_t>(y * scene.width + x)]);
    return result;
}

// What the eye sees: call(x, y, depth) for each sample that counts.
template <class T, class Call>
void for_each_sample(SampledScene<T> const& scene, Call const& call) {
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x) {
            T const depth = scene.depth[static_cast<std::size_t>(y * scene.width + x)];
            if (depth >= scene.view.z_near && depth < scene.view.z_far) call(x, y, depth);
        }
}

}  // namespace shadowmath::test
