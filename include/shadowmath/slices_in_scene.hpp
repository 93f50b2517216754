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
#include <shadowmath/long_lanes.hpp>
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

// Several vectors at a time.
template <class L>
struct Vectors {
    L x, y, z;

    [[gnu::always_inline]] friend Vectors operator+(Vectors const& a, Vectors const& b) noexcept {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    [[gnu::always_inline]] friend Vectors operator*(Vectors const& a, L const& s) noexcept {
        return {a.x * s, a.y * s, a.z * s};
    }
    [[gnu::always_inline]] friend Vectors least(Vectors const& a, Vectors const& b) noexcept {
        return {least(a.x, b.x), least(a.y, b.y), least(a.z, b.z)};
    }
    [[gnu::always_inline]] friend Vectors largest(Vectors const& a, Vectors const& b) noexcept {
        return {largest(a.x, b.x), largest(a.y, b.y), largest(a.z, b.z)};
    }
};

template <class T>
using FourVectors = Vectors<Lanes<T>>;
template <class T>
using LongVectors = Vectors<LongLanes<T>>;

// Multiples of one vector.
template <class L, class T>
[[nodiscard, gnu::always_inline]] inline Vectors<L> times(L const& s, Vec3<T> const& v) noexcept {
    return {s * L::all(v.x), s * L::all(v.y), s * L::all(v.z)};
}

template <class T>
[[nodiscard, gnu::always_inline]] inline LongVectors<T> repeated(FourVectors<T> const& v) noexcept {
    using Long = LongLanes<T>;
    return {repeated<Long>(v.x), repeated<Long>(v.y), repeated<Long>(v.z)};
}

// Least and largest light-space coordinates of edges.
template <class L>
struct ExtentInLanes {
    Vectors<L> lo;
    Vectors<L> hi;

    [[gnu::always_inline]] void add(ExtentInLanes const& other) noexcept {
        lo = least(lo, other.lo);
        hi = largest(hi, other.hi);
    }
};

// Half a step along edges, and how long that is along each axis.
template <class L>
struct HalfStep {
    Vectors<L> step;
    Vectors<L> size;
};

// NOTE: no size is zero: an edge that is none must be seen on every axis.
template <class L>
[[nodiscard, gnu::always_inline]] inline HalfStep<L> half_of(Vectors<L> const& step) noexcept {
    Vectors<L> const half = step * L::all(0.5f);
    L const none = L::all(0), tiny = L::all(1e-12f);
    auto const size = [&](L const& a) { return largest(a, none - a) + tiny; };
    return {half, {size(half.x), size(half.y), size(half.z)}};
}

// What edges, from `origin` on, reach between a and b: around their middle, by half their length. Where a > b an edge
// is none, and its extent is inside out by more than anything can be long.
template <class L>
[[nodiscard, gnu::always_inline]] inline ExtentInLanes<L> extent_of(Vectors<L> const& origin, HalfStep<L> const& half,
                                                                    L const& a, L const& b) noexcept {
    Vectors<L> const middle = origin + half.step * (a + b);
    L const length = where_at_most(a, b, b - a, L::all(-1e37f));
    Vectors<L> const reach = half.size * length;
    return {{middle.x - reach.x, middle.y - reach.y, middle.z - reach.z}, middle + reach};
}

// Metres along edges at which they enter and leave the box between two of its faces, for edges whose origin lies
// `shift` farther along.
template <class L>
struct Passage {
    L enter, leave;

    [[gnu::always_inline]] void cut(L const& shift, L& first, L& last) const noexcept {
        first = largest(first, enter - shift);
        last = least(last, leave - shift);
    }
};

// Edges from `from` on; `inverse`: metres along them for one across.
// NOTE: products before differences: one difference serves all that are parallel, and is as near as that of rounded
// places can be.
template <class L>
[[nodiscard, gnu::always_inline]] inline Passage<L> passage(L const& lo, L const& hi, L const& from,
                                                           L const& inverse) noexcept {
    L const a = lo * inverse, b = hi * inverse, shift = from * inverse;
    return {least(a, b) - shift, largest(a, b) - shift};
}

// Nothing is divided by less than this; what it stands for is the same to far less than a rounding.
template <class L>
[[nodiscard, gnu::always_inline]] inline L not_zero(L const& value) noexcept {
    L const tiny = L::all(1e-20f);
    return where_at_most(tiny, largest(value, L::all(0) - value), value, tiny);
}

// A view with what it sees of a box, relative to the eye, every plane `slack` metres farther out. Side `i` of the view
// at depth z is at `slope[i] * z + offset[i]`; left, right, bottom, top.
template <class T>
struct ViewOfBox {
    Pose<T> const& pose;
    ViewInLight<T> lit;
    Lanes<T> slope;
    Lanes<T> offset;
    Lanes<T> lo;  // x, y, z
    Lanes<T> hi;
    T slack;
};

// False where the numbers are none that products of three can be made of, or nothing is there. After look(), which has
// seen that the view is finite and filled in `lit`.
template <class T>
[[nodiscard, gnu::always_inline]] inline bool look_at_box(ViewVolume<T> const& view, T farthest, Aabb<T> const& scene,
                                                          ViewOfBox<T>& seen) noexcept {
    using Lanes = Lanes<T>;
    constexpr T most = T(1e12);
    Vec3<T> const& eye = view.pose.position;
    T const x = std::abs(eye.x), y = std::abs(eye.y), z = std::abs(eye.z), sides = seen.lit.sides;
    bool const flat = view.kind == ViewKind::orthographic;
    T const reach = flat ? farthest + sides : farthest * (T(1) + sides);
    if (!((x <= most) & (y <= most) & (z <= most) & (sides <= most) & (reach <= most))) return false;
    BeyondReach<T> infinite;
    Lanes lo, hi;
    if constexpr (sizeof scene == 6 * sizeof(T)) {
        lo = four_at(&scene.lo.x);
        hi = moved_up(four_at(&scene.lo.z), T(0));
    } else {
        lo = Lanes::of(scene.lo.x, scene.lo.y, scene.lo.z, T(0));
        hi = Lanes::of(scene.hi.x, scene.hi.y, scene.hi.z, T(0));
    }
    infinite.look_for_finite(lo);
    infinite.look_for_finite(hi);
    if (infinite.any() || is_empty(scene)) return false;
    auto const size_of = [](Vec3<T> const& v) { return absolute(Lanes::of(v.x, v.y, v.z, T(0))); };
    Lanes const axes = size_of(view.pose.right) + size_of(view.pose.up) + size_of(view.pose.forward) +
                       (absolute(seen.lit.x) + absolute(seen.lit.y) + absolute(seen.lit.z));
    if (!(axes[0] + axes[1] + axes[2] <= T(12))) return false;  // six unit vectors sum up to less
    seen.slack = T(16) * std::numeric_limits<T>::epsilon() * (reach + (x + y + z));
    Lanes const of_side = four_at(&view.left), slack = all_four(seen.slack);
    Lanes const outward = Lanes::of(-seen.slack, seen.slack, -seen.slack, seen.slack);
    if (flat) {
        seen.slope = all_four(T(0));
        seen.offset = of_side + outward;
    } else {
        seen.slope = of_side;
        // A plane that leans is moved farther along its side than outward.
        seen.offset = outward * (all_four(T(1)) + absolute(of_side));
    }
    // Nothing of the view is farther from the eye along any axis than twice its reach.
    T const limit = T(2) * reach;
    auto const limited = [limit](Lanes const& at) { return largest(least(at, all_four(limit)), all_four(-limit)); };
    Lanes const at_eye = Lanes::of(eye.x, eye.y, eye.z, T(0));
    seen.lo = limited(lo - at_eye - slack);
    seen.hi = limited(hi - at_eye + slack);
    return true;
}

// The twelve edges of the box, four to an axis, from its lower face on; and four more that mean nothing. An edge is
// inside the sides of the view from `first` to `last` metres behind its origin. (x, y, z): origin in light space;
// ahead: metres along the edge that its depth in the view amounts to.
template <class T>
struct EdgesOfBox {
    T first[16], last[16], ahead[16], x[16], y[16], z[16];
    Lanes<T> per_ahead;  // of each axis: metres along it for one of depth
};

// Where an axis has its four edges: at the lower (0) or the upper (1) end of the others.
template <class T>
inline constexpr T edge_at[3][16] = {{0, 0, 0, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0},
                                     {0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0},
                                     {0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0}};

template <int i>
struct Place {
    static constexpr int value = i;
};

// Lane i everywhere.
template <int i, class T>
[[nodiscard, gnu::always_inline]] inline Lanes<T> all_of(Lanes<T> const& four) noexcept {
    return picked<i, i, i, i>(four);
}
template <int i, class T>
[[nodiscard, gnu::always_inline]] inline LongLanes<T> long_of(Lanes<T> const& four) noexcept {
    return repeated<LongLanes<T>>(all_of<i>(four));
}

template <class T>
[[gnu::always_inline]] inline void cut_box_edges(ViewOfBox<T> const& seen, EdgesOfBox<T>& edges) noexcept {
    using Long = LongLanes<T>;
    using Lanes = Lanes<T>;
    auto const four = [](Vec3<T> const& v) { return Lanes::of(v.x, v.y, v.z, T(0)); };
    // By how much each axis goes inward through each side, metres a metre.
    Lanes const right = four(seen.pose.right), up = four(seen.pose.up), ahead = four(seen.pose.forward);
    Lanes const inward[4] = {right - ahead * all_of<0>(seen.slope), ahead * all_of<1>(seen.slope) - right,
                             up - ahead * all_of<2>(seen.slope), ahead * all_of<3>(seen.slope) - up};
    // An edge enters where it goes inward, and leaves where not: what it does not do is moved out of the way.
    constexpr T away = T(1e36);
    Lanes inverse[4], not_entered[4], not_left[4];
    for (int i = 0; i < 4; ++i) {
        Lanes const in = not_zero(inward[i]);
        inverse[i] = all_four(T(-1)) / in;
        not_entered[i] = where_at_most(in, all_four(T(0)), all_four(-away), all_four(T(0)));
        not_left[i] = not_entered[i] + all_four(away);
    }
    Lanes const length = seen.hi - seen.lo;
    Long const lo_x = long_of<0>(seen.lo), lo_y = long_of<1>(seen.lo), lo_z = long_of<2>(seen.lo);
    Long const hi_x = long_of<0>(seen.hi), hi_y = long_of<1>(seen.hi), hi_z = long_of<2>(seen.hi);
    edges.per_ahead = all_four(T(1)) / not_zero(ahead);
    for (int axis = 0; axis < 3; axis += Long::fours) {
        auto const end = [&](int i, Long const& lo, Long const& hi) {
            return where_at_most(long_at<Long>(edge_at<T>[i] + 4 * axis), Long::all(T(0)), lo, hi);
        };
        Long const x = end(0, lo_x, hi_x), y = end(1, lo_y, hi_y), z = end(2, lo_z, hi_z);
        auto const along = [&](Lanes const& v) { return x * long_of<0>(v) + y * long_of<1>(v) + z * long_of<2>(v); };
        Long const inside[4] = {along(inward[0]) - long_of<0>(seen.offset), along(inward[1]) + long_of<1>(seen.offset),
                                along(inward[2]) - long_of<2>(seen.offset), along(inward[3]) + long_of<3>(seen.offset)};
        Long first = Long::all(T(0)), last = spread<Long>(length, axis);
        for (int i = 0; i < 4; ++i) {
            Long const root = inside[i] * spread<Long>(inverse[i], axis);
            first = largest(first, root + spread<Long>(not_entered[i], axis));
            last = least(last, root + spread<Long>(not_left[i], axis));
        }
        auto const store = [axis](T* to, Long const& lanes) { std::memcpy(to + 4 * axis, &lanes, sizeof lanes); };
        auto const lit = [&](auto place) {
            constexpr int i = decltype(place)::value;
            return x * long_of<i>(seen.lit.x) + y * long_of<i>(seen.lit.y) + z * long_of<i>(seen.lit.z);
        };
        store(edges.first, first);
        store(edges.last, last);
        store(edges.ahead, along(ahead) * spread<Long>(edges.per_ahead, axis));
        store(edges.x, lit(Place<0>()));
        store(edges.y, lit(Place<1>()));
        store(edges.z, lit(Place<2>()));
    }
}

// Least and largest coordinates of four edges in each of four slices.
template <class T>
struct ExtentsOfSlices {
    T lo[3][16], hi[3][16];
};

// Four slices, from plane[0] to plane[4].
template <class T>
[[gnu::always_inline]] inline void bound_four_slices(ViewOfBox<T> const& seen, T const* plane,
                                                     ExtentsOfSlices<T>& of) noexcept {
    using Lanes = Lanes<T>;
    using Long = LongLanes<T>;
    auto const all = [](T value) { return all_four(value); };
    Vec3<T> const &right = seen.pose.right, &up = seen.pose.up, &ahead = seen.pose.forward;
    EdgesOfBox<T> edges;
    cut_box_edges(seen, edges);
    // NOTE: one by one, as they have mostly just been written.
    Lanes const n = Lanes::of(plane[0], plane[1], plane[2], plane[3]), f = moved_up(n, plane[4]);
    Lanes const begins = n - all(seen.slack), ends = f + all(seen.slack);
    // Corners of the view: (left, bottom), (right, bottom), (right, top), (left, top).
    Lanes const x_slope = picked<0, 1, 1, 0>(seen.slope), y_slope = picked<2, 2, 3, 3>(seen.slope);
    Lanes const x_offset = picked<0, 1, 1, 0>(seen.offset), y_offset = picked<2, 2, 3, 3>(seen.offset);
    auto const lit = [](Lanes const& v) { return FourVectors<T>{all_of<0>(v), all_of<1>(v), all_of<2>(v)}; };
    FourVectors<T> const right_lit = lit(seen.lit.right), up_lit = lit(seen.lit.up);
    FourVectors<T> const from = times(x_offset, right) + times(y_offset, up);
    FourVectors<T> const ray = times(x_slope, right) + times(y_slope, up) + times(all(T(1)), ahead);
    LongVectors<T> const from_lit = repeated<T>(right_lit * x_offset + up_lit * y_offset);
    LongVectors<T> const ray_lit = repeated<T>(right_lit * x_slope + up_lit * y_slope + lit(seen.lit.forward));
    Lanes const lo_x = all_of<0>(seen.lo), lo_y = all_of<1>(seen.lo), lo_z = all_of<2>(seen.lo);
    Lanes const hi_x = all_of<0>(seen.hi), hi_y = all_of<1>(seen.hi), hi_z = all_of<2>(seen.hi);
    Lanes const one = all(T(1));
    auto const along_ray_x = passage(lo_x, hi_x, from.x, one / not_zero(ray.x));
    auto const along_ray_y = passage(lo_y, hi_y, from.y, one / not_zero(ray.y));
    auto const along_ray_z = passage(lo_z, hi_z, from.z, one / not_zero(ray.z));
    Lanes const first_of_ray = largest(along_ray_x.enter, largest(along_ray_y.enter, along_ray_z.enter));
    Lanes const last_of_ray = least(along_ray_x.leave, least(along_ray_y.leave, along_ray_z.leave));
    // Sides of the split planes, from corner to corner: right, up, left, down. Planes are where they are: the box that
    // these edges are cut by is larger.
    Lanes const sideways = Lanes::of(T(1), T(0), T(-1), T(0)), upward = Lanes::of(T(0), T(1), T(0), T(-1));
    FourVectors<T> const side = times(sideways, right) + times(upward, up);
    HalfStep<Long> const along_side = half_of(repeated<T>(right_lit * sideways + up_lit * upward));
    HalfStep<Long> const along_ray = half_of(ray_lit);
    Lanes const per_x = one / not_zero(side.x), per_y = one / not_zero(side.y), per_z = one / not_zero(side.z);
    auto const long_passage = [](Passage<Lanes> const& p) {
        return Passage<Long>{repeated<Long>(p.enter), repeated<Long>(p.leave)};
    };
    Passage<Long> const across_x = long_passage(passage(lo_x, hi_x, from.x, per_x));
    Passage<Long> const across_y = long_passage(passage(lo_y, hi_y, from.y, per_y));
    Passage<Long> const across_z = long_passage(passage(lo_z, hi_z, from.z, per_z));
    // How far the origins move along the sides with every metre of depth.
    LongVectors<T> const shift = repeated<T>(FourVectors<T>{ray.x * per_x, ray.y * per_y, ray.z * per_z});
    auto const across = [](Lanes const& side) { return picked<1, 3, 1, 3>(side) - picked<0, 2, 0, 2>(side); };
    Long const growth = repeated<Long>(across(seen.slope)), length = repeated<Long>(across(seen.offset));
    auto const of_sides = [&](Long const& z) {
        Long first = Long::all(T(0)), last = growth * z + length;
        across_x.cut(shift.x * z, first, last);
        across_y.cut(shift.y * z, first, last);
        across_z.cut(shift.z * z, first, last);
        return extent_of(from_lit + ray_lit * z, along_side, first, last);
    };
    Long const first_long = repeated<Long>(first_of_ray), last_long = repeated<Long>(last_of_ray);
    auto const along_axis = [](Lanes const& in_light) {
        return half_of(LongVectors<T>{long_of<0>(in_light), long_of<1>(in_light), long_of<2>(in_light)});
    };
    HalfStep<Long> const along[3] = {along_axis(seen.lit.x), along_axis(seen.lit.y), along_axis(seen.lit.z)};
    // Where the slices begin and end along the edges of each axis, had these no depth of their own.
    Lanes enter[3], leave[3];
    for (int axis = 0; axis < 3; ++axis) {
        Lanes const per_ahead = all(edges.per_ahead[axis]), a = begins * per_ahead, b = ends * per_ahead;
        enter[axis] = least(a, b);
        leave[axis] = largest(a, b);
    }
    ExtentInLanes<Long> far_sides;
    for (int i = 0; i < 4; i += Long::fours) {
        // The far plane of one slice is the near plane of the next.
        ExtentInLanes<Long> extent = far_sides;
        if (i == 0 || Long::fours > 1) extent = of_sides(spread<Long>(n, i));
        far_sides = of_sides(spread<Long>(f, i));
        extent.add(far_sides);
        Long const begin = spread<Long>(begins, i), end = spread<Long>(ends, i);
        extent.add(extent_of(from_lit, along_ray, largest(first_long, begin), least(last_long, end)));
        for (int axis = 0; axis < 3; ++axis) {
            auto const at = [axis](T const* edge) { return repeated<Long>(four_at(edge + 4 * axis)); };
            Long const ahead = at(edges.ahead);
            Long const a = largest(at(edges.first), spread<Long>(enter[axis], i) - ahead);
            Long const b = least(at(edges.last), spread<Long>(leave[axis], i) - ahead);
            LongVectors<T> const origin = {at(edges.x), at(edges.y), at(edges.z)};
            extent.add(extent_of(origin, along[axis], a, b));
        }
        auto const store = [i](T* to, Long const& lanes) { std::memcpy(to + 4 * i, &lanes, sizeof lanes); };
        store(of.lo[0], extent.lo.x);
        store(of.lo[1], extent.lo.y);
        store(of.lo[2], extent.lo.z);
        store(of.hi[0], extent.hi.x);
        store(of.hi[1], extent.hi.y);
        store(of.hi[2], extent.hi.z);
    }
}

// The same, with a slice to a lane: light-space boxes, from the world's origin.
template <class T>
struct FourSlices {
    ViewOfBox<T> const& seen;
    T const* plane;
    FourVectors<T>& lo;
    FourVectors<T>& hi;

    [[gnu::always_inline]] static Lanes<T> least_of(T const (&edges)[16]) noexcept {
        Lanes<T> rows[4] = {four_at(edges), four_at(edges + 4), four_at(edges + 8), four_at(edges + 12)};
        transpose(rows);
        return least(least(rows[0], rows[1]), least(rows[2], rows[3]));
    }
    [[gnu::always_inline]] static Lanes<T> largest_of(T const (&edges)[16]) noexcept {
        Lanes<T> rows[4] = {four_at(edges), four_at(edges + 4), four_at(edges + 8), four_at(edges + 12)};
        transpose(rows);
        return largest(largest(rows[0], rows[1]), largest(rows[2], rows[3]));
    }
    [[gnu::always_inline]] void operator()() const noexcept {
        ExtentsOfSlices<T> of;
        bound_four_slices(seen, plane, of);
        // Where there is nothing, these are numbers that no eye and no slack can move.
        Lanes<T> const least_eye = seen.lit.eye - all_four(seen.slack), most_eye = seen.lit.eye + all_four(seen.slack);
        lo.x = least_of(of.lo[0]) + all_of<0>(least_eye);
        lo.y = least_of(of.lo[1]) + all_of<1>(least_eye);
        lo.z = least_of(of.lo[2]) + all_of<2>(least_eye);
        hi.x = largest_of(of.hi[0]) + all_of<0>(most_eye);
        hi.y = largest_of(of.hi[1]) + all_of<1>(most_eye);
        hi.z = largest_of(of.hi[2]) + all_of<2>(most_eye);
    }
};

// Calls visit(first, count, lo, hi) for up to four slices at a time; false, and never, where nothing can be seen.
template <class T, class Visit>
[[gnu::always_inline]] inline bool visit_slices_in_scene(ViewVolume<T> const& view, LightBasis<T> const& basis,
                                                         Splits<T> const& splits, Aabb<T> const& scene,
                                                         Visit const& visit) noexcept {
    ViewOfBox<T> seen{view.pose, {}, {}, {}, {}, {}, T(0)};
    if (!look(basis, view, seen.lit) || !in_range(splits) ||
        !look_at_box(view, splits.plane[splits.count], scene, seen))
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
        run_widely(FourSlices<T>{seen, plane, lo, hi});
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
            if (!(lo.x[i] <= hi.x[i])) {  // nothing is nothing on every axis
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
