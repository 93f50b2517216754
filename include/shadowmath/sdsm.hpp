// SPDX-License-Identifier: MIT
//
// Sample-distribution shadow maps: cascades fitted to what the eye sees, pixel by pixel, instead of to all that it
// could see. In the streets of the gallery's town a texel covers 0.9 eye pixels; four tight cascades come to 1.5 and
// four stable ones to 1.8. Use them when the eye's depth is at hand before the maps are drawn: from a depth prepass,
// or from the frame before (then widen the boxes by what may have moved).
//
//   eye depths ── sample_splits ── boxes of samples ── fit_samples ── one matrix a split
//   (pass 1: SampleDepths)          (pass 2: SampleBounds)
//
//   SampleDepths<float> depths = no_depths(view.z_near, view.z_far);
//   for (pixel) add(depths, depth);
//   SampleBounds<float> bounds = no_bounds(sample_splits(depths, 4, SampleSplits::adaptive));
//   SampleRays<float> const rays = sample_rays(view, light, width, height);
//   for (pixel) add(bounds, rays, x, y, depth);
//   Cascades<float> const cascades = fit_samples(rays, bounds, casters, options);
//
// The samples have to be all of them. Every n-th pixel of a picture tells nothing of the leaf, wire or far gap between,
// and what was missed lies outside every map, lit: over the study's views (scripts/quality) one pixel in 64 as samples
// leaves some twenty thousand dark points without a map. From a small picture take the nearest and farthest depth of
// each tile, as a depth pyramid holds them, and add_tile instead of add; or choose_maps.hpp, which takes the same.
//
// glsl/sdsm.glsl is the same for compute shaders: the matrices stay in a buffer and are used from there.
//
// Under motion the boxes change with every pixel that comes into sight, and shadow edges crawl by up to a texel, which
// is a pixel or less here. With `still` the texel is one of eight sizes an octave and the map lies on a grid of whole
// texels, so that nothing crawls as long as no size changes.
//
// Source: Lauritzen, Salvi, Lefohn, "Sample distribution shadow maps", I3D 2011. Departures: each map's own box in
// light space, not a crop of one common projection; the near end is where the light enters the casters' box above the
// map's sides; still maps.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/cascade.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/fit_box.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/light_box.hpp>
#include <shadowmath/margin.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/sample_bounds.hpp>
#include <shadowmath/sample_depths.hpp>

#include <cmath>
#include <limits>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct SampleFitOptions {
    int map_size = 2048;       // texels along one side of each
    T margin_texels = T(2);    // free on every side: half the width of the PCF kernel, and one
    bool still = false;        // true: texels of quantised size on a grid
    bool pancake = false;      // true: near plane at the first sample, and the renderer turns depth clamp ON
    ClipSpace clip = gl_clip;  // the convention of the pass that draws the maps
};

// The next number up whose mantissa has four bits: eight an octave. For x > 0.
template <class T>
[[nodiscard]] inline T eighth_of_octave_up(T x) noexcept {
    int exponent = 0;
    T const mantissa = std::frexp(x, &exponent);
    return std::ldexp(std::ceil(mantissa * T(16)), exponent - 4);
}

namespace detail {

// Cosines of faces that the light runs along: they are taken to stop nothing.
template <class T>
inline constexpr T least_along = T(1e-4);

}  // namespace detail

// Metres along the light, from the world origin, at which the rays between the sides lo and hi (light space) enter the
// box: nothing of it lies before. Never later than the truth, and earlier by what the box's faces rise across the
// sides. Above the far side of the box for rays that pass it by.
template <class T>
[[nodiscard]] inline T light_entry(LightBasis<T> const& basis, Vec2<T> const& lo, Vec2<T> const& hi,
                                   Aabb<T> const& box) noexcept {
    T entry = -detail::farthest_metres<T>;
    for (int k = 0; k < 3; ++k) {
        T const along = basis.depth[k];
        if (!(std::abs(along) > detail::least_along<T>)) continue;
        // On a ray world coordinate k is across + along * depth.
        T const x0 = basis.x[k] * lo.x, x1 = basis.x[k] * hi.x, y0 = basis.y[k] * lo.y, y1 = basis.y[k] * hi.y;
        T const face = along > T(0) ? box.lo[k] : box.hi[k];
        T const across =
            along > T(0) ? (x0 > x1 ? x0 : x1) + (y0 > y1 ? y0 : y1) : (x0 < x1 ? x0 : x1) + (y0 < y1 ? y0 : y1);
        T const rounding = T(4) * std::numeric_limits<T>::epsilon() *
                           (std::abs(face) + std::abs(x0) + std::abs(x1) + std::abs(y0) + std::abs(y1));
        T const enters = ((face - across) - (along > T(0) ? rounding : -rounding)) * (T(1) / along);
        entry = enters > entry ? enters : entry;
    }
    return entry;
}

namespace detail {

// One axis of a map: NDC = scale * (light-space coordinate) + offset.
template <class T>
struct MapSide {
    T lo = T(0);  // metres
    T hi = T(0);
    T scale = T(0);
    T offset = T(0);
    T texel_metres = T(0);
};

template <class T>
[[nodiscard]] inline MapSide<T> tight_side(T lo, T hi, int map_size) noexcept {
    T const extent = hi - lo;
    return {lo, hi, T(2) / extent, -(hi + lo) / extent, extent / T(map_size)};
}

// The window of map_size quantised texels, a whole number of them from the world origin, that holds [lo, hi] and the
// margin wherever rounding puts it: half a texel to either side. Its place comes from the integer, not from metres.
template <class T>
[[nodiscard]] inline MapSide<T> still_side(T lo, T hi, int map_size, T margin_texels, Faults& faults) noexcept {
    constexpr T eps = std::numeric_limits<T>::epsilon();
    T const size = T(map_size), spare = T(1) / (usable_texels(map_size, margin_texels) - T(1)) * (T(1) + T(4) * eps);
    T const texel = eighth_of_octave_up((hi - lo) * spare);
    T const index = std::floor(T(0.5) * (lo + hi) / texel - size * T(0.5) + T(0.5));
    // As for texel_grid: a coordinate's roundings stay below a 64th of a texel.
    if (!((std::abs(index) + size) * eps <= T(1) / T(256))) faults |= Fault::precision_lost;
    return {index * texel, (index + size) * texel, T(2) / (size * texel), -(T(2) * index + size) / size, texel};
}

template <class T>
inline void fit_samples_of(Cascade<T>& cascade, SampleRays<T> const& rays, Aabb<T> const& box, Aabb<T> const& casters,
                           SampleFitOptions<T> const& options) noexcept {
    // Receivers are drawn by another pass than the depths were: their places agree to some ulp of a float.
    T const slack = T(0x1p-18) * largest_of(box);
    Aabb<T> const body{box.lo + rays.eye - slack, box.hi + rays.eye + slack};
    if (!(largest_of(body) <= farthest_metres<T>)) {
        cascade.map.faults |= Fault::precision_lost;
        return;
    }
    T const margin_texels = options.still ? T(0) : options.margin_texels;
    LightBox<T> const sides = box_around(rays.basis, body, options.map_size, margin_texels);
    auto const side = [&](int axis) {
        return options.still ? still_side(sides.lo[axis], sides.hi[axis], options.map_size, options.margin_texels,
                                          cascade.map.faults)
                             : tight_side(sides.lo[axis], sides.hi[axis], options.map_size);
    };
    MapSide<T> const x = side(0), y = side(1);
    T const entry = light_entry(rays.basis, Vec2<T>(x.lo, y.lo), Vec2<T>(x.hi, y.hi), casters);
    if (!(entry <= sides.depth_hi)) return;
    // A depth buffer tells nothing apart in more, as in depth_range. The way from the eye counts: what is seen may be a
    // single point.
    T const size = (x.hi - x.lo) + (y.hi - y.lo) + (sides.depth_hi - sides.depth_lo) + largest_of(box);
    T const deepest = sides.depth_lo - T(65536) * size;
    T const reach = options.pancake ? sides.depth_lo : (entry > deepest ? entry : deepest);
    T const depth_lo = reach < sides.depth_lo ? reach : sides.depth_lo;
    T const depth_scale = T(1) / (sides.depth_hi - depth_lo);
    Mat4<T> const canonical =
        from_rows(Vec4<T>(rays.basis.x * x.scale, x.offset), Vec4<T>(rays.basis.y * y.scale, y.offset),
                  Vec4<T>(rays.basis.depth * depth_scale, -depth_lo * depth_scale), Vec4<T>(T(0), T(0), T(0), T(1)));
    if (!all_finite(canonical)) {
        cascade.map.faults |= Fault::precision_lost;
        return;
    }
    cascade.map.clip_from_world = clip_from_canonical<T>(options.clip) * canonical;
    cascade.map.visible = true;
    cascade.texel_metres = x.texel_metres > y.texel_metres ? x.texel_metres : y.texel_metres;
    cascade.depth_metres = sides.depth_hi - depth_lo;
}

}  // namespace detail

// Every sample of a split is inside its map with margin_texels to spare on each side, and every caster of the box
// between it and the sun is in that map, whatever the clip convention. A split without samples, and samples above all
// casters, give a map that is not visible, and no fault. With `still` a world point keeps its place within a texel from
// one fit to the next, whatever the eye and the samples did, when both fits have texels of the same size.
//
// `casters` is a world box; empty: no map is visible. Suns only: a spot is clamped_option.
template <class T>
[[nodiscard]] inline Cascades<T> fit_samples(SampleRays<T> const& rays, SampleBounds<T> const& bounds,
                                             Aabb<T> const& casters, SampleFitOptions<T> const& options) noexcept {
    Cascades<T> cascades;
    cascades.faults = rays.faults | bounds.faults | faults_of_margin(options.map_size, options.margin_texels);
    if (!all_finite(casters)) cascades.faults |= Fault::not_finite;
    if (!rays.usable || cascades.faults.has(Fault::not_finite) || cascades.faults.has(Fault::map_too_small))
        return cascades;
    cascades.count = bounds.count;
    Vec3<T> const farthest(detail::farthest_metres<T>);
    Aabb<T> const reached = intersect(casters, Aabb<T>{-farthest, farthest});
    for (int i = 0; i < bounds.count; ++i) {
        Cascade<T>& cascade = cascades.at[i];
        cascade.range = bounds.range[i];
        cascade.map.clip = options.clip;
        if (!is_empty(bounds.box[i]) && !is_empty(reached))
            detail::fit_samples_of(cascade, rays, bounds.box[i], reached, options);
        cascades.faults |= cascade.map.faults;
    }
    return cascades;
}

}  // namespace v0
}  // namespace shadowmath
