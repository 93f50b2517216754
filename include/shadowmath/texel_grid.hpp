// SPDX-License-Identifier: MIT
//
// Why shadows stand still: every map of a sphere's size is a window of one endless grid of texels that is fixed in the
// world, and moves over it in whole texels. Shadow edges then never shimmer when the camera moves or turns, as long as
// the light, the map's size and the sphere's radius stay the same.
//
//   . . . . . . . .        the grid: texel (i, j) covers [i, i + 1) x [j, j + 1) times texel_metres, in light space
//   . . +-----+ . .        the window: map_size texels from (x, y), which are 64-bit integers
//   . . |  o  | . .        the sphere's centre, never more than half a texel from the window's
//   . . +-----+ . .
//
// Budget: the window may stand half a texel off on either side, and `margin_texels` are the filter's, so
// texel = 2 R / (map_size - 2 margin - 1). The plain 2 R / map_size cuts the sphere.
//
// Source: Valient, "Stable rendering of cascaded shadow maps", ShaderX6 (2008). Departures: integer origins, the
// budget, and no matrix that rounds on the way.
//
// How far from the origin: a point keeps its place in its texel to 1/64 within 2^15 texels of the world origin in float
// (300 m with centimetre texels) and 2^44 in double (1e11 m). Beyond: precision_lost. Rebase, or use double.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/light_box.hpp>
#include <shadowmath/margin.hpp>
#include <shadowmath/reach.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct TexelGrid {
    LightBasis<T> basis;
    std::int64_t x = 0;  // lower-left texel of the window, texels from the world origin in light space
    std::int64_t y = 0;
    T texel_metres = T(1);
    int map_size = 1;  // texels along a side of the window
    Faults faults;
    bool visible = false;  // false: no window, and no map from it
};

// The window of map_size texels whose middle is nearest to `center` while its corner is a whole multiple of
// `step_texels`: 1, or the texels of a page (clipmap.hpp). So the centre is at most half a step off. Not visible:
// arguments that are not finite, or not positive, or out of the reach of the scalar type.
template <class T>
[[nodiscard]] inline TexelGrid<T> grid_window(LightBasis<T> const& basis, Vec3<T> const& center, T const& texel_metres,
                                              int map_size, int step_texels = 1) noexcept {
    TexelGrid<T> grid;
    if (!all_finite(center) || !all_finite(&texel_metres, 1)) grid.faults |= Fault::not_finite;
    if (!detail::has_unit_axes(basis)) grid.faults |= Fault::bad_pose;
    if (map_size < 1 || step_texels < 1) grid.faults |= Fault::map_too_small;
    if (grid.faults.any() || !(texel_metres >= detail::least_metres<T>)) return grid;
    // Double for float too: the rounding to whole texels then adds nothing to what the inputs have lost.
    using Exact = decltype(T() + double());
    Exact const step = Exact(step_texels);
    auto const lower_left = [&](Vec3<T> const& axis) {
        Exact const at = glm::dot(Vec3<Exact>(axis), Vec3<Exact>(center));
        return step * std::floor((at / Exact(texel_metres) - Exact(map_size) / 2) / step + Exact(0.5));
    };
    Exact const x = lower_left(basis.x), y = lower_left(basis.y);
    Exact const reach = std::fmax(std::abs(x), std::abs(y)) + Exact(map_size);
    // Four roundings of a coordinate lie between a world point and its texel: 2^-6 / 4.
    if (!(reach * Exact(std::numeric_limits<T>::epsilon()) <= Exact(1) / 256)) grid.faults |= Fault::precision_lost;
    constexpr Exact whole_numbers = Exact(std::int64_t(1) << 52);
    if (!(reach < whole_numbers)) return grid;
    grid.basis = basis;
    grid.x = static_cast<std::int64_t>(x);
    grid.y = static_cast<std::int64_t>(y);
    grid.texel_metres = texel_metres;
    grid.map_size = map_size;
    grid.visible = true;
    return grid;
}

// Metres of a texel with which a window holds this sphere wherever its centre is, and `margin_texels` around it.
template <class T>
[[nodiscard]] inline T texel_for(T radius, int map_size, T margin_texels) noexcept {
    // Up by the roundings of this line and of the window's own extent.
    return radius / (usable_texels(map_size, margin_texels) - T(1)) *
           (T(2) + T(16) * std::numeric_limits<T>::epsilon());
}

// The window holds the sphere and `margin_texels` texels around it. Its place is a whole number of texels, its texel
// the same bits for the same radius. A radius of 0 (no slice) is not visible and no fault.
template <class T>
[[nodiscard]] inline TexelGrid<T> texel_grid(LightBasis<T> const& basis, Sphere<T> const& sphere, int map_size,
                                             T margin_texels) noexcept {
    TexelGrid<T> none;
    none.faults = faults_of_margin(map_size, margin_texels);
    if (!all_finite(sphere.center) || !all_finite(&sphere.radius, 1)) none.faults |= Fault::not_finite;
    if (!detail::has_unit_axes(basis)) none.faults |= Fault::bad_pose;
    if (none.faults.has(Fault::not_finite) || none.faults.has(Fault::map_too_small) ||
        none.faults.has(Fault::bad_pose) || !(sphere.radius > T(0)) || !(sphere.radius <= detail::farthest_metres<T>))
        return none;
    TexelGrid<T> grid = grid_window(basis, sphere.center, texel_for(sphere.radius, map_size, margin_texels), map_size);
    grid.faults |= none.faults;
    return grid;
}

// A size for what is `needed` that a slow zoom does not change in every frame: the previous one, while that is enough
// and not a quarter too much; else the least eighth of an octave, 2^(k/8), that is enough. At least `needed`, and at
// most 5/4 of it. `needed` itself where it is not positive, or nothing came before (a previous of 0).
template <class T>
[[nodiscard]] inline T held_size(T const& needed, T const& previous) noexcept {
    if (!all_finite(&needed, 1) || !all_finite(&previous, 1) || !(needed > T(0)) || !(previous > T(0))) return needed;
    if (needed <= previous && previous <= needed * T(1.25)) return previous;
    T const steps = std::ceil(std::log2(needed) * T(8));
    T const size = std::exp2(steps / T(8)), next = std::exp2((steps + T(1)) / T(8));
    T const held = size >= needed ? size : next;
    return all_finite(&held, 1) && held <= needed * T(1.25) ? held : needed;
}

// The window as a box, for depth_range. Its sides are rounded to T, which clip_from_world below does not do.
template <class T>
[[nodiscard]] inline LightBox<T> on_grid(TexelGrid<T> const& grid, T depth_lo, T depth_hi) noexcept {
    using Exact = decltype(T() + double());
    Exact const texel = Exact(grid.texel_metres);
    auto const side = [texel](std::int64_t index) { return T(Exact(index) * texel); };
    return {grid.basis, Vec2<T>(side(grid.x), side(grid.y)),
            Vec2<T>(side(grid.x + grid.map_size), side(grid.y + grid.map_size)), depth_lo, depth_hi};
}

// The window fills the map; depth_lo goes to the near end and depth_hi to the far one. Offsets come from the integers,
// not from metres, so texel (x, y) of the grid is texel (0, 0) of the map however far the origin is. nowhere() where
// the grid is not visible, or the depths are not increasing.
template <class T>
[[nodiscard]] inline Mat4<T> clip_from_world(TexelGrid<T> const& grid, T const& depth_lo, T const& depth_hi,
                                             ClipSpace clip) noexcept {
    bool const finite = all_finite(&depth_lo, 1) && all_finite(&depth_hi, 1);
    if (!grid.visible || !finite || !(std::fmax(std::abs(depth_lo), std::abs(depth_hi)) <= T(1e24)) ||
        !(depth_hi - depth_lo >= detail::least_metres<T>))
        return nowhere<T>();
    using Exact = decltype(T() + double());
    Exact const size = Exact(grid.map_size);
    auto const row_of = [](Vec3<T> const& axis, Exact scale, Exact offset) {
        return Vec4<T>(Vec3<T>(Vec3<Exact>(axis) * scale), T(offset));
    };
    auto const side = [&](Vec3<T> const& axis, std::int64_t index) {
        return row_of(axis, 2 / (size * Exact(grid.texel_metres)), -Exact(2 * index + grid.map_size) / size);
    };
    Exact const depth_scale = 1 / (Exact(depth_hi) - Exact(depth_lo));
    Mat4<T> const canonical = from_rows(side(grid.basis.x, grid.x), side(grid.basis.y, grid.y),
                                        row_of(grid.basis.depth, depth_scale, -Exact(depth_lo) * depth_scale),
                                        Vec4<T>(T(0), T(0), T(0), T(1)));
    return clip_from_canonical<T>(clip) * canonical;
}

}  // namespace v0
}  // namespace shadowmath
