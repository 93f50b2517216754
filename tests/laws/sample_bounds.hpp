// SPDX-License-Identifier: MIT
//
// Laws of the boxes of samples: where a sample lies, and that its box holds it.
#pragma once

#include "tests/laws/fit_sphere.hpp"

#include <shadowmath/sample_bounds.hpp>

#include <cmath>
#include <limits>

namespace shadowmath::laws {

// The sample of a pixel is where the view's own sides put the pixel's centre. Three products of sides, axes and depth,
// their sums, and the rounding of the axes in light space to 4 ulp.
template <class T>
[[nodiscard]] bool lies_where_the_view_has_it(SampleRays<T> const& rays, ViewVolume<T> const& view, int x, int y,
                                              int width, int height, T depth) {
    using Wide = long double;
    ViewVolume<Wide> const exact = widened_to_long(view);
    Wide const side_x = exact.left + (exact.right - exact.left) * (x + 0.5L) / width;
    Wide const side_y = exact.bottom + (exact.top - exact.bottom) * (y + 0.5L) / height;
    Wide const spread = view.kind == ViewKind::perspective ? Wide(depth) : 1;
    Vec3<Wide> const world =
        exact.pose.forward * Wide(depth) + exact.pose.right * (side_x * spread) + exact.pose.up * (side_y * spread);
    LightBasis<Wide> const basis{Vec3<Wide>(rays.basis.x), Vec3<Wide>(rays.basis.y), Vec3<Wide>(rays.basis.depth)};
    Vec3<Wide> const wanted = in_light(basis, world), found(from_eye(rays, x, y, depth));
    Wide const reach = Wide(depth) + (std::fmax(std::abs(exact.left), std::abs(exact.right)) +
                                      std::fmax(std::abs(exact.bottom), std::abs(exact.top))) *
                                         spread;
    Wide const slack = 16 * static_cast<Wide>(std::numeric_limits<T>::epsilon()) * reach;
    return glm::length(wanted - found) <= slack;
}

// Every box whose split serves the depth holds the sample; at least one does.
template <class T>
[[nodiscard]] bool is_held(SampleBounds<T> const& bounds, SampleRays<T> const& rays, int x, int y, T depth) {
    bool somewhere = false;
    for (int i = 0; i < bounds.count; ++i) {
        if (!(depth >= bounds.range[i].begin && depth < bounds.range[i].end)) continue;
        if (!contains(bounds.box[i], from_eye(rays, x, y, depth))) return false;
        somewhere = true;
    }
    return somewhere;
}

template <class T>
[[nodiscard]] bool same(SampleBounds<T> const& a, SampleBounds<T> const& b) {
    for (int i = 0; i < max_splits; ++i)
        if (a.box[i].lo != b.box[i].lo || a.box[i].hi != b.box[i].hi) return false;
    return a.count == b.count;
}

}  // namespace shadowmath::laws
