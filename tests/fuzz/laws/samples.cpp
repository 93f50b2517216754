// SPDX-License-Identifier: MIT
//
// Splits and maps from depth samples, NaN and depths behind the far plane among them.
#include "tests/fuzz/inputs.hpp"
#include "tests/laws/sample_bounds.hpp"
#include "tests/laws/shadow_map.hpp"

#include <shadowmath/sdsm.hpp>

namespace shadowmath::fuzz {
namespace {

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
    for (Cascade<T> const& cascade : cascades)
        c.require(laws::harmless(cascade.map), "a map is finite, and shows nothing when it is not visible");
    if (!good) return;
    for (int i = 0; i < count; ++i)
        if (bounds.count > 0 && depth[i] >= view.z_near && depth[i] < view.z_far)
            c.require(laws::is_held(bounds, rays, x[i], y[i], depth[i]), "bounds hold every sample");
    for (Cascade<T> const& cascade : cascades)
        c.require(!cascade.map.visible || laws::is_map_of(cascade.map.clip_from_world, light, options.clip, 256),
                  "a map is a map of its light");
}

[[maybe_unused]] bool const samples_target =
    add_target("samples", [](Case& c) { c.one_in(2) ? try_samples<float>(c) : try_samples<double>(c); });

}  // namespace
}  // namespace shadowmath::fuzz
