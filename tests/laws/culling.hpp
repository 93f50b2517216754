// SPDX-License-Identifier: MIT
//
// What culling.hpp promises: no caster is missed, and none is kept but for the rule that the header states. Points and
// planes are judged in long double, on the given matrix.
#pragma once

#include "tests/laws/shadow_map.hpp"

#include <shadowmath/culling.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace shadowmath::laws {

// Between the four sides, w > 0, and not behind the far end; before the near end counts.
template <class T>
[[nodiscard]] bool may_shadow(ShadowMap<T> const& map, Vec3<long double> const& point) {
    Vec4<long double> const at = canonical_from_clip<long double>(map.clip) *
                                 (Mat4<long double>(map.clip_from_world) * Vec4<long double>(point, 1));
    return map.visible && at.w > 0 && std::abs(at.x) <= at.w && std::abs(at.y) <= at.w && at.z <= at.w;
}

// `share` says where in the box: 0 at lo, 1 at hi, on each axis.
template <class T>
[[nodiscard]] bool misses_no_point(ShadowMap<T> const& map, Aabb<T> const& box, Vec3<T> const& share, bool bit) {
    Vec3<long double> const lo(box.lo), hi(box.hi);
    return bit || !may_shadow(map, lo + (hi - lo) * Vec3<long double>(share));
}

// Twice the largest of normal . p + offset over the box, and how far it must stand below zero before a test in T that
// never misses can tell: box_slack, twice.
struct Clearance {
    long double reach;
    long double noise;
};

template <class T>
[[nodiscard]] std::array<Clearance, 5> clearances(ShadowMap<T> const& map, Aabb<T> const& box) {
    Mat4<long double> const m(map.clip_from_world);
    Vec4<long double> const x = row(m, 0), y = row(m, 1), z = row(m, 2), w = row(m, 3);
    Vec3<long double> const lo(box.lo), hi(box.hi);
    std::array<Clearance, 5> of_side;
    std::size_t side = 0;
    for (Vec4<long double> const& plane :
         {w + x, w - x, w + y, w - y, map.clip.depth == DepthOrder::one_to_zero ? z : w - z}) {
        long double reach = 2 * plane.w, sizes = 0, largest = 0;
        for (int axis = 0; axis < 3; ++axis) {
            reach += plane[axis] * (lo[axis] + hi[axis]) + std::abs(plane[axis]) * (hi[axis] - lo[axis]);
            sizes += std::abs(lo[axis]) + std::abs(hi[axis]);
            largest = std::max(largest, std::abs(plane[axis]));
        }
        long double const unit = 32 * static_cast<long double>(std::numeric_limits<T>::epsilon());
        of_side[side++] = {reach, unit * (3 * largest * sizes + std::abs(plane.w))};
    }
    return of_side;
}

// A bit is set only where no side has the whole box outside.
template <class T>
[[nodiscard]] bool keeps_to_the_rule(ShadowMap<T> const& map, Aabb<T> const& box, bool bit) {
    if (!bit) return true;
    for (Clearance const& side : clearances(map, box))
        if (side.reach < -side.noise) return false;
    return map.visible;
}

// Two answers may differ where the box touches a plane.
template <class T>
[[nodiscard]] bool touches_a_side(ShadowMap<T> const& map, Aabb<T> const& box) {
    for (Clearance const& side : clearances(map, box))
        if (std::abs(side.reach) <= side.noise) return true;
    return false;
}

// The range holds every bit, and both of its ends are set.
[[nodiscard]] inline bool spans(MapRange range, MapMask mask) {
    if (mask == 0) return range.first > range.last;
    for (int i = 0; i < max_caster_maps; ++i)
        if ((mask >> i & 1) != 0 && (i < range.first || i > range.last)) return false;
    return (mask >> range.first & 1) != 0 && (mask >> range.last & 1) != 0;
}

}  // namespace shadowmath::laws
