// SPDX-License-Identifier: MIT
//
// The one call: a view, a light and two boxes go in, one matrix for each cascade comes out.
//
//   view ── splits ── slices ─┬─ fit ── depth range ── matrix
//   light ── basis ───────────┘
//
//   stable      bounding sphere on a texel grid: nothing shimmers when the camera moves or turns
//   tight       light-space box: up to twice the texels, and shadow edges crawl under motion
//   rectangle   the smallest rectangle at any angle: a quarter fewer metres than tight
//   focus       the smallest around what can be seen in shadow: receivers in view that casters are above
//   warped      a perspective warp of each slice (warp.hpp): texels small near the eye within every map
//
// Use `stable` unless the camera never moves or a temporal filter hides the crawl; or for the nearest maps alone, where
// a crawl is seen most and a finer fit gains least (`steady_maps`). choose.hpp finds the rest by measuring. Every step
// is a header of its own, so a renderer that needs another order calls them itself.
//
// Source: Zhang, Sun, Nyman, GPU Gems 3 chapter 10. Departures: corners come from the sides of the view, not from an
// inverse matrix; maps are fitted to each slice directly, not cropped out of one common light projection; the stable
// fit is the minimal sphere, and its grid has integer origins.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/cascade.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/culling.hpp>
#include <shadowmath/depth_range.hpp>
#include <shadowmath/fit_box.hpp>
#include <shadowmath/fit_crop.hpp>
#include <shadowmath/fit_focus.hpp>
#include <shadowmath/fit_rectangle.hpp>
#include <shadowmath/fit_sphere.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/margin.hpp>
#include <shadowmath/polytope.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/slice.hpp>
#include <shadowmath/slice_warps.hpp>
#include <shadowmath/splits.hpp>
#include <shadowmath/texel_grid.hpp>
#include <shadowmath/view_volume.hpp>
#include <shadowmath/warp.hpp>

#include <array>
#include <cstdint>

namespace shadowmath {
inline namespace v0 {
namespace detail {

// The view with what can be mended mended: axes orthonormal, far at the shadow distance.
template <class T>
[[nodiscard]] inline ViewVolume<T> shadowed_part(ViewVolume<T> const& view, T const& shadow_distance,
                                                 Faults& faults) noexcept {
    faults |= faults_of(view);
    ViewVolume<T> part = view;
    if (faults.has(Fault::not_finite) || faults.has(Fault::bad_pose)) return part;
    part.pose = orthonormalized(view.pose);
    bool const endless = is_positive_infinity(&view.z_far);
    if (!all_finite(&shadow_distance, 1) || shadow_distance < T(0)) {
        faults |= Fault::clamped_option;
    } else if (shadow_distance > T(0) && (endless || shadow_distance < view.z_far)) {
        part.z_far = shadow_distance;
        if (!(part.z_near < part.z_far)) faults |= Fault::empty_range;
        return part;
    }
    if (endless) {
        // Somewhere shadows must end. A thousand metres, or ten thousand near distances where the unit is larger.
        part.z_far = view.z_near * T(1e4) > T(1000) ? view.z_near * T(1e4) : T(1000);
        faults |= Fault::far_clamped;
    }
    return part;
}

template <class T>
inline void fit_stable(Cascade<T>& cascade, ViewVolume<T> const& part, LightBasis<T> const& basis,
                       DepthRange<T> const& slice_depth, T previous_texel, Aabb<T> const& casters,
                       Aabb<T> const& receivers, T margin_texels, CascadeOptions<T> const& options) noexcept {
    Sphere<T> const sphere = bounding_sphere(part);
    TexelGrid<T> grid = texel_grid(basis, sphere, options.map_size, margin_texels);
    T const held = held_size(grid.texel_metres, previous_texel);
    if (grid.visible && held != grid.texel_metres) grid = grid_window(basis, sphere.center, held, options.map_size);
    cascade.map.faults |= grid.faults;
    if (!grid.visible) return;
    LightBox<T> const sides = on_grid(grid, slice_depth.lo, slice_depth.hi);
    DepthRange<T> const depth = depth_range(sides, slice_depth, casters, receivers, options.pancake);
    if (!depth.visible) return;
    cascade.map.clip_from_world = clip_from_world(grid, depth.lo, depth.hi, options.clip);
    cascade.map.visible = true;
    cascade.texel_metres = grid.texel_metres;
    cascade.depth_metres = depth.hi - depth.lo;
}

// `previous`: the same map in the last frame, or one that is not visible.
template <class T>
inline void fit_directional(Cascade<T>& cascade, CascadeFit cascade_fit, T warp_strength, ViewVolume<T> const& part,
                            Light<T> const& light, Cascade<T> const& previous, Aabb<T> const& casters,
                            Aabb<T> const& receivers, T margin_texels, CascadeOptions<T> const& options) noexcept {
    if (cascade_fit == CascadeFit::warped) {
        WarpOptions<T> const warp{options.map_size, margin_texels, warp_strength};
        cascade.map = simple_perspective_map(part, light, casters, receivers, warp, options.clip);
        return;
    }
    LightBasis<T> const basis = light_basis(light.direction);
    std::array<Vec3<T>, 8> const body = corners(part);
    LightBox<T> sides = fit_box(basis, body, options.map_size, margin_texels);
    DepthRange<T> depth{sides.depth_lo, sides.depth_hi, true};
    if (cascade_fit == CascadeFit::stable) {
        fit_stable(cascade, part, basis, depth, previous.texel_metres, casters, receivers, margin_texels, options);
        return;
    }
    Vec3<T> const previous_x = previous.map.visible ? Vec3<T>(row(previous.map.clip_from_world, 0)) : Vec3<T>(T(0));
    if (cascade_fit == CascadeFit::focus) {
        Focus<T> const focus = focus_of(part, light, casters, receivers);
        if (!focus.visible) return;
        sides = fit_rectangle(basis, focus.receivers, options.map_size, margin_texels, previous_x);
        depth = focus.depth;
        if (options.pancake) depth.lo = focus.first_receiver;
    } else {
        if (cascade_fit == CascadeFit::rectangle)
            sides = fit_rectangle(basis, convex_body(body), options.map_size, margin_texels, previous_x);
        depth = depth_range(sides, depth, casters, receivers, options.pancake);
    }
    if (!depth.visible) return;
    sides.depth_lo = depth.lo;
    sides.depth_hi = depth.hi;
    cascade.map.clip_from_world = clip_from_world(sides, options.clip);
    cascade.map.visible = true;
    Vec2<T> const texel = texel_metres(sides, options.map_size);
    cascade.texel_metres = texel.x > texel.y ? texel.x : texel.y;
    cascade.depth_metres = depth.hi - depth.lo;
}

template <class T>
[[nodiscard]] inline T strength_of(CascadeOptions<T> const& options, int map) noexcept {
    return options.warp_strength * (T(1) - options.warp_less[static_cast<unsigned>(map)]);
}

// All warped maps from `first` on at once; false, and nothing done, where they must be made one by one. `seen` is
// mended.
template <class T>
[[nodiscard]] inline bool fit_warps(Cascades<T>& cascades, int first, ViewVolume<T> const& seen, Light<T> const& light,
                                    Aabb<T> const& casters, Aabb<T> const& receivers, T margin_texels,
                                    CascadeOptions<T> const& options) noexcept {
    SliceRange<T> ranges[max_splits];
    T strengths[max_splits];
    ShadowMap<T>* maps[max_splits];
    int const count = cascades.count - first;
    bool in_range = count > 0 && light.kind == LightKind::directional;
    for (int i = 0; i < count; ++i) {
        Cascade<T>& cascade = cascades.at[first + i];
        ranges[i] = cascade.range, maps[i] = &cascade.map;
        strengths[i] = strength_of(options, first + i);
        in_range = in_range && all_finite(&strengths[i], 1) && strengths[i] >= T(0) && strengths[i] <= T(2);
    }
    if (!in_range) return false;
    WarpInputs<T> const in{
        seen,        safe_normalize(light.direction).direction, faults_of(light), options.map_size, margin_texels,
        options.clip};
    return warp_slices(in, ranges, strengths, count, casters, receivers, maps);
}

}  // namespace detail

// Every point that the eye can see up to the shadow distance and that lies in `receivers` is inside the map of its
// slice, filter margin included, in any clip convention; every caster of `casters` on its way to the light is in that
// map. With CascadeFit::stable and an unmoving light, a world point keeps its place within a texel whatever the camera
// does. With CascadeFit::focus, points that no ray of light reaches through `casters` are left out; they read as lit.
// `casters` and `receivers` are world boxes; either empty: no map is visible, and that is no fault. `previous`, if not
// null: the last frame's. Rectangles keep its angle while that is nearly as good, and stable maps its size while that
// is not a quarter too much: so a slow zoom does not set all shadows crawling.
template <class T>
[[nodiscard]] inline Cascades<T> fit_cascades(ViewVolume<T> const& view, Light<T> const& light, Aabb<T> const& casters,
                                              Aabb<T> const& receivers, CascadeOptions<T> const& options,
                                              Cascades<T> const* previous = nullptr) noexcept {
    Cascades<T> cascades;
    Faults faults = faults_of(light);
    ViewVolume<T> const seen = detail::shadowed_part(view, options.shadow_distance, faults);
    if (!all_finite(casters) || !all_finite(receivers)) faults |= Fault::not_finite;
    bool const unusable_view = faults.has(Fault::not_finite) || faults.has(Fault::bad_frustum) ||
                               faults.has(Fault::bad_pose) || faults.has(Fault::empty_range);
    if (unusable_view || unusable(light)) {
        cascades.faults = faults;
        return cascades;
    }
    bool const pinned = !(options.first_split_end == T(0));
    Splits<T> const splits =
        pinned ? pinned_splits(seen.z_near, seen.z_far, options.count, options.first_split_end, options.lambda)
               : practical_splits(seen.z_near, seen.z_far, options.count, options.lambda);
    // One texel more than the kernel needs: the texel that holds the point may be cut by the map's side.
    T const margin_texels = T(detail::kernel_radius(options, faults) + 1);
    faults |= faults_of_margin(options.map_size, margin_texels);
    if (faults.has(Fault::map_too_small)) {
        cascades.faults = faults;
        return cascades;
    }
    T blend = options.blend;
    if (!all_finite(&options.blend, 1) || blend < T(0) || blend > T(1)) {
        blend = all_finite(&options.blend, 1) && blend > T(1) ? T(1) : T(0);
        faults |= Fault::clamped_option;
    }
    cascades.count = splits.count;
    cascades.faults = faults | splits.faults;
    for (int i = 0; i < splits.count; ++i) {
        cascades.at[i].range = slice_range(splits, i, blend);
        cascades.at[i].map.clip = options.clip;
    }
    if (is_empty(casters) || is_empty(receivers)) return cascades;
    int alone = splits.count;  // so many of the first are made one by one
    if (options.fit == CascadeFit::warped) {
        int const steady = options.steady_maps < 0 ? 0 : (options.steady_maps < alone ? options.steady_maps : alone);
        if (detail::fit_warps(cascades, steady, seen, light, casters, receivers, margin_texels, options))
            alone = steady;
    }
    for (int i = 0; i < alone; ++i) {
        Cascade<T>& cascade = cascades.at[i];
        ViewVolume<T> const part = slice(seen, cascade.range);
        if (light.kind == LightKind::directional) {
            Cascade<T> const last = previous != nullptr && i < previous->count ? previous->at[i] : Cascade<T>{};
            CascadeFit const cascade_fit = i < options.steady_maps ? CascadeFit::stable : options.fit;
            T const strength = detail::strength_of(options, i);
            detail::fit_directional(cascade, cascade_fit, strength, part, light, last, casters, receivers,
                                    margin_texels, options);
        } else {
            cascade.map = fit_spot(part, light, casters, receivers, options.map_size, margin_texels, options.clip);
        }
    }
    for (Cascade<T> const& cascade : cascades) cascades.faults |= cascade.map.faults;
    return cascades;
}

// For caster_mask: bit i is cascade i.
template <class T>
[[nodiscard]] inline CasterMaps<T> caster_maps(Cascades<T> const& cascades) noexcept {
    CasterMaps<T> maps;
    for (Cascade<T> const& cascade : cascades) add_map(maps, cascade.map);
    return maps;
}

}  // namespace v0
}  // namespace shadowmath
