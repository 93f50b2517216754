// SPDX-License-Identifier: MIT
//
// The edges of a view's slices and of a box in it, cut and bounded in light space: the inside of slices_in_scene.hpp.
// What the box comes to by itself is made by view_of_box.hpp.
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

#include <shadowmath/config.hpp>
#include <shadowmath/lanes.hpp>
#include <shadowmath/long_lanes.hpp>
#include <shadowmath/view_of_box.hpp>

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
template <class T>
[[nodiscard, gnu::always_inline]] inline HalfStep<LongLanes<T>> half_of(FourVectors<T> const& step) noexcept {
    Lanes<T> const half = all_four(T(0.5)), tiny = all_four(T(1e-18));
    FourVectors<T> const halved = step * half;
    auto const size = [&tiny](Lanes<T> const& a) { return absolute(a) + tiny; };
    return {repeated<T>(halved), repeated<T>(FourVectors<T>{size(halved.x), size(halved.y), size(halved.z)})};
}

// Edges from `origin` on, cut: what is left of them is from `first` to `last` steps along. Where first > last an edge
// is none.
template <class L>
struct CutEdges {
    Vectors<L> origin;
    HalfStep<L> const& half;
    L first, last;

    [[nodiscard, gnu::always_inline]] Vectors<L> middle() const noexcept { return origin + half.step * (first + last); }
    // Steps; of one that is none, less than nothing by more than anything can be long.
    [[nodiscard, gnu::always_inline]] L length() const noexcept {
        return where_at_most(first, last, last - first, L::all(typename L::Scalar(-1e37)));
    }
};

// What edges reach: around their middle, by half their length; inside out where an edge is none.
template <class L>
[[nodiscard, gnu::always_inline]] inline ExtentInLanes<L> extent_of(CutEdges<L> const& edges) noexcept {
    Vectors<L> const middle = edges.middle(), reach = edges.half.size * edges.length();
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

// Least and largest coordinates of four edges in each of four slices.
template <class T>
struct ExtentsOfSlices {
    T lo[3][16], hi[3][16];

    // Of slices from i on.
    template <class Long>
    [[gnu::always_inline]] void store(int i, ExtentInLanes<Long> const& extent) noexcept {
        store_long(lo[0] + 4 * i, extent.lo.x), store_long(lo[1] + 4 * i, extent.lo.y);
        store_long(lo[2] + 4 * i, extent.lo.z), store_long(hi[0] + 4 * i, extent.hi.x);
        store_long(hi[1] + 4 * i, extent.hi.y), store_long(hi[2] + 4 * i, extent.hi.z);
    }
};

// All edges of four slices and the box.
template <class T>
struct EdgesInLight {
    using Four = Lanes<T>;
    using Long = LongLanes<T>;

    Four nearest, farthest;  // planes of each slice
    Four begins, ends;       // and a little farther apart
    EdgesOfBox<T> of_box;
    HalfStep<Long> along[3];  // its axes
    Four enter[3], leave[3];  // where the slices begin and end along them, had their edges no depth of their own
    // Corners of the view: (left, bottom), (right, bottom), (right, top), (left, top). Rays through them from depth 0.
    LongVectors<T> from, ray;
    HalfStep<Long> along_ray;
    Long first_of_ray, last_of_ray;
    // Sides of a split plane, from corner to corner: right, up, left, down; `length` metres at depth 0, `growth` more
    // for every metre of depth, and their origins `shift` farther along them.
    HalfStep<Long> along_side;
    Passage<Long> side_in_x, side_in_y, side_in_z;
    LongVectors<T> shift;
    Long growth, length;

    [[gnu::always_inline]] EdgesInLight(ViewOfBox<T> const& seen, Four const& begin, Four const& end) noexcept
        : nearest(begin), farthest(end) {
        auto const all = [](T value) { return all_four(value); };
        auto const lit = [](Four const& v) { return FourVectors<T>{all_of<0>(v), all_of<1>(v), all_of<2>(v)}; };
        Vec3<T> const &right = seen.pose->right, &up = seen.pose->up, &ahead = seen.pose->forward;
        begins = nearest - all(seen.slack), ends = farthest + all(seen.slack);
        cut_box_edges(seen, of_box);
        along[0] = half_of<T>(lit(seen.lit.x)), along[1] = half_of<T>(lit(seen.lit.y));
        along[2] = half_of<T>(lit(seen.lit.z));
        for (int axis = 0; axis < 3; ++axis) {
            Four const per_ahead = all(of_box.per_ahead[axis]), a = begins * per_ahead, b = ends * per_ahead;
            enter[axis] = least(a, b), leave[axis] = largest(a, b);
        }
        Four const x_slope = picked<0, 1, 1, 0>(seen.slope), y_slope = picked<2, 2, 3, 3>(seen.slope);
        Four const x_offset = picked<0, 1, 1, 0>(seen.offset), y_offset = picked<2, 2, 3, 3>(seen.offset);
        FourVectors<T> const right_lit = lit(seen.lit.right), up_lit = lit(seen.lit.up);
        FourVectors<T> const corner = times(x_offset, right) + times(y_offset, up);
        FourVectors<T> const outward = times(x_slope, right) + times(y_slope, up) + times(all(T(1)), ahead);
        FourVectors<T> const outward_lit = right_lit * x_slope + up_lit * y_slope + lit(seen.lit.forward);
        from = repeated<T>(right_lit * x_offset + up_lit * y_offset), ray = repeated<T>(outward_lit);
        along_ray = half_of<T>(outward_lit);
        FourVectors<T> const lo = lit(seen.lo), hi = lit(seen.hi);
        Four const one = all(T(1));
        Passage<Four> const x = passage(lo.x, hi.x, corner.x, one / not_zero(outward.x));
        Passage<Four> const y = passage(lo.y, hi.y, corner.y, one / not_zero(outward.y));
        Passage<Four> const z = passage(lo.z, hi.z, corner.z, one / not_zero(outward.z));
        first_of_ray = repeated<Long>(largest(x.enter, largest(y.enter, z.enter)));
        last_of_ray = repeated<Long>(least(x.leave, least(y.leave, z.leave)));
        Four const sideways = Four::of(T(1), T(0), T(-1), T(0)), upward = Four::of(T(0), T(1), T(0), T(-1));
        FourVectors<T> const side = times(sideways, right) + times(upward, up);
        along_side = half_of<T>(right_lit * sideways + up_lit * upward);
        Four const per_x = one / not_zero(side.x), per_y = one / not_zero(side.y), per_z = one / not_zero(side.z);
        auto const sides = [](Passage<Four> const& p) {
            return Passage<Long>{repeated<Long>(p.enter), repeated<Long>(p.leave)};
        };
        side_in_x = sides(passage(lo.x, hi.x, corner.x, per_x)),
        side_in_y = sides(passage(lo.y, hi.y, corner.y, per_y));
        side_in_z = sides(passage(lo.z, hi.z, corner.z, per_z));
        shift = repeated<T>(FourVectors<T>{outward.x * per_x, outward.y * per_y, outward.z * per_z});
        auto const apart = [](Four const& of) { return picked<1, 3, 1, 3>(of) - picked<0, 2, 0, 2>(of); };
        growth = repeated<Long>(apart(seen.slope)), length = repeated<Long>(apart(seen.offset));
    }

    // Planes are where they are: the box that their sides are cut by is larger.
    [[nodiscard, gnu::always_inline]] CutEdges<Long> sides_at(Long const& depth) const noexcept {
        Long first = Long::all(T(0)), last = growth * depth + length;
        side_in_x.cut(shift.x * depth, first, last);
        side_in_y.cut(shift.y * depth, first, last);
        side_in_z.cut(shift.z * depth, first, last);
        return {from + ray * depth, along_side, first, last};
    }
    // Those of slices from i on; their steps are metres of depth.
    [[nodiscard, gnu::always_inline]] CutEdges<Long> rays_in(int i) const noexcept {
        return {from, along_ray, largest(first_of_ray, spread<Long>(begins, i)),
                least(last_of_ray, spread<Long>(ends, i))};
    }
    [[nodiscard, gnu::always_inline]] CutEdges<Long> box_edges_in(int i, int axis) const noexcept {
        auto const at = [axis](T const* edge) { return repeated<Long>(four_at(edge + 4 * axis)); };
        Long const ahead = at(of_box.ahead);
        Long const first = largest(at(of_box.first), spread<Long>(enter[axis], i) - ahead);
        Long const last = least(at(of_box.last), spread<Long>(leave[axis], i) - ahead);
        return {{at(of_box.x), at(of_box.y), at(of_box.z)}, along[axis], first, last};
    }

    // For slices from i on; the far plane of one is the near plane of the next.
    [[gnu::always_inline]] void bound(int i, ExtentInLanes<Long>& sides, ExtentsOfSlices<T>& of) const noexcept {
        ExtentInLanes<Long> extent = sides;
        if (Long::fours > 1) extent = extent_of(sides_at(spread<Long>(nearest, i)));
        sides = extent_of(sides_at(spread<Long>(farthest, i)));
        extent.add(sides);
        extent.add(extent_of(rays_in(i)));
        extent.add(extent_of(box_edges_in(i, 0)));
        extent.add(extent_of(box_edges_in(i, 1)));
        extent.add(extent_of(box_edges_in(i, 2)));
        of.store(i, extent);
    }
};

// For each slice, what is left of its four edges.
template <class T, class Fold>
[[nodiscard, gnu::always_inline]] inline Lanes<T> folded(T const (&edges)[16], Fold const& fold) noexcept {
    Lanes<T> const a = four_at(edges), b = four_at(edges + 4), c = four_at(edges + 8), d = four_at(edges + 12);
    Lanes<T> const of_ab = fold(picked<0, 4, 1, 5>(a, b), picked<2, 6, 3, 7>(a, b));
    Lanes<T> const of_cd = fold(picked<0, 4, 1, 5>(c, d), picked<2, 6, 3, 7>(c, d));
    return fold(picked<0, 1, 4, 5>(of_ab, of_cd), picked<2, 3, 6, 7>(of_ab, of_cd));
}
template <class T>
[[nodiscard, gnu::always_inline]] inline Lanes<T> least_of(T const (&edges)[16]) noexcept {
    return folded(edges, [](Lanes<T> const& a, Lanes<T> const& b) { return least(a, b); });
}
template <class T>
[[nodiscard, gnu::always_inline]] inline Lanes<T> largest_of(T const (&edges)[16]) noexcept {
    return folded(edges, [](Lanes<T> const& a, Lanes<T> const& b) { return largest(a, b); });
}

template <class T>
[[gnu::always_inline]] inline void bound_four_slices(ViewOfBox<T> const& seen, T const* plane,
                                                     ExtentsOfSlices<T>& of) noexcept {
    using Long = LongLanes<T>;
    // NOTE: one by one, as they have mostly just been written.
    Lanes<T> const begin = Lanes<T>::of(plane[0], plane[1], plane[2], plane[3]);
    EdgesInLight<T> const edges(seen, begin, moved_up(begin, plane[4]));
    ExtentInLanes<Long> sides = extent_of(edges.sides_at(Long::all(plane[0])));
    // NOTE: no loop: compilers would keep what it needs in registers that they have not.
    edges.bound(0, sides, of);
    if constexpr (Long::fours == 1) edges.bound(1, sides, of);
    if constexpr (Long::fours <= 2) edges.bound(2, sides, of);
    if constexpr (Long::fours == 1) edges.bound(3, sides, of);
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath
