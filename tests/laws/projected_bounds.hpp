// SPDX-License-Identifier: MIT
//
// What projected_bounds.hpp promises: bounds of a body lose no point in front, and those of many are their bounds
// merged.
#pragma once

#include "tests/laws/shadow_map.hpp"

#include <shadowmath/projected_bounds.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace shadowmath::laws {

// A point of the body at `weight` (convex weights of its eight corners) is inside the bounds, if its w is w_min or
// more. 32 roundings: a product of four, an interpolation, a quotient, each over numbers as large as |row| |corner| /
// w.
template <class T>
[[nodiscard]] bool loses_no_point_in_front(Mat4<T> const& clip_from_world, std::array<Vec3<T>, 8> const& corners,
                                           T w_min, std::array<T, 8> const& weight) {
    Aabb<T> const bounds = projected_bounds(clip_from_world, corners, w_min);
    Vec3<long double> point(0);
    long double sum = 0, reach = 1;
    for (std::size_t i = 0; i < 8; ++i) sum += static_cast<long double>(weight[i]);
    for (std::size_t i = 0; i < 8; ++i) {
        point += Vec3<long double>(corners[i]) * (static_cast<long double>(weight[i]) / sum);
        reach = std::max(reach, glm::length(Vec3<long double>(corners[i])));
    }
    Vec4<long double> const at = Mat4<long double>(clip_from_world) * Vec4<long double>(point, 1);
    long double const unit = 32 * static_cast<long double>(std::numeric_limits<T>::epsilon()) * reach;
    long double const w_noise = unit * glm::length(Vec4<long double>(row(clip_from_world, 3)));
    if (at.w < static_cast<long double>(w_min) + w_noise) return true;
    if (is_empty(bounds)) return false;
    for (int axis = 0; axis < 3; ++axis) {
        long double const ndc = at[axis] / at.w;
        long double const noise =
            (unit * glm::length(Vec4<long double>(row(clip_from_world, axis))) + w_noise * std::abs(ndc)) / at.w;
        if (ndc < static_cast<long double>(bounds.lo[axis]) - noise) return false;
        if (ndc > static_cast<long double>(bounds.hi[axis]) + noise) return false;
    }
    return true;
}

// Bounds of many boxes hold those of each, and are no larger than all of theirs: to the roundings of a product of four
// and a quotient, 32 of numbers as large as the largest |row| |corner| / w_min or the bounds themselves.
template <class T>
[[nodiscard]] bool are_the_merged_bounds(Mat4<T> const& clip_from_world, Aabb<T> const* boxes, int count, T w_min,
                                         Aabb<T> const& together) {
    Aabb<T> merged;
    long double reach = 1;
    for (int i = 0; i < count; ++i) {
        if (!all_finite(boxes[i]) || is_empty(boxes[i])) continue;
        Aabb<T> const own = projected_bounds(clip_from_world, corners(boxes[i]), w_min);
        if (!is_empty(own)) merged = merge(merged, own);
        for (Vec3<T> const& corner : corners(boxes[i])) reach = std::max(reach, glm::length(Vec3<long double>(corner)));
    }
    if (is_empty(merged) || is_empty(together)) return is_empty(merged) == is_empty(together);
    long double const unit = 32 * static_cast<long double>(std::numeric_limits<T>::epsilon()) * reach;
    long double const w_noise = unit * glm::length(Vec4<long double>(row(clip_from_world, 3)));
    long double const w = std::max(static_cast<long double>(w_min), 1e-6L);
    for (int axis = 0; axis < 3; ++axis) {
        long double const lo = merged.lo[axis], hi = merged.hi[axis];
        long double const row_noise = unit * glm::length(Vec4<long double>(row(clip_from_world, axis)));
        long double const noise = (row_noise + w_noise * std::max(std::abs(lo), std::abs(hi))) / w;
        if (std::abs(together.lo[axis] - lo) > noise || std::abs(together.hi[axis] - hi) > noise) return false;
    }
    return true;
}

}  // namespace shadowmath::laws
