// SPDX-License-Identifier: MIT
//
// What the one call promises, whichever fit is behind it.
#pragma once

#include "tests/laws/shadow_map.hpp"

#include <shadowmath/cascades.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace shadowmath::laws {

// Ranges join without a gap from near to the shadow distance, blend bands lie inside, and every map is harmless.
template <class T>
[[nodiscard]] bool well_formed(Cascades<T> const& cascades) {
    if (cascades.count < 0 || cascades.count > max_splits) return false;
    for (int i = 0; i < cascades.count; ++i) {
        Cascade<T> const& c = cascades.at[i];
        if (!harmless(c.map)) return false;
        if (!(c.range.begin < c.range.end) || c.range.blend_begin > c.range.end) return false;
        if (i == 0) continue;
        SliceRange<T> const& before = cascades.at[i - 1].range;
        if (!(before.end < c.range.end) || c.range.begin > before.end) return false;
        // What fades into this map must be in this map. One rounding a side: both are differences of the same planes.
        if (c.range.begin - before.blend_begin > 4 * std::numeric_limits<T>::epsilon() * before.end) return false;
    }
    return true;
}

// A world point that the eye sees at `depth` metres is inside each visible map whose range holds that depth, with
// `margin_texels` texels to spare on each side. `slack_texels` is what the scalar type has lost at this distance.
template <class T>
[[nodiscard]] bool serves(Cascades<T> const& cascades, CascadeOptions<T> const& options, Vec3<T> const& world, T depth,
                          T margin_texels, T slack_texels) {
    for (Cascade<T> const& c : cascades) {
        if (!c.map.visible || depth < c.range.begin || depth > c.range.end) continue;
        T const ndc_per_texel = T(2) / T(options.map_size);
        Vec4<long double> const at =
            canonical_from_clip<long double>(options.clip) * image_of(c.map.clip_from_world, Vec4<T>(world, T(1)));
        long double const side = 1 - static_cast<long double>((margin_texels - slack_texels) * ndc_per_texel);
        long double const deep = static_cast<long double>(slack_texels * ndc_per_texel) + 1e-6L;
        if (!(at.w > 0) || std::abs(at.x) > side * at.w || std::abs(at.y) > side * at.w) return false;
        if (at.z > (1 + deep) * at.w || (!options.pancake && at.z < -deep * at.w)) return false;
    }
    return true;
}

// Of the ground that a sun's map covers, across the light.
template <class T>
[[nodiscard]] long double square_metres(ShadowMap<T> const& map) {
    auto const length = [&](int r) {
        return glm::length(Vec3<long double>(Vec4<long double>(row(map.clip_from_world, r))));
    };
    return 2 / length(0) * (2 / length(1));
}

// The longer side of a sun's texel and the way from depth 0 to depth 1, in metres, are those of its matrix; `slack`: in
// parts of them.
template <class T>
[[nodiscard]] bool measures_itself(Cascade<T> const& cascade, CascadeOptions<T> const& options, long double slack) {
    Mat4<long double> const canonical =
        canonical_from_clip<long double>(options.clip) * Mat4<long double>(cascade.map.clip_from_world);
    auto const metres = [&](int r) { return 1 / glm::length(Vec3<long double>(row(canonical, r))); };
    long double const texel = 2 * std::max(metres(0), metres(1)) / static_cast<long double>(options.map_size);
    return std::abs(static_cast<long double>(cascade.texel_metres) / texel - 1) <= slack &&
           std::abs(static_cast<long double>(cascade.depth_metres) / metres(2) - 1) <= slack;
}

// Where in its texel a world point falls, moved by less than `texels` between two fits.
template <class T>
[[nodiscard]] bool keeps_its_place(Mat4<T> const& before, Mat4<T> const& after, int map_size, Vec3<T> const& world,
                                   long double texels) {
    for (int axis = 0; axis < 2; ++axis) {
        long double const half = static_cast<long double>(map_size) / 2;
        long double const moved =
            (image_of(after, Vec4<T>(world, T(1)))[axis] - image_of(before, Vec4<T>(world, T(1)))[axis]) * half;
        if (!(std::abs(moved - std::round(moved)) < texels)) return false;
    }
    return true;
}

}  // namespace shadowmath::laws
