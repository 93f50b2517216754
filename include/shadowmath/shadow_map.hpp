// SPDX-License-Identifier: MIT
//
// What every technique ends as: one matrix, where it is valid, and what went wrong.
#pragma once

#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct ShadowMap {
    Mat4<T> clip_from_world = nowhere<T>();  // draw casters and look receivers up with it; always finite
    ClipSpace clip;                          // the convention it was made for
    T w_min = T(0);                          // the map holds no receiver whose clip w is at or below this
    bool visible = false;                    // false: it serves nothing, the matrix sends everything outside
    Faults faults;
};

// Where the map holds a point: u, v and stored depth in [0, 1].
template <class T>
[[nodiscard]] inline Mat4<T> texture_from_world(ShadowMap<T> const& map) noexcept {
    return texture_from_clip<T>(map.clip) * map.clip_from_world;
}

}  // namespace v0
}  // namespace shadowmath
