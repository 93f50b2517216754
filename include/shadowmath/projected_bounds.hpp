// SPDX-License-Identifier: MIT
//
// What a matrix makes of bodies: the bounds in NDC of one, or of a hundred thousand boxes together, clipped before the
// divide. The rectangle of a map that receivers or casters need (region.hpp).
//
// Any matrix will do. Source: ours; boxes as in culling.hpp, a corner is X + Y + Z.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/bounds_of_body.hpp>
#include <shadowmath/bounds_of_boxes.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/wide.hpp>

#include <array>
#include <cmath>

namespace shadowmath {
inline namespace v0 {

// Bounds in NDC of the part of a convex body at w >= w_min; empty when nothing is left, or an input is not finite. The
// body is given by eight corners whose indices differ in one bit along an edge, as those of a box or a view volume.
// Every point of the body at w >= w_min lies inside, to rounding, for any matrix and for boxes of +-FLT_MAX: the
// twelve edges are cut at w_min before anything is divided. A w_min that is not positive becomes the least one whose
// quotients still mean something: epsilon times the largest w.
template <class T>
[[nodiscard]] inline Aabb<T> projected_bounds(Mat4<T> const& clip_from_world, std::array<Vec3<T>, 8> const& corners,
                                              T w_min) noexcept {
    return detail::bounds_of_body(clip_from_world, corners, w_min);
}

// The bounds of many boxes together: what projected_bounds of each, merged, would give, to rounding; a box that is
// empty or not finite adds nothing. Fast where w_min is positive, or the matrix affine; otherwise box by box.
template <class T>
[[nodiscard]] inline Aabb<T> projected_bounds(Mat4<T> const& clip_from_world, BoxArrays<T> const& boxes, int count,
                                              T w_min) noexcept {
    Aabb<T> bounds;
    if (!all_finite(clip_from_world) || !all_finite(&w_min, 1)) return bounds;
    Mat4<T> const& m = clip_from_world;
    T entry = T(0);
    for (int column = 0; column < 4; ++column)
        for (int r = 0; r < 4; ++r) entry = glm::max(entry, std::abs(m[column][r]));
    bool const flat = m[0][3] == T(0) && m[1][3] == T(0) && m[2][3] == T(0);
    bool const ordinary = entry <= T(1e15) && (flat ? m[3][3] >= T(1e-15) && m[3][3] >= w_min : w_min >= T(1e-15));
    constexpr int n = detail::bodies_at_once;
    if (ordinary && count > 0) {
        Vec4<T> const rows[4] = {row(m, 0), row(m, 1), row(m, 2), row(m, 3)};
        // Fewer than a block are filled up with copies of the first, which change nothing.
        T ends[6][n];
        BoxArrays<T> const padded{ends[0], ends[1], ends[2], ends[3], ends[4], ends[5]};
        for (int i = 0; i < n && count < n; ++i) {
            Aabb<T> const box = box_at(boxes, i < count ? i : 0);
            for (int axis = 0; axis < 3; ++axis) ends[axis][i] = box.lo[axis], ends[axis + 3][i] = box.hi[axis];
        }
        detail::run_widely(
            detail::BoundsOfBoxes<T>{m, rows, w_min, count < n ? padded : boxes, count < n ? n : count, bounds});
    }
    for (int i = ordinary ? count : 0; i < count; ++i) {
        Aabb<T> const box = box_at(boxes, i);
        if (all_finite(box) && !is_empty(box)) bounds = merge(bounds, projected_bounds(m, corners(box), w_min));
    }
    return bounds;
}

}  // namespace v0
}  // namespace shadowmath
