// SPDX-License-Identifier: MIT
//
// Where the light that warped maps get first meets the casters' box, four maps at a time: where their depth begins. The
// inside of four_warps.hpp; what depth_range.hpp is for sides that are parallel.
//
// Source: ours.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/lanes.hpp>
#include <shadowmath/light.hpp>

#include <cmath>
#include <limits>

namespace shadowmath {
inline namespace v0 {
namespace detail {

// A plane that goes up by `growth` along an axis of a box, as what cuts the edges along it: by -1 / growth, out of the
// way at the end that it does not cut.
template <class T>
struct CutAlong {
    Lanes<T> inverse, not_entered, not_left;

    [[gnu::always_inline]] explicit CutAlong(Lanes<T> const& growth) noexcept {
        constexpr T away = T(1e38);
        Lanes<T> const in = not_zero(growth), none = all_four(T(0));
        inverse = all_four(T(-1)) / in;
        not_entered = where_at_most(in, none, all_four(-away), none);
        not_left = not_entered + all_four(away);
    }
    // `inside`: of the edges' origin, above the plane.
    [[gnu::always_inline]] void cut(Lanes<T> const& inside, Lanes<T>& first, Lanes<T>& last) const noexcept {
        Lanes<T> const at = inside * inverse;
        first = largest(first, at + not_entered);
        last = least(last, at + not_left);
    }
};

// The light that a map gets, a map to a lane: between y_lo and y_hi, and between x_lo w and x_hi w.
template <class T>
struct ShaftsOfLight {
    Lanes<T> x_lo, x_hi, y_lo, y_hi;
    Lanes<T> w_slope, w_offset;  // w = w_slope y + w_offset
};

// Where such light first meets a box: on one of the three faces that it falls on, so on one of their nine edges, or
// where one of the shaft's own four edges enters the box.
template <class T>
struct LightOnBox {
    using Four = Lanes<T>;
    static constexpr T none = T(1e37);

    // In the mirror, along every axis of the box that the light goes down: then it goes up all of them.
    Vec3<T> across, upward, travel;
    Four lo[3], hi[3], rounding;  // of the box
    // What the lower and the upper end of the box add to y, and to how far it is inside either side.
    Four y[3][2], above[3][2], below[3][2], above_growth[3], below_growth[3];
    Four from_y, to_y, middle_y, half_y, lo_wider, hi_wider, lo_offset, hi_offset;

    // `box`: relative to the eye, and taken no farther out than `reach`.
    [[gnu::always_inline]] LightOnBox(ShaftsOfLight<T> const& shafts, LightBasis<T> const& axes, Aabb<T> const& box,
                                      Four const& reach) noexcept
        : across(axes.x), upward(axes.y), travel(axes.depth) {
        constexpr T unsure = T(8) * std::numeric_limits<T>::epsilon();
        Four const zero = all_four(T(0)), back = zero - reach, half = all_four(T(0.5));
        Four const lo_slope = shafts.x_lo * shafts.w_slope, hi_slope = shafts.x_hi * shafts.w_slope;
        add_axis<0>(box, back, reach, lo_slope, hi_slope);
        add_axis<1>(box, back, reach, lo_slope, hi_slope);
        add_axis<2>(box, back, reach, lo_slope, hi_slope);
        auto const farther = [](Four const& a, Four const& b) { return largest(absolute(a), absolute(b)); };
        rounding = (farther(lo[0], hi[0]) + farther(lo[1], hi[1]) + farther(lo[2], hi[2])) * all_four(unsure);
        Four const of_offset = absolute(shafts.w_offset) * all_four(unsure);
        lo_wider = rounding + absolute(lo_slope) * rounding + absolute(shafts.x_lo) * of_offset;
        hi_wider = rounding + absolute(hi_slope) * rounding + absolute(shafts.x_hi) * of_offset;
        lo_offset = lo_wider - shafts.x_lo * shafts.w_offset, hi_offset = hi_wider + shafts.x_hi * shafts.w_offset;
        Four const y_lo = least(y[0][0], y[0][1]) + least(y[1][0], y[1][1]) + least(y[2][0], y[2][1]);
        Four const y_hi = largest(y[0][0], y[0][1]) + largest(y[1][0], y[1][1]) + largest(y[2][0], y[2][1]);
        from_y = largest(shafts.y_lo, y_lo) - rounding, to_y = least(shafts.y_hi, y_hi) + rounding;
        middle_y = (from_y + to_y) * half, half_y = (to_y - from_y) * half;
    }
    template <int k>
    [[gnu::always_inline]] void add_axis(Aabb<T> const& box, Four const& back, Four const& reach, Four const& lo_slope,
                                         Four const& hi_slope) noexcept {
        bool const down = travel[k] < T(0);
        across[k] = down ? -across[k] : across[k];
        upward[k] = down ? -upward[k] : upward[k];
        travel[k] = std::abs(travel[k]);
        lo[k] = largest(all_four(down ? -box.hi[k] : box.lo[k]), back);
        hi[k] = least(all_four(down ? -box.lo[k] : box.hi[k]), reach);
        Four const x_of = all_four(across[k]), y_of = all_four(upward[k]);
        above_growth[k] = x_of - lo_slope * y_of, below_growth[k] = hi_slope * y_of - x_of;
        y[k][0] = lo[k] * y_of, y[k][1] = hi[k] * y_of;
        above[k][0] = lo[k] * above_growth[k], above[k][1] = hi[k] * above_growth[k];
        below[k][0] = lo[k] * below_growth[k], below[k][1] = hi[k] * below_growth[k];
    }

    // Of the edge along axis k at the lower (0) or upper (1) ends of the two others.
    template <int k, int a, int b>
    [[gnu::always_inline]] void meet_edge(Four const& inverse_y, Four const& reach_y, CutAlong<T> const& by_above,
                                          CutAlong<T> const& by_below, Four& first_of_all) const noexcept {
        constexpr int u = (k + 1) % 3, v = (k + 2) % 3;
        Four const at = (middle_y - (y[u][a] + y[v][b])) * inverse_y;
        Four first = largest(lo[k], at - reach_y), last = least(hi[k], at + reach_y);
        by_above.cut(above[u][a] + (above[v][b] + lo_offset), first, last);
        by_below.cut(below[u][a] + (below[v][b] + hi_offset), first, last);
        Four const depth = (a == 0 ? lo[u] : hi[u]) * all_four(travel[u]) +
                           (b == 0 ? lo[v] : hi[v]) * all_four(travel[v]) + first * all_four(travel[k]);
        first_of_all = least(first_of_all, where_at_most(first, last, depth, all_four(none)));
    }
    template <int k>
    [[gnu::always_inline]] void meet_edges(Four& first_of_all) const noexcept {
        T const per_y = T(1) / not_zero(upward[k]);
        Four const inverse_y = all_four(per_y), reach_y = half_y * all_four(std::abs(per_y));
        CutAlong<T> const by_above(above_growth[k]), by_below(below_growth[k]);
        meet_edge<k, 0, 0>(inverse_y, reach_y, by_above, by_below, first_of_all);
        meet_edge<k, 0, 1>(inverse_y, reach_y, by_above, by_below, first_of_all);
        meet_edge<k, 1, 0>(inverse_y, reach_y, by_above, by_below, first_of_all);
    }
    template <int k>
    [[gnu::always_inline]] void enter(Four const& at_x, Four const& at_y, T per_step, Four& first,
                                      Four& last) const noexcept {
        Four const at = at_x * all_four(across[k]) + at_y * all_four(upward[k]);
        first = largest(first, (lo[k] - rounding - at) * all_four(per_step));
        last = least(last, (hi[k] + rounding - at) * all_four(per_step));
    }
    [[gnu::always_inline]] void meet_corner(Four const& at_x, Four const& at_y, Vec3<T> const& per_step,
                                            Four& first_of_all) const noexcept {
        Four first = all_four(-none), last = all_four(none);
        enter<0>(at_x, at_y, per_step.x, first, last);
        enter<1>(at_x, at_y, per_step.y, first, last);
        enter<2>(at_x, at_y, per_step.z, first, last);
        first_of_all = least(first_of_all, where_at_most(first, last, first, all_four(none)));
    }
    // Metres along the light, less by rounding; the largest number where it meets nothing.
    [[nodiscard, gnu::always_inline]] Four first_met(ShaftsOfLight<T> const& shafts) const noexcept {
        Four first_of_all = all_four(none);
        meet_edges<0>(first_of_all), meet_edges<1>(first_of_all), meet_edges<2>(first_of_all);
        Vec3<T> const per_step(T(1) / not_zero(travel.x), T(1) / not_zero(travel.y), T(1) / not_zero(travel.z));
        Four const w_lo = shafts.w_offset + shafts.w_slope * from_y, w_hi = shafts.w_offset + shafts.w_slope * to_y;
        meet_corner(shafts.x_lo * w_lo - lo_wider, from_y, per_step, first_of_all);
        meet_corner(shafts.x_hi * w_lo + hi_wider, from_y, per_step, first_of_all);
        meet_corner(shafts.x_lo * w_hi - lo_wider, to_y, per_step, first_of_all);
        meet_corner(shafts.x_hi * w_hi + hi_wider, to_y, per_step, first_of_all);
        // Boxes that are none have edges all the same.
        Four const size = least(hi[0] - lo[0], least(hi[1] - lo[1], hi[2] - lo[2]));
        return where_at_most(all_four(T(0)), least(size, half_y), first_of_all, all_four(none)) - rounding;
    }
};

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath
