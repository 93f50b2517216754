// SPDX-License-Identifier: MIT
//
// All slices of a view at once, each cut down to the receivers and warped (warp.hpp): what simple_perspective_map gives
// for each slice, some forty times as fast. For cascades under a low sun; fit_cascades calls it for CascadeFit::warped.
//
// Source: that of warp.hpp; four_warps.hpp says how. Departure: every plane is 16 epsilon of the view's reach farther
// out, since edges are bounded one by one.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/four_warps.hpp>
#include <shadowmath/lanes.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/slice.hpp>
#include <shadowmath/slices.hpp>
#include <shadowmath/splits.hpp>
#include <shadowmath/view_of_box.hpp>
#include <shadowmath/view_volume.hpp>
#include <shadowmath/warp.hpp>
#include <shadowmath/wide.hpp>

#include <cstdint>

namespace shadowmath {
inline namespace v0 {
namespace detail {

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
