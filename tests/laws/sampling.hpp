// SPDX-License-Identifier: MIT
#pragma once

#include "shadow_map.hpp"

#include <shadowmath/sampling.hpp>

#include <cmath>

namespace shadowmath::laws {

template <class T>
[[nodiscard]] bool is_look_up(LookUp<T> const& look_up, int count) {
    bool const known = look_up.first >= -1 && look_up.first < count && look_up.second >= -1 && look_up.second < count;
    return known && all_finite(&look_up.blend, 1) && look_up.blend >= T(0) && look_up.blend <= T(1);
}

// The weight that a look-up gives to map `index`; to light for -1.
template <class T>
[[nodiscard]] T weight_of(LookUp<T> const& look_up, int index) {
    return (look_up.first == index ? T(1) - look_up.blend : T(0)) + (look_up.second == index ? look_up.blend : T(0));
}

// Every texel of the map that a kernel of this radius around the point touches exists.
template <class T>
[[nodiscard]] bool kernel_fits(ShadowMap<T> const& map, int map_size, int radius, Vec3<T> const& point) {
    Vec4<long double> const clip = image_of(texture_from_world(map), Vec4<T>(point, T(1)));
    long double const x = std::floor(clip.x / clip.w * map_size), y = std::floor(clip.y / clip.w * map_size);
    return clip.w > 0 && x - radius >= 0 && y - radius >= 0 && x + radius < map_size && y + radius < map_size;
}

}  // namespace shadowmath::laws
