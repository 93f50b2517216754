// SPDX-License-Identifier: MIT
//
// Crop: zoom a light's own projection onto a box in its NDC. In post-projective light space a sun and a spot are the
// same case, since every light ray runs along the depth axis there. fit_spot is the whole way for a spot light; for a
// sun use fit_sphere or fit_box, which need no first projection.
//
// Boxes here are in CANONICAL light NDC (clip_space.hpp): x and y in [-1, 1], y up, depth 0 at the light's near plane
// and 1 at its far one. clip_from_canonical goes to the left of everything, at the end.
//
// Source: Zhang, Sun, Nyman, GPU Gems 3 chapter 10.1.3 (2007). Departures: the split's own corners are used, not those
// of its world box; what is behind the light is cut before the division by w; the near plane of a spot comes from its
// casters, in metres, because the depth of a projection with a tiny near plane has lost them.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/depth_range.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/fit_box.hpp>
#include <shadowmath/fit_sphere.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/margin.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/region.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/view_volume.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace shadowmath {
inline namespace v0 {

// Everything in the split, and every caster between it and the light.
template <class T>
[[nodiscard]] inline Aabb<T> scene_independent_box(Aabb<T> const& split) noexcept {
    return {Vec3<T>(split.lo.x, split.lo.y, T(0)), split.hi};
}

// Only where a caster and a receiver of the split share light rays can there be a shadow. `receivers` are those of the
// split, cut to it. Points outside must read as lit. Where no ray is shared, the split's own box: harmless, and a sign
// to leave the map out.
template <class T>
[[nodiscard]] inline Aabb<T> scene_dependent_box(Aabb<T> const& split, Aabb<T> const& receivers,
                                                 Aabb<T> const& casters) noexcept {
    Aabb<T> box = intersect(intersect(split, receivers), casters);
    // Depth starts at the first caster, and need not go past the last receiver.
    box.lo.z = std::fmin(split.lo.z, casters.lo.z);
    box.hi.z = std::fmin(split.hi.z, receivers.hi.z);
    return is_empty(box) ? split : box;
}

// The box's corners go to those of the canonical clip volume; the order of depths stays. A flat box is widened to what
// the scalar type can tell apart; one that is empty or not finite gives nowhere().
template <class T>
[[nodiscard]] inline Mat4<T> crop_matrix(Aabb<T> const& box_in_ndc) noexcept {
    if (!all_finite(box_in_ndc) || is_empty(box_in_ndc)) return nowhere<T>();
    Aabb<T> box = box_in_ndc;
    T const largest = std::fmax(detail::largest_of(box), T(1));
    if (!(largest <= detail::farthest_metres<T>)) return nowhere<T>();
    for (int axis = 0; axis < 3; ++axis)
        detail::widen(box.lo[axis], box.hi[axis], T(8) * std::numeric_limits<T>::epsilon() * largest);
    Vec3<T> const extent = box.hi - box.lo, sum = box.hi + box.lo;
    return from_rows(Vec4<T>(T(2) / extent.x, T(0), T(0), -sum.x / extent.x),
                     Vec4<T>(T(0), T(2) / extent.y, T(0), -sum.y / extent.y),
                     Vec4<T>(T(0), T(0), T(1) / extent.z, -box.lo.z / extent.z), Vec4<T>(T(0), T(0), T(0), T(1)));
}

// A spot as a camera: the pyramid around its cone, from z_near to its range. z_near is brought into
// [range / 2^20, range / 2]: the first keeps depth finite, the second a volume.
template <class T>
[[nodiscard]] inline ViewVolume<T> spot_view(Light<T> const& light, T z_near) noexcept {
    LightBasis<T> const basis = light_basis(light.direction);
    T const angle = std::fmin(std::fmax(light.half_angle_radians, T(1e-3)), T(1.5));
    T const side = std::tan(angle);
    ViewVolume<T> view{{light.position, basis.x, basis.y, basis.depth},
                       -side,
                       side,
                       -side,
                       side,
                       z_near,
                       light.range,
                       ViewKind::perspective};
    view.z_near = std::fmin(std::fmax(z_near, light.range / T(1 << 20)), light.range / T(2));
    return view;
}

namespace detail {

// The far corners of the cone's pyramid: tan(1.5) is 14.1.
template <class T>
[[nodiscard]] inline bool is_within_reach(Light<T> const& light) noexcept {
    return std::fmax(T(20) * light.range, largest_of(light.position)) <= farthest_metres<T> &&
           light.range >= least_metres<T>;
}

}  // namespace detail

// The whole cone in one map. nowhere() for a light that is unusable, and for a sun.
template <class T>
[[nodiscard]] inline Mat4<T> spot_clip_from_world(Light<T> const& light, T const& z_near, ClipSpace clip) noexcept {
    if (light.kind != LightKind::spot || unusable(light) || !all_finite(&z_near, 1) || !detail::is_within_reach(light))
        return nowhere<T>();
    return clip_from_world(spot_view(light, z_near), clip);
}

// The map of what the eye sees in this slice of the lit cone: every receiver there, with `margin_texels` texels to
// spare on each side, and every caster between it and the light. Zooms in as far as slice and receivers allow, at most
// until the whole cone would be map_size maps wide.
//
// Lost: what is nearer to the light than 1/4096 of its range. An infinite z_far is cut at the end of the cone. Not
// visible, and no fault: no caster or no receiver in the lit part of the slice. Faults of slice, light and margin are
// handed on; a sun is clamped_option.
template <class T>
[[nodiscard]] inline ShadowMap<T> fit_spot(ViewVolume<T> const& slice, Light<T> const& light, Aabb<T> const& casters,
                                           Aabb<T> const& receivers, int map_size, T margin_texels,
                                           ClipSpace clip) noexcept {
    ShadowMap<T> map;
    map.clip = clip;
    map.faults = faults_of(slice) | faults_of(light) | faults_of_margin(map_size, margin_texels);
    if (light.kind != LightKind::spot) map.faults |= Fault::clamped_option;
    if (!all_finite(casters) || !all_finite(receivers)) map.faults |= Fault::not_finite;
    bool const usable = !map.faults.has(Fault::not_finite) && !map.faults.has(Fault::map_too_small) &&
                        light.kind == LightKind::spot && !unusable(light) && detail::is_within_reach(light);
    if (!usable || is_empty(casters) || is_empty(receivers)) return map;

    // Beyond the end of the cone the eye sees nothing lit.
    ViewVolume<T> seen = slice;
    ViewVolume<T> lit = spot_view(light, light.range / T(4096));
    T const end = eye_depth(slice, light.position) + light.range * (T(1) + T(1.5) * lit.right);
    if (is_positive_infinity(&slice.z_far) || end < slice.z_far) seen.z_far = end;
    if (!(seen.z_near < seen.z_far) || !(bounding_sphere(seen).radius > T(0))) return map;

    std::array<Vec3<T>, 8> const seen_corners = corners(seen);
    Aabb<T> const received = intersect(receivers, bounds_of(seen_corners));
    DepthRange<T> const receiver_depth = depths_inside(received, lit);
    if (!receiver_depth.visible) return map;
    lit.z_far = receiver_depth.hi;
    DepthRange<T> const caster_depth = lit.z_near < lit.z_far ? depths_inside(casters, lit) : DepthRange<T>{};
    if (!caster_depth.visible) return map;

    // A thousandth before the first and behind the last: room for rounding, and a volume where all lies at one depth.
    lit.z_near = std::fmin(caster_depth.lo, receiver_depth.lo) * (T(1) - T(1) / T(1024));
    lit.z_far = lit.z_far * (T(1) + T(1) / T(1024));
    Mat4<T> const canonical = clip_from_world(lit, ClipSpace{});
    // NOTE: depth is known from above, and better: a wide slice's own, cut at a tiny w, is mostly rounding.
    auto const in_cone = [&](std::array<Vec3<T>, 8> const& body) {
        Aabb<T> bounds = projected_bounds(canonical, body, lit.z_near);
        if (is_empty(bounds)) return bounds;
        bounds.lo.z = T(0);
        bounds.hi.z = T(1);
        return intersect(bounds, Aabb<T>{Vec3<T>(T(-1), T(-1), T(0)), Vec3<T>(T(1))});
    };
    Aabb<T> const split = in_cone(seen_corners);
    if (is_empty(split)) return map;
    // Casters do not narrow the sides: then every receiver would still be right, but not every one inside.
    Aabb<T> box = intersect(split, in_cone(corners(received)));
    Aabb<T> const shared = intersect(box, in_cone(corners(intersect(casters, bounds_of(corners(lit))))));
    if (is_empty(shared)) return map;
    T const usable_part = usable_texels(map_size, margin_texels) / T(map_size);
    for (int axis = 0; axis < 2; ++axis) {
        detail::widen(box.lo[axis], box.hi[axis], T(2) / T(map_size));
        detail::widen(box.lo[axis], box.hi[axis], (box.hi[axis] - box.lo[axis]) / usable_part);
    }
    map.clip_from_world = clip_from_canonical<T>(clip) * crop_matrix(box) * canonical;
    map.w_min = lit.z_near;
    map.visible = true;
    return map;
}

}  // namespace v0
}  // namespace shadowmath
