// SPDX-License-Identifier: MIT
//
// A convex body that planes can cut: what a view sees of a box, what a light reaches of that. No heap, no sorting.
//
// The body is its edges, each with the two faces that meet there. A plane shortens edges; every face that it cuts is
// left with two ends, and the line between them is a new edge, shared with the new face. So nothing ever needs to be
// in order. Each face also keeps its own plane, which sweep.hpp follows the light with. Use it to bound what a map must
// hold; for a box alone bounds.hpp is enough.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/view_volume.hpp>

#include <array>
#include <cstdint>

namespace shadowmath {
inline namespace v0 {

// Six faces to begin with and up to twenty-six cuts: a polyhedron of f faces has at most 3 f - 6 edges.
inline constexpr int max_body_faces = 32;
inline constexpr int max_body_edges = 3 * max_body_faces - 6;

template <class T>
struct ConvexBody {
    struct Edge {
        Vec3<T> a;
        Vec3<T> b;
        std::array<std::uint8_t, 2> face;
    };
    std::array<Edge, max_body_edges> edges;
    std::array<Vec4<T>, max_body_faces> half_space;  // of each face, >= 0 inside, of any length; 0 where none is known
    int edge_count = 0;                              // 0: nothing left
    int face_count = 0;
};

// From eight corners whose indices differ in one bit along an edge: a box, a view volume. A face without area has no
// plane of its own.
template <class T>
[[nodiscard]] inline ConvexBody<T> convex_body(std::array<Vec3<T>, 8> const& corners) noexcept {
    ConvexBody<T> body;
    body.face_count = 6;
    for (unsigned i = 0; i < 8; ++i)
        for (unsigned axis = 0; axis < 3; ++axis) {
            if ((i >> axis & 1u) != 0) continue;
            // Face 2 * axis is the one at the axis' lower end; an edge along one axis lies in faces of the other two.
            unsigned const u = (axis + 1) % 3, v = (axis + 2) % 3;
            body.edges[static_cast<unsigned>(body.edge_count++)] = {
                corners[i],
                corners[i | 1u << axis],
                {static_cast<std::uint8_t>(2 * u + (i >> u & 1u)), static_cast<std::uint8_t>(2 * v + (i >> v & 1u))}};
        }
    for (unsigned face = 0; face < 6; ++face) {
        unsigned const axis = face / 2, at = (face & 1u) << axis, u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
        // The diagonals span the face even where two of its corners are one.
        Vec3<T> const across = corners[at | u | v] - corners[at], aside = corners[at | v] - corners[at | u];
        Vec3<T> const normal = safe_normalize(glm::cross(across, aside)).direction;
        Vec3<T> const middle = (corners[at] + corners[at | u | v]) * T(0.5);
        Vec3<T> const opposite = (corners[at ^ 1u << axis] + corners[(at ^ 1u << axis) | u | v]) * T(0.5);
        T const sign = glm::dot(normal, opposite - middle) < T(0) ? T(-1) : T(1);
        body.half_space[face] = sign * Vec4<T>(normal, -glm::dot(normal, middle));
    }
    return body;
}

// A box: its planes are known even where it is flat.
template <class T>
[[nodiscard]] inline ConvexBody<T> convex_body(Aabb<T> const& box) noexcept {
    ConvexBody<T> body = convex_body(corners(box));
    for (int axis = 0; axis < 3; ++axis) {
        Vec3<T> normal(T(0));
        normal[axis] = T(1);
        body.half_space[static_cast<unsigned>(2 * axis)] = Vec4<T>(normal, -box.lo[axis]);
        body.half_space[static_cast<unsigned>(2 * axis + 1)] = Vec4<T>(-normal, box.hi[axis]);
    }
    return body;
}

// Every vertex, each as often as edges meet there.
template <class T, class Visit>
inline void for_each_vertex(ConvexBody<T> const& body, Visit&& visit) noexcept {
    for (int i = 0; i < body.edge_count; ++i) {
        visit(body.edges[static_cast<unsigned>(i)].a);
        visit(body.edges[static_cast<unsigned>(i)].b);
    }
}

// The part where half_space . (p, 1) >= 0. Flat bodies and planes through vertices are no special case: a vertex is
// inside or outside, the same for all its edges.
template <class T>
[[nodiscard]] inline ConvexBody<T> clipped(ConvexBody<T> const& body, Vec4<T> const& half_space) noexcept {
    SHADOWMATH_ASSERT(body.face_count < max_body_faces, "a convex body was cut too often");
    if (body.face_count >= max_body_faces) return body;
    ConvexBody<T> kept;
    kept.half_space = body.half_space;
    kept.half_space[static_cast<unsigned>(body.face_count)] = half_space;
    auto const add = [&kept](typename ConvexBody<T>::Edge const& edge) {
        if (kept.edge_count < max_body_edges) kept.edges[static_cast<unsigned>(kept.edge_count++)] = edge;
    };
    auto const cap = static_cast<std::uint8_t>(body.face_count);
    kept.face_count = body.face_count + 1;
    std::array<Vec3<T>, max_body_faces> end_of_face;
    std::array<bool, max_body_faces> open{};
    for (int i = 0; i < body.edge_count; ++i) {
        typename ConvexBody<T>::Edge edge = body.edges[static_cast<unsigned>(i)];
        T const at_a = glm::dot(half_space, Vec4<T>(edge.a, T(1))), at_b = glm::dot(half_space, Vec4<T>(edge.b, T(1)));
        bool const a_inside = at_a >= T(0), b_inside = at_b >= T(0);
        if (!a_inside && !b_inside) continue;
        if (a_inside != b_inside) {
            // From the inner end: a far outer one then costs no precision.
            T const t = a_inside ? at_a / (at_a - at_b) : at_b / (at_b - at_a);
            Vec3<T> const cut = a_inside ? edge.a + (edge.b - edge.a) * t : edge.b + (edge.a - edge.b) * t;
            (a_inside ? edge.b : edge.a) = cut;
            for (std::uint8_t const face : edge.face) {
                if (open[face]) add({end_of_face[face], cut, {face, cap}});
                end_of_face[face] = cut;
                open[face] = !open[face];
            }
        }
        add(edge);
    }
    return kept;
}

// The same body elsewhere.
template <class T>
[[nodiscard]] inline ConvexBody<T> translated(ConvexBody<T> const& body, Vec3<T> const& offset) noexcept {
    ConvexBody<T> moved = body;
    for (int i = 0; i < body.edge_count; ++i) {
        moved.edges[static_cast<unsigned>(i)].a += offset;
        moved.edges[static_cast<unsigned>(i)].b += offset;
    }
    for (int i = 0; i < body.face_count; ++i) {
        Vec4<T>& plane = moved.half_space[static_cast<unsigned>(i)];
        plane.w -= glm::dot(Vec3<T>(plane), offset);
    }
    return moved;
}

// What a view sees of a box, RELATIVE TO THE EYE: add view.pose.position for world points. Boxes of +-FLT_MAX are cut
// to the bounds of the view before any arithmetic. A valid view with a finite z_far; an empty box gives an empty body.
// `slack_metres` moves every plane outward: a wedge thinner than a rounding then loses nothing of its tip.
template <class T>
[[nodiscard]] inline ConvexBody<T> visible_body(ViewVolume<T> const& view, Aabb<T> const& box_in_world,
                                                T slack_metres = T(0)) noexcept {
    if (is_empty(box_in_world)) return {};
    Vec3<T> const &x = view.pose.right, &y = view.pose.up, &z = view.pose.forward;
    ViewVolume<T> centred = view;
    centred.pose.position = Vec3<T>(T(0));
    // NOTE: the square of this bound, times a few, still fits into a float.
    Aabb<T> const bound{Vec3<T>(T(-1e12)), Vec3<T>(T(1e12))};
    Vec3<T> const slack(slack_metres);
    Aabb<T> const relative{box_in_world.lo - view.pose.position - slack, box_in_world.hi - view.pose.position + slack};
    Aabb<T> const seen = bounds_of(corners(centred));
    Aabb<T> const box = intersect(intersect(relative, Aabb<T>{seen.lo - slack, seen.hi + slack}), bound);
    if (is_empty(box)) return {};
    bool const flat = view.kind == ViewKind::orthographic;
    auto const side = [&z, flat, slack_metres](Vec3<T> const& inward, T limit) {
        if (flat) return Vec4<T>(inward, slack_metres - limit);
        return Vec4<T>(safe_normalize(inward - z * limit).direction, slack_metres);
    };
    ConvexBody<T> body = convex_body(box);
    body = clipped(body, side(x, view.left));
    body = clipped(body, side(-x, -view.right));
    body = clipped(body, side(y, view.bottom));
    body = clipped(body, side(-y, -view.top));
    body = clipped(body, Vec4<T>(z, slack_metres - view.z_near));
    return clipped(body, Vec4<T>(-z, view.z_far + slack_metres));
}

}  // namespace v0
}  // namespace shadowmath
