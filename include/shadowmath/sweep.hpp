// SPDX-License-Identifier: MIT
//
// A convex body swept along the light: where its shadow's casters are, and where its own shadow falls. As half-spaces:
// to cull casters with, to cut boxes with.
//
//        light                    One formula for suns and spots. With l the homogeneous light and h a face's
//     |    |    |                 half-space, the face is lit when h . l > 0. Where a lit face h1 and an unlit one h2
//     |  __|__  |  <- silhouette  meet, the plane through their edge along the light is
//     | /     \ |
//     |/  body \|                     h = h1 (-h2 . l) + h2 (h1 . l),     so that h . l = 0:
//      \_______/   <- unlit faces
//                                 a sum of half-spaces of the body with weights >= 0, hence one of the body itself.
//
// No edge is ever measured, so short ones do no harm. Faces that meet at a knife's edge make a small sum, of which
// rounding has its share: so only its direction is used, and the plane put where it touches the body.
//
// Source: silhouette planes are common for view frusta (by a table of 64 cases in some engines). Departures: any convex
// body, spots, and padding for filters and for the sun's radius.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/polytope.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace shadowmath {
inline namespace v0 {

// Where all of them are >= 0: the dot product with (p, 1), metres from each plane. A frustum on a box gives ten or so;
// what would be more than fit is left out, which only culls less.
template <class T>
struct HalfSpaces {
    std::array<Vec4<T>, max_body_faces> at;  // with unit normals
    int count = 0;                           // 0: everywhere
    bool visible = false;                    // false: of no body, nowhere

    [[nodiscard]] Vec4<T> const* begin() const noexcept { return at.data(); }
    [[nodiscard]] Vec4<T> const* end() const noexcept { return at.data() + count; }
};

// How much a caster may stand beside the body and still matter to it.
template <class T>
struct SweepPadding {
    T metres = T(0);     // everywhere: filter, bias, a spot's own radius; >= 0
    T sun_slope = T(0);  // tan of the sun's angular radius: the sweep widens by this for a metre of height; >= 0
};

namespace detail {

// The half-space with this inward normal that touches the body, and the light where that is a place; of no direction,
// everywhere.
template <class T>
[[nodiscard]] inline Vec4<T> touching(ConvexBody<T> const& body, Vec4<T> const& source,
                                      Vec3<T> const& normal) noexcept {
    T lowest = source.w == T(0) ? std::numeric_limits<T>::max() : glm::dot(normal, Vec3<T>(source) / source.w);
    for_each_vertex(body, [&](Vec3<T> const& v) { lowest = std::fmin(lowest, glm::dot(normal, v)); });
    return Vec4<T>(normal, -lowest);
}

template <class T>
inline void add(HalfSpaces<T>& planes, Vec4<T> const& plane) noexcept {
    if (planes.count < max_body_faces) planes.at[static_cast<unsigned>(planes.count++)] = plane;
}

}  // namespace detail

// Every point of the body and every point on the way from there to the light is inside, `padding` farther out. `source`
// is homogeneous(light), relative to what the body is relative to; its negative sweeps away from the light. A body
// around a spot is all faces, and comes back as itself.
template <class T>
[[nodiscard]] inline HalfSpaces<T> swept_to_light(ConvexBody<T> const& body, Vec4<T> const& source,
                                                  SweepPadding<T> const& padding = {}) noexcept {
    HalfSpaces<T> swept;
    swept.visible = body.edge_count > 0;
    Vec3<T> const travel(source);
    bool const is_sun = source.w == T(0), widens = is_sun && padding.sun_slope > T(0);
    std::array<T, max_body_faces> lit{};
    std::array<bool, max_body_faces> used{};
    for (unsigned face = 0; face < static_cast<unsigned>(body.face_count); ++face)
        lit[face] = glm::dot(body.half_space[face], source);
    for (int i = 0; i < body.edge_count; ++i) {
        auto const [f, g] = body.edges[static_cast<unsigned>(i)].face;
        used[f] = used[g] = true;
        // An unlit face along the light is the silhouette's plane itself, and comes below.
        if (!(lit[f] > T(0) && lit[g] < T(0)) && !(lit[g] > T(0) && lit[f] < T(0))) continue;
        Vec4<T> const sum = body.half_space[f] * std::abs(lit[g]) + body.half_space[g] * std::abs(lit[f]);
        Vec3<T> normal = safe_normalize(Vec3<T>(sum)).direction;
        if (is_sun) normal = safe_normalize(normal - travel * glm::dot(normal, travel)).direction;
        if (normal != Vec3<T>(T(0))) detail::add(swept, detail::touching(body, source, normal));
    }
    for (unsigned face = 0; face < static_cast<unsigned>(body.face_count); ++face) {
        T const length = glm::length(Vec3<T>(body.half_space[face]));
        if (used[face] && !(lit[face] > T(0)) && length > T(0)) detail::add(swept, body.half_space[face] / length);
    }
    T const sine = padding.sun_slope / detail::hypotenuse(T(1), padding.sun_slope);
    for (unsigned i = 0; i < static_cast<unsigned>(swept.count); ++i) {
        // The way to the edge of the sun must not leave through the plane: its normal rises at least by the sun's sine.
        Vec3<T> const normal(swept.at[i]);
        T const rise = -glm::dot(normal, travel);
        if (widens && rise < sine) {
            Vec3<T> const level = safe_normalize(normal + travel * rise).direction;
            Vec3<T> const tilted = safe_normalize(level - travel * padding.sun_slope).direction;
            swept.at[i] = detail::touching(body, source, tilted);
        }
        swept.at[i].w += padding.metres;
    }
    return swept;
}

// False only where the box is outside one of the planes: such a caster has nothing to do with the body.
template <class T>
[[nodiscard]] inline bool may_meet(HalfSpaces<T> const& planes, Aabb<T> const& box) noexcept {
    if (!planes.visible || is_empty(box)) return false;
    for (Vec4<T> const& plane : planes) {
        T distance = plane.w;
        for (int axis = 0; axis < 3; ++axis)
            distance += plane[axis] * (plane[axis] > T(0) ? box.hi[axis] : box.lo[axis]);
        if (distance < T(0)) return false;
    }
    return true;
}

// The part of a body inside all planes; planes that miss it cost nothing. Where a body has run out of faces it comes
// back larger than it should be, never smaller.
template <class T>
[[nodiscard]] inline ConvexBody<T> clipped(ConvexBody<T> const& body, HalfSpaces<T> const& planes) noexcept {
    if (!planes.visible) return {};
    ConvexBody<T> part = body;
    for (Vec4<T> const& plane : planes) {
        bool cuts = false;
        for_each_vertex(part, [&](Vec3<T> const& v) { cuts = cuts || glm::dot(plane, Vec4<T>(v, T(1))) < T(0); });
        if (cuts && part.face_count < max_body_faces) part = clipped(part, plane);
    }
    return part;
}

}  // namespace v0
}  // namespace shadowmath
