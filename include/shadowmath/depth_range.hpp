// SPDX-License-Identifier: MIT
//
// How deep a map must be: from the first caster that can shadow anything inside its sides, to the last receiver.
//
//        light                 Casters count where they are in the shaft between the sides, from the light down to the
//     |    |    |              receivers; not where their box merely overlaps it. A mountain's box that leans into the
//  c c|cc  |    |   <- lo      shaft at the top counts from the height at which it is inside.
//   c |    |    |
//     |  slice  |              pancake: lo is the first receiver instead. The renderer must turn depth clamp on
//     |_________|   <- hi      (GL_DEPTH_CLAMP, depthClampEnable): casters above lo are then drawn flat at depth 0.
//
// Source: clipping the scene's box against the map's four sides is that of Microsoft's "Common techniques to improve
// shadow depth maps". Departures: polygons for triangles, and boxes without an end are cut before they are computed
// with.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fit_box.hpp>
#include <shadowmath/light_box.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/view_volume.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct DepthRange {
    T lo = T(0);  // metres along the light, from the world origin
    T hi = T(1);
    bool visible = false;  // false: nothing is there, or nothing that could shadow it
};

namespace detail {

// A quadrilateral and what cutting by six planes can add: a corner each.
template <class T>
struct Polygon {
    Vec3<T> at[10];
    int count = 0;
};

// What is left where plane.xyz * p + plane.w >= 0; Sutherland and Hodgman 1974.
template <class T>
[[nodiscard]] inline Polygon<T> clipped(Polygon<T> const& whole, Vec4<T> const& plane) noexcept {
    Polygon<T> part;
    for (int i = 0; i < whole.count; ++i) {
        Vec3<T> const &a = whole.at[i], &b = whole.at[i + 1 < whole.count ? i + 1 : 0];
        T const above_a = glm::dot(Vec3<T>(plane), a) + plane.w, above_b = glm::dot(Vec3<T>(plane), b) + plane.w;
        // NOTE: rounding can make a convex polygon cross a plane more than twice; the spare corners are dropped.
        if (above_a >= T(0) && part.count < 10) part.at[part.count++] = a;
        if ((above_a >= T(0)) != (above_b >= T(0)) && part.count < 10)
            part.at[part.count++] = a + (b - a) * (above_a / (above_a - above_b));
    }
    return part;
}

// The six sides as planes whose positive half is inside.
template <class T>
[[nodiscard]] inline std::array<Vec4<T>, 6> inner_planes(ViewVolume<T> const& view) noexcept {
    Pose<T> const& pose = view.pose;
    auto const coordinate = [&pose](Vec3<T> const& axis) { return Vec4<T>(axis, -glm::dot(axis, pose.position)); };
    Vec4<T> const x = coordinate(pose.right), y = coordinate(pose.up), depth = coordinate(pose.forward);
    Vec4<T> const one(T(0), T(0), T(0), T(1));
    Vec4<T> const& spread = view.kind == ViewKind::perspective ? depth : one;
    return {x - view.left * spread, view.right * spread - x,   y - view.bottom * spread,
            view.top * spread - y,  depth - view.z_near * one, view.z_far * one - depth};
}

}  // namespace detail

// Depths along `volume` at which the box is inside it: never less than the truth, and more by rounding only. Any finite
// box will do, however large; the volume must be finite. Not visible where they do not meet.
//
// The least and the greatest depth of the common part are at its corners, and those are corners of the volume inside
// the box, or lie on the box's faces.
template <class T>
[[nodiscard]] inline DepthRange<T> depths_inside(Aabb<T> const& box, ViewVolume<T> const& volume) noexcept {
    if (!all_finite(box) || is_empty(box)) return {};
    std::array<Vec3<T>, 8> const volume_corners = corners(volume);
    constexpr T slack = T(8) * std::numeric_limits<T>::epsilon();
    Aabb<T> const around = merge(bounds_of(volume_corners), volume.pose.position);
    // Whatever does not reach the volume goes first: from here on no number is larger than the volume's own.
    T const reach = slack * detail::largest_of(around);
    Aabb<T> const body = intersect(box, Aabb<T>{around.lo - reach, around.hi + reach});
    if (is_empty(body)) return {};
    T const largest = detail::largest_of(merge(body, volume.pose.position)), rounding = slack * largest;
    DepthRange<T> range{volume.z_far, volume.z_near, false};
    auto const reaches = [&](Vec3<T> const& point) {
        T const depth = eye_depth(volume, point);
        range.lo = depth < range.lo ? depth : range.lo;
        range.hi = depth > range.hi ? depth : range.hi;
        range.visible = true;
    };
    for (Vec3<T> const& corner : volume_corners)
        if (contains(body, corner)) reaches(corner);
    std::array<Vec4<T>, 6> planes = detail::inner_planes(volume);
    for (Vec4<T>& plane : planes)
        plane.w += slack * ((std::abs(plane.x) + std::abs(plane.y) + std::abs(plane.z)) * largest + std::abs(plane.w));
    std::array<Vec3<T>, 8> const at = corners(body);
    for (unsigned axis = 0; axis < 3; ++axis) {
        std::size_t const u = std::size_t(1) << (axis + 1) % 3, v = std::size_t(1) << (axis + 2) % 3;
        for (std::size_t const first : {std::size_t(0), std::size_t(1) << axis}) {
            detail::Polygon<T> face{{at[first], at[first + u], at[first + u + v], at[first + v]}, 4};
            for (Vec4<T> const& plane : planes) face = detail::clipped(face, plane);
            for (int i = 0; i < face.count; ++i) reaches(face.at[i]);
        }
    }
    if (!range.visible) return {};
    range.lo = std::fmax(range.lo - rounding, volume.z_near);
    range.hi = std::fmin(range.hi + rounding, volume.z_far);
    return range;
}

// Between lo and hi lies every receiver inside the sides and the slice, and, unless `pancake`, every caster above it.
//
//   sides            of the map; its depths are not read
//   receivers_slice  the first and last depth of the slice, as fit_box finds them
//   casters, receivers   world boxes. Either empty, or nowhere inside: not visible, and no fault.
//
// A caster box that goes on and on toward the light (+-FLT_MAX) is cut 65536 times the size of sides and slice above
// the slice: a depth buffer tells nothing apart in more. Give true bounds, or pancake.
template <class T>
[[nodiscard]] inline DepthRange<T> depth_range(LightBox<T> const& sides, DepthRange<T> const& receivers_slice,
                                               Aabb<T> const& casters, Aabb<T> const& receivers,
                                               bool pancake) noexcept {
    DepthRange<T> const& slice = receivers_slice;
    bool const finite =
        all_finite(sides.lo) && all_finite(sides.hi) && all_finite(&slice.lo, 1) && all_finite(&slice.hi, 1);
    if (!finite || !detail::has_unit_axes(sides.basis) || !slice.visible || !(slice.lo <= slice.hi)) return {};
    T largest = std::fmax(std::abs(slice.lo), std::abs(slice.hi));
    for (T const side : {sides.lo.x, sides.lo.y, sides.hi.x, sides.hi.y}) largest = std::fmax(largest, std::abs(side));
    if (!(largest <= detail::farthest_metres<T>)) return {};
    // Light space is an orthographic view from the world origin.
    ViewVolume<T> shaft = orthographic_view({Vec3<T>(T(0)), sides.basis.x, sides.basis.y, sides.basis.depth},
                                            sides.lo.x, sides.hi.x, sides.lo.y, sides.hi.y, slice.lo, slice.hi);
    DepthRange<T> const received = depths_inside(receivers, shaft);
    if (!received.visible) return {};
    T const size = (sides.hi.x - sides.lo.x) + (sides.hi.y - sides.lo.y) + (slice.hi - slice.lo);
    shaft.z_near = slice.lo - T(65536) * size;
    shaft.z_far = received.hi;
    DepthRange<T> const cast = depths_inside(casters, shaft);
    if (!cast.visible) return {};
    DepthRange<T> range{pancake ? received.lo : std::fmin(cast.lo, received.lo), received.hi, true};
    detail::widen(range.lo, range.hi, std::fmax(T(8) * std::numeric_limits<T>::epsilon() * largest, T(1e-6)));
    return range;
}

// Both ends moved outward to whole multiples of `step_metres`: the depth that a map stores for a point is then the same
// from frame to frame until an end is crossed. A power of two makes the multiples exact. A step that is not positive
// changes nothing.
template <class T>
[[nodiscard]] inline DepthRange<T> in_steps(DepthRange<T> range, T const& step_metres) noexcept {
    if (!all_finite(&step_metres, 1) || !(step_metres > T(0)) || !range.visible) return range;
    T const lo = std::floor(range.lo / step_metres), hi = std::ceil(range.hi / step_metres);
    constexpr T whole_numbers = T(1) / std::numeric_limits<T>::epsilon();
    if (!(std::abs(lo) < whole_numbers && std::abs(hi) < whole_numbers)) return range;
    return {lo * step_metres, hi * step_metres, true};
}

}  // namespace v0
}  // namespace shadowmath
