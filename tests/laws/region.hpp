// SPDX-License-Identifier: MIT
//
// What region.hpp promises: lo and hi land on the map's corners and nothing else changes, regions compose, and bounds
// of a body lose no point in front.
#pragma once

#include "tests/laws/shadow_map.hpp"

#include <shadowmath/region.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace shadowmath::laws {

// Four roundings make a row (two differences, a quotient, a sum), three a product with it; the terms are as large as
// (|lo| + |hi|) / (hi - lo).
template <class T>
[[nodiscard]] bool fills_the_map(Region<T> const& region) {
    Mat4<T> const matrix = region_matrix(region);
    auto const lands = [&](Vec2<T> const& from, long double wanted) {
        Vec4<long double> const at = image_of(matrix, Vec4<T>(from, T(0.25), T(1)));
        for (int axis = 0; axis < 2; ++axis) {
            long double const lo = static_cast<long double>(region.lo[axis]);
            long double const hi = static_cast<long double>(region.hi[axis]);
            long double const noise =
                8 * std::numeric_limits<T>::epsilon() * (std::abs(lo) + std::abs(hi)) / (hi - lo) + 1e-30L;
            if (!(std::abs(at[axis] - wanted) <= noise)) return false;
        }
        return at.z == 0.25L && at.w == 1.0L;
    };
    return lands(region.lo, -1) && lands(region.hi, 1);
}

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
