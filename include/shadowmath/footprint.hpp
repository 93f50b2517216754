// SPDX-License-Identifier: MIT
//
// The one number: how many eye pixels one texel of a shadow map covers, at a point of a surface. It is measured from
// the two matrices alone, so it holds for any technique, this library's or another's, and for spots as for suns.
//
//   major <= 1   the map is as fine as the picture there, whatever the direction
//   minor > 1    blocks of minor x major pixels share one shadow sample
//
// On the tangent plane, J = d(eye pixels) / d(map texels) = A_eye * inverse(A_map), where the columns of A are what
// two tangents gain in pixels and in texels. The footprint is its two singular values. For what theory says of the
// whole view at once see aliasing.hpp.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/tangent.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct Footprint {
    T major = T(0);  // eye pixels per texel along the axis where a texel is longest in the picture
    T minor = T(0);  // and across it; 0 <= minor <= major <= footprint_limit
};

// What a footprint is where no number of texels helps: the map sees the surface edge-on, or does not see it at all.
template <class T>
inline constexpr T footprint_limit = T(1e6);

// Eye pixels, as an area.
template <class T>
[[nodiscard]] inline T area(Footprint<T> const& footprint) noexcept {
    return footprint.major * footprint.minor;
}

// What a footprint of `major` pixels counts for where maps are compared: the pixels that come out wrong, as measured
// over many views. A texel of a pixel and a half is as good as any smaller one; from there on so many more are wrong,
// until a texel of some thirty pixels has lost the shadow, and larger ones lose no more.
template <class T>
[[nodiscard]] inline T price_of(T major) noexcept {
    constexpr T fine = T(1.4), lost = T(30);
    T const excess = major > fine ? major - fine : T(0), share = excess / lost;
    return T(0.1) * (major < fine ? major : fine) + excess / std::sqrt(T(1) + share * share);
}

// The same seen from the map: the axes, in texels, of one eye pixel. Above 1 the map is finer than the picture needs.
template <class T>
[[nodiscard]] inline Footprint<T> texels_per_pixel(Footprint<T> const& footprint) noexcept {
    return {bounded_quotient(T(1), footprint.minor, footprint_limit<T>),
            bounded_quotient(T(1), footprint.major, footprint_limit<T>)};
}

namespace detail {

// Columns of a 2x2 matrix over their largest entry, so that no product of two under- or overflows.
template <class T>
struct ScaledColumns {
    Vec2<T> s{T(0)};
    Vec2<T> t{T(0)};
    T scale = T(0);
};

template <class T>
[[nodiscard]] inline ScaledColumns<T> gains_on_plane(Mat4<T> const& matrix, Projected<T> const& point,
                                                     Tangents<T> const& plane, Vec2<T> const& half_size) noexcept {
    Vec2<T> const s = Vec2<T>(gain_along(matrix, point, plane.s)) * half_size;
    Vec2<T> const t = Vec2<T>(gain_along(matrix, point, plane.t)) * half_size;
    T scale = T(0);
    for (T const entry : {s.x, s.y, t.x, t.y}) scale = std::abs(entry) > scale ? std::abs(entry) : scale;
    if (!all_finite(s) || !all_finite(t) || !(scale > T(0))) return {};
    return {s / scale, t / scale, scale};
}

}  // namespace detail

// Exact on the tangent plane of `normal` (of any length and either sign) at `point`, both in world space.
// `eye_pixels` and `map_texels` are the sizes of picture and map. 0 where the eye does not see the point (w <= 0) and
// where something is not finite; footprint_limit where the map does not hold it, or sees the plane edge-on.
template <class T>
[[nodiscard]] inline Footprint<T> footprint(Mat4<T> const& eye_clip_from_world, Vec2<T> const& eye_pixels,
                                            Mat4<T> const& map_clip_from_world, T map_texels, Vec3<T> const& point,
                                            Vec3<T> const& normal) noexcept {
    Projected<T> const in_eye = projected(eye_clip_from_world, point);
    Tangents<T> const plane = tangents(normal);
    bool const sizes = all_finite(eye_pixels) && eye_pixels.x > T(0) && eye_pixels.y > T(0);
    if (!in_eye.in_front || !plane.ok || !sizes) return {};
    detail::ScaledColumns<T> const eye =
        detail::gains_on_plane(eye_clip_from_world, in_eye, plane, eye_pixels * T(0.5));
    if (!(eye.scale > T(0))) return {};

    constexpr T limit = footprint_limit<T>;
    Footprint<T> const unseen{limit, limit};
    Projected<T> const in_map = projected(map_clip_from_world, point);
    if (!in_map.in_front || !all_finite(&map_texels, 1) || !(map_texels > T(0))) return unseen;
    detail::ScaledColumns<T> const map =
        detail::gains_on_plane(map_clip_from_world, in_map, plane, Vec2<T>(map_texels * T(0.5)));
    if (!(map.scale > T(0))) return unseen;

    // J * det(map) = eye * adjugate(map). The larger singular value is a sum of lengths, so nothing cancels; the
    // smaller one follows from the determinant.
    T const map_det = map.s.x * map.t.y - map.s.y * map.t.x;
    T const eye_det = eye.s.x * eye.t.y - eye.s.y * eye.t.x;
    T const a = eye.s.x * map.t.y - eye.t.x * map.s.y, b = eye.t.x * map.s.x - eye.s.x * map.t.x;
    T const c = eye.s.y * map.t.y - eye.t.y * map.s.y, d = eye.t.y * map.s.x - eye.s.y * map.t.x;
    T const stretch = (detail::hypotenuse(a + d, c - b) + detail::hypotenuse(a - d, c + b)) * T(0.5);
    T const pixels_per_texel = bounded_quotient(eye.scale, map.scale, limit * limit);
    T const major = bounded_quotient(stretch * pixels_per_texel, std::abs(map_det), limit);
    T const minor = bounded_quotient(std::abs(eye_det) * pixels_per_texel, stretch, limit);
    return {major, minor < major ? minor : major};
}

}  // namespace v0
}  // namespace shadowmath
