// SPDX-License-Identifier: MIT
//
// Which map a point is looked up in, and what its shadow does to its colour: what a receiver shader decides, on the
// CPU.
//
//   by_depth   the slice of the view that the point's eye depth falls into, fading into the next one. For cascades.
//   by_map     the first map that holds the point, kernel included. Maps stand in order of preference, so this is also
//              the order of fallback: a warp before the plain map that catches what the warp cannot see. With cascades
//              it uses the sharper map wherever maps overlap, at the cost of seams that move with the view.
//
// Outside everything is lit.
#pragma once

#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/slice.hpp>
#include <shadowmath/tangent.hpp>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct LookUp {
    int first = -1;   // map to read; -1: none, the point is lit
    int second = -1;  // map to fade into; -1 with blend > 0: into light
    T blend = T(0);   // share of the second, [0, 1]
};

// True when the map can answer for the point: w above w_min, at least `margin_texels` inside the four sides, and not
// beyond the map's far end. Nearer to the light than its near end it can: nothing that matters lies in between.
template <class T>
[[nodiscard]] inline bool contains(ShadowMap<T> const& map, int map_size, T margin_texels,
                                   Vec3<T> const& point) noexcept {
    Projected<T> const at = projected(map.clip_from_world, point, map.w_min);
    if (!map.visible || !at.in_front || map_size < 1 || !all_finite(&margin_texels, 1)) return false;
    T const side = T(1) - T(2) * margin_texels / T(map_size);
    bool const before_far_end = map.clip.depth == DepthOrder::one_to_zero ? at.at.z >= T(0) : at.at.z <= T(1);
    return at.at.x >= -side && at.at.x <= side && at.at.y >= -side && at.at.y <= side && before_far_end;
}

// The first of `count` ranges that ends beyond the eye depth. The index never decreases along a view ray, and
// visibility is continuous across a blend band.
template <class T>
[[nodiscard]] inline LookUp<T> by_depth(SliceRange<T> const* ranges, int count, T eye_depth) noexcept {
    SHADOWMATH_ASSERT(ranges != nullptr || count <= 0, "no ranges to choose from");
    if (!all_finite(&eye_depth, 1)) return {};
    for (int i = 0; i < count; ++i) {
        SliceRange<T> const& range = ranges[i];
        if (!(eye_depth < range.end)) continue;
        if (!(eye_depth > range.blend_begin)) return {i, -1, T(0)};
        int const next = i + 1 < count ? i + 1 : -1;
        return {i, next, (eye_depth - range.blend_begin) / (range.end - range.blend_begin)};
    }
    return {};
}

// The first of `count` maps that contains the point, or none. `margin_texels` is the kernel's reach: filter radius +
// 1.
template <class T>
[[nodiscard]] inline LookUp<T> by_map(ShadowMap<T> const* maps, int count, int map_size, T margin_texels,
                                      Vec3<T> const& point) noexcept {
    SHADOWMATH_ASSERT(maps != nullptr || count <= 0, "no maps to choose from");
    for (int i = 0; i < count; ++i)
        if (contains(maps[i], map_size, margin_texels, point)) return {i, -1, T(0)};
    return {};
}

// Visibility of the two maps of a look-up, mixed; pass 1 for a map that is -1.
template <class T>
[[nodiscard]] constexpr T blended(LookUp<T> const& look_up, T first_visibility, T second_visibility) noexcept {
    return first_visibility * (T(1) - look_up.blend) + second_visibility * look_up.blend;
}

// Light that is let through takes part in diffuse and specular, never in ambient; albedo tints all three (Kwon 2002,
// section 4.4). Linear colours; `visibility` 0 to 1.
template <class T>
[[nodiscard]] inline Vec3<T> shade(Vec3<T> const& ambient, Vec3<T> const& diffuse, Vec3<T> const& specular,
                                   T visibility, Vec3<T> const& albedo) noexcept {
    return (ambient + (diffuse + specular) * visibility) * albedo;
}

}  // namespace v0
}  // namespace shadowmath
