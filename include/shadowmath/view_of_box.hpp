// SPDX-License-Identifier: MIT
//
// A box as a view sees it: from the eye, every plane a little farther out, its twelve edges cut by the four sides of
// the view. The half of slice_edges.hpp that no split has to do with.
//
// Source: ours. An edge enters the view where it goes inward through a side, and leaves it where outward.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/lanes.hpp>
#include <shadowmath/long_lanes.hpp>
#include <shadowmath/slices.hpp>
#include <shadowmath/view_volume.hpp>

#include <cmath>
#include <limits>

namespace shadowmath {
inline namespace v0 {
namespace detail {

// A view with what it sees of a box, relative to the eye, every plane `slack` metres farther out. Side `i` of the view
// at depth z is at `slope[i] * z + offset[i]`; left, right, bottom, top.
template <class T>
struct ViewOfBox {
    Pose<T> const* pose;
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
    Lanes const right = four(seen.pose->right), up = four(seen.pose->up), ahead = four(seen.pose->forward);
    Lanes const inward[4] = {right - ahead * all_of<0>(seen.slope), ahead * all_of<1>(seen.slope) - right,
                             up - ahead * all_of<2>(seen.slope), ahead * all_of<3>(seen.slope) - up};
    // An edge enters where it goes inward, and leaves where not: what it does not do is moved out of the way.
    constexpr T away = T(1e38);
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
        auto const cut = [&](int i) {
            Long const root = inside[i] * spread<Long>(inverse[i], axis);
            first = largest(first, root + spread<Long>(not_entered[i], axis));
            last = least(last, root + spread<Long>(not_left[i], axis));
        };
        cut(0), cut(1), cut(2), cut(3);
        auto const store = [axis](T* to, Long const& lanes) { store_long(to + 4 * axis, lanes); };
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

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath
