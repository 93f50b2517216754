// SPDX-License-Identifier: MIT
//
// All slices of a view at once, each cut down to the scene: for worlds that end before the view does, and to fit maps
// to a room. What visible_body gives for each slice, bounded along the axes of the light, a hundred times as fast.
//
// The corners of what a slice and a box have in common are where edges of one end, inside the other, or pass through
// its faces. So nothing but edges is clipped, each once for all slices, four at a time:
//
//   four corner rays of the view     to the box, then to the depths of every slice
//   four sides of each split plane   to the box; they belong to the slices on either side
//   twelve edges of the box          to the four sides of the view, then to the depths of every slice
//
// Source: ours. Edges instead of faces, as in polytope.hpp, but none is ever new.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/lanes.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/polytope.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/slices.hpp>
#include <shadowmath/splits.hpp>
#include <shadowmath/view_volume.hpp>
#include <shadowmath/wide.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

namespace shadowmath {
inline namespace v0 {
namespace detail {

// Four vectors at a time.
template <class T>
struct FourVectors {
    Lanes<T> x, y, z;

    [[gnu::always_inline]] friend FourVectors operator+(FourVectors const& a, FourVectors const& b) noexcept {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    [[gnu::always_inline]] friend FourVectors operator*(FourVectors const& a, Lanes<T> const& s) noexcept {
        return {a.x * s, a.y * s, a.z * s};
    }
    [[gnu::always_inline]] friend FourVectors least(FourVectors const& a, FourVectors const& b) noexcept {
        return {least(a.x, b.x), least(a.y, b.y), least(a.z, b.z)};
    }
    [[gnu::always_inline]] friend FourVectors largest(FourVectors const& a, FourVectors const& b) noexcept {
        return {largest(a.x, b.x), largest(a.y, b.y), largest(a.z, b.z)};
    }
};

// Multiples of one vector.
template <class T>
[[nodiscard, gnu::always_inline]] inline FourVectors<T> times(Lanes<T> const& s, Vec3<T> const& v) noexcept {
    return {s * all_four(v.x), s * all_four(v.y), s * all_four(v.z)};
}

// Least and largest light-space coordinates of four edges at a time.
template <class T>
struct ExtentInLanes {
    FourVectors<T> lo;
    FourVectors<T> hi;

    [[gnu::always_inline]] void add(ExtentInLanes const& other) noexcept {
        lo = least(lo, other.lo);
        hi = largest(hi, other.hi);
    }
};

// What four edges, from `origin` on along `step`, reach between a and b. Where a > b an edge is none, and its extent is
// inside out by more than anything can be long.
template <class T>
[[nodiscard, gnu::always_inline]] inline ExtentInLanes<T> extent_of(FourVectors<T> const& origin,
                                                                    FourVectors<T> const& step, Lanes<T> const& a,
                                                                    Lanes<T> const& b) noexcept {
    FourVectors<T> const p = origin + step * a, q = origin + step * b;
    Lanes<T> const none = where_at_most(a, b, all_four(T(0)), all_four(T(1e30)));
    FourVectors<T> const lo = least(p, q), hi = largest(p, q);
    return {{lo.x + none, lo.y + none, lo.z + none}, {hi.x - none, hi.y - none, hi.z - none}};
}

// The part of [first, last] for which from + that / inverse lies in [lo, hi].
template <class T>
[[gnu::always_inline]] inline void keep_between(T lo, T hi, Lanes<T> const& from, Lanes<T> const& inverse,
                                                Lanes<T>& first, Lanes<T>& last) noexcept {
    Lanes<T> const a = (all_four(lo) - from) * inverse, b = (all_four(hi) - from) * inverse;
    first = largest(first, least(a, b));
    last = least(last, largest(a, b));
}

// Nothing is divided by less than this; what it stands for is the same to far less than a rounding.
template <class T>
[[nodiscard, gnu::always_inline]] inline Lanes<T> not_zero(Lanes<T> const& value) noexcept {
    Lanes<T> const tiny = all_four(T(1e-20));
    return where_at_most(tiny, largest(value, all_four(T(0)) - value), value, tiny);
}
template <class T>
[[nodiscard, gnu::always_inline]] inline T not_zero(T value) noexcept {
    return value > T(1e-20) || value < T(-1e-20) ? value : T(1e-20);
}

// A view with what it sees of a box, relative to the eye, every plane `slack` metres farther out. Side `i` of the view
// at depth z is at `slope[i] * z + offset[i]`; left, right, bottom, top.
template <class T>
struct ViewOfBox {
    Pose<T> pose;
    T slope[4];
    T offset[4];
    Vec3<T> lo;
    Vec3<T> hi;
    T slack;
};

// False where the numbers are none that products of three can be made of, or nothing is there.
template <class T>
[[nodiscard]] inline bool look_at_box(ViewVolume<T> const& view, LightBasis<T> const& basis, T farthest,
                                      Aabb<T> const& scene, ViewOfBox<T>& seen) noexcept {
    constexpr T most = T(1e12);
    auto const bound = order_of(most);
    auto const size = [](T value) { return order_of(std::abs(value)); };
    T const sides = std::abs(view.left) + std::abs(view.right) + std::abs(view.bottom) + std::abs(view.top);
    Vec3<T> const& eye = view.pose.position;
    auto const far_end = order_of(farthest), widest = size(sides), x = size(eye.x), y = size(eye.y), z = size(eye.z);
    bool const good = (far_end <= bound) & (widest <= bound) & (x <= bound) & (y <= bound) & (z <= bound);
    if (!good || !all_finite(scene) || is_empty(scene)) return false;
    T const axes = absolute_sum(view.pose.right) + absolute_sum(view.pose.up) + absolute_sum(view.pose.forward) +
                   absolute_sum(basis.x) + absolute_sum(basis.y) + absolute_sum(basis.depth);
    if (!(axes <= T(12))) return false;  // six unit vectors sum up to less
    bool const flat = view.kind == ViewKind::orthographic;
    T const reach = flat ? farthest + sides : farthest * (T(1) + sides);
    if (!(reach <= most)) return false;
    seen.pose = view.pose;
    seen.slack = T(16) * std::numeric_limits<T>::epsilon() * (reach + absolute_sum(eye));
    T const of_side[4] = {view.left, view.right, view.bottom, view.top};
    for (int i = 0; i < 4; ++i) {
        T const outward = (i & 1) != 0 ? seen.slack : -seen.slack;
        seen.slope[i] = flat ? T(0) : of_side[i];
        // A plane that leans is moved farther along its side than outward.
        seen.offset[i] = flat ? of_side[i] + outward : outward * (T(1) + std::abs(of_side[i]));
    }
    // Nothing of the view is farther from the eye along any axis than twice its reach.
    T const limit = T(2) * reach;
    auto const limited = [limit](T value) { return value < -limit ? -limit : (value > limit ? limit : value); };
    Vec3<T> const lo = scene.lo - eye, hi = scene.hi - eye;
    seen.lo = Vec3<T>(limited(lo.x - seen.slack), limited(lo.y - seen.slack), limited(lo.z - seen.slack));
    seen.hi = Vec3<T>(limited(hi.x + seen.slack), limited(hi.y + seen.slack), limited(hi.z + seen.slack));
    return true;
}

template <class T>
using FourExtents = ExtentInLanes<T>[4];

// A vector along the axes of the light.
template <class T>
[[nodiscard, gnu::always_inline]] inline Vec3<T> turned(LightBasis<T> const& basis, Vec3<T> const& v) noexcept {
    return Vec3<T>(basis.x.x * v.x + basis.x.y * v.y + basis.x.z * v.z,
                   basis.y.x * v.x + basis.y.y * v.y + basis.y.z * v.z,
                   basis.depth.x * v.x + basis.depth.y * v.y + basis.depth.z * v.z);
}

// Edges of the box along one axis, from the four corners of its lower face. `of_u`, `of_v` and `of_axis` are what a
// metre along the other two axes and this one is along the view's (right, up, forward) and along the light's.
template <class T>
[[gnu::always_inline]] inline void bound_box_edges(ViewOfBox<T> const& seen, Lanes<T> const (&begin)[4],
                                                   Lanes<T> const (&end)[4], Vec3<T> const (&in_view)[3],
                                                   Vec3<T> const (&in_light)[3], T low, T high, Lanes<T> const& at_u,
                                                   Lanes<T> const& at_v, FourExtents<T>& extent) noexcept {
    auto const all = [](T value) { return all_four(value); };
    FourVectors<T> const corner = times(at_u, in_view[1]) + times(at_v, in_view[2]) + times(all(low), in_view[0]);
    Vec3<T> const& grow = in_view[0];
    Lanes<T> first = all(T(0)), last = all(high - low);
    auto const keep = [&first, &last](Lanes<T> const& inside, T growth) {
        T const slope = not_zero(growth);
        Lanes<T> const root = inside * all_four(T(-1) / slope);
        if (slope > T(0))
            first = largest(first, root);
        else
            last = least(last, root);
    };
    keep(corner.x - corner.z * all(seen.slope[0]) - all(seen.offset[0]), grow.x - grow.z * seen.slope[0]);
    keep(corner.z * all(seen.slope[1]) + all(seen.offset[1]) - corner.x, grow.z * seen.slope[1] - grow.x);
    keep(corner.y - corner.z * all(seen.slope[2]) - all(seen.offset[2]), grow.y - grow.z * seen.slope[2]);
    keep(corner.z * all(seen.slope[3]) + all(seen.offset[3]) - corner.y, grow.z * seen.slope[3] - grow.y);
    FourVectors<T> const origin = times(at_u, in_light[1]) + times(at_v, in_light[2]) + times(all(low), in_light[0]);
    FourVectors<T> const step = {all(in_light[0].x), all(in_light[0].y), all(in_light[0].z)};
    Lanes<T> const per_depth = all(T(1) / not_zero(grow.z));
    for (int slice = 0; slice < 4; ++slice) {
        Lanes<T> const a = (begin[slice] - corner.z) * per_depth, b = (end[slice] - corner.z) * per_depth;
        extent[slice].add(extent_of(origin, step, largest(first, least(a, b)), least(last, largest(a, b))));
    }
}

// Four slices, from plane[0] to plane[4].
template <class T>
[[gnu::always_inline]] inline void bound_four_slices(ViewOfBox<T> const& seen, LightBasis<T> const& basis,
                                                     T const* plane, FourExtents<T>& extent) noexcept {
    using Lanes = Lanes<T>;
    using Vectors = FourVectors<T>;
    auto const all = [](T value) { return all_four(value); };
    Vec3<T> const &right = seen.pose.right, &up = seen.pose.up, &ahead = seen.pose.forward, &lo = seen.lo,
                  &hi = seen.hi;
    Lanes const slack = all(seen.slack);
    Lanes const planes[5] = {all(plane[0]), all(plane[1]), all(plane[2]), all(plane[3]), all(plane[4])};
    Lanes const begin[4] = {planes[0] - slack, planes[1] - slack, planes[2] - slack, planes[3] - slack};
    Lanes const end[4] = {planes[1] + slack, planes[2] + slack, planes[3] + slack, planes[4] + slack};
    // Corners of the view: (left, bottom), (right, bottom), (right, top), (left, top).
    Lanes const x_slope = Lanes::of(seen.slope[0], seen.slope[1], seen.slope[1], seen.slope[0]);
    Lanes const y_slope = Lanes::of(seen.slope[2], seen.slope[2], seen.slope[3], seen.slope[3]);
    Lanes const x_offset = Lanes::of(seen.offset[0], seen.offset[1], seen.offset[1], seen.offset[0]);
    Lanes const y_offset = Lanes::of(seen.offset[2], seen.offset[2], seen.offset[3], seen.offset[3]);
    Vec3<T> const right_lit = turned(basis, right), up_lit = turned(basis, up), ahead_lit = turned(basis, ahead);
    Vectors const from = times(x_offset, right) + times(y_offset, up);
    Vectors const ray = times(x_slope, right) + times(y_slope, up) + times(all(T(1)), ahead);
    Vectors const from_lit = times(x_offset, right_lit) + times(y_offset, up_lit);
    Vectors const ray_lit = times(x_slope, right_lit) + times(y_slope, up_lit) + times(all(T(1)), ahead_lit);
    {
        Lanes first = begin[0], last = end[3];
        keep_between(lo.x, hi.x, from.x, all(T(1)) / not_zero(ray.x), first, last);
        keep_between(lo.y, hi.y, from.y, all(T(1)) / not_zero(ray.y), first, last);
        keep_between(lo.z, hi.z, from.z, all(T(1)) / not_zero(ray.z), first, last);
        for (int slice = 0; slice < 4; ++slice)
            extent[slice] = extent_of(from_lit, ray_lit, largest(first, begin[slice]), least(last, end[slice]));
    }
    // Sides of the split planes, from corner to corner: right, up, left, down. Planes are where they are: the box that
    // these edges are cut by is larger.
    Lanes const sideways = Lanes::of(T(1), T(0), T(-1), T(0)), upward = Lanes::of(T(0), T(1), T(0), T(-1));
    Vectors const side = times(sideways, right) + times(upward, up),
                  side_lit = times(sideways, right_lit) + times(upward, up_lit);
    Lanes const one = all(T(1));
    Vectors const per_side = {one / not_zero(side.x), one / not_zero(side.y), one / not_zero(side.z)};
    T const wider = seen.slope[1] - seen.slope[0], taller = seen.slope[3] - seen.slope[2];
    T const width = seen.offset[1] - seen.offset[0], height = seen.offset[3] - seen.offset[2];
    Lanes const growth = Lanes::of(wider, taller, wider, taller), length = Lanes::of(width, height, width, height);
    for (int i = 0; i < 5; ++i) {
        Lanes const z = planes[i];
        Lanes first = all(T(0)), last = growth * z + length;
        Vectors const corner = from + ray * z;
        keep_between(lo.x, hi.x, corner.x, per_side.x, first, last);
        keep_between(lo.y, hi.y, corner.y, per_side.y, first, last);
        keep_between(lo.z, hi.z, corner.z, per_side.z, first, last);
        ExtentInLanes<T> const of_plane = extent_of(from_lit + ray_lit * z, side_lit, first, last);
        if (i > 0) extent[i - 1].add(of_plane);
        if (i < 4) extent[i].add(of_plane);
    }
    Vec3<T> const view_x(right.x, up.x, ahead.x), view_y(right.y, up.y, ahead.y), view_z(right.z, up.z, ahead.z);
    Vec3<T> const lit_x(basis.x.x, basis.y.x, basis.depth.x), lit_y(basis.x.y, basis.y.y, basis.depth.y);
    Vec3<T> const lit_z(basis.x.z, basis.y.z, basis.depth.z);
    Lanes const x_as_u = Lanes::of(lo.x, hi.x, lo.x, hi.x), y_as_u = Lanes::of(lo.y, hi.y, lo.y, hi.y);
    Lanes const y_as_v = Lanes::of(lo.y, lo.y, hi.y, hi.y), z_as_v = Lanes::of(lo.z, lo.z, hi.z, hi.z);
    bound_box_edges(seen, begin, end, {view_x, view_y, view_z}, {lit_x, lit_y, lit_z}, lo.x, hi.x, y_as_u, z_as_v,
                    extent);
    bound_box_edges(seen, begin, end, {view_y, view_x, view_z}, {lit_y, lit_x, lit_z}, lo.y, hi.y, x_as_u, z_as_v,
                    extent);
    bound_box_edges(seen, begin, end, {view_z, view_x, view_y}, {lit_z, lit_x, lit_y}, lo.z, hi.z, x_as_u, y_as_v,
                    extent);
}

// The same, with a slice to a lane: light-space boxes, from the world's origin.
template <class T>
struct FourSlices {
    ViewOfBox<T> const& seen;
    LightBasis<T> const& basis;
    T const* plane;
    FourVectors<T>& lo;
    FourVectors<T>& hi;

    [[gnu::always_inline]] static Lanes<T> least_of(Lanes<T> a, Lanes<T> b, Lanes<T> c, Lanes<T> d) noexcept {
        Lanes<T> rows[4] = {a, b, c, d};
        transpose(rows);
        return least(least(rows[0], rows[1]), least(rows[2], rows[3]));
    }
    [[gnu::always_inline]] static Lanes<T> largest_of(Lanes<T> a, Lanes<T> b, Lanes<T> c, Lanes<T> d) noexcept {
        Lanes<T> rows[4] = {a, b, c, d};
        transpose(rows);
        return largest(largest(rows[0], rows[1]), largest(rows[2], rows[3]));
    }
    [[gnu::always_inline]] void operator()() const noexcept {
        FourExtents<T> of;
        bound_four_slices(seen, basis, plane, of);
        Vec3<T> const eye = turned(basis, seen.pose.position);
        T const slack = seen.slack;
        // Where there is nothing, these are numbers that no eye and no slack can move.
        lo.x = least_of(of[0].lo.x, of[1].lo.x, of[2].lo.x, of[3].lo.x) + all_four(eye.x - slack);
        lo.y = least_of(of[0].lo.y, of[1].lo.y, of[2].lo.y, of[3].lo.y) + all_four(eye.y - slack);
        lo.z = least_of(of[0].lo.z, of[1].lo.z, of[2].lo.z, of[3].lo.z) + all_four(eye.z - slack);
        hi.x = largest_of(of[0].hi.x, of[1].hi.x, of[2].hi.x, of[3].hi.x) + all_four(eye.x + slack);
        hi.y = largest_of(of[0].hi.y, of[1].hi.y, of[2].hi.y, of[3].hi.y) + all_four(eye.y + slack);
        hi.z = largest_of(of[0].hi.z, of[1].hi.z, of[2].hi.z, of[3].hi.z) + all_four(eye.z + slack);
    }
};

// Calls visit(first, count, lo, hi) for up to four slices at a time; false, and never, where nothing can be seen.
template <class T, class Visit>
[[gnu::always_inline]] inline bool visit_slices_in_scene(ViewVolume<T> const& view, LightBasis<T> const& basis,
                                                         Splits<T> const& splits, Aabb<T> const& scene,
                                                         Visit const& visit) noexcept {
    ViewInLight<T> checked;
    ViewOfBox<T> seen;
    if (!look(basis, view, checked) || !in_range(splits) ||
        !look_at_box(view, basis, splits.plane[splits.count], scene, seen))
        return false;
    for (int first = 0; first < splits.count; first += 4) {
        int const left = splits.count - first < 4 ? splits.count - first : 4;
        T const* plane = splits.plane + first;
        T padded[5];
        if (left < 4) {
            for (int i = 0; i < 5; ++i) padded[i] = plane[i < left ? i : left];
            plane = padded;
        }
        FourVectors<T> lo, hi;
        run_widely(FourSlices<T>{seen, basis, plane, lo, hi});
        visit(first, left, lo, hi);
    }
    return true;
}

}  // namespace detail

// in_light[i]: the box along the axes of the light (x, y, depth; metres from the world's origin) around what slice i
// sees of the scene; empty where that is nothing. Every point of both is inside, and none of it is farther out than
// what 256 epsilon of the view's reach and of its place, in metres, may add to slice and scene. Writes splits.count
// boxes, all empty where a number is not finite, a side is crossed or something lies beyond 1e12 m.
template <class T>
inline void bound_slices(ViewVolume<T> const& view, LightBasis<T> const& basis, Splits<T> const& splits,
                         Aabb<T> const& scene, Aabb<T>* in_light) noexcept {
    bool const seen =
        detail::visit_slices_in_scene(view, basis, splits, scene, [&](int first, int count, auto& lo, auto& hi) {
            for (int i = 0; i < count; ++i)
                in_light[first + i] = {Vec3<T>(lo.x[i], lo.y[i], lo.z[i]), Vec3<T>(hi.x[i], hi.y[i], hi.z[i])};
        });
    for (int i = 0; i < splits.count && !seen; ++i) in_light[i] = {};
}

// As fit_slice_boxes, for what each slice sees of the scene. Bit i of the result: slice i sees some of it; nowhere()
// where not. All of it is inside, up to `border`.
template <class T>
[[nodiscard]] inline std::uint32_t fit_slice_focus(ViewVolume<T> const& view, LightBasis<T> const& basis,
                                                   Splits<T> const& splits, Aabb<T> const& scene, T border,
                                                   ClipSpace clip, Mat4<T>* clip_from_world) noexcept {
    using Lanes = detail::Lanes<T>;
    bool const free =
        detail::order_of(border) >= detail::order_of(T(0)) && detail::order_of(border) <= detail::order_of(T(0.49));
    detail::MapInLanes<T> const map = detail::map_in_lanes(clip, free ? T(2) - T(4) * border : T(2));
    detail::ViewInLight<T> columns;
    columns.x = Lanes::of(basis.x.x, basis.y.x, basis.depth.x, T(0));
    columns.y = Lanes::of(basis.x.y, basis.y.y, basis.depth.y, T(0));
    columns.z = Lanes::of(basis.x.z, basis.y.z, basis.depth.z, T(0));
    std::uint32_t visible = 0;
    auto const write = [&](int first, int count, auto& lo, auto& hi) {
        auto const one = detail::all_four(T(1)), half = detail::all_four(T(0.5));
        Lanes scale[4] = {detail::all_four(map.extent[0]) / (hi.x - lo.x),
                          detail::all_four(map.extent[1]) / (hi.y - lo.y),
                          detail::all_four(map.extent[2]) / (hi.z - lo.z), one - one};
        Lanes moved[4] = {detail::all_four(map.middle[0]) - (lo.x + hi.x) * half * scale[0],
                          detail::all_four(map.middle[1]) - (lo.y + hi.y) * half * scale[1],
                          detail::all_four(map.middle[2]) - (lo.z + hi.z) * half * scale[2], one};
        detail::transpose(scale);
        detail::transpose(moved);
        for (int i = 0; i < count; ++i) {
            if (!(lo.x[i] <= hi.x[i] && lo.y[i] <= hi.y[i] && lo.z[i] <= hi.z[i])) {
                clip_from_world[first + i] = nowhere<T>();
                continue;
            }
            detail::write_columns(columns, scale[i], moved[i], clip_from_world[first + i]);
            visible |= 1u << (first + i);
        }
    };
    if (free && detail::visit_slices_in_scene(view, basis, splits, scene, write)) return visible;
    for (int i = 0; i < splits.count; ++i) clip_from_world[i] = nowhere<T>();
    return 0;
}

}  // namespace v0
}  // namespace shadowmath
