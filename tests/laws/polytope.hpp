// SPDX-License-Identifier: MIT
//
// What polytope.hpp promises: a cut body keeps every point that the whole one had on the right side, and gains none.
#pragma once

#include <shadowmath/polytope.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace shadowmath::laws {

// No direction in which the body ends before the point does; `slack` metres. The six axes and eight diagonals are
// asked.
template <class T>
[[nodiscard]] bool may_contain(ConvexBody<T> const& body, Vec3<T> const& point, T slack) {
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                Vec3<T> const direction{T(x), T(y), T(z)};
                T end = std::numeric_limits<T>::lowest();
                for_each_vertex(body, [&](Vec3<T> const& v) { end = std::max(end, glm::dot(direction, v)); });
                if (!(end + slack * T(2) >= glm::dot(direction, point))) return false;
            }
    return true;
}

// Every vertex is at least -slack metres inside; `half_space` has a unit normal.
template <class T>
[[nodiscard]] bool lies_inside(ConvexBody<T> const& body, Vec4<T> const& half_space, T slack) {
    bool inside = true;
    for_each_vertex(
        body, [&](Vec3<T> const& v) { inside = inside && glm::dot(Vec3<T>(half_space), v) + half_space.w >= -slack; });
    return inside;
}

// V - E + F = 2, with faces counted as those that still have edges, three at least, and every edge end met by three
// edges: the combinatorics hold whatever rounding does to the places, but for two cuts along what is one plane to
// rounding. Those may link the points of a face in another order; what the body holds is the same.
template <class T>
[[nodiscard]] bool is_a_polyhedron(ConvexBody<T> const& body) {
    int edges_of[max_body_faces] = {};
    for (int i = 0; i < body.edge_count; ++i)
        for (std::uint8_t const face : body.edges[static_cast<std::size_t>(i)].face) ++edges_of[face];
    int faces = 0;
    for (int const count : edges_of) {
        if (count == 1 || count == 2) return false;
        faces += count > 0;
    }
    // Cuts make simple polyhedra: three edges meet at a vertex, so V = 2 E / 3.
    return body.edge_count == 0 || (body.edge_count % 3 == 0 && body.edge_count * 2 / 3 - body.edge_count + faces == 2);
}

}  // namespace shadowmath::laws
