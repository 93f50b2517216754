// SPDX-License-Identifier: MIT
#pragma once

#include "tests/laws/sampling.hpp"

#include <shadowmath/by_footprint.hpp>

namespace shadowmath::laws {

// The first holds the point, and no other that does has a smaller footprint; none where none holds it. What is mixed in
// holds it too, for no more than a half.
template <class T>
[[nodiscard]] bool is_finest(LookUp<T> const& at, ShadowMap<T> const* maps, int count, int map_size, T margin_texels,
                             Mat4<T> const& eye, Vec2<T> const& pixels, Vec3<T> const& point, Vec3<T> const& normal) {
    if (!is_look_up(at, count) || at.blend > T(0.5) || (at.second >= 0 && at.second == at.first)) return false;
    if (at.second >= 0 && !contains(maps[at.second], map_size, margin_texels, point)) return false;
    auto const major = [&](int i) {
        return footprint(eye, pixels, maps[i].clip_from_world, T(map_size), point, normal).major;
    };
    for (int i = 0; i < count; ++i) {
        if (!contains(maps[i], map_size, margin_texels, point)) continue;
        if (at.first < 0 || major(i) < major(at.first)) return false;
    }
    return at.first < 0 || contains(maps[at.first], map_size, margin_texels, point);
}

}  // namespace shadowmath::laws
