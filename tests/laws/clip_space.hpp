// SPDX-License-Identifier: MIT
//
// Laws of conventions: they change numbers, never decisions.
#pragma once

#include <shadowmath/clip_space.hpp>

#include <cmath>

namespace shadowmath::laws {

// Conversion and its inverse are exact inverses: entries are 0, 1, 2 and halves.
template <class T>
[[nodiscard]] bool converts_both_ways(ClipSpace clip) {
    Mat4<T> const there = clip_from_canonical<T>(clip), back = canonical_from_clip<T>(clip);
    return there * back == Mat4<T>(T(1)) && back * there == Mat4<T>(T(1));
}

// What the map stores, and is read at, for a point in canonical clip space.
template <class T>
[[nodiscard]] Vec3<T> texture_point(ClipSpace clip, Vec4<T> const& canonical) {
    Vec4<T> const at = texture_from_clip<T>(clip) * (clip_from_canonical<T>(clip) * canonical);
    return Vec3<T>(at) / at.w;
}

// In [0, 1]^3 exactly when inside the canonical volume, and at the same place of the picture: u to the right, v to
// where texture_v points. For coordinates that are multiples of 2^-10 nothing rounds, so the comparison is exact.
template <class T>
[[nodiscard]] bool reads_where_it_was_written(ClipSpace clip, Vec3<T> const& canonical) {
    Vec3<T> const at = texture_point(clip, Vec4<T>(canonical, T(1)));
    bool const inside =
        std::abs(canonical.x) <= T(1) && std::abs(canonical.y) <= T(1) && canonical.z >= T(0) && canonical.z <= T(1);
    bool const in_texture =
        at.x >= T(0) && at.x <= T(1) && at.y >= T(0) && at.y <= T(1) && at.z >= T(0) && at.z <= T(1);
    T const height = (canonical.y + T(1)) / T(2);
    return inside == in_texture && at.x == (canonical.x + T(1)) / T(2) &&
           at.y == (clip.texture_v == YAxis::up ? height : T(1) - height);
}

// The same answer as in canonical depth, where the receiver is lit when it is not behind the occluder by more than the
// bias. Exact for multiples of 2^-10.
template <class T>
[[nodiscard]] bool keeps_the_decision(ClipSpace clip, T occluder, T receiver, T bias) {
    T const stored = texture_point(clip, Vec4<T>(T(0), T(0), occluder, T(1))).z;
    T const read = texture_point(clip, Vec4<T>(T(0), T(0), receiver, T(1))).z;
    return is_lit(stored, read, bias, clip) == (receiver - bias <= occluder);
}

// A cleared map shadows nothing that lies inside it.
template <class T>
[[nodiscard]] bool is_lit_by_a_cleared_map(ClipSpace clip, T receiver) {
    T const read = texture_point(clip, Vec4<T>(T(0), T(0), receiver, T(1))).z;
    T const end = texture_point(clip, Vec4<T>(T(0), T(0), T(1), T(1))).z;
    return end == far_depth<T>(clip) && is_lit(far_depth<T>(clip), read, T(0), clip);
}

}  // namespace shadowmath::laws
