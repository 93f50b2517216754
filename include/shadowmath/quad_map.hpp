// SPDX-License-Identifier: MIT
//
// A map whose four sides are any four lines of the light's plane: the one homography that takes the quadrilateral
// between them to the square. Boxes, rotated rectangles, every perspective warp, sheared or lopsided, are all this.
//
//          top               Each side is a line l with l(p) >= 0 inside. One combination of four lines in a plane
//        ________            is zero everywhere,
//       /        |
// left /         | right         a left + b right = c bottom + d top,     a, b, c, d > 0,
//     /__________|
//         bottom             and with it w = a left + b right, x = a left - b right, y = c bottom - d top: x = -w on
//                            the left side, x = w on the right one, w > 0 between.
//
// Use it where four sides are known to be good ones (fit_quad.hpp looks for them). One side alone can then be moved or
// turned and the others stay where they are, which two projective numbers and a rectangle cannot.
//
// Source: none known for shadow maps; that four lines fix a homography is the projective theorem of von Staudt.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/map_rows.hpp>
#include <shadowmath/polytope.hpp>
#include <shadowmath/shadow_map.hpp>

#include <array>
#include <cmath>

namespace shadowmath {
inline namespace v0 {

// Left, right, bottom, top: each dotted with (x, y, 1) of the light's plane, >= 0 inside, of any length.
template <class T>
using QuadSides = std::array<Vec3<T>, 4>;

// The homography: x / w and y / w of (x, y, 1) are in [-1, 1] between the sides.
template <class T>
struct Quad {
    Vec3<T> x{T(0)};
    Vec3<T> y{T(0)};
    Vec3<T> w{T(0), T(0), T(1)};  // 1 where it is most, among the corners
    std::array<Vec2<T>, 4> corner{};
    T w_least = T(0);      // at a corner
    bool visible = false;  // false: the lines bound no quadrilateral, or one that ends in a point
};

namespace detail {

template <class T>
[[nodiscard]] inline T triple(Vec3<T> const& a, Vec3<T> const& b, Vec3<T> const& c) noexcept {
    return glm::dot(a, glm::cross(b, c));
}

}  // namespace detail

// w varies by no more than `most_warp` from corner to corner, and texels are no more than `most_shear` times as long as
// their sides are apart; sides that ask for more are not visible. Bias, which must suit a whole map, sets both limits.
template <class T>
[[nodiscard]] inline Quad<T> quad_between(QuadSides<T> const& side, T most_warp = T(4),
                                          T most_shear = T(1.6)) noexcept {
    Quad<T> quad;
    auto const& [left, right, bottom, top] = side;
    // Cramer: the combination that vanishes has the four minors for its weights, with signs in turn.
    T a = detail::triple(right, bottom, top), b = -detail::triple(left, bottom, top);
    T c = -detail::triple(left, right, top), d = detail::triple(left, right, bottom);
    if (a < T(0)) a = -a, b = -b, c = -c, d = -d;
    if (!(a > T(0)) || !(b > T(0)) || !(c > T(0)) || !(d > T(0))) return quad;
    Vec3<T> const w = left * a + right * b;
    T most = T(0), least = T(0);
    for (unsigned i = 0; i < 4; ++i) {
        Vec3<T> const meet = glm::cross(side[i & 1u], side[2u + (i >> 1)]);
        if (meet.z == T(0)) return quad;
        quad.corner[i] = Vec2<T>(meet.x / meet.z, meet.y / meet.z);
        T const here = glm::dot(w, Vec3<T>(quad.corner[i], T(1)));
        most = i == 0 || here > most ? here : most;
        least = i == 0 || here < least ? here : least;
    }
    if (!(least * most_warp >= most) || !(most > T(0))) return quad;
    T const scale = T(1) / most;
    quad.x = (left * a - right * b) * scale;
    quad.y = (bottom * c - top * d) * scale;
    quad.w = w * scale;
    quad.w_least = least * scale;
    for (T const x : {T(-1), T(1)})
        for (T const y : {T(-1), T(1)}) {
            Vec2<T> const along_x = Vec2<T>(quad.x) - Vec2<T>(quad.w) * x;
            Vec2<T> const along_y = Vec2<T>(quad.y) - Vec2<T>(quad.w) * y;
            T const cross = along_x.x * along_y.y - along_x.y * along_y.x;
            T const squares = glm::dot(along_x, along_x) * glm::dot(along_y, along_y);
            if (!(squares <= cross * cross * most_shear * most_shear)) return quad;
        }
    quad.visible = all_finite(quad.x) && all_finite(quad.y) && all_finite(quad.w) && quad.w_least > T(0);
    return quad;
}

// The same quadrilateral elsewhere. Sides are best given about their own middle: far from it their minors are all
// rounding.
template <class T>
[[nodiscard]] inline Quad<T> moved(Quad<T> quad, Vec2<T> const& offset) noexcept {
    for (Vec3<T>* const row : {&quad.x, &quad.y, &quad.w}) row->z -= row->x * offset.x + row->y * offset.y;
    for (Vec2<T>& corner : quad.corner) corner += offset;
    return quad;
}

// Square metres of the light's plane.
template <class T>
[[nodiscard]] inline T area(Quad<T> const& quad) noexcept {
    Vec2<T> const d = quad.corner[3] - quad.corner[0], e = quad.corner[2] - quad.corner[1];
    return T(0.5) * std::abs(d.x * e.y - d.y * e.x);
}

// True inside and on the sides.
template <class T>
[[nodiscard]] inline bool is_in(Quad<T> const& quad, Vec2<T> const& place) noexcept {
    Vec3<T> const p(place, T(1));
    T const w = glm::dot(quad.w, p);
    return w >= quad.w_least * T(0.999) && std::abs(glm::dot(quad.x, p)) <= w && std::abs(glm::dot(quad.y, p)) <= w;
}

// Texels gained for a metre along x and along y of the light's plane, at a place inside.
template <class T>
struct QuadGain {
    Vec2<T> x{T(0)};
    Vec2<T> y{T(0)};
};

template <class T>
[[nodiscard]] inline QuadGain<T> gain_at(Quad<T> const& quad, T usable_texels, Vec2<T> const& place) noexcept {
    Vec3<T> const p(place, T(1));
    T const w = glm::dot(quad.w, p);
    if (w == T(0)) return {};  // at its horizon
    T const scale = usable_texels * T(0.5) / w;
    T const x = glm::dot(quad.x, p) / w, y = glm::dot(quad.y, p) / w;
    return {Vec2<T>(quad.x.x - x * quad.w.x, quad.y.x - y * quad.w.x) * scale,
            Vec2<T>(quad.x.y - x * quad.w.y, quad.y.y - y * quad.w.y) * scale};
}

// The map of everything between the quadrilateral's sides from `first` to `last` along the light: inside with
// `margin_texels` to spare, and every caster of the box between it and the light with stored depth in [0, 1]. The
// light's plane passes through `origin`; places are metres from there along basis.x and basis.y, depths along
// basis.depth. Not visible, and no fault: no caster is above. A sun's.
template <class T>
[[nodiscard]] inline ShadowMap<T> quad_map(Quad<T> const& quad, LightBasis<T> const& basis, Vec3<T> const& origin,
                                           T first, T last, Aabb<T> const& casters, int map_size, T margin_texels,
                                           ClipSpace clip) noexcept {
    ShadowMap<T> map;
    map.clip = clip;
    if (!quad.visible) return map;
    auto const in_world = [&basis](Vec3<T> const& functional) {
        return Vec4<T>(basis.x * functional.x + basis.y * functional.y, functional.z);
    };
    MapRows<T> rows;
    rows.x = in_world(quad.x);
    rows.y = in_world(quad.y);
    rows.w = in_world(quad.w);
    rows.along = Vec4<T>(basis.depth, T(0));
    rows.source = rows.along;
    rows.w_min = quad.w_least * T(0.5);
    rows.crop = false;
    std::array<Vec3<T>, 8> body;
    for (unsigned i = 0; i < 8; ++i) {
        Vec2<T> const& corner = quad.corner[i & 3u];
        body[i] = basis.x * corner.x + basis.y * corner.y + basis.depth * ((i & 4u) != 0 ? last : first);
    }
    return map_from_rows(rows, origin, convex_body(body), casters, map_size, margin_texels, clip);
}

}  // namespace v0
}  // namespace shadowmath
