// SPDX-License-Identifier: MIT
//
// How a projective technique ends: four rows that obey the light's law become one map that fills itself with what is
// seen, and whose depth reaches from the first caster that matters to the last receiver.
//
// warp.hpp and vdsm.hpp only choose the rows. With l the light, x.l = y.l = w.l = 0 and along.l = 1, so any
//
//   depth row = k along + c w + (a constant)          keeps the order along every light ray.
//
// Which one? Depth is divided by w, and w varies over the map. The constant is chosen so that the end that a depth
// buffer counts from lies at 0 for every w: depth = k (along - first) / w, or 1 - depth = k (last - along) / w where a
// sun's depth is reversed. k is the largest for which no receiver leaves [0, 1]. Then
//   24 bits: a step of the buffer is worth 2^-24 w / k, as fine as any depth row can have it where w is least;
//   float:   the stored value falls with 1 / w as the step does, so its relative precision makes up for it.
// In OpenGL's default depth range the value passes through [-1, 1] and that gain of float is lost.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/light_box.hpp>
#include <shadowmath/margin.hpp>
#include <shadowmath/polytope.hpp>
#include <shadowmath/region.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/view_volume.hpp>

#include <cmath>
#include <limits>

namespace shadowmath {
inline namespace v0 {

// Rows of a map, RELATIVE TO THE EYE: dotted with (p - eye, 1).
template <class T>
struct MapRows {
    Vec4<T> x;
    Vec4<T> y;
    Vec4<T> w;
    Vec4<T> along;                                     // along . source = 1: grows with the light, in any unit
    Vec4<T> source;                                    // the light itself, homogeneous and relative to the eye
    bool parallel = true;                              // a sun: w is the same all along a light ray
    T along_floor = std::numeric_limits<T>::lowest();  // casters below are cut: keeps them off a spot's position
    T w_min = T(0);                                    // > 0; receivers at or below are not the map's
    T least_width = T(0);  // of the region, in units of x / w and y / w: one texel, when the receivers are a point
    bool crop = true;      // false: the region is [-1, 1]^2 as it is
};

// What every technique asks of its inputs. The map goes on only where `stop` says no.
template <class T>
struct Door {
    Faults faults;
    ViewVolume<T> view;  // with mended axes and a finite z_far
    Light<T> light;      // its direction of length 1 to the last bits
    bool stop = true;
};

template <class T>
[[nodiscard]] inline Door<T> door(ViewVolume<T> const& view, Light<T> const& light, Aabb<T> const& casters,
                                  Aabb<T> const& receivers, int map_size, T const& margin_texels) noexcept {
    Door<T> door;
    door.view = view;
    door.light = light;
    door.faults = faults_of(view) | faults_of(light) | faults_of_margin(map_size, margin_texels);
    if (!all_finite(casters) || !all_finite(receivers)) door.faults |= Fault::not_finite;
    Faults const fatal = Fault::not_finite | Fault::zero_light | Fault::empty_range | Fault::bad_frustum |
                         Fault::bad_pose | Fault::map_too_small;
    door.stop = (door.faults.bits & fatal.bits) != 0 || is_empty(casters) || is_empty(receivers);
    if (door.stop) return door;
    // No coordinate beyond it can be multiplied in a float; no scene has one.
    constexpr T farthest = T(1e12);
    auto const beyond = [](Vec3<T> const& p) {
        return !(std::abs(p.x) <= farthest && std::abs(p.y) <= farthest && std::abs(p.z) <= farthest);
    };
    if (beyond(view.pose.position) || beyond(light.position) || !(light.range <= farthest)) {
        door.faults |= Fault::precision_lost;
        door.stop = true;
        return door;
    }
    door.view.pose = orthonormalized(view.pose);
    door.light.direction = safe_normalize(light.direction).direction;
    if (is_positive_infinity(&view.z_far) || view.z_far > farthest) {
        T end = T(0);
        for (Vec3<T> const& corner : corners(receivers)) end = glm::max(end, eye_depth(door.view, corner));
        door.view.z_far = glm::min(end, farthest);
        door.faults |= Fault::far_clamped;
        door.stop = !(door.view.z_near < door.view.z_far);
    }
    // Nor one that is seen at its sides.
    if (!detail::sides_are_within(door.view, farthest)) {
        door.faults |= Fault::precision_lost;
        door.stop = true;
    }
    return door;
}

namespace detail {

template <class T>
[[nodiscard]] inline T value(Vec4<T> const& row, Vec3<T> const& point) noexcept {
    return glm::dot(Vec3<T>(row), point) + row.w;
}

// Least and largest of one number.
template <class T>
struct Extent {
    T lo = std::numeric_limits<T>::max();
    T hi = std::numeric_limits<T>::lowest();
    void add(T value) noexcept {
        lo = value < lo ? value : lo;
        hi = value > hi ? value : hi;
    }
};

// The casters in the shaft of light that the map sees, from the light down to `last`. Its sides stand out by what the
// farthest caster is rounded by, or one far above a narrow map would seem to lie beside it.
template <class T>
[[nodiscard]] inline ConvexBody<T> casters_in(MapRows<T> const& rows, Vec3<T> const& eye, Aabb<T> const& casters,
                                              T reach_metres, T last) noexcept {
    Aabb<T> const near_enough{Vec3<T>(-reach_metres), Vec3<T>(reach_metres)};
    Aabb<T> const box = intersect(Aabb<T>{casters.lo - eye, casters.hi - eye}, near_enough);
    if (is_empty(box)) return {};
    ConvexBody<T> shaft = convex_body(box);
    Vec4<T> const one(T(0), T(0), T(0), T(1));
    if (!rows.parallel) shaft = clipped(shaft, rows.along - one * rows.along_floor);
    shaft = clipped(shaft, one * last - rows.along);
    T const farthest = glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi))) + glm::length(eye);
    T const rounding = T(64) * std::numeric_limits<T>::epsilon() * farthest;
    for (Vec4<T> const& side : {rows.w - rows.x, rows.w + rows.x, rows.w - rows.y, rows.w + rows.y})
        shaft = clipped(shaft, side + one * (rounding * glm::length(Vec3<T>(side))));
    return clipped(shaft, rows.parallel ? rows.w - one * rows.w_min : rows.w);
}

}  // namespace detail

// Every vertex of `receivers` (relative to the eye) with w >= w_min lies inside the map, `margin_texels` from its
// sides, with stored depth in [0, 1]; so does every caster between it and the light; those of a sun as far as 1024
// times the receivers' distance from the eye. Farther ones need depth clamp. Not visible, and no fault: no receivers,
// or no caster above them. precision_lost: so far from the world's origin that the matrix moves by more than half a
// texel from one representable place to the next; rebase it (light_box.hpp), or use double.
template <class T>
[[nodiscard]] inline ShadowMap<T> map_from_rows(MapRows<T> rows, Vec3<T> const& eye, ConvexBody<T> const& receivers,
                                                Aabb<T> const& casters, int map_size, T margin_texels,
                                                ClipSpace clip) noexcept {
    constexpr T eps = std::numeric_limits<T>::epsilon();
    ShadowMap<T> map;
    map.clip = clip;
    if (receivers.edge_count == 0) return map;
    detail::Extent<T> x, y, w, along;
    T radius = T(0);
    for_each_vertex(receivers, [&](Vec3<T> const& p) {
        T const w_of_p = glm::max(detail::value(rows.w, p), rows.w_min);
        x.add(detail::value(rows.x, p) / w_of_p);
        y.add(detail::value(rows.y, p) / w_of_p);
        w.add(w_of_p);
        along.add(detail::value(rows.along, p));
        radius = glm::max(radius, glm::length(p));
    });
    Region<T> region;
    if (rows.crop) {
        // A side as thin as the rounding of its points is no side; 64: as many roundings stand behind a corner.
        T const steepest = glm::max(glm::length(Vec3<T>(rows.x)), glm::length(Vec3<T>(rows.y))) / w.lo;
        T const noise = T(64) * eps * (radius + glm::length(eye)) * steepest;
        region = widened(Region<T>{Vec2<T>(x.lo, y.lo), Vec2<T>(x.hi, y.hi)}, glm::max(rows.least_width, noise));
    }
    region = with_margin(region, map_size, glm::max(margin_texels, T(0)));
    // A narrow region magnifies what rounding has left of the light in a row; taken out once more, the law holds again.
    auto const zoom = [&rows](Vec4<T> const& row, T lo, T hi) {
        Vec4<T> const zoomed = row * (T(2) / (hi - lo)) - rows.w * ((hi + lo) / (hi - lo));
        return zoomed - rows.along * glm::dot(zoomed, rows.source);
    };
    rows.x = zoom(rows.x, region.lo.x, region.hi.x);
    rows.y = zoom(rows.y, region.lo.y, region.hi.y);

    T const to_light = rows.parallel ? T(0) : glm::length(Vec3<T>(rows.source));
    ConvexBody<T> const shaft = detail::casters_in(
        rows, eye, casters, T(1024) * radius + T(2) * to_light,
        along.hi + T(1e-3) * (along.hi - along.lo) + T(64) * eps * glm::max(std::abs(along.lo), std::abs(along.hi)));
    if (shaft.edge_count == 0) return map;
    for_each_vertex(shaft, [&](Vec3<T> const& p) { along.lo = glm::min(along.lo, detail::value(rows.along, p)); });
    // A thousandth of room at both ends, and a depth of at least some ulps where everything lies at one.
    T const room = (along.hi - along.lo) / T(1024) +
                   T(64) * eps * (glm::length(Vec3<T>(rows.along)) * radius + std::abs(rows.along.w));
    along.lo = glm::max(along.lo - room, rows.along_floor);
    along.hi += room;
    Vec4<T> const one(T(0), T(0), T(0), T(1));
    Vec4<T> depth;
    if (clip.depth == DepthOrder::one_to_zero && rows.parallel) {
        depth = rows.w - (one * along.hi - rows.along) * (w.lo / (along.hi - along.lo));
    } else {
        T deepest = T(0);
        for_each_vertex(receivers, [&](Vec3<T> const& p) {
            T const w_of_p = glm::max(detail::value(rows.w, p), rows.w_min);
            deepest = glm::max(deepest, (detail::value(rows.along, p) + room - along.lo) / w_of_p);
        });
        depth = (rows.along - one * along.lo) * (T(1) / deepest);
    }
    Mat4<T> const canonical_from_eye = from_rows(rows.x, rows.y, depth, rows.w);
    Mat4<T> const clip_from_world = rebased(clip_from_canonical<T>(clip) * canonical_from_eye, -eye);
    if (!all_finite(clip_from_world)) {
        map.faults = Fault::precision_lost;
        return map;
    }
    T const steepest = glm::max(glm::length(Vec3<T>(rows.x)), glm::length(Vec3<T>(rows.y))) / w.lo;
    if (eps * glm::length(eye) * steepest * T(map_size) > T(1)) map.faults |= Fault::precision_lost;
    map.clip_from_world = clip_from_world;
    map.w_min = rows.w_min;
    map.visible = true;
    return map;
}

}  // namespace v0
}  // namespace shadowmath
