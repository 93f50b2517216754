// SPDX-License-Identifier: MIT
//
// The box in light space of what the eye sees in each split, measured sample by sample, merged from any number of
// tiles or threads. The second half of sample-distribution shadow maps; sdsm.hpp is the whole.
//
// A sample is a pixel and an eye depth. Its place is taken from the sides of the view: depth times a direction, never
// an inverse matrix, and relative to the eye, so a sample a metre away is exact to a micrometre wherever the eye is.
// Three products and sums a coordinate, no division: a shader rounds alike (glsl/sample_bounds.glsl).
//
// Source: Lauritzen, Salvi, Lefohn, "Sample distribution shadow maps", I3D 2011.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/slice.hpp>
#include <shadowmath/splits.hpp>
#include <shadowmath/view_volume.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {

// From pixels to light space.
template <class T>
struct SampleRays {
    LightBasis<T> basis;
    Vec3<T> eye{T(0)};      // in light space, metres from the world origin
    Vec3<T> forward{T(0)};  // the eye's axes in light space
    Vec3<T> right{T(0)};
    Vec3<T> up{T(0)};
    Vec2<T> first{T(0)};  // sides of the view at the centre of pixel (0, 0)
    Vec2<T> step{T(0)};   // from one pixel to the next
    ViewKind kind = ViewKind::perspective;
    bool usable = false;  // false: all samples lie at the world origin
    Faults faults;        // of view and light
};

// The view is seen by width * height pixels, (0, 0) at its left and bottom sides; a picture that counts rows from the
// top turns its y over first. A view or light with faults gives no rays but those faults; a pose that is nearly
// orthonormal is mended. Suns only: a spot is clamped_option.
template <class T>
[[nodiscard]] inline SampleRays<T> sample_rays(ViewVolume<T> const& view, Light<T> const& light, int width,
                                               int height) noexcept {
    SampleRays<T> rays;
    rays.faults = faults_of(view) | faults_of(light);
    if (light.kind != LightKind::directional || width < 1 || height < 1) rays.faults |= Fault::clamped_option;
    if (rays.faults.any()) return rays;
    T farthest = detail::largest_of(view.pose.position);
    for (T const side : {view.left, view.right, view.bottom, view.top}) farthest = std::fmax(farthest, std::abs(side));
    if (!(farthest <= detail::farthest_metres<T>)) {
        rays.faults = Fault::precision_lost;
        return rays;
    }
    Pose<T> const pose = orthonormalized(view.pose);
    rays.basis = light_basis(light.direction);
    rays.eye = in_light(rays.basis, pose.position);
    rays.forward = in_light(rays.basis, pose.forward);
    rays.right = in_light(rays.basis, pose.right);
    rays.up = in_light(rays.basis, pose.up);
    rays.step = Vec2<T>((view.right - view.left) / T(width), (view.top - view.bottom) / T(height));
    rays.first = Vec2<T>(view.left, view.bottom) + rays.step * T(0.5);
    rays.kind = view.kind;
    rays.usable = true;
    return rays;
}

namespace detail {

template <class T>
[[nodiscard]] inline Vec3<T> from_eye(SampleRays<T> const& rays, Vec2<T> const& side, T depth) noexcept {
    Vec3<T> const aside = rays.right * side.x + rays.up * side.y;
    return rays.kind == ViewKind::perspective ? (rays.forward + aside) * depth : rays.forward * depth + aside;
}

}  // namespace detail

// Light space relative to the eye, metres.
template <class T>
[[nodiscard]] inline Vec3<T> from_eye(SampleRays<T> const& rays, int x, int y, T depth) noexcept {
    return detail::from_eye(rays, rays.first + rays.step * Vec2<T>(T(x), T(y)), depth);
}

// One box a split. A sample near a plane counts for both neighbours: whoever looks it up may compute its depth a little
// differently.
template <class T>
struct SampleBounds {
    SliceRange<T> range[max_splits];  // metres of eye depth
    Aabb<T> box[max_splits];          // light space relative to the eye; empty where nothing is seen
    int count = 0;
    Faults faults;  // of the splits
};

// No samples yet. `blend` as for slice_range.
template <class T>
[[nodiscard]] inline SampleBounds<T> no_bounds(Splits<T> const& splits, T blend = T(0)) noexcept {
    SampleBounds<T> bounds;
    bounds.count = splits.count;
    bounds.faults = splits.faults;
    for (int i = 0; i < splits.count; ++i) bounds.range[i] = slice_range(splits, i, blend);
    return bounds;
}

// True for a depth that the range holds, to 2^-12 of the depth itself.
template <class T>
[[nodiscard]] inline bool is_served(SliceRange<T> const& range, T depth) noexcept {
    return depth * (T(1) + T(0x1p-12)) >= range.begin && depth * (T(1) - T(0x1p-12)) < range.end;
}

// Takes in the sample of pixel (x, y) at an eye depth in metres. Depths that no_depths would not have counted, NaN
// among them, are left out.
template <class T>
inline void add(SampleBounds<T>& bounds, SampleRays<T> const& rays, int x, int y, T const& depth) noexcept {
    if (bounds.count == 0 || !all_finite(&depth, 1)) return;
    if (!(depth >= bounds.range[0].begin && depth < bounds.range[bounds.count - 1].end)) return;
    Vec3<T> const point = from_eye(rays, x, y, depth);
    for (int i = 0; i < bounds.count; ++i)
        if (is_served(bounds.range[i], depth)) bounds.box[i] = merge(bounds.box[i], point);
}

// Takes in all that a tile may hold: its whole cell of the picture from the nearest to the farthest eye depth in it, as
// a depth pyramid has them. `rays` are those of a picture with a pixel for each tile. Depths that are no numbers, and
// nearest > farthest, are no tile; what lies outside all splits is left out.
template <class T>
inline void add_tile(SampleBounds<T>& bounds, SampleRays<T> const& rays, int x, int y, T const& nearest,
                     T const& farthest) noexcept {
    if (!all_finite(&nearest, 1) || !all_finite(&farthest, 1)) return;
    Vec2<T> const middle = rays.first + rays.step * Vec2<T>(T(x), T(y));
    for (int i = 0; i < bounds.count; ++i) {
        T const begin = bounds.range[i].begin * (T(1) - T(0x1p-12)), end = bounds.range[i].end * (T(1) + T(0x1p-12));
        T const first = nearest > begin ? nearest : begin, last = farthest < end ? farthest : end;
        if (!(first <= last)) continue;
        for (T const depth : {first, last})
            for (T const u : {T(-0.5), T(0.5)})
                for (T const v : {T(-0.5), T(0.5)})
                    bounds.box[i] =
                        merge(bounds.box[i], detail::from_eye(rays, middle + rays.step * Vec2<T>(u, v), depth));
    }
}

// Takes in all samples of another part of the same view, cut by the same splits. Order and grouping of parts never
// matter, not by a bit.
template <class T>
inline void add(SampleBounds<T>& bounds, SampleBounds<T> const& part) noexcept {
    for (int i = 0; i < bounds.count; ++i) bounds.box[i] = merge(bounds.box[i], part.box[i]);
}

}  // namespace v0
}  // namespace shadowmath
