// SPDX-License-Identifier: MIT
//
// Of several maps that hold a point, the one whose texels look smallest there. For maps of unlike techniques, none of
// which is the sharpest everywhere: view-dependent maps on their planes with cascades around them, a warp and the plain
// map behind it. For cascades alone by_map is as good and asks for no normal.
//
//        pixels a texel      The choice changes where two footprints are equal, so that is where texels change least;
//   B \      / A             within `band` of there the two maps are mixed, half and half where they are equal, and
//      \    /                shadows change over without a seam.
//       \../  <- band
//       /  \                 The light's law makes any such choice right: each map has every caster above its point.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/footprint.hpp>
#include <shadowmath/sampling.hpp>
#include <shadowmath/shadow_map.hpp>

namespace shadowmath {
inline namespace v0 {

// The finest two maps of those met so far, and their footprints.
template <class T>
struct FinestMaps {
    int first = -1;  // -1: none
    int second = -1;
    T first_major = T(0);  // eye pixels
    T second_major = T(0);
};

// With one more map, whose texels are `major` pixels long at the point. The earlier one stays first where two are
// equal.
template <class T>
[[nodiscard]] inline FinestMaps<T> with_map(FinestMaps<T> finest, int map, T major) noexcept {
    if (finest.first < 0 || major < finest.first_major) return {map, finest.first, major, finest.first_major};
    if (finest.second < 0 || major < finest.second_major) {
        finest.second = map;
        finest.second_major = major;
    }
    return finest;
}

// The second takes part where its footprint is less than 1 + band times the first's; its share falls from a half to
// none over the band.
template <class T>
[[nodiscard]] inline LookUp<T> look_up_in(FinestMaps<T> const& finest, T band) noexcept {
    bool const mixes = finest.second >= 0 && all_finite(&band, 1) && band > T(0) && finest.first_major > T(0);
    T const excess = mixes ? (finest.second_major / finest.first_major - T(1)) / band : T(1);
    if (excess < T(1)) return {finest.first, finest.second, T(0.5) * (T(1) - excess)};
    return {finest.first, -1, T(0)};
}

// No map that holds the point, `margin_texels` from its sides, has a smaller footprint (major axis) than the first.
// None of the maps: -1, the point is lit. A normal without length chooses the first map that holds the point.
template <class T>
[[nodiscard]] inline LookUp<T> by_footprint(ShadowMap<T> const* maps, int count, int map_size, T margin_texels,
                                            Mat4<T> const& eye_clip_from_world, Vec2<T> const& eye_pixels,
                                            Vec3<T> const& point, Vec3<T> const& normal, T band = T(0)) noexcept {
    SHADOWMATH_ASSERT(maps != nullptr || count <= 0, "no maps to choose from");
    FinestMaps<T> finest;
    for (int i = 0; i < count; ++i) {
        if (!contains(maps[i], map_size, margin_texels, point)) continue;
        Mat4<T> const& map = maps[i].clip_from_world;
        finest = with_map(finest, i, footprint(eye_clip_from_world, eye_pixels, map, T(map_size), point, normal).major);
    }
    return look_up_in(finest, band);
}

}  // namespace v0
}  // namespace shadowmath
