// SPDX-License-Identifier: MIT
//
// All slices of a view at once, each cut down to the receivers and warped (warp.hpp): what simple_perspective_map gives
// for each slice, some forty times as fast. For cascades under a low sun; fit_cascades calls it for CascadeFit::warped.
//
//   edges of slices and receivers    cut and bounded in light space, as slice_edges.hpp does: y and z_near say 1 / a
//   their ends                       behind the warp, x / w: the sides of the map
//   edges of the casters' box        between those sides, and the sides' own edges: where depth begins
//   the ends again                   depth / w: how far it goes
//
// The first, second and fourth take four edges of a slice at a time, the third a slice to a lane.
//
// Source: that of warp.hpp and map_rows.hpp, of which this is the twin in lanes. Departure: every plane is 16 epsilon
// of the view's reach farther out, since edges are bounded one by one.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/lanes.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/long_lanes.hpp>
#include <shadowmath/map_rows.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/shafts_of_light.hpp>
#include <shadowmath/slice.hpp>
#include <shadowmath/slice_edges.hpp>
#include <shadowmath/slices.hpp>
#include <shadowmath/splits.hpp>
#include <shadowmath/view_volume.hpp>
#include <shadowmath/warp.hpp>
#include <shadowmath/wide.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace shadowmath {
inline namespace v0 {
namespace detail {

// What the maps of one call have in common.
template <class T>
struct WarpsOfView {
    ViewOfBox<T> seen;  // of the receivers, along `axes`
    WarpAxes<T> axes;
    Aabb<T> casters;  // relative to the eye
    Vec3<T> eye;
    Faults faults;
    T margin;  // texels, for each that is used
    T size;    // texels of a map's side
    ClipSpace clip;
    bool flat;  // orthographic: nothing to undo
};

// Edges of four slices, four to a slice, as they are kept until the warp is known.
template <class T>
struct KeptEdges {
    using Long = LongLanes<T>;
    enum Group { near_sides, far_sides, rays, of_box, groups = of_box + 3 };
    T x[groups][16], y[groups][16], along[groups][16];  // of their middles, relative to the eye
    T length[groups][16];                               // in steps; negative where an edge is none

    [[gnu::always_inline]] ExtentInLanes<Long> keep(int group, int i, CutEdges<Long> const& edges) noexcept {
        Vectors<Long> const middle = edges.middle();
        Long const steps = edges.length();
        store_long(x[group] + 4 * i, middle.x), store_long(y[group] + 4 * i, middle.y);
        store_long(along[group] + 4 * i, middle.z), store_long(length[group] + 4 * i, steps);
        Vectors<Long> const reach = edges.half.size * steps;
        return {{middle.x - reach.x, middle.y - reach.y, middle.z - reach.z}, middle + reach};
    }
    [[nodiscard, gnu::always_inline]] Long at(T const (&of)[groups][16], int group, int i) const noexcept {
        return long_at<Long>(of[group] + 4 * i);
    }
};

// Four maps, a map to a lane; `count` of them are wanted.
template <class T>
struct FourWarps {
    using Four = Lanes<T>;
    using Long = LongLanes<T>;
    using Kept = KeptEdges<T>;
    WarpsOfView<T> const& view;
    Four begin, end;  // of the slices, metres of eye depth
    Four strength;    // [0, 2]
    int count;
    ShadowMap<T>* const* maps;

    static constexpr T none = T(1e37);

    [[nodiscard, gnu::always_inline]] static Four all(T value) noexcept { return all_four(value); }

    // Slices from i on: everything that they reach, and how near it comes to the eye.
    struct Reach {
        ExtentInLanes<Long> extent;
        Long ahead;
    };
    [[gnu::always_inline]] void add_box_edges(EdgesInLight<T> const& edges, int axis, int i, Kept& kept,
                                              Reach& reach) const noexcept {
        CutEdges<Long> const cut = edges.box_edges_in(i, axis);
        reach.extent.add(kept.keep(Kept::of_box + axis, i, cut));
        Long const from = repeated<Long>(four_at(edges.of_box.ahead + 4 * axis));
        Long const growth = Long::all(not_zero(view.seen.pose->forward[axis]));
        Long const depth = least((from + cut.first) * growth, (from + cut.last) * growth);
        reach.ahead = least(reach.ahead, where_at_most(cut.first, cut.last, depth, Long::all(none)));
    }
    [[gnu::always_inline]] void bound(EdgesInLight<T> const& edges, int i, Kept& kept, ExtentsOfSlices<T>& of,
                                      T (&nearest)[16]) const noexcept {
        Long const nothing = Long::all(none), at_near = spread<Long>(begin, i), at_far = spread<Long>(end, i);
        Reach reach;
        reach.extent = kept.keep(Kept::near_sides, i, edges.sides_at(at_near));
        reach.ahead = where_at_most(Long::all(T(0)), kept.at(kept.length, Kept::near_sides, i), at_near, nothing);
        reach.extent.add(kept.keep(Kept::far_sides, i, edges.sides_at(at_far)));
        CutEdges<Long> const rays = edges.rays_in(i);
        reach.extent.add(kept.keep(Kept::rays, i, rays));
        reach.ahead = least(reach.ahead, where_at_most(rays.first, rays.last, rays.first, nothing));
        add_box_edges(edges, 0, i, kept, reach);
        add_box_edges(edges, 1, i, kept, reach);
        add_box_edges(edges, 2, i, kept, reach);
        of.store(i, reach.extent);
        store_long(nearest + 4 * i, reach.ahead);
    }

    // The ends of what was kept, behind the warp w = w_slope y + w_offset.
    struct Ends {
        T along[Kept::groups][2][16], inverse_w[Kept::groups][2][16];
        T lo[16], hi[16];  // x / w
    };
    struct Span {
        Long lo, hi;
    };
    [[gnu::always_inline]] static void project_group(Kept const& kept, int group, HalfStep<Long> const& half, int i,
                                                     Long const& slope, Long const& offset, Span& span,
                                                     Ends& ends) noexcept {
        Long const nothing = Long::all(none), less_than_nothing = Long::all(-none), w_min = Long::all(T(0.5));
        Long const zero = Long::all(T(0)), kept_length = kept.at(kept.length, group, i);
        Long const length = largest(kept_length, Long::all(T(-1)));
        Long const x = kept.at(kept.x, group, i), across = half.step.x * length, ahead = half.step.z * length;
        Long const along = where_at_most(zero, kept_length, kept.at(kept.along, group, i), less_than_nothing);
        Long const w = kept.at(kept.y, group, i) * slope + offset, growth = half.step.y * length * slope;
        Long const a = Long::all(T(1)) / largest(w - growth, w_min);
        Long const b = Long::all(T(1)) / largest(w + growth, w_min);
        Long const from = (x - across) * a, to = (x + across) * b;
        span.lo = least(span.lo, where_at_most(zero, kept_length, least(from, to), nothing));
        span.hi = largest(span.hi, where_at_most(zero, kept_length, largest(from, to), less_than_nothing));
        store_long(ends.along[group][0] + 4 * i, along - ahead);
        store_long(ends.along[group][1] + 4 * i, along + ahead);
        store_long(ends.inverse_w[group][0] + 4 * i, a);
        store_long(ends.inverse_w[group][1] + 4 * i, b);
    }
    [[gnu::always_inline]] static void project(EdgesInLight<T> const& edges, int i, Kept const& kept,
                                               Four const& w_slope, Four const& w_offset, Ends& ends) noexcept {
        Long const slope = spread<Long>(w_slope, i), offset = spread<Long>(w_offset, i);
        Span span{Long::all(none), Long::all(-none)};
        project_group(kept, Kept::near_sides, edges.along_side, i, slope, offset, span, ends);
        project_group(kept, Kept::far_sides, edges.along_side, i, slope, offset, span, ends);
        project_group(kept, Kept::rays, edges.along_ray, i, slope, offset, span, ends);
        project_group(kept, Kept::of_box, edges.along[0], i, slope, offset, span, ends);
        project_group(kept, Kept::of_box + 1, edges.along[1], i, slope, offset, span, ends);
        project_group(kept, Kept::of_box + 2, edges.along[2], i, slope, offset, span, ends);
        store_long(ends.lo + 4 * i, span.lo);
        store_long(ends.hi + 4 * i, span.hi);
    }
    // The largest of (depth - first) / w.
    [[nodiscard, gnu::always_inline]] static Four deepest(Ends const& ends, Four const& first) noexcept {
        T of_slices[16];
        deepest_from(ends, 0, first, of_slices);
        if constexpr (Long::fours == 1) deepest_from(ends, 1, first, of_slices);
        if constexpr (Long::fours <= 2) deepest_from(ends, 2, first, of_slices);
        if constexpr (Long::fours == 1) deepest_from(ends, 3, first, of_slices);
        return largest_of(of_slices);
    }
    [[gnu::always_inline]] static void deepest_from(Ends const& ends, int i, Four const& first,
                                                    T (&of_slices)[16]) noexcept {
        Long const start = spread<Long>(first, i);
        Long most = Long::all(-none);
        for (int group = 0; group < Kept::groups; ++group)
            for (int side = 0; side < 2; ++side)
                most = largest(most, (long_at<Long>(ends.along[group][side] + 4 * i) - start) *
                                         long_at<Long>(ends.inverse_w[group][side] + 4 * i));
        store_long(of_slices + 4 * i, most);
    }

    // 1 / a of the warp (warp.hpp), in lanes.
    [[nodiscard, gnu::always_inline]] Four inverse_centre(Four const& nearest, Four const& length) const noexcept {
        if (view.flat) return all(T(0));
        T const sine = view.axes.sine;
        // Nearer than 2^-20 of the far distance no ratio of depths means anything.
        Four const z_near = largest(nearest, end * all(T(1) / T(1 << 20))), most = all(sine) / z_near;
        Four const root_of_ratio = root(all(T(1)) + length * most);
        Four const share = least(strength, all(T(1))) + largest(strength - all(T(1)), all(T(0))) * root_of_ratio;
        return all(view.axes.fade) * (most * share / (all(T(1)) + root_of_ratio));
    }

    // One row of four matrices, relative to the eye.
    struct Row {
        Vectors<Four> normal;
        Four offset;
    };
    // Column by column, of all four.
    [[gnu::always_inline]] void write(Row const& x, Row const& y, Row const& z, Row const& w,
                                      bool (&finite)[4]) const noexcept {
        Vec3<T> const& eye = view.eye;
        auto const moved = [&eye](Row const& row) {
            return row.offset - (row.normal.x * all(eye.x) + row.normal.y * all(eye.y) + row.normal.z * all(eye.z));
        };
        Four columns[4][4] = {{x.normal.x, y.normal.x, z.normal.x, w.normal.x},
                              {x.normal.y, y.normal.y, z.normal.y, w.normal.y},
                              {x.normal.z, y.normal.z, z.normal.z, w.normal.z},
                              {moved(x), moved(y), moved(z), moved(w)}};
        for (auto& column : columns) transpose(column);
        for (int i = 0; i < count; ++i) {
            BeyondReach<T> infinite;
            for (int column = 0; column < 4; ++column) {
                static_assert(sizeof columns[0][0] == sizeof maps[0]->clip_from_world[0], "columns without a gap");
                std::memcpy(&maps[i]->clip_from_world[column].x, &columns[column][i], sizeof columns[0][0]);
                infinite.look_for_finite(columns[column][i]);
            }
            finite[i] = !infinite.any();
        }
    }

    [[gnu::always_inline]] void operator()() const noexcept {
        constexpr T eps = std::numeric_limits<T>::epsilon();
        T const slack = view.seen.slack;
        Four const zero = all(T(0)), one = all(T(1));
        EdgesInLight<T> const edges(view.seen, begin, end);
        Kept kept;
        ExtentsOfSlices<T> of;
        T ahead[16];
        bound(edges, 0, kept, of, ahead);
        if constexpr (Long::fours == 1) bound(edges, 1, kept, of, ahead);
        if constexpr (Long::fours <= 2) bound(edges, 2, kept, of, ahead);
        if constexpr (Long::fours == 1) bound(edges, 3, kept, of, ahead);
        Four const seen_lo = least_of(of.lo[0]), seen_hi = largest_of(of.hi[0]);
        // Of a slice that sees nothing, numbers to compute with.
        auto const or_none = [&](Four const& value) { return where_at_most(seen_lo, seen_hi, value, zero); };
        Four const x_lo = or_none(seen_lo - all(slack)), x_hi = or_none(seen_hi + all(slack));
        Four const y_lo = or_none(least_of(of.lo[1]) - all(slack)), y_hi = or_none(largest_of(of.hi[1]) + all(slack));
        Four const first = or_none(least_of(of.lo[2]) - all(slack)), last = or_none(largest_of(of.hi[2]) + all(slack));
        Four const nearest = largest(least(least_of(ahead), end), begin);

        Four const length = y_hi - y_lo, centre = inverse_centre(nearest, length);
        Four const w_offset = one - y_lo * centre;
        Ends ends;
        project(edges, 0, kept, centre, w_offset, ends);
        if constexpr (Long::fours == 1) project(edges, 1, kept, centre, w_offset, ends);
        if constexpr (Long::fours <= 2) project(edges, 2, kept, centre, w_offset, ends);
        if constexpr (Long::fours == 1) project(edges, 3, kept, centre, w_offset, ends);
        Four left = or_none(least_of(ends.lo)), right = or_none(largest_of(ends.hi));
        left = left - all(slack) * (one + absolute(left) * centre);
        right = right + all(slack) * (one + absolute(right) * centre);
        Four bottom = zero, top = length / (one + length * centre);

        // As wide as a texel and as rounding may be, and a margin.
        auto const larger_end = [](Four const& a, Four const& b) { return largest(absolute(a), absolute(b)); };
        Four const far_x = larger_end(x_lo, x_hi), far_y = larger_end(y_lo, y_hi), far_z = larger_end(first, last);
        Four const radius = root(far_x * far_x + far_y * far_y + far_z * far_z);
        T const eye_metres = glm::length(view.eye);
        Four const noise = (radius + all(eye_metres)) * all(T(64) * eps);
        Four const texel = largest(x_hi - x_lo, length) * all(T(1) / view.size), least_width = largest(texel, noise);
        auto const widen = [&](Four& lo, Four& hi) {
            Four const more = largest(least_width - (hi - lo), zero) * all(T(0.5));
            lo = lo - more, hi = hi + more;
            Four const border = (hi - lo) * all(view.margin);
            lo = lo - border, hi = hi + border;
        };
        widen(left, right), widen(bottom, top);

        // y of the lower and upper side: where (y - y_lo) / w is `bottom` and `top`; w >= 1/2 below.
        Four const below = largest(bottom / (one - bottom * centre), all(T(-0.5)) / largest(centre, all(T(1e-30))));
        Four const narrowing = one - top * centre - all(T(4) * eps);
        Four const above = where_at_most(all(T(1e-6)), narrowing, top / largest(narrowing, all(T(1e-6))), all(none));
        ShaftsOfLight<T> const shafts{left, right, y_lo + below, y_lo + above, centre, w_offset};
        LightOnBox<T> const lit(shafts, view.axes.basis, view.casters, radius * all(T(1024)));
        Four const caster = lit.first_met(shafts);
        // No receiver is farther from the light than this.
        Four const lowest =
            last + all(T(1e-3)) * (last - first) + largest(absolute(first), absolute(last)) * all(T(64) * eps);
        Four const depth_lo = where_at_most(caster, lowest, least(first, caster), first);
        Four const room = (last - depth_lo) * all(T(1) / T(1024)) + radius * all(T(64) * eps) + all(slack);
        Four const from = depth_lo - room, to = last + room;

        Vec3<T> const &across = view.axes.basis.x, &up = view.axes.basis.y, &travel = view.axes.basis.depth;
        Row const w{times(centre, up), w_offset};
        Four const x_scale = all(T(2)) / (right - left), x_shift = (right + left) / (right - left);
        Row x{times(x_scale, across) + times(zero - centre * x_shift, up), zero - w_offset * x_shift};
        T const y_sign = view.clip.ndc_y == YAxis::up ? T(1) : T(-1);
        Four const y_scale = all(y_sign * T(2)) / (top - bottom),
                   y_shift = (top + bottom) / (top - bottom) * all(y_sign);
        Row y{times(y_scale - centre * y_shift, up), zero - (y_lo * y_scale + w_offset * y_shift)};
        Row z;
        if (view.clip.depth == DepthOrder::one_to_zero) {
            Four const scale = one / (to - from);
            z = {times(zero - scale, travel), to * scale};
        } else {
            Four const scale = one / or_one(deepest(ends, from - room), seen_lo, seen_hi);
            z = {times(scale, travel), zero - from * scale};
            if (view.clip.depth == DepthOrder::minus_one_to_one) {
                Four const two = all(T(2));
                z = {times(two * scale, travel) + times(zero - centre, up), z.offset * two - w_offset};
            }
        }
        bool finite[4];
        write(x, y, z, w, finite);

        auto const steep = [](Row const& row) {
            return row.normal.x * row.normal.x + row.normal.y * row.normal.y + row.normal.z * row.normal.z;
        };
        Four const steepest = root(largest(steep(x), steep(y))) * all(eps * eye_metres * view.size);
        for (int i = 0; i < count; ++i) {
            ShadowMap<T>& map = *maps[i];
            map.clip = view.clip;
            map.faults = view.faults;
            map.w_min = T(0);
            map.visible = false;
            bool const body = seen_lo[i] <= seen_hi[i];
            if (body && !view.flat && view.axes.fade * strength[i] == T(0)) map.faults |= Fault::warp_faded;
            if (body && !view.flat && !(begin[i] > T(0))) map.faults |= Fault::near_clamped;
            if (!body || !(caster[i] <= lowest[i])) {
                map.clip_from_world = nowhere<T>();
                continue;
            }
            if (!finite[i]) {
                map.clip_from_world = nowhere<T>();
                map.faults |= Fault::precision_lost;
                continue;
            }
            if (steepest[i] > T(1)) map.faults |= Fault::precision_lost;
            map.w_min = T(0.5);
            map.visible = true;
        }
    }
    [[nodiscard, gnu::always_inline]] static Four or_one(Four const& value, Four const& lo, Four const& hi) noexcept {
        return where_at_most(lo, hi, value, all(T(1)));
    }
};

// What warps are made from, checked and mended.
template <class T>
struct WarpInputs {
    ViewVolume<T> const& view;
    Vec3<T> travel;  // unit to the last bits
    Faults faults;   // of every map
    int map_size;
    T margin_texels;
    ClipSpace clip;
};

// False, and nothing written, where the numbers are none for it: then each map is to be made alone. `strengths`: of
// each map, in [0, 2].
template <class T>
[[nodiscard]] inline bool warp_slices(WarpInputs<T> const& in, SliceRange<T> const* ranges, T const* strengths,
                                      int count, Aabb<T> const& casters, Aabb<T> const& receivers,
                                      ShadowMap<T>* const* maps) noexcept {
    WarpsOfView<T> view;
    view.axes = warp_axes(in.view.pose, in.travel);
    view.seen.pose = &in.view.pose;
    if (!look(view.axes.basis, in.view, view.seen.lit) ||
        !look_at_box(in.view, ranges[count - 1].end, receivers, view.seen))
        return false;
    view.eye = in.view.pose.position;
    view.casters = {casters.lo - view.eye, casters.hi - view.eye};
    view.faults = in.faults;
    view.size = T(in.map_size);
    T const margin = in.margin_texels > T(0) ? in.margin_texels : T(0);
    view.margin = margin / (view.size - T(2) * margin);
    view.clip = in.clip;
    view.flat = in.view.kind == ViewKind::orthographic;
    for (int start = 0; start < count; start += 4) {
        int const left = count - start < 4 ? count - start : 4;
        // The last slice once more in the places that are left.
        T begin[4], end[4], strength[4];
        for (int i = 0; i < 4; ++i) {
            int const at = start + (i < left ? i : left - 1);
            begin[i] = ranges[at].begin, end[i] = ranges[at].end, strength[i] = strengths[at];
        }
        run_widely(FourWarps<T>{view, Lanes<T>::of(begin[0], begin[1], begin[2], begin[3]),
                                Lanes<T>::of(end[0], end[1], end[2], end[3]),
                                Lanes<T>::of(strength[0], strength[1], strength[2], strength[3]), left, maps + start});
    }
    return true;
}

}  // namespace detail

// maps[i] is what simple_perspective_map gives for slice i, of splits that fade into each other by `blend` (slice.hpp):
// every receiver in it and every caster above them inside, `margin_texels` from the sides, w > 0 on all of them. It
// differs from that by no more than planes do that are 256 epsilon of the view's reach and of its place apart; where
// casters reach farther than ten times the receivers, depth may begin a thousandth of that sooner. Bit i of the result:
// map i is visible. Writes splits.count maps. A spot, the other rules of WarpOptions and what lies beyond 1e12 m are
// served map by map.
template <class T>
[[nodiscard]] inline std::uint32_t fit_slice_warps(ViewVolume<T> const& view, Light<T> const& light,
                                                   Splits<T> const& splits, T const& blend, Aabb<T> const& casters,
                                                   Aabb<T> const& receivers, WarpOptions<T> const& options,
                                                   ClipSpace clip, ShadowMap<T>* maps) noexcept {
    if (splits.count < 1 || splits.count > max_splits) return 0;
    if (!all_finite(splits.plane, splits.count + 1)) {
        for (int i = 0; i < splits.count; ++i) {
            maps[i] = {};
            maps[i].clip = clip;
            maps[i].faults = Fault::not_finite;
        }
        return 0;
    }
    bool const usable_blend = all_finite(&blend, 1);
    SliceRange<T> ranges[max_splits];
    T strengths[max_splits];
    for (int i = 0; i < splits.count; ++i) ranges[i] = slice_range(splits, i, usable_blend ? blend : T(0));
    bool const plain = light.kind == LightKind::directional && options.rule == WarpRule::by_strength &&
                       all_finite(&options.strength, 1) && all_finite(&options.focus_metres, 1) &&
                       all_finite(&options.coefficient, 1) && detail::in_range(splits);
    bool done = false;
    if (plain) {
        ShadowMap<T>* each[max_splits];
        T const strength = glm::clamp(options.strength, T(0), T(2));
        for (int i = 0; i < splits.count; ++i) strengths[i] = strength, each[i] = maps + i;
        ViewVolume<T> const seen = slice(view, {ranges[0].begin, T(0), ranges[splits.count - 1].end});
        Door<T> const door = shadowmath::door(seen, light, casters, receivers, options.map_size, options.margin_texels);
        Faults const clamped = strength != options.strength ? Faults(Fault::clamped_option) : Faults{};
        detail::WarpInputs<T> const in{door.view,        door.light.direction,  door.faults | clamped,
                                       options.map_size, options.margin_texels, clip};
        done = !door.stop && detail::warp_slices(in, ranges, strengths, splits.count, casters, receivers, each);
    }
    std::uint32_t visible = 0;
    for (int i = 0; i < splits.count; ++i) {
        if (!done) maps[i] = simple_perspective_map(slice(view, ranges[i]), light, casters, receivers, options, clip);
        visible |= maps[i].visible ? 1u << i : 0u;
    }
    return visible;
}

}  // namespace v0
}  // namespace shadowmath
