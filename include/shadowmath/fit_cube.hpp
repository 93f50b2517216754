// SPDX-License-Identifier: MIT
//
// A lamp that shines in all directions: six maps, each a spot's, and only those that the eye has a use for. A face is
// skipped where the view, the receivers or the casters do not reach it; those that remain are zoomed in on what is
// seen, and their near planes come from their casters.
//
//          +---+
//          |+y |            face    0   1   2   3   4   5
//      +---+---+---+---+    axis   +x  -x  +y  -y  +z  -z       of the world
//      |-x |+z |+x |-z |
//      +---+---+---+---+    A receiver is looked up in the map of its own face (face_toward). The maps are plain 2D
//          |-y |            ones for tiles of an atlas, each with its own margin, so that filters see no seams between
//          +---+            faces; not layers of a cube texture, which cannot be zoomed in on.
//
// Source: six perspective faces are common knowledge; the crop is that of fit_spot.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/fit_crop.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/view_volume.hpp>

#include <array>
#include <cmath>

namespace shadowmath {
inline namespace v0 {

inline constexpr int cube_faces = 6;

template <class T>
struct CubeMaps {
    std::array<ShadowMap<T>, cube_faces> face;
    int visible_count = 0;  // 0: nothing to draw, everything lit
    Faults faults;
};

// The spot whose pyramid is this face, for bias_for and for drawing. It is wider than the face by a thousandth, so that
// no receiver falls between two. `face` from 0 to 5.
template <class T>
[[nodiscard]] inline Light<T> face_light(Vec3<T> const& position, T range, int face) noexcept {
    SHADOWMATH_ASSERT(face >= 0 && face < cube_faces, "a cube has six faces");
    Vec3<T> axis(T(0));
    axis[face / 2 % 3] = face % 2 == 0 ? T(1) : T(-1);
    constexpr T eighth_of_a_turn = T(0.78539816339744830961566084581987572L);
    return spot(position, axis, eighth_of_a_turn + T(0.5e-3), range);
}

// The face through which the light at `position` sees the point: of its largest coordinate, the earlier axis where two
// are equal. 0 for the position itself.
template <class T>
[[nodiscard]] inline int face_toward(Vec3<T> const& position, Vec3<T> const& point) noexcept {
    Vec3<T> const way = point - position, size(std::abs(way.x), std::abs(way.y), std::abs(way.z));
    int const axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    return 2 * axis + (way[axis] < T(0) ? 1 : 0);
}

// As fit_spot, for each face: every receiver in the slice and within `range` metres of the light is inside the map of
// its face, with `margin_texels` texels to spare, and every caster between it and the light; nearer than range / 4096
// nothing casts. A face without both is not visible, and that is no fault.
template <class T>
[[nodiscard]] inline CubeMaps<T> fit_cube(ViewVolume<T> const& slice, Vec3<T> const& position, T const& range,
                                          Aabb<T> const& casters, Aabb<T> const& receivers, int map_size,
                                          T margin_texels, ClipSpace clip) noexcept {
    CubeMaps<T> maps;
    // What lies beyond the sphere is not lit; corners of a face's pyramid would reach farther.
    Aabb<T> lit = receivers;
    if (all_finite(position) && all_finite(&range, 1) && all_finite(receivers))
        lit = intersect(receivers, Aabb<T>{position - range, position + range});
    for (int i = 0; i < cube_faces; ++i) {
        ShadowMap<T>& face = maps.face[static_cast<std::size_t>(i)];
        face = fit_spot(slice, face_light(position, range, i), casters, lit, map_size, margin_texels, clip);
        maps.faults |= face.faults;
        maps.visible_count += face.visible ? 1 : 0;
    }
    return maps;
}

}  // namespace v0
}  // namespace shadowmath
