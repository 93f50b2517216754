// SPDX-License-Identifier: MIT
//
// What filterable shadow maps share: texels hold moments of depth, which may be averaged by anything (a blur, mipmaps,
// the sampler), because the moments of a mixture are the mean of the moments. What comes out is a bound on the share of
// the kernel that is lit, from a handful of numbers however wide the kernel is: vsm.hpp two or four, msm.hpp four.
//
// Use them for wide soft edges that a blur once a frame pays for. Not where a lit strip between two occluders must stay
// dark: each bound is in favour of light, and lets some through where depths overlap. filter.hpp never does.
//
// Depths are in [0, 1] and grow away from the light: 1 - depth of a map whose depth is reversed.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/filter.hpp>
#include <shadowmath/finite.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {

// Mean of the moments over the box of filter.hpp, 2 * radius texels wide around the point (radius 0: the texel that
// holds it). `outside` is what texels outside the map count as: the moments of depth 1. `stored_moments(x, y)` is asked
// for texels of the map only.
template <class T, class Moments, class StoredMoments>
[[nodiscard]] inline Moments mean_moments(Vec2<T> const& texel, int map_size, int radius, Moments const& outside,
                                          StoredMoments const& stored_moments) noexcept {
    int const kept = radius < 0 ? 0 : (radius > largest_filter_radius ? largest_filter_radius : radius);
    T const reach = T(kept + 1), size = T(map_size);
    if (map_size < 1 || map_size > largest_map_size || !all_finite(texel)) return outside;
    if (!(texel.x >= -reach && texel.y >= -reach && texel.x <= size + reach && texel.y <= size + reach)) return outside;
    int const home_x = static_cast<int>(std::floor(texel.x)), home_y = static_cast<int>(std::floor(texel.y));
    Vec2<T> const fraction(texel.x - T(home_x), texel.y - T(home_y));
    Moments mean(T(0));
    for (int j = -kept; j <= kept; ++j) {
        for (int i = -kept; i <= kept; ++i) {
            int const x = home_x + i, y = home_y + j;
            bool const inside = x >= 0 && y >= 0 && x < map_size && y < map_size;
            T const weight = tap_weight(i, kept, fraction.x) * tap_weight(j, kept, fraction.y);
            mean += (inside ? stored_moments(x, y) : outside) * weight;
        }
    }
    return mean;
}

// Takes the faint light out of overlapping shadows: shares below `amount` [0, 1) become 0, the rest is stretched. What
// it returns is no bound any more; all penumbrae grow narrower.
template <class T>
[[nodiscard]] inline T less_bleeding(T visibility, T amount) noexcept {
    if (!all_finite(&visibility, 1) || !all_finite(&amount, 1)) return T(1);
    T const cut = amount > T(0) ? (amount < T(0.99) ? amount : T(0.99)) : T(0);
    T const share = (visibility - cut) / (T(1) - cut);
    return share < T(1) ? (share > T(0) ? share : T(0)) : T(1);
}

namespace detail {

template <class T>
[[nodiscard]] constexpr T unit_depth(T depth) noexcept {
    return depth > T(0) ? (depth < T(1) ? depth : T(1)) : T(0);
}

// Within [0, 1]; light for what is not a number.
template <class T>
[[nodiscard]] constexpr T share_or_light(T share) noexcept {
    return share < T(1) ? (share > T(0) ? share : T(0)) : T(1);
}

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath
