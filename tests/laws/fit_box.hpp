// SPDX-License-Identifier: MIT
//
// Laws of the box fit: everything inside, and not a texel more than asked for.
#pragma once

#include <shadowmath/fit_box.hpp>

#include <cmath>

namespace shadowmath::laws {

// What light-space coordinates of a point are rounded by: three products of unit axes and the point, their sum.
template <class T>
[[nodiscard]] long double light_rounding(Vec3<T> const& point) {
    return 8 * static_cast<long double>(std::numeric_limits<T>::epsilon()) * glm::length(Vec3<long double>(point));
}

// Of the corners: that of the farthest.
template <class T>
[[nodiscard]] long double light_rounding(std::array<Vec3<T>, 8> const& body) {
    long double largest = 0;
    for (Vec3<T> const& corner : body) largest = std::fmax(largest, light_rounding(corner));
    return largest;
}

// At least the margin between the point and every side, and its depth between the ends.
template <class T>
[[nodiscard]] bool holds_point_and_margin(LightBox<T> const& box, Vec3<T> const& point, long double rounding,
                                          int map_size, T margin_texels) {
    using Long = long double;
    LightBasis<Long> const basis{Vec3<Long>(box.basis.x), Vec3<Long>(box.basis.y), Vec3<Long>(box.basis.depth)};
    Vec3<Long> const at = in_light(basis, Vec3<Long>(point));
    for (int axis = 0; axis < 2; ++axis) {
        Long const lo = box.lo[axis], hi = box.hi[axis];
        Long const margin = Long(margin_texels) * (hi - lo) / map_size;
        if (!(at[axis] >= lo + margin - rounding && at[axis] <= hi - margin + rounding)) return false;
    }
    return at.z >= Long(box.depth_lo) - rounding && at.z <= Long(box.depth_hi) + rounding;
}

template <class T>
[[nodiscard]] bool has_extent(LightBox<T> const& box) {
    return box.lo.x < box.hi.x && box.lo.y < box.hi.y && box.depth_lo < box.depth_hi;
}

// The same of every corner.
template <class T>
[[nodiscard]] bool holds_corners_and_margin(LightBox<T> const& box, std::array<Vec3<T>, 8> const& body, int map_size,
                                            T margin_texels) {
    bool holds = has_extent(box);
    long double const rounding = light_rounding(body);
    for (Vec3<T> const& corner : body)
        holds = holds && holds_point_and_margin(box, corner, rounding, map_size, margin_texels);
    return holds;
}

// Extent of the body and that of the box without its margins agree on all three axes: for bodies that are not flat.
template <class T>
[[nodiscard]] bool is_tight(LightBox<T> const& box, std::array<Vec3<T>, 8> const& body, int map_size, T margin_texels) {
    using Long = long double;
    LightBasis<Long> const basis{Vec3<Long>(box.basis.x), Vec3<Long>(box.basis.y), Vec3<Long>(box.basis.depth)};
    Aabb<Long> bounds;
    for (Vec3<T> const& corner : body) bounds = merge(bounds, in_light(basis, Vec3<Long>(corner)));
    Vec3<Long> const extent = bounds.hi - bounds.lo;
    Long const kept = (Long(map_size) - 2 * Long(margin_texels)) / map_size;
    Long const largest = std::fmax(extent.x, std::fmax(extent.y, extent.z));
    auto const fits = [&](Long given, Long wanted) {
        Long const least = std::fmax(largest / map_size, 1e-6L) * (1 + 1e-3L);
        return given <= std::fmax(wanted, least) + 4 * light_rounding(body);
    };
    return fits(Long(box.hi.x - box.lo.x) * kept, extent.x) && fits(Long(box.hi.y - box.lo.y) * kept, extent.y) &&
           fits(Long(box.depth_hi - box.depth_lo), extent.z);
}

// Whatever came in: finite, and all three extents positive.
template <class T>
[[nodiscard]] bool is_a_box(LightBox<T> const& box) {
    return all_finite(box.lo) && all_finite(box.hi) && all_finite(&box.depth_lo, 1) && all_finite(&box.depth_hi, 1) &&
           all_finite(box.basis.x) && all_finite(box.basis.y) && all_finite(box.basis.depth) && has_extent(box) &&
           all_finite(clip_from_world(box, gl_clip));
}

}  // namespace shadowmath::laws
