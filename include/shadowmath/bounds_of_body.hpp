// SPDX-License-Identifier: MIT
//
// Bounds in NDC of one convex body, clipped before the divide: the inside of projected_bounds.hpp, which says what it
// promises.
//
// Source: ours. Edges cut at w_min, without a polygon.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace shadowmath {
inline namespace v0 {
namespace detail {

// A quotient may overflow where w is far below the rest; the largest number still bounds it.
template <class T>
[[nodiscard]] inline Vec3<T> within_numbers(Vec3<T> const& ndc) noexcept {
    Vec3<T> const largest(std::numeric_limits<T>::max());
    return glm::clamp(ndc, -largest, largest);
}

template <class T>
[[nodiscard]] inline Aabb<T> bounds_of_body(Mat4<T> const& clip_from_world, std::array<Vec3<T>, 8> const& corners,
                                            T w_min) noexcept {
    if (!all_finite(clip_from_world) || !all_finite(&w_min, 1)) return {};
    T entry = T(0);
    for (int column = 0; column < 4; ++column)
        for (int r = 0; r < 4; ++r) entry = glm::max(entry, std::abs(clip_from_world[column][r]));
    if (!(entry > T(0))) return {};
    // Homogeneous coordinates may be scaled by anything positive. Matrices and points too large to be multiplied are
    // brought down, each point together with its own share of w_min; ordinary ones keep every bit.
    constexpr T ordinary = T(1e15);
    Mat4<T> const clip = entry > ordinary ? clip_from_world * (T(1) / entry) : clip_from_world;
    T const floor = entry > ordinary ? w_min / entry : w_min;
    std::array<Vec4<T>, 8> point;
    std::array<T, 8> share;
    T largest_w = T(0);
    for (unsigned i = 0; i < 8; ++i) {
        if (!all_finite(corners[i])) return {};
        T const reach = glm::max(std::abs(corners[i].x), glm::max(std::abs(corners[i].y), std::abs(corners[i].z)));
        // No farther down than that: 1 / FLT_MAX is no normal number.
        share[i] = reach > ordinary ? ordinary / reach : T(1);
        point[i] = clip * Vec4<T>(corners[i] * share[i], share[i]);
        largest_w = glm::max(largest_w, point[i].w);
    }
    constexpr T tiny = T(8) * std::numeric_limits<T>::min();
    T const least = glm::max(floor > T(0) ? floor : std::numeric_limits<T>::epsilon() * largest_w, tiny);
    Aabb<T> bounds;
    auto const add = [&bounds](Vec4<T> const& p, T w) {
        bounds = merge(bounds, within_numbers(Vec3<T>(p.x / w, p.y / w, p.z / w)));
    };
    for (unsigned i = 0; i < 8; ++i) {
        T const above = point[i].w - least * share[i];
        if (above >= T(0)) add(point[i], glm::max(point[i].w, tiny));
        for (unsigned bit = 1; bit < 8; bit <<= 1) {
            unsigned const j = i | bit;
            T const other = point[j].w - least * share[j];
            if (j == i || (above >= T(0)) == (other >= T(0))) continue;
            T const t = above / (above - other);
            add(point[i] * (T(1) - t) + point[j] * t, glm::max(least * (share[i] * (T(1) - t) + share[j] * t), tiny));
        }
    }
    return bounds;
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath
