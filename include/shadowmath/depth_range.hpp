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
// Source: cutting the scene's box by the map's four sides is that of Microsoft's "Common techniques to improve shadow
// depth maps". Departures: edges for triangles, four at a time, and boxes without an end are cut before they are
// computed with.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fit_box.hpp>
#include <shadowmath/lanes.hpp>
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

// Least and greatest depth of edges, four at a time.
template <class T>
struct DepthsOfEdges {
    Lanes<T> lo = Lanes<T>::all(std::numeric_limits<T>::max()), hi = Lanes<T>::all(-std::numeric_limits<T>::max());

    // From depth a to depth b, where first <= last.
    [[gnu::always_inline]] void add(Lanes<T> const& a, Lanes<T> const& b, Lanes<T> const& first,
                                    Lanes<T> const& last) noexcept {
        lo = least(lo, where_at_most(first, last, least(a, b), lo));
        hi = largest(hi, where_at_most(first, last, largest(a, b), hi));
    }
};

// The four sides of a volume, moved outward by what rounding may have moved them inward.
template <class T>
struct WidenedSides {
    std::array<Vec4<T>, 4> planes;  // positive inside
    T wider[4];                     // metres, plane by plane

    [[gnu::always_inline]] WidenedSides(ViewVolume<T> const& volume, T const& size, T const& slack) noexcept {
        std::array<Vec4<T>, 6> const given = inner_planes(volume);
        for (std::size_t i = 0; i < 4; ++i) {
            Vec4<T>& plane = planes[i];
            plane = given[i];
            T const growth = std::abs(plane.x) + std::abs(plane.y) + std::abs(plane.z);
            wider[i] = slack * (growth * size + std::abs(plane.w));
            plane.w += wider[i];
        }
    }
};

// The twelve edges of the box between the sides, four to an axis.
template <class T>
[[gnu::always_inline]] inline void add_box_edges(DepthsOfEdges<T>& depths, Aabb<T> const& body,
                                                 WidenedSides<T> const& sides, Pose<T> const& pose) noexcept {
    using Lanes = Lanes<T>;
    auto const all = [](T value) { return Lanes::all(value); };
    constexpr T none = std::numeric_limits<T>::max();
    for (int axis = 0; axis < 3; ++axis) {
        int const next = (axis + 1) % 3, after = (axis + 2) % 3;
        // Where the four are on the other two axes.
        Lanes const u = Lanes::of(body.lo[next], body.hi[next], body.lo[next], body.hi[next]);
        Lanes const v = Lanes::of(body.lo[after], body.lo[after], body.hi[after], body.hi[after]);
        Lanes first = all(body.lo[axis]), last = all(body.hi[axis]);
        for (Vec4<T> const& plane : sides.planes) {
            T const inward = not_zero(plane[axis]);
            Lanes const root = (u * all(plane[next]) + v * all(plane[after]) + all(plane.w)) * all(T(-1) / inward);
            // It enters where it goes inward, and leaves where not.
            if (inward > T(0))
                first = largest(first, least(root, all(none)));
            else
                last = least(last, largest(root, all(-none)));
        }
        Vec3<T> const &eye = pose.position, &ahead = pose.forward;
        Lanes const at = (u - all(eye[next])) * all(ahead[next]) + (v - all(eye[after])) * all(ahead[after]);
        auto const depth = [&](Lanes const& along) {
            // NOTE: of edges that are none, any depth does, as long as it is a number.
            Lanes const on_edge = least(largest(along, all(body.lo[axis])), all(body.hi[axis]));
            return (on_edge - all(eye[axis])) * all(ahead[axis]) + at;
        };
        depths.add(depth(first), depth(last), first, last);
    }
}

// The corner edges of the four sides inside the box: (left, bottom), (right, bottom), (right, top), (left, top).
template <class T>
[[gnu::always_inline]] inline void add_corner_edges(DepthsOfEdges<T>& depths, Aabb<T> const& body,
                                                    WidenedSides<T> const& sides, ViewVolume<T> const& volume,
                                                    T const& rounding) noexcept {
    using Lanes = Lanes<T>;
    auto const all = [](T value) { return Lanes::all(value); };
    constexpr T none = std::numeric_limits<T>::max();
    Pose<T> const& pose = volume.pose;
    bool const flat = volume.kind == ViewKind::orthographic;
    Lanes const x = Lanes::of(volume.left, volume.right, volume.right, volume.left);
    Lanes const y = Lanes::of(volume.bottom, volume.bottom, volume.top, volume.top);
    Lanes const wider_x = Lanes::of(-sides.wider[0], sides.wider[1], sides.wider[1], -sides.wider[0]);
    Lanes const wider_y = Lanes::of(-sides.wider[2], -sides.wider[2], sides.wider[3], sides.wider[3]);
    // Those of a perspective begin at the eye.
    Lanes first = all(flat ? -none : T(0)), last = all(none);
    for (int axis = 0; axis < 3; ++axis) {
        Lanes const across = all(pose.right[axis]), upward = all(pose.up[axis]), sideways = x * across + y * upward;
        Lanes from = all(pose.position[axis]) + (wider_x * across + wider_y * upward), step = all(pose.forward[axis]);
        if (flat)
            from = from + sideways;
        else
            step = step + sideways;
        Lanes const inverse = all(T(1)) / not_zero(step);
        Lanes const a = (all(body.lo[axis] - rounding) - from) * inverse;
        Lanes const b = (all(body.hi[axis] + rounding) - from) * inverse;
        first = largest(first, least(a, b));
        last = least(last, largest(a, b));
    }
    depths.add(first, last, first, last);
}

}  // namespace detail

// Depths along `volume` at which the box is inside it: never less than the truth, and more by rounding only. Any finite
// box will do, however large; the volume must be finite. Not visible where they do not meet.
//
// The least and the greatest depth that the box has between the four sides, however far they go, are where its edges
// enter and leave, where the corner edges of the sides enter and leave the box, or at the eye. What lies between them
// is one piece: near and far end only cut it off.
template <class T>
[[nodiscard]] inline DepthRange<T> depths_inside(Aabb<T> const& box, ViewVolume<T> const& volume) noexcept {
    if (!all_finite(box) || is_empty(box)) return {};
    constexpr T slack = T(8) * std::numeric_limits<T>::epsilon();
    Vec3<T> const& eye = volume.pose.position;
    Aabb<T> const around = merge(bounds_of(corners(volume)), eye);
    // Whatever does not reach the volume goes first: from here on no number is larger than the volume's own.
    T const reach = slack * detail::largest_of(around);
    Aabb<T> const body = intersect(box, Aabb<T>{around.lo - reach, around.hi + reach});
    if (is_empty(body)) return {};
    T const size = detail::largest_of(merge(body, eye)), rounding = slack * size;
    detail::WidenedSides<T> const sides(volume, size, slack);
    detail::DepthsOfEdges<T> depths;
    detail::add_box_edges(depths, body, sides, volume.pose);
    detail::add_corner_edges(depths, body, sides, volume, rounding);
    T lo = depths.lo[0], hi = depths.hi[0];
    for (int i = 1; i < 4; ++i) {
        lo = depths.lo[i] < lo ? depths.lo[i] : lo;
        hi = depths.hi[i] > hi ? depths.hi[i] : hi;
    }
    // The eye, where the sides of a perspective meet: a flat box through it holds that and none of their edges.
    if (volume.kind == ViewKind::perspective && contains(Aabb<T>{body.lo - rounding, body.hi + rounding}, eye)) {
        lo = std::fmin(lo, T(0));
        hi = std::fmax(hi, T(0));
    }
    if (!(lo <= hi)) return {};
    DepthRange<T> const range{std::fmax(lo - rounding, volume.z_near), std::fmin(hi + rounding, volume.z_far), true};
    return range.lo <= range.hi ? range : DepthRange<T>{};
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
