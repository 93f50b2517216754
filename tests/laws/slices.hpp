// SPDX-License-Identifier: MIT
//
// What slices.hpp promises: every corner inside, the smallest box around them, and the texel grid of texel_grid.hpp.
#pragma once

#include "tests/laws/shadow_map.hpp"

#include <shadowmath/slice.hpp>
#include <shadowmath/slices.hpp>
#include <shadowmath/texel_grid.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace shadowmath::laws {

// The same view, to be computed with where no rounding shows.
template <class T>
[[nodiscard]] ViewVolume<long double> exact_view(ViewVolume<T> const& part) {
    using Real = long double;
    ViewVolume<Real> exact;
    exact.pose = {Vec3<Real>(part.pose.position), Vec3<Real>(part.pose.right), Vec3<Real>(part.pose.up),
                  Vec3<Real>(part.pose.forward)};
    exact.left = part.left, exact.right = part.right, exact.bottom = part.bottom, exact.top = part.top;
    exact.z_near = part.z_near, exact.z_far = part.z_far;
    exact.kind = part.kind;
    return exact;
}

// Corners that no rounding has moved.
template <class T>
[[nodiscard]] std::array<Vec3<long double>, 8> exact_corners(ViewVolume<T> const& part) {
    return corners(exact_view(part));
}

// `margin_ndc` inside the four sides, and between the ends.
template <class T>
[[nodiscard]] bool holds_corners(Mat4<T> const& clip_from_world, ClipSpace clip, ViewVolume<T> const& part,
                                 long double margin_ndc) {
    for (Vec3<long double> const& corner : exact_corners(part)) {
        Vec4<long double> const at = canonical_from_clip<long double>(clip) *
                                     (Mat4<long double>(clip_from_world) * Vec4<long double>(corner, 1));
        if (!(std::abs(at.x) <= 1 - margin_ndc && std::abs(at.y) <= 1 - margin_ndc && at.z >= 0 && at.z <= 1))
            return false;
    }
    return true;
}

// Metres: what a coordinate in light space of the slice may be rounded by.
template <class T>
[[nodiscard]] long double slice_rounding(ViewVolume<T> const& part) {
    long double farthest = 0;
    for (Vec3<long double> const& corner : exact_corners(part))
        farthest = std::max(farthest, std::abs(corner.x) + std::abs(corner.y) + std::abs(corner.z));
    Vec3<T> const& eye = part.pose.position;
    farthest += static_cast<long double>(std::abs(eye.x) + std::abs(eye.y) + std::abs(eye.z)) + part.z_far;
    return 64 * static_cast<long double>(std::numeric_limits<T>::epsilon()) * farthest;
}

// A matrix of the same numbers, to the roundings of an offset far from the origin.
template <class T>
[[nodiscard]] bool is_nearly(Mat4<T> const& ours, Mat4<T> const& twin) {
    T const eps = T(16) * std::numeric_limits<T>::epsilon();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) {
            T const size = std::abs(twin[column][row]) + (column == 3 ? T(1) : T(0));
            if (!(std::abs(ours[column][row] - twin[column][row]) <= eps * size)) return false;
        }
    return true;
}

// The body fills the part of the map that the border leaves free, but for what rounding is allowed.
template <class T>
[[nodiscard]] bool is_filled(Mat4<T> const& clip_from_world, ClipSpace clip, ViewVolume<T> const& part, T border) {
    Vec3<long double> lo(1e30L), hi(-1e30L);
    Mat4<long double> const matrix = canonical_from_clip<long double>(clip) * Mat4<long double>(clip_from_world);
    for (Vec3<long double> const& corner : exact_corners(part)) {
        Vec3<long double> const at(matrix * Vec4<long double>(corner, 1));
        lo = glm::min(lo, at);
        hi = glm::max(hi, at);
    }
    long double const used = 2 - 4 * static_cast<long double>(border);
    for (int axis = 0; axis < 3; ++axis) {
        long double const scale = glm::length(Vec3<long double>(row(matrix, axis)));
        if (!(hi[axis] - lo[axis] >= (axis < 2 ? used : 1) - 2 * scale * slice_rounding(part))) return false;
    }
    return true;
}

// The texel is that of texel_grid to a few ulp, and the map's corner lies on a whole one.
template <class T>
[[nodiscard]] bool is_on_the_grid(Mat4<T> const& clip_from_world, LightBasis<T> const& basis, ViewVolume<T> const& part,
                                  int map_size, T margin_texels, ClipSpace clip) {
    TexelGrid<T> const grid = texel_grid(basis, bounding_sphere(part), map_size, margin_texels);
    if (!grid.visible) return false;
    Mat4<T> const twin = shadowmath::clip_from_world(grid, T(0), T(1), clip);
    long double const eps = std::numeric_limits<T>::epsilon();
    long double const strayed = 1.5L + slice_rounding(part) / static_cast<long double>(grid.texel_metres);
    for (int r = 0; r < 2; ++r) {
        Vec4<long double> const ours(row(clip_from_world, r)), theirs(row(twin, r));
        if (glm::length(Vec3<long double>(ours - theirs)) > 8 * eps * glm::length(Vec3<long double>(theirs)))
            return false;
        // Windows may differ by a texel where the centre is half way, and by what the twin's centre is rounded by.
        long double const texels = (ours.w - theirs.w) * map_size / 2, off = std::abs(texels - std::round(texels));
        if (!(off <= 4 * eps * map_size * (1 + std::abs(ours.w)) && std::abs(texels) < strayed)) return false;
    }
    return true;
}

}  // namespace shadowmath::laws
