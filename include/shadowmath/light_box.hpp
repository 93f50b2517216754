// SPDX-License-Identifier: MIT
//
// What every fit for a directional light gives: a box in light space, and the one matrix that makes of it.
//
// fit_sphere and fit_box choose its sides, depth_range its depth, texel_grid its position. The three do not know of
// each other; the box is all that passes between them.
#pragma once

#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/light.hpp>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct LightBox {
    LightBasis<T> basis;
    Vec2<T> lo{T(-1)};  // sides in light space, metres from the world origin
    Vec2<T> hi{T(1)};
    T depth_lo = T(0);  // along the light, metres from the world origin: 0 of the map
    T depth_hi = T(1);  // 1 of the map
};

// Metres that one texel covers across the light, in x and y; of a map without texels, as if it had one.
template <class T>
[[nodiscard]] inline Vec2<T> texel_metres(LightBox<T> const& box, int map_size) noexcept {
    return (box.hi - box.lo) / T(map_size > 1 ? map_size : 1);
}

// The box fills the map: its corners land on those of the clip volume. Affine, w = 1 everywhere. A box without
// extent, or so small that its inverse overflows, maps everything outside; fits see to it that theirs are not.
template <class T>
[[nodiscard]] inline Mat4<T> clip_from_world(LightBox<T> const& box, ClipSpace clip) noexcept {
    bool const has_extent = box.lo.x < box.hi.x && box.lo.y < box.hi.y && box.depth_lo < box.depth_hi;
    if (!has_extent) return nowhere<T>();
    // Centre and half extent instead of a product of matrices: one rounding each.
    auto const axis = [](Vec3<T> const& direction, T lo, T hi) {
        T const scale = T(2) / (hi - lo);
        return Vec4<T>(direction * scale, -(hi + lo) / (hi - lo));
    };
    T const depth_scale = T(1) / (box.depth_hi - box.depth_lo);
    Mat4<T> const canonical =
        from_rows(axis(box.basis.x, box.lo.x, box.hi.x), axis(box.basis.y, box.lo.y, box.hi.y),
                  Vec4<T>(box.basis.depth * depth_scale, -box.depth_lo * depth_scale), Vec4<T>(T(0), T(0), T(0), T(1)));
    if (!all_finite(canonical)) return nowhere<T>();
    // Where depth runs from -1 to 1, or the other way, the largest numbers of a float are not enough.
    Mat4<T> const map = clip_from_canonical<T>(clip) * canonical;
    return all_finite(map) ? map : nowhere<T>();
}

// The same map for points given relative to `origin` (a camera-relative renderer): M * translate(origin). Compute it in
// double and round the result to float: near the origin nothing is lost, however far it is from the world's.
template <class T>
[[nodiscard]] inline Mat4<T> rebased(Mat4<T> const& clip_from_world, Vec3<T> const& origin) noexcept {
    Mat4<T> moved = clip_from_world;
    moved[3] = clip_from_world * Vec4<T>(origin, T(1));
    return moved;
}

}  // namespace v0
}  // namespace shadowmath
