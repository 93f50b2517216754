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

// No map that holds the point, `margin_texels` from its sides, has a smaller footprint (major axis) than the first; the
// earlier one where two are equal. The second is the next best, where its footprint is less than 1 + band times the
// first's; its share falls from a half to none over the band. None of the maps: -1, the point is lit. A normal without
// length chooses the first map that holds the point.
template <class T>
[[nodiscard]] inline LookUp<T> by_footprint(ShadowMap<T> const* maps, int count, int map_size, T margin_texels,
                                            Mat4<T> const& eye_clip_from_world, Vec2<T> const& eye_pixels,
                                            Vec3<T> const& point, Vec3<T> const& normal, T band = T(0)) noexcept {
    SHADOWMATH_ASSERT(maps != nullptr || count <= 0, "no maps to choose from");
    LookUp<T> best;
    T first = T(0), second = T(0);
    for (int i = 0; i < count; ++i) {
        if (!contains(maps[i], map_size, margin_texels, point)) continue;
        T const major =
            footprint(eye_clip_from_world, eye_pixels, maps[i].clip_from_world, T(map_size), point, normal).major;
        if (best.first < 0 || major < first) {
            best.second = best.first;
            second = first;
            best.first = i;
            first = major;
        } else if (best.second < 0 || major < second) {
            best.second = i;
            second = major;
        }
    }
    bool const mixes = best.second >= 0 && all_finite(&band, 1) && band > T(0) && first > T(0);
    T const excess = mixes ? (second / first - T(1)) / band : T(1);
    if (excess < T(1))
        best.blend = T(0.5) * (T(1) - excess);
    else
        best.second = -1;
    return best;
}

}  // namespace v0
}  // namespace shadowmath
