// SPDX-License-Identifier: MIT
//
// What a map that was made from rows promises of the points it serves: inside, ordered, to rounding.
#pragma once

#include "tests/laws/shadow_map.hpp"

#include <shadowmath/map_rows.hpp>

#include <cmath>
#include <limits>

namespace shadowmath::laws {

// A point through the map, canonical, with the rounding that each coordinate may carry: `operations` roundings over
// |row| |point|, as far from the origin as the point may lie.
struct Measured {
    Vec4<long double> at;
    Vec4<long double> noise;
};

template <class T>
[[nodiscard]] Measured measured(ShadowMap<T> const& map, Vec3<T> const& world, int operations) {
    Mat4<long double> const canonical =
        canonical_from_clip<long double>(map.clip) * Mat4<long double>(map.clip_from_world);
    Vec4<long double> const point(Vec3<long double>(world), 1);
    Measured m{canonical * point, {}};
    long double const unit =
        static_cast<long double>(operations) * std::numeric_limits<T>::epsilon() * glm::length(point);
    for (int r = 0; r < 4; ++r) m.noise[r] = unit * glm::length(row(canonical, r));
    return m;
}

// w > 0, inside the sides less `margin_ndc`, depth in [0, 1].
template <class T>
[[nodiscard]] bool serves(ShadowMap<T> const& map, Vec3<T> const& world, T margin_ndc, int operations = 64) {
    Measured const m = measured(map, world, operations);
    long double const w = m.at.w + m.noise.w, side = w * (1 - static_cast<long double>(margin_ndc));
    return map.visible && w > 0 && std::abs(m.at.x) <= side + m.noise.x && std::abs(m.at.y) <= side + m.noise.y &&
           m.at.z >= -m.noise.z && m.at.z <= w + m.noise.z;
}

// Of two points on one light ray, the one nearer to the light is before the other, on the same texel.
template <class T>
[[nodiscard]] bool keeps_the_order(ShadowMap<T> const& map, Vec3<T> const& nearer, Vec3<T> const& farther,
                                   int operations = 64) {
    Measured const a = measured(map, nearer, operations), b = measured(map, farther, operations);
    if (!(a.at.w > 0) || !(b.at.w > 0)) return false;
    auto const gap = [&](int r) { return b.at[r] / b.at.w - a.at[r] / a.at.w; };
    auto const noise = [&](int r) {
        return (a.noise[r] + a.noise.w * std::abs(a.at[r] / a.at.w)) / a.at.w +
               (b.noise[r] + b.noise.w * std::abs(b.at[r] / b.at.w)) / b.at.w;
    };
    return std::abs(gap(0)) <= noise(0) && std::abs(gap(1)) <= noise(1) && gap(2) >= -noise(2);
}

}  // namespace shadowmath::laws
