// SPDX-License-Identifier: MIT
//
// The smallest rectangle around a body as the light sees it, at whatever angle: never larger than fit_box, and a
// quarter smaller on average around a view frustum. As with fit_box, size and place change as the camera turns, and
// edges crawl; use it where fit_box would do.
//
//    ___________         A least rectangle has a side along an edge of the hull (Freeman and Shapira 1975). The hull's
//   |   fit_box |        edges are the body's silhouette: those where a face that the light meets joins one that it
//   | /\        |        does not. So each silhouette edge is tried, and no hull is ever built.
//   |/  \__     |
//   |\ least \_ |        Two angles can be equally good, and then the least one jumps between them. The angle of the
//   |_\________\|        last frame is kept while its rectangle is within `hysteresis` of the least.
//
// Source: Freeman and Shapira, "Determining the minimum-area encasing rectangle for an arbitrary closed curve", CACM
// 18(7), 1975. Departures: the silhouette for the hull; the angle's hysteresis.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/fit_box.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/light_box.hpp>
#include <shadowmath/polytope.hpp>
#include <shadowmath/reach.hpp>

#include <array>
#include <cmath>

namespace shadowmath {
inline namespace v0 {

// Turned about the light: x goes to (cosine, sine) in the old axes. The two need not be of length 1 together.
template <class T>
[[nodiscard]] inline LightBasis<T> rolled(LightBasis<T> const& basis, T cosine, T sine) noexcept {
    // Not by hypot, here and below: its last bit differs between platforms, and may turn a box.
    Normalized<T> const x = safe_normalize(Vec3<T>(cosine, sine, T(0)));
    if (!x.ok) return basis;
    T const c = x.direction.x, s = x.direction.y;
    return {basis.x * c + basis.y * s, basis.y * c - basis.x * s, basis.depth};
}

// Square metres across the light.
template <class T>
[[nodiscard]] inline T area(LightBox<T> const& box) noexcept {
    return (box.hi.x - box.lo.x) * (box.hi.y - box.lo.y);
}

// As fit_box holds corners, this holds every vertex of the body (in world space), and area(box) is never more than that
// of fit_box in the same basis. Of the four quarter turns the one nearest to `previous_x` is taken: the x axis of the
// last frame's box, a world direction; or to basis.x where it is zero, or not finite, or along the light. Exactly its
// direction is kept while the area is at most 1 + hysteresis times the least, and no more than fit_box's. Bodies that
// are empty, not finite, or beyond 1e18 m give what fit_box gives for such corners.
template <class T>
[[nodiscard]] inline LightBox<T> fit_rectangle(LightBasis<T> const& basis, ConvexBody<T> const& body, int map_size,
                                               T margin_texels, Vec3<T> const& previous_x = Vec3<T>(T(0)),
                                               T hysteresis = T(0.1)) noexcept {
    if (!detail::has_unit_axes(basis) || body.edge_count == 0) return {};
    std::array<Vec3<T>, 2 * max_body_edges> vertex;  // in light space, edge by edge
    unsigned count = 0;
    bool sound = true;
    Aabb<T> bounds;
    for_each_vertex(body, [&](Vec3<T> const& v) {
        sound = sound && all_finite(v) && detail::largest_of(v) <= detail::farthest_metres<T>;
        vertex[count] = in_light(basis, v);
        bounds = merge(bounds, vertex[count++]);
    });
    if (!sound) return {};

    auto const bounds_along = [&](T c, T s) {
        Aabb<T> turned;
        for (unsigned i = 0; i < count; ++i)
            turned = merge(turned,
                           Vec3<T>(c * vertex[i].x + s * vertex[i].y, c * vertex[i].y - s * vertex[i].x, vertex[i].z));
        return turned;
    };
    auto const area_along = [&](Vec2<T> const& x) {
        Aabb<T> const turned = bounds_along(x.x, x.y);
        return (turned.hi.x - turned.lo.x) * (turned.hi.y - turned.lo.y);
    };
    T const plain = area_along(Vec2<T>(T(1), T(0)));
    Vec2<T> best(T(1), T(0));
    T least = plain;
    for (int i = 0; i < body.edge_count; ++i) {
        auto const [f, g] = body.edges[static_cast<unsigned>(i)].face;
        auto const lit = [&](unsigned face) { return glm::dot(basis.depth, Vec3<T>(body.half_space[face])) > T(0); };
        if (lit(f) == lit(g)) continue;
        Vec2<T> const edge = Vec2<T>(vertex[2 * static_cast<unsigned>(i) + 1] - vertex[2 * static_cast<unsigned>(i)]);
        Normalized<T> const along = safe_normalize(Vec3<T>(edge, T(0)));
        if (!along.ok) continue;
        T const needed = area_along(Vec2<T>(along.direction));
        if (needed < least) {
            least = needed;
            best = Vec2<T>(along.direction);
        }
    }
    // The previous direction, as far as it lies across this light.
    Vec3<T> const before = all_finite(previous_x) ? safe_normalize(previous_x).direction : Vec3<T>(T(0));
    Vec2<T> last(glm::dot(basis.x, before), glm::dot(basis.y, before));
    Normalized<T> const across = safe_normalize(Vec3<T>(last, T(0)));
    bool const has_last = across.length > T(1e-3);
    last = has_last ? Vec2<T>(across.direction) : Vec2<T>(T(1), T(0));
    T const slack = all_finite(&hysteresis, 1) && hysteresis > T(0) ? hysteresis : T(0);
    if (has_last && area_along(last) <= std::fmin(least * (T(1) + slack), plain)) best = last;
    auto const box_along = [&](Vec2<T> x) {
        // Quarter turns, until the new x is within an eighth of the last.
        if (std::abs(glm::dot(x, last)) < std::abs(x.x * last.y - x.y * last.x)) x = Vec2<T>(-x.y, x.x);
        if (glm::dot(x, last) < T(0)) x = -x;
        return box_around(rolled(basis, x.x, x.y), bounds_along(x.x, x.y), map_size, margin_texels);
    };
    // Widened and rounded, the least may have become more than the plain one.
    LightBox<T> const turned = box_along(best), straight = box_along(Vec2<T>(T(1), T(0)));
    return area(turned) <= area(straight) ? turned : straight;
}

}  // namespace v0
}  // namespace shadowmath
