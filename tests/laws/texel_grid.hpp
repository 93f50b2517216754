// SPDX-License-Identifier: MIT
//
// Laws of the texel grid: it holds the sphere, and stands still.
#pragma once

#include "tests/laws/shadow_map.hpp"

#include <shadowmath/texel_grid.hpp>

#include <cmath>

namespace shadowmath::laws {

// The sphere and `margin_texels` around it lie inside the window's four sides. Up to the rounding of the centre's own
// light-space coordinates: three products of numbers as large as the distance from the origin.
template <class T>
[[nodiscard]] bool holds_sphere_and_margin(TexelGrid<T> const& grid, Sphere<T> const& sphere, T margin_texels) {
    using Long = long double;
    Vec3<Long> const center(sphere.center);
    Long const texel = grid.texel_metres;
    Long const need = Long(sphere.radius) + Long(margin_texels) * texel;
    Long const rounding = 4 * Long(std::numeric_limits<decltype(T() + 0.0)>::epsilon()) * glm::length(center);
    auto const holds = [&](Vec3<T> const& axis, std::int64_t lower) {
        Long const at = glm::dot(Vec3<Long>(axis), center);
        return Long(lower) * texel <= at - need + rounding &&
               at + need <= Long(lower + grid.map_size) * texel + rounding;
    };
    return grid.visible && holds(grid.basis.x, grid.x) && holds(grid.basis.y, grid.y);
}

// Where a world point falls in the map, texels from its lower-left corner.
template <class T>
[[nodiscard]] Vec2<long double> texel_of(Mat4<T> const& clip_from_world, ClipSpace clip, int map_size,
                                         Vec3<T> const& point) {
    Vec4<long double> const at =
        canonical_from_clip<long double>(clip) * image_of(clip_from_world, Vec4<T>(point, T(1)));
    return {(at.x / at.w + 1) / 2 * map_size, (at.y / at.w + 1) / 2 * map_size};
}

// Two windows of one grid: the point's place differs by exactly the whole texels between their origins, to a 64th.
template <class T>
[[nodiscard]] bool keeps_its_place_in_the_texel(TexelGrid<T> const& a, TexelGrid<T> const& b, ClipSpace clip,
                                                Vec3<T> const& point) {
    auto const in = [&](TexelGrid<T> const& grid) {
        return texel_of(clip_from_world(grid, T(0), T(1), clip), clip, grid.map_size, point);
    };
    Vec2<long double> const moved = in(a)-in(b);
    return a.texel_metres == b.texel_metres && a.map_size == b.map_size &&
           std::abs(moved.x - static_cast<long double>(b.x - a.x)) <= 1.0L / 64 &&
           std::abs(moved.y - static_cast<long double>(b.y - a.y)) <= 1.0L / 64;
}

// For any numbers at all: what is not visible has the harmless matrix, what is visible a finite one.
template <class T>
[[nodiscard]] bool is_harmless(TexelGrid<T> const& grid, T depth_lo, T depth_hi, ClipSpace clip) {
    Mat4<T> const matrix = clip_from_world(grid, depth_lo, depth_hi, clip);
    LightBox<T> const box = on_grid(grid, T(0), T(1));
    return finite(matrix) && all_finite(box.lo) && all_finite(box.hi) && grid.texel_metres > T(0) &&
           (grid.visible || matrix == nowhere<T>());
}

}  // namespace shadowmath::laws
