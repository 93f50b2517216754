// SPDX-License-Identifier: MIT
//
// The law that every shadow map obeys, whatever technique made it. Points are put through the given matrix in long
// double, so that what is judged is the matrix and not the judging.
#pragma once

#include <shadowmath/light.hpp>
#include <shadowmath/shadow_map.hpp>

#include <cmath>
#include <limits>

namespace shadowmath::laws {

template <class T>
[[nodiscard]] Vec4<long double> image_of(Mat4<T> const& matrix, Vec4<T> const& point) {
    return Mat4<long double>(matrix) * Vec4<long double>(point);
}

// M * light = (0, 0, k, 0), k > 0, or < 0 where depth is reversed: every ray of the light is one texel, and depth along
// it is ordered. Each zero within `operations` roundings of |row| |light|. k must stand out of 32 of its own row,
// however many stand behind the zeros: in OpenGL's default range that row is mostly w, and k falls as casters recede.
template <class T>
[[nodiscard]] bool is_map_of(Mat4<T> const& clip_from_world, Light<T> const& light, ClipSpace clip,
                             int operations = 32) {
    Vec4<T> const source = homogeneous(light);
    Vec4<long double> const image = image_of(clip_from_world, source);
    long double const eps = std::numeric_limits<T>::epsilon(), noise = operations * eps;
    long double const light_length = glm::length(Vec4<long double>(source));
    auto const vanishes = [&](int r) {
        long double const row_length = glm::length(Vec4<long double>(row(clip_from_world, r)));
        return row_length > 0 && std::abs(image[r]) <= noise * row_length * light_length;
    };
    long double const k = clip.depth == DepthOrder::one_to_zero ? -image.z : image.z;
    long double const depth_length = glm::length(Vec3<long double>(Vec4<long double>(row(clip_from_world, 2))));
    return vanishes(0) && vanishes(1) && vanishes(3) && k > 0 && k > 32 * eps * depth_length;
}

// The point lies in front of the light (w > 0), at least `margin_ndc` inside the four sides of the map, and between its
// near and far end. A negative margin is a slack, for the depth too: half of it, as NDC is twice as long there.
template <class T>
[[nodiscard]] bool holds(Mat4<T> const& clip_from_world, ClipSpace clip, Vec3<T> const& world, T margin_ndc) {
    Vec4<long double> const at_clip = image_of(clip_from_world, Vec4<T>(world, T(1)));
    Vec4<long double> const at = canonical_from_clip<long double>(clip) * at_clip;
    long double const side = (1 - static_cast<long double>(margin_ndc)) * at.w;
    long double const slack = margin_ndc < 0 ? -static_cast<long double>(margin_ndc) / 2 * at.w : 0;
    return at.w > 0 && std::abs(at.x) <= side && std::abs(at.y) <= side && at.z >= -slack && at.z <= at.w + slack;
}

template <class T>
[[nodiscard]] bool finite(Mat4<T> const& matrix) {
    return all_finite(matrix);
}

template <class T>
[[nodiscard]] bool finite(ShadowMap<T> const& map) {
    return all_finite(map.clip_from_world) && all_finite(&map.w_min, 1) && map.w_min >= T(0);
}

// What the door promises for any input at all: a finite matrix, and one that shows nothing when nothing is visible.
template <class T>
[[nodiscard]] bool harmless(ShadowMap<T> const& map) {
    return finite(map) && (map.visible || map.clip_from_world == nowhere<T>());
}

}  // namespace shadowmath::laws
