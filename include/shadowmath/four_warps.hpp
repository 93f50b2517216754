// SPDX-License-Identifier: MIT
//
// Four warped maps at once, a map to a lane: the inside of slice_warps.hpp, and the twin of map_rows.hpp in lanes.
//
//   edges of slices and receivers    cut and bounded in light space, as slice_edges.hpp does: y and z_near say 1 / a
//   their ends                       behind the warp, x / w: the sides of the map
//   edges of the casters' box        between those sides, and the sides' own edges: where depth begins
//   the ends again                   depth / w: how far it goes
//
// The first, second and fourth take four edges of a slice at a time (warped_edges.hpp), the third a slice to a lane
// (shafts_of_light.hpp).
//
// Source: that of warp.hpp.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/lanes.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/shafts_of_light.hpp>
#include <shadowmath/slice_edges.hpp>
#include <shadowmath/view_of_box.hpp>
#include <shadowmath/warp.hpp>
#include <shadowmath/warped_edges.hpp>

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

// One row of four matrices, relative to the eye.
template <class T>
struct FourRows {
    FourVectors<T> normal;
    Lanes<T> offset;
};

// Column by column, of all four. finite[i]: what matrix i holds.
template <class T>
[[gnu::always_inline]] inline void write_rows(FourRows<T> const& x, FourRows<T> const& y, FourRows<T> const& z,
                                              FourRows<T> const& w, Vec3<T> const& eye, int count,
                                              ShadowMap<T>* const* maps, bool (&finite)[4]) noexcept {
    auto const moved = [&eye](FourRows<T> const& row) {
        return row.offset -
               (row.normal.x * all_four(eye.x) + row.normal.y * all_four(eye.y) + row.normal.z * all_four(eye.z));
    };
    Lanes<T> columns[4][4] = {{x.normal.x, y.normal.x, z.normal.x, w.normal.x},
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

// Four maps, a map to a lane; `count` of them are wanted.
template <class T>
struct FourWarps {
    using Four = Lanes<T>;
    using Row = FourRows<T>;
    WarpsOfView<T> const& view;
    Four begin, end;  // of the slices, metres of eye depth
    Four strength;    // [0, 2]
    int count;
    ShadowMap<T>* const* maps;

    static constexpr T eps = std::numeric_limits<T>::epsilon();
    [[nodiscard, gnu::always_inline]] static Four all(T value) noexcept { return all_four(value); }

    // What slices see of the receivers, in light space, relative to the eye; of one that sees nothing, lo > hi, and
    // numbers to compute with.
    struct Seen {
        Four lo, hi;
        Four x_lo, x_hi, y_lo, y_hi, first, last;
        Four nearest;  // metres of eye depth
        Four radius;   // nothing is farther from the eye

        [[nodiscard, gnu::always_inline]] Four or_none(Four const& value) const noexcept {
            return where_at_most(lo, hi, value, all(T(0)));
        }
        [[nodiscard, gnu::always_inline]] Four or_one(Four const& value) const noexcept {
            return where_at_most(lo, hi, value, all(T(1)));
        }
    };
    [[nodiscard, gnu::always_inline]] Seen see(EdgesInLight<T> const& edges, KeptEdges<T>& kept) const noexcept {
        Four const slack = all(view.seen.slack);
        ExtentsOfSlices<T> of;
        T ahead[16];
        kept.keep_all(view.seen, edges, of, ahead);
        Seen seen;
        seen.lo = least_of(of.lo[0]), seen.hi = largest_of(of.hi[0]);
        seen.x_lo = seen.or_none(seen.lo - slack), seen.x_hi = seen.or_none(seen.hi + slack);
        seen.y_lo = seen.or_none(least_of(of.lo[1]) - slack), seen.y_hi = seen.or_none(largest_of(of.hi[1]) + slack);
        seen.first = seen.or_none(least_of(of.lo[2]) - slack), seen.last = seen.or_none(largest_of(of.hi[2]) + slack);
        seen.nearest = largest(least(least_of(ahead), end), begin);
        auto const larger_end = [](Four const& a, Four const& b) { return largest(absolute(a), absolute(b)); };
        Four const x = larger_end(seen.x_lo, seen.x_hi), y = larger_end(seen.y_lo, seen.y_hi);
        Four const z = larger_end(seen.first, seen.last);
        seen.radius = root(x * x + y * y + z * z);
        return seen;
    }

    // w = slope y + offset; the slope is 1 / a of warp.hpp.
    struct Warp {
        Four slope, offset;
    };
    [[nodiscard, gnu::always_inline]] Warp warp_for(Seen const& seen) const noexcept {
        if (view.flat) return {all(T(0)), all(T(1))};
        T const sine = view.axes.sine;
        // Nearer than 2^-20 of the far distance no ratio of depths means anything.
        Four const z_near = largest(seen.nearest, end * all(T(1) / T(1 << 20))), most = all(sine) / z_near;
        Four const root_of_ratio = root(all(T(1)) + (seen.y_hi - seen.y_lo) * most);
        Four const share = least(strength, all(T(1))) + largest(strength - all(T(1)), all(T(0))) * root_of_ratio;
        Four const slope = all(view.axes.fade) * (most * share / (all(T(1)) + root_of_ratio));
        return {slope, all(T(1)) - seen.y_lo * slope};
    }

    // Of the maps: x / w, and (y - y_lo) / w.
    struct Sides {
        Four left, right, bottom, top;
    };
    [[nodiscard, gnu::always_inline]] Sides sides_of(Seen const& seen, Warp const& warp,
                                                     WarpedEnds<T> const& ends) const noexcept {
        Four const zero = all(T(0)), one = all(T(1)), slack = all(view.seen.slack), length = seen.y_hi - seen.y_lo;
        Sides of{seen.or_none(least_of(ends.lo)), seen.or_none(largest_of(ends.hi)), zero,
                 length / (one + length * warp.slope)};
        of.left = of.left - slack * (one + absolute(of.left) * warp.slope);
        of.right = of.right + slack * (one + absolute(of.right) * warp.slope);
        // As wide as a texel and as rounding may be, and a margin.
        Four const noise = (seen.radius + all(glm::length(view.eye))) * all(T(64) * eps);
        Four const texel = largest(seen.x_hi - seen.x_lo, length) * all(T(1) / view.size);
        Four const least_width = seen.or_one(largest(texel, noise));
        auto const widen = [&](Four& lo, Four& hi) {
            Four const more = largest(least_width - (hi - lo), zero) * all(T(0.5));
            lo = lo - more, hi = hi + more;
            Four const border = (hi - lo) * all(view.margin);
            lo = lo - border, hi = hi + border;
        };
        widen(of.left, of.right), widen(of.bottom, of.top);
        return of;
    }

    // Metres along the light: of the first caster between the sides, of the last receiver, and a little more than both.
    struct Depth {
        Four caster, lowest;
        Four from, to, room;
    };
    [[nodiscard, gnu::always_inline]] Depth depth_of(Seen const& seen, Warp const& warp,
                                                     Sides const& of) const noexcept {
        Four const one = all(T(1)), least_w = all(T(1e-6));
        // y of the lower and upper side: where (y - y_lo) / w is `bottom` and `top`; w >= 1/2 below.
        Four const below =
            largest(of.bottom / (one - of.bottom * warp.slope), all(T(-0.5)) / largest(warp.slope, all(T(1e-30))));
        Four const narrowing = one - of.top * warp.slope - all(T(4) * eps);
        Four const above = where_at_most(least_w, narrowing, of.top / largest(narrowing, least_w), all(far_away<T>));
        ShaftsOfLight<T> const shafts{of.left, of.right, seen.y_lo + below, seen.y_lo + above, warp.slope, warp.offset};
        LightOnBox<T> const lit(shafts, view.axes.basis, view.casters, seen.radius * all(T(1024)));
        Depth depth;
        depth.caster = lit.first_met(shafts);
        // No receiver is farther from the light than this.
        depth.lowest = seen.last + all(T(1e-3)) * (seen.last - seen.first) +
                       largest(absolute(seen.first), absolute(seen.last)) * all(T(64) * eps);
        Four const begins = where_at_most(depth.caster, depth.lowest, least(seen.first, depth.caster), seen.first);
        depth.room = (seen.last - begins) * all(T(1) / T(1024)) + seen.radius * all(T(64) * eps) + all(view.seen.slack);
        depth.from = begins - depth.room, depth.to = seen.last + depth.room;
        return depth;
    }

    [[nodiscard, gnu::always_inline]] Row x_row(Warp const& warp, Sides const& of) const noexcept {
        Vec3<T> const &across = view.axes.basis.x, &up = view.axes.basis.y;
        Four const zero = all(T(0)), width = of.right - of.left;
        Four const scale = all(T(2)) / width, shift = (of.right + of.left) / width;
        return {times(scale, across) + times(zero - warp.slope * shift, up), zero - warp.offset * shift};
    }
    [[nodiscard, gnu::always_inline]] Row y_row(Seen const& seen, Warp const& warp, Sides const& of) const noexcept {
        T const sign = view.clip.ndc_y == YAxis::up ? T(1) : T(-1);
        Four const height = of.top - of.bottom, scale = all(sign * T(2)) / height;
        Four const shift = (of.top + of.bottom) / height * all(sign);
        return {times(scale - warp.slope * shift, view.axes.basis.y),
                all(T(0)) - (seen.y_lo * scale + warp.offset * shift)};
    }
    [[nodiscard, gnu::always_inline]] Row z_row(Seen const& seen, Warp const& warp, WarpedEnds<T> const& ends,
                                                Depth const& depth) const noexcept {
        Vec3<T> const &up = view.axes.basis.y, &travel = view.axes.basis.depth;
        Four const zero = all(T(0)), one = all(T(1)), two = all(T(2));
        if (view.clip.depth == DepthOrder::one_to_zero) {
            Four const scale = one / (depth.to - depth.from);
            return {times(zero - scale, travel), depth.to * scale};
        }
        Four const scale = one / seen.or_one(ends.deepest(depth.from - depth.room));
        Row const z{times(scale, travel), zero - depth.from * scale};
        if (view.clip.depth != DepthOrder::minus_one_to_one) return z;
        return {times(two * scale, travel) + times(zero - warp.slope, up), z.offset * two - warp.offset};
    }

    // Everything about the maps but their matrices, which have been written; those that show nothing are taken back.
    [[gnu::always_inline]] void conclude(Seen const& seen, Depth const& depth, Four const& steepest,
                                         bool const (&finite)[4]) const noexcept {
        for (int i = 0; i < count; ++i) {
            ShadowMap<T>& map = *maps[i];
            map.clip = view.clip;
            map.faults = view.faults;
            map.w_min = T(0);
            map.visible = false;
            bool const body = seen.lo[i] <= seen.hi[i];
            if (body && !view.flat && view.axes.fade * strength[i] == T(0)) map.faults |= Fault::warp_faded;
            if (body && !view.flat && !(begin[i] > T(0))) map.faults |= Fault::near_clamped;
            if (!body || !(depth.caster[i] <= depth.lowest[i])) {
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

    [[gnu::always_inline]] void operator()() const noexcept {
        EdgesInLight<T> const edges(view.seen, begin, end);
        KeptEdges<T> kept;
        Seen const seen = see(edges, kept);
        Warp const warp = warp_for(seen);
        WarpedEnds<T> const ends(edges, kept, warp.slope, warp.offset);
        Sides const of = sides_of(seen, warp, ends);
        Depth const depth = depth_of(seen, warp, of);

        Row const x = x_row(warp, of), y = y_row(seen, warp, of), z = z_row(seen, warp, ends, depth);
        Row const w{times(warp.slope, view.axes.basis.y), warp.offset};
        bool finite[4];
        write_rows(x, y, z, w, view.eye, count, maps, finite);
        // Texels that the last bit of the eye's place makes.
        auto const squared = [](Vectors<Four> const& v) { return v.x * v.x + v.y * v.y + v.z * v.z; };
        Four const steepest =
            root(largest(squared(x.normal), squared(y.normal))) * all(eps * glm::length(view.eye) * view.size);
        conclude(seen, depth, steepest, finite);
    }
};

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath
