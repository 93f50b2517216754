// SPDX-License-Identifier: MIT
//
// What cascades are: maps of one light, each with the depths that it serves, and what is asked of them. Values alone,
// for all that reads cascades (gpu.hpp, judge.hpp) or makes them in its own way (sdsm.hpp); cascades.hpp fits them.
#pragma once

#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/slice.hpp>
#include <shadowmath/splits.hpp>

#include <array>
#include <cstdint>

namespace shadowmath {
inline namespace v0 {

// What each is good for: cascades.hpp.
enum class CascadeFit : std::uint8_t { stable, tight, rectangle, focus, warped };

template <class T>
struct CascadeOptions {
    int count = 4;        // maps, 1 to max_splits
    int map_size = 2048;  // texels along one side of each
    CascadeFit fit = CascadeFit::stable;
    int steady_maps = 0;       // so many of the nearest maps are stable, whatever `fit` says
    T warp_strength = T(1);    // of CascadeFit::warped: 1 the least aliasing along the view, 0 none; see warp_less
    T lambda = T(0.5);         // of the practical splits: 1 logarithmic, 0 uniform
    T first_split_end = T(0);  // metres of eye depth at which the first split ends; 0: wherever lambda puts it
    T shadow_distance = T(0);  // metres of eye depth up to which shadows are wanted; 0: the view's far distance
    T blend = T(0.1);          // fraction of each slice that fades into the next; 0: hard seams
    int filter_radius = 1;     // half width of the PCF kernel, texels: 0, 1 (3x3), 2 (5x5), ...
    bool pancake = false;      // true: near plane at the slice, and the renderer turns depth clamp ON
    ClipSpace clip = gl_clip;  // the convention of the pass that draws the maps
    std::array<T, max_splits> warp_less{};  // the share of warp_strength that each map goes without, [0, 1]
};

template <class T>
struct Cascade {
    ShadowMap<T> map;
    SliceRange<T> range;    // metres of eye depth that it serves
    T texel_metres = T(0);  // across the light; 0 of a spot or a warped map, whose texels grow with distance
    T depth_metres = T(0);  // along the light, from depth 0 to depth 1; 0 of those
};

template <class T>
struct Cascades {
    Cascade<T> at[max_splits];
    int count = 0;  // 0: nothing to draw, everything lit
    Faults faults;  // of the inputs, and of every map

    [[nodiscard]] Cascade<T> const* begin() const noexcept { return at; }
    [[nodiscard]] Cascade<T> const* end() const noexcept { return at + count; }
};

namespace detail {

// Texels: what is asked for, brought between none and a quarter of the map.
template <class T>
[[nodiscard]] inline int kernel_radius(CascadeOptions<T> const& options, Faults& faults) noexcept {
    int const quarter = options.map_size > 0 ? options.map_size / 4 : 0, most = quarter < 64 ? quarter : 64;
    int const radius = options.filter_radius < 0 ? 0 : (options.filter_radius > most ? most : options.filter_radius);
    if (radius != options.filter_radius) faults |= Fault::clamped_option;
    return radius;
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath
