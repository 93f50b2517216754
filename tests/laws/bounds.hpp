// SPDX-License-Identifier: MIT
//
// Laws of boxes: sets of points, whose union and intersection mean what they say. All exact: nothing is rounded.
#pragma once

#include <shadowmath/bounds.hpp>

namespace shadowmath::laws {

template <class T>
[[nodiscard]] bool same(Aabb<T> const& a, Aabb<T> const& b) {
    return a.lo == b.lo && a.hi == b.hi;
}

template <class T>
[[nodiscard]] bool merging_with_nothing_changes_nothing(Aabb<T> const& box) {
    return same(merge(box, Aabb<T>{}), box) && same(merge(Aabb<T>{}, box), box);
}

// The smallest box around both.
template <class T>
[[nodiscard]] bool merges(Aabb<T> const& a, Aabb<T> const& b, Vec3<T> const& point) {
    Aabb<T> const both = merge(a, b);
    bool const holds_both =
        contains(both, a.lo) && contains(both, a.hi) && contains(both, b.lo) && contains(both, b.hi);
    bool touches = true;
    for (int axis = 0; axis < 3; ++axis)
        touches = touches && (both.lo[axis] == a.lo[axis] || both.lo[axis] == b.lo[axis]) &&
                  (both.hi[axis] == a.hi[axis] || both.hi[axis] == b.hi[axis]);
    return holds_both && touches && contains(merge(a, point), point) && same(merge(a, b), merge(b, a));
}

// A point lies in the intersection exactly when it lies in both; an empty intersection holds none.
template <class T>
[[nodiscard]] bool intersects(Aabb<T> const& a, Aabb<T> const& b, Vec3<T> const& point) {
    Aabb<T> const common = intersect(a, b);
    bool const in_common = contains(common, point);
    return in_common == (contains(a, point) && contains(b, point)) && !(is_empty(common) && in_common);
}

// Bit 0 of the index is x, bit 1 y, bit 2 z; and the corners bound the box they came from.
template <class T>
[[nodiscard]] bool has_numbered_corners(Aabb<T> const& box) {
    std::array<Vec3<T>, 8> const points = corners(box);
    for (int i = 0; i < 8; ++i)
        for (int axis = 0; axis < 3; ++axis)
            if (points[static_cast<std::size_t>(i)][axis] != ((i >> axis) & 1 ? box.hi : box.lo)[axis]) return false;
    return same(bounds_of(points), box);
}

}  // namespace shadowmath::laws
