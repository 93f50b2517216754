// SPDX-License-Identifier: MIT
//
// Points into a map, many at once. Every technique ends as one matrix, so this is the vertex transform of all of them,
// the view-dependent map's included: what the thesis does in two products and a division a vertex is one product.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/lanes.hpp>

#include <cstring>

namespace shadowmath {
inline namespace v0 {

// clip[i] = matrix * (points[i], 1), for `count` points; `clip` holds as many and does not overlap them. Columns are
// added from the first to the last, so the sum may differ from glm's in its last bits. Nothing is divided.
template <class T>
inline void clip_points(Mat4<T> const& matrix, Vec3<T> const* points, int count, Vec4<T>* clip) noexcept {
    SHADOWMATH_ASSERT(count <= 0 || (points != nullptr && clip != nullptr), "clip_points needs two arrays");
    using Lanes = detail::Lanes<T>;
    static_assert(sizeof(Lanes) == sizeof(Vec4<T>), "a point in a register");
    Lanes column[4];
    std::memcpy(column, &matrix, sizeof column);
    for (int i = 0; i < count; ++i) {
        Vec3<T> const& p = points[i];
        Lanes const at = column[0] * detail::all_four(p.x) + column[1] * detail::all_four(p.y) +
                         column[2] * detail::all_four(p.z) + column[3];
        std::memcpy(clip + i, &at, sizeof at);
    }
}

}  // namespace v0
}  // namespace shadowmath
