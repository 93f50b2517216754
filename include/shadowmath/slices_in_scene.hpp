// SPDX-License-Identifier: MIT
//
// All slices of a view at once, each cut down to the scene: for worlds that end before the view does, and to fit maps
// to a room. What visible_body gives for each slice, bounded along the axes of the light, a hundred times as fast.
//
// Source: ours; slice_edges.hpp says how.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/lanes.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/slice_edges.hpp>
#include <shadowmath/slices.hpp>
#include <shadowmath/splits.hpp>
#include <shadowmath/view_of_box.hpp>
#include <shadowmath/view_volume.hpp>
#include <shadowmath/wide.hpp>

#include <cstdint>

namespace shadowmath {
inline namespace v0 {
namespace detail {

// bound_four_slices with a slice to a lane: light-space boxes, from the world's origin.
template <class T>
struct FourSlices {
    ViewOfBox<T> const& seen;
    T const* plane;
    FourVectors<T>& lo;
    FourVectors<T>& hi;

    [[gnu::always_inline]] void operator()() const noexcept {
        ExtentsOfSlices<T> of;
        bound_four_slices(seen, plane, of);
        // Where there is nothing, these are numbers that no eye and no slack can move.
        Lanes<T> const least_eye = seen.lit.eye - all_four(seen.slack), most_eye = seen.lit.eye + all_four(seen.slack);
        lo.x = least_of(of.lo[0]) + all_of<0>(least_eye);
        lo.y = least_of(of.lo[1]) + all_of<1>(least_eye);
        lo.z = least_of(of.lo[2]) + all_of<2>(least_eye);
        hi.x = largest_of(of.hi[0]) + all_of<0>(most_eye);
        hi.y = largest_of(of.hi[1]) + all_of<1>(most_eye);
        hi.z = largest_of(of.hi[2]) + all_of<2>(most_eye);
    }
};

// Calls visit(first, count, lo, hi) for up to four slices at a time; false, and never, where nothing can be seen.
template <class T, class Visit>
[[gnu::always_inline]] inline bool visit_slices_in_scene(ViewVolume<T> const& view, LightBasis<T> const& basis,
                                                         Splits<T> const& splits, Aabb<T> const& scene,
                                                         Visit const& visit) noexcept {
    ViewOfBox<T> seen;
    seen.pose = &view.pose;
    if (!look(basis, view, seen.lit) || !in_range(splits) ||
        !look_at_box(view, splits.plane[splits.count], scene, seen))
        return false;
    for (int first = 0; first < splits.count; first += 4) {
        int const left = splits.count - first < 4 ? splits.count - first : 4;
        T const* plane = splits.plane + first;
        T padded[5];
        if (left < 4) {
            for (int i = 0; i < 5; ++i) padded[i] = plane[i < left ? i : left];
            plane = padded;
        }
        FourVectors<T> lo, hi;
        run_widely(FourSlices<T>{seen, plane, lo, hi});
        visit(first, left, lo, hi);
    }
    return true;
}

}  // namespace detail

// in_light[i]: the box along the axes of the light (x, y, depth; metres from the world's origin) around what slice i
// sees of the scene; empty where that is nothing. Every point of both is inside, and none of it is farther out than
// what 256 epsilon of the view's reach and of its place, in metres, may add to slice and scene. Writes splits.count
// boxes, all empty where a number is not finite, a side is crossed or something lies beyond 1e12 m.
template <class T>
inline void bound_slices(ViewVolume<T> const& view, LightBasis<T> const& basis, Splits<T> const& splits,
                         Aabb<T> const& scene, Aabb<T>* in_light) noexcept {
    bool const seen =
        detail::visit_slices_in_scene(view, basis, splits, scene, [&](int first, int count, auto& lo, auto& hi) {
            for (int i = 0; i < count; ++i)
                in_light[first + i] = {Vec3<T>(lo.x[i], lo.y[i], lo.z[i]), Vec3<T>(hi.x[i], hi.y[i], hi.z[i])};
        });
    for (int i = 0; i < splits.count && !seen; ++i) in_light[i] = {};
}

// As fit_slice_boxes, for what each slice sees of the scene. Bit i of the result: slice i sees some of it; nowhere()
// where not. All of it is inside, up to `border`.
template <class T>
[[nodiscard]] inline std::uint32_t fit_slice_focus(ViewVolume<T> const& view, LightBasis<T> const& basis,
                                                   Splits<T> const& splits, Aabb<T> const& scene, T border,
                                                   ClipSpace clip, Mat4<T>* clip_from_world) noexcept {
    using Lanes = detail::Lanes<T>;
    bool const free =
        detail::order_of(border) >= detail::order_of(T(0)) && detail::order_of(border) <= detail::order_of(T(0.49));
    detail::MapInLanes<T> const map = detail::map_in_lanes(clip, free ? T(2) - T(4) * border : T(2));
    detail::ViewInLight<T> columns;
    columns.x = Lanes::of(basis.x.x, basis.y.x, basis.depth.x, T(0));
    columns.y = Lanes::of(basis.x.y, basis.y.y, basis.depth.y, T(0));
    columns.z = Lanes::of(basis.x.z, basis.y.z, basis.depth.z, T(0));
    std::uint32_t visible = 0;
    auto const write = [&](int first, int count, auto& lo, auto& hi) {
        auto const one = detail::all_four(T(1)), half = detail::all_four(T(0.5));
        Lanes scale[4] = {detail::all_four(map.extent[0]) / (hi.x - lo.x),
                          detail::all_four(map.extent[1]) / (hi.y - lo.y),
                          detail::all_four(map.extent[2]) / (hi.z - lo.z), one - one};
        Lanes moved[4] = {detail::all_four(map.middle[0]) - (lo.x + hi.x) * half * scale[0],
                          detail::all_four(map.middle[1]) - (lo.y + hi.y) * half * scale[1],
                          detail::all_four(map.middle[2]) - (lo.z + hi.z) * half * scale[2], one};
        detail::transpose(scale);
        detail::transpose(moved);
        for (int i = 0; i < count; ++i) {
            if (!(lo.x[i] <= hi.x[i])) {  // nothing is nothing on every axis
                clip_from_world[first + i] = nowhere<T>();
                continue;
            }
            detail::write_columns(columns, scale[i], moved[i], clip_from_world[first + i]);
            visible |= 1u << (first + i);
        }
    };
    if (free && detail::visit_slices_in_scene(view, basis, splits, scene, write)) return visible;
    for (int i = 0; i < splits.count; ++i) clip_from_world[i] = nowhere<T>();
    return 0;
}

}  // namespace v0
}  // namespace shadowmath
