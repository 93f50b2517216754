// SPDX-License-Identifier: MIT
//
// Laws of the view: axes that are axes, corners that are where the sides say, and one volume whatever the projection
// matrix it is read from. Judged in long double.
#pragma once

#include <shadowmath/view_volume.hpp>

#include <cmath>
#include <limits>

namespace shadowmath::laws {

using Real = long double;

template <class T>
[[nodiscard]] Pose<Real> widened(Pose<T> const& pose) {
    return {Vec3<Real>(pose.position), Vec3<Real>(pose.right), Vec3<Real>(pose.up), Vec3<Real>(pose.forward)};
}

template <class T>
[[nodiscard]] ViewVolume<Real> widened(ViewVolume<T> const& view) {
    return {widened(view.pose), view.left, view.right, view.bottom, view.top, view.z_near, view.z_far, view.kind};
}

// Unit and orthogonal to 4 ulp: each axis is one normalisation, or a cross product of two that are.
template <class T>
[[nodiscard]] bool is_orthonormal(Pose<T> const& pose) {
    Pose<Real> const wide = widened(pose);
    auto const is = [](Real value, Real wanted) {
        return std::abs(value - wanted) <= 4 * static_cast<Real>(std::numeric_limits<T>::epsilon());
    };
    return is(glm::length(wide.right), 1) && is(glm::length(wide.up), 1) && is(glm::length(wide.forward), 1) &&
           is(glm::dot(wide.right, wide.up), 0) && is(glm::dot(wide.up, wide.forward), 0) &&
           is(glm::dot(wide.forward, wide.right), 0);
}

// Each corner within 4 ulp of the farther of two ways: from the eye to the corner, and from the origin to the eye.
template <class T>
[[nodiscard]] bool has_accurate_corners(ViewVolume<T> const& view) {
    std::array<Vec3<T>, 8> const rounded = corners(view);
    std::array<Vec3<Real>, 8> const exact = corners(widened(view));
    Vec3<Real> const eye(view.pose.position);
    for (std::size_t i = 0; i < 8; ++i) {
        Real const reach = std::fmax(glm::length(exact[i] - eye), glm::length(eye));
        Vec3<Real> const error = glm::abs(Vec3<Real>(rounded[i]) - exact[i]);
        Real const worst = std::fmax(error.x, std::fmax(error.y, error.z));
        if (!(worst <= 4 * static_cast<Real>(std::numeric_limits<T>::epsilon()) * reach)) return false;
    }
    return true;
}

// The eye's matrix puts the eight corners on those of the clip volume: +-1, +-1, and the near and far depth of `clip`.
// The matrix knows positions only to an ulp of the largest distance from the origin, |p| + |eye|. Across the view that
// is divided by the width there; along it, by how fast depth grows there.
template <class T>
[[nodiscard]] bool fills_the_clip_volume(ViewVolume<T> const& view, ClipSpace clip) {
    Mat4<Real> const canonical_from_world = canonical_from_clip<Real>(clip) * Mat4<Real>(clip_from_world(view, clip));
    std::array<Vec3<Real>, 8> const points = corners(widened(view));
    Real const eps = std::numeric_limits<T>::epsilon();
    Real const width = static_cast<Real>(view.right) - view.left, height = static_cast<Real>(view.top) - view.bottom;
    Real const range = static_cast<Real>(view.z_far) - view.z_near;
    bool const flat = view.kind == ViewKind::orthographic;
    for (int i = 0; i < 8; ++i) {
        Vec3<Real> const& point = points[static_cast<std::size_t>(i)];
        Real const at_depth = (i & 4) != 0 ? view.z_far : view.z_near;
        Real const w = flat ? 1 : at_depth;
        Real const reach = glm::length(point) + glm::length(Vec3<Real>(view.pose.position));
        Vec4<Real> const at_clip = canonical_from_world * Vec4<Real>(point, 1);
        Vec3<Real> const at = Vec3<Real>(at_clip) / at_clip.w;
        auto const near_to = [eps](Real value, Real wanted, Real roundings) {
            return std::abs(value - wanted) <= 16 * eps * roundings;
        };
        Real const off_x = std::abs(static_cast<Real>(view.left) + view.right) / width;
        Real const off_y = std::abs(static_cast<Real>(view.bottom) + view.top) / height;
        Real const w_error = flat ? 0 : reach / w;
        // w itself may drown in rounding: then nothing can be said.
        if (16 * eps * w_error > 0.5L) continue;
        Real const slope = flat ? 1 / range : view.z_far / range;
        bool const x =
            near_to(at.x, (i & 1) != 0 ? 1 : -1, 1 + off_x + 2 * reach / (width * w) + (1 + off_x) * w_error);
        bool const y =
            near_to(at.y, (i & 2) != 0 ? 1 : -1, 1 + off_y + 2 * reach / (height * w) + (1 + off_y) * w_error);
        bool const z = near_to(at.z, (i & 4) != 0 ? 1 : 0, 1 + slope * (reach + view.z_near) / w + w_error);
        if (!(at_clip.w > 0 && x && y && z)) return false;
    }
    return true;
}

// The same four sides and kind. Each side comes from a sum as large as the largest side: 16 roundings, most of them
// those of the matrix that was read.
template <class T>
[[nodiscard]] bool has_the_sides_of(ViewVolume<T> const& read, ViewVolume<T> const& view) {
    T const wide = std::fmax(std::abs(view.left), std::abs(view.right));
    T const high = std::fmax(std::abs(view.bottom), std::abs(view.top));
    auto const same = [](T value, T wanted, T scale) {
        return std::abs(value - wanted) <= T(16) * std::numeric_limits<T>::epsilon() * scale;
    };
    return read.kind == view.kind && same(read.left, view.left, wide) && same(read.right, view.right, wide) &&
           same(read.bottom, view.bottom, high) && same(read.top, view.top, high);
}

}  // namespace shadowmath::laws
