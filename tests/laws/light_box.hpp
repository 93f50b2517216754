// SPDX-License-Identifier: MIT
//
// Laws of the box in light space: the map is the box, no more and no less.
#pragma once

#include "shadow_map.hpp"

#include <shadowmath/light_box.hpp>

#include <cmath>
#include <limits>

namespace shadowmath::laws {

// A point of light space, in the world; light spaces are orthonormal, so the axes themselves lead back.
template <class T>
[[nodiscard]] Vec3<long double> world_from_light(LightBasis<T> const& basis, Vec3<long double> const& in_light) {
    using Wide = Vec3<long double>;
    return Wide(basis.x) * in_light.x + Wide(basis.y) * in_light.y + Wide(basis.depth) * in_light.z;
}

// The corners of the box land on those of the clip volume. An offset is known to an ulp of the box's distance from the
// origin, and NDC counts it in half extents.
template <class T>
[[nodiscard]] bool fills_the_map(LightBox<T> const& box, ClipSpace clip) {
    using Real = long double;
    Mat4<Real> const canonical = canonical_from_clip<Real>(clip) * Mat4<Real>(clip_from_world(box, clip));
    Vec3<Real> const lo(box.lo.x, box.lo.y, box.depth_lo), hi(box.hi.x, box.hi.y, box.depth_hi);
    Vec3<Real> const extent = hi - lo;
    for (int i = 0; i < 8; ++i) {
        Vec3<Real> const corner((i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z);
        Vec3<Real> const wanted((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : 0);
        Vec4<Real> const at = canonical * Vec4<Real>(world_from_light(box.basis, corner), 1);
        if (at.w != 1) return false;
        Real const reach = glm::length(lo) + glm::length(hi);
        for (int axis = 0; axis < 3; ++axis) {
            // The axes are orthonormal to 4 ulp, twice; the row is rounded three times: 16 in half extents.
            Real const slack =
                16 * static_cast<Real>(std::numeric_limits<T>::epsilon()) * (1 + 2 * reach / extent[axis]);
            if (!(std::abs(at[axis] - wanted[axis]) <= slack)) return false;
        }
    }
    return true;
}

// The rebased map does to a point relative to the origin what the map does to the point.
template <class T>
[[nodiscard]] bool is_rebased(Mat4<T> const& clip_from_world, Vec3<T> const& origin, Vec3<T> const& relative) {
    using Real = long double;
    Mat4<T> const moved = rebased(clip_from_world, origin);
    Vec4<Real> const direct = Mat4<Real>(clip_from_world) * Vec4<Real>(Vec3<Real>(origin) + Vec3<Real>(relative), 1);
    Vec4<Real> const by_way = Mat4<Real>(moved) * Vec4<Real>(Vec3<Real>(relative), 1);
    for (int r = 0; r < 4; ++r) {
        Real const scale = glm::length(Vec4<Real>(row(clip_from_world, r))) * (1 + glm::length(Vec3<Real>(origin)));
        // A sum of four products.
        if (!(std::abs(direct[r] - by_way[r]) <= 4 * static_cast<Real>(std::numeric_limits<T>::epsilon()) * scale))
            return false;
    }
    return true;
}

}  // namespace shadowmath::laws
