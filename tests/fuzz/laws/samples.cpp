// SPDX-License-Identifier: MIT
//
// Splits and maps from depth samples, NaN and depths behind the far plane among them.
#include "tests/fuzz/inputs.hpp"
#include "tests/laws/sample_bounds.hpp"
#include "tests/laws/sample_depths.hpp"
#include "tests/laws/sdsm.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace shadowmath::fuzz {
namespace {

// As of the properties of the same laws: even splits are as deep as the root of the whole, adaptive ones no deeper than
// any placing would have them, but for a bin at either end.
template <class T>
void require_shallow(Case& c, Splits<T> const& splits, std::vector<T> samples, int asked, SampleSplits kind) {
    std::sort(samples.begin(), samples.end());
    int const count = std::min(asked, max_splits);
    long double const whole = static_cast<long double>(samples.back()) / samples.front();
    long double const least =
        kind == SampleSplits::even ? std::pow(whole, 1.0L / count) : laws::least_worst_ratio(samples, count) * 33 / 32;
    long double const rounding = 1e-6L + 4 * count * static_cast<long double>(std::numeric_limits<T>::epsilon());
    c.require(laws::worst_ratio(splits, samples, T(0)) <= std::max(least, 1.05L * 33 / 32) * (1 + rounding),
              "no other placing of the splits is better");
}

template <class T>
void try_samples(Case& c) {
    ViewVolume<T> view = good_view<T>(c);
    Light<T> light = good_sun<T>(c);
    bool const good = c.one_in(2);
    if (!good) spoil(c, view);
    if (!good && c.one_in(2)) light = any_light<T>(c);
    int const width = good ? 64 : c.below(200) - 20, height = good ? 48 : c.below(200) - 20;
    constexpr int count = 6;
    T depth[count];
    int x[count], y[count];
    SampleRays<T> const rays = c.call([&] { return sample_rays(view, light, width, height); });
    SampleDepths<T> depths = c.call([&] { return no_depths(view.z_near, view.z_far); });
    for (int i = 0; i < count; ++i) {
        depth[i] = good ? c.uniform<T>(view.z_near, view.z_far) : c.number<T>();
        x[i] = c.below(64);
        y[i] = c.below(48);
        add(depths, depth[i]);
    }
    int const asked = c.below(20) - 2;
    auto const kind = c.one_in(2) ? SampleSplits::adaptive : SampleSplits::even;
    Splits<T> const splits = c.call([&] { return sample_splits(depths, asked, kind); });
    c.require(laws::is_in_order(depths), "bins are in order");
    c.require(laws::is_ordered(splits, depths, asked), "splits follow the samples from near to far");
    std::vector<T> counted;
    std::copy_if(depth, depth + count, std::back_inserter(counted),
                 [&](T at) { return at >= view.z_near && at < view.z_far; });
    if (good && splits.count > 0 && !counted.empty()) require_shallow(c, splits, counted, asked, kind);
    SampleBounds<T> bounds = c.call([&] { return no_bounds(splits, c.number<T>()); });
    for (int i = 0; i < count; ++i) add(bounds, rays, x[i], y[i], depth[i]);

    SampleFitOptions<T> options;
    options.map_size = good ? 512 : c.below(600) - 20;
    options.margin_texels = good ? T(2) : c.number<T>();
    options.still = c.one_in(2);
    options.pancake = c.one_in(2);
    options.clip = any_clip(c);
    Aabb<T> const casters = any_box<T>(c);
    Cascades<T> const cascades = c.call([&] { return fit_samples(rays, bounds, casters, options); });
    c.hash(splits.plane, splits.count + 1);
    for (Cascade<T> const& cascade : cascades) {
        c.require(laws::harmless(cascade.map), "a map is finite, and shows nothing when it is not visible");
        c.hash(cascade.map.clip_from_world);
    }
    if (!good) return;
    for (int i = 0; i < count; ++i)
        if (bounds.count > 0 && depth[i] >= view.z_near && depth[i] < view.z_far)
            c.require(laws::is_held(bounds, rays, x[i], y[i], depth[i]), "bounds hold every sample");
    for (Cascade<T> const& cascade : cascades)
        c.require(!cascade.map.visible || laws::is_map_of(cascade.map.clip_from_world, light, options.clip, 256),
                  "a map is a map of its light");
    // With casters everywhere each sample lies in its map. Wide views far away are all rounding in a float.
    if (std::abs(view.left) + std::abs(view.right) > T(6) || view.kind == ViewKind::orthographic) return;
    Aabb<T> const everything{Vec3<T>(T(-1e6)), Vec3<T>(T(1e6))};
    Cascades<T> const served = fit_samples(rays, bounds, everything, options);
    for (int i = 0; i < count; ++i) {
        Vec3<T> const point = from_eye(rays, x[i], y[i], depth[i]);
        long double const lost = 16 * static_cast<long double>(std::numeric_limits<T>::epsilon()) *
                                 (2 * glm::length(rays.eye) + 2 * glm::length(point));
        for (Cascade<T> const& cascade : served)
            if (depth[i] >= view.z_near && depth[i] < view.z_far && is_served(cascade.range, depth[i]))
                c.require(cascade.map.visible && laws::holds_sample(cascade.map, rays, point, options.map_size,
                                                                    options.margin_texels, options.pancake, lost),
                          "every sample is inside its map, margin included");
    }
}

[[maybe_unused]] bool const samples_target =
    add_target("samples", [](Case& c) { c.one_in(2) ? try_samples<float>(c) : try_samples<double>(c); });

}  // namespace
}  // namespace shadowmath::fuzz
