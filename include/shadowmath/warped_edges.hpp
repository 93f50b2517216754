// SPDX-License-Identifier: MIT
//
// The edges of slices and box (slice_edges.hpp), kept until a warp is known, and then seen behind it: what warps are
// fitted to, without a polygon. The inside of four_warps.hpp.
//
// Source: ours. An edge stays one under x / w: its ends bound it, as long as w > 0.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/lanes.hpp>
#include <shadowmath/long_lanes.hpp>
#include <shadowmath/slice_edges.hpp>
#include <shadowmath/view_of_box.hpp>

namespace shadowmath {
inline namespace v0 {
namespace detail {

// Farther than anything is.
template <class T>
inline constexpr T far_away = T(1e37);

// Edges of four slices, four to a slice, as they are kept until the warp is known.
template <class T>
struct KeptEdges {
    using Four = Lanes<T>;
    using Long = LongLanes<T>;
    enum Group { near_sides, far_sides, rays, of_box, groups = of_box + 3 };
    T x[groups][16], y[groups][16], along[groups][16];  // of their middles, relative to the eye
    T length[groups][16];                               // in steps; negative where an edge is none

    // Keeps those of slices from i on, and says what they reach and how near it comes to the eye.
    // NOTE: no loop: compilers would keep what it needs in registers that they have not.
    template <int i = 0>
    [[gnu::always_inline]] void keep_all(ViewOfBox<T> const& seen, EdgesInLight<T> const& edges, ExtentsOfSlices<T>& of,
                                         T (&nearest)[16]) noexcept {
        Long const nothing = Long::all(far_away<T>);
        Long const at_near = spread<Long>(edges.nearest, i), at_far = spread<Long>(edges.farthest, i);
        Reach reach;
        reach.extent = keep(near_sides, i, edges.sides_at(at_near));
        reach.ahead = where_at_most(Long::all(T(0)), at(length, near_sides, i), at_near, nothing);
        reach.extent.add(keep(far_sides, i, edges.sides_at(at_far)));
        CutEdges<Long> const cut_rays = edges.rays_in(i);
        reach.extent.add(keep(rays, i, cut_rays));
        reach.ahead = least(reach.ahead, where_at_most(cut_rays.first, cut_rays.last, cut_rays.first, nothing));
        keep_box_edges(seen, edges, 0, i, reach);
        keep_box_edges(seen, edges, 1, i, reach);
        keep_box_edges(seen, edges, 2, i, reach);
        of.store(i, reach.extent);
        store_long(nearest + 4 * i, reach.ahead);
        if constexpr (i + Long::fours < 4) keep_all<i + Long::fours>(seen, edges, of, nearest);
    }
    struct Reach {
        ExtentInLanes<Long> extent;
        Long ahead;
    };
    [[gnu::always_inline]] void keep_box_edges(ViewOfBox<T> const& seen, EdgesInLight<T> const& edges, int axis, int i,
                                               Reach& reach) noexcept {
        CutEdges<Long> const cut = edges.box_edges_in(i, axis);
        reach.extent.add(keep(of_box + axis, i, cut));
        Long const from = repeated<Long>(four_at(edges.of_box.ahead + 4 * axis));
        Long const growth = Long::all(not_zero(seen.pose->forward[axis]));
        Long const depth = least((from + cut.first) * growth, (from + cut.last) * growth);
        reach.ahead = least(reach.ahead, where_at_most(cut.first, cut.last, depth, Long::all(far_away<T>)));
    }
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

// The ends of what was kept, behind the warp w = w_slope y + w_offset.
template <class T>
struct WarpedEnds {
    using Four = Lanes<T>;
    using Long = LongLanes<T>;
    using Kept = KeptEdges<T>;
    T along[Kept::groups][2][16], inverse_w[Kept::groups][2][16];
    T lo[16], hi[16];  // x / w

    struct Span {
        Long lo, hi;
    };
    [[gnu::always_inline]] WarpedEnds(EdgesInLight<T> const& edges, Kept const& kept, Four const& w_slope,
                                      Four const& w_offset) noexcept {
        project_all(edges, kept, w_slope, w_offset);
    }
    template <int i = 0>
    [[gnu::always_inline]] void project_all(EdgesInLight<T> const& edges, Kept const& kept, Four const& w_slope,
                                            Four const& w_offset) noexcept {
        Long const slope = spread<Long>(w_slope, i), offset = spread<Long>(w_offset, i);
        Span span{Long::all(far_away<T>), Long::all(-far_away<T>)};
        project(kept, Kept::near_sides, edges.along_side, i, slope, offset, span);
        project(kept, Kept::far_sides, edges.along_side, i, slope, offset, span);
        project(kept, Kept::rays, edges.along_ray, i, slope, offset, span);
        project(kept, Kept::of_box, edges.along[0], i, slope, offset, span);
        project(kept, Kept::of_box + 1, edges.along[1], i, slope, offset, span);
        project(kept, Kept::of_box + 2, edges.along[2], i, slope, offset, span);
        store_long(lo + 4 * i, span.lo);
        store_long(hi + 4 * i, span.hi);
        if constexpr (i + Long::fours < 4) project_all<i + Long::fours>(edges, kept, w_slope, w_offset);
    }
    [[gnu::always_inline]] void project(Kept const& kept, int group, HalfStep<Long> const& half, int i,
                                        Long const& slope, Long const& offset, Span& span) noexcept {
        Long const nothing = Long::all(far_away<T>), less_than_nothing = Long::all(-far_away<T>);
        Long const zero = Long::all(T(0)), w_min = Long::all(T(0.5)), kept_length = kept.at(kept.length, group, i);
        Long const length = largest(kept_length, Long::all(T(-1)));
        Long const x = kept.at(kept.x, group, i), across = half.step.x * length, ahead = half.step.z * length;
        Long const middle = where_at_most(zero, kept_length, kept.at(kept.along, group, i), less_than_nothing);
        Long const w = kept.at(kept.y, group, i) * slope + offset, growth = half.step.y * length * slope;
        Long const a = Long::all(T(1)) / largest(w - growth, w_min);
        Long const b = Long::all(T(1)) / largest(w + growth, w_min);
        Long const from = (x - across) * a, to = (x + across) * b;
        span.lo = least(span.lo, where_at_most(zero, kept_length, least(from, to), nothing));
        span.hi = largest(span.hi, where_at_most(zero, kept_length, largest(from, to), less_than_nothing));
        store_long(along[group][0] + 4 * i, middle - ahead);
        store_long(along[group][1] + 4 * i, middle + ahead);
        store_long(inverse_w[group][0] + 4 * i, a);
        store_long(inverse_w[group][1] + 4 * i, b);
    }

    // The largest of (depth - first) / w.
    [[nodiscard, gnu::always_inline]] Four deepest(Four const& first) const noexcept {
        T of_slices[16];
        deepest_of_all(first, of_slices);
        return largest_of(of_slices);
    }
    template <int i = 0>
    [[gnu::always_inline]] void deepest_of_all(Four const& first, T (&of_slices)[16]) const noexcept {
        Long const start = spread<Long>(first, i);
        Long most = Long::all(-far_away<T>);
        for (int group = 0; group < Kept::groups; ++group)
            for (int side = 0; side < 2; ++side)
                most = largest(most, (long_at<Long>(along[group][side] + 4 * i) - start) *
                                         long_at<Long>(inverse_w[group][side] + 4 * i));
        store_long(of_slices + 4 * i, most);
        if constexpr (i + Long::fours < 4) deepest_of_all<i + Long::fours>(first, of_slices);
    }
};

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath
