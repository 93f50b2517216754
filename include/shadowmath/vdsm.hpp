// SPDX-License-Identifier: MIT
//
// View-dependent shadow map: slide everything along the light onto a shadow plane, look at that from the EYE, keep the
// light's depth. On the plane, a texel covers the same number of eye pixels from the nearest point to the farthest.
//
//   light \   \   \                 One linear map: Q ~ (I - l pi^T / (pi.l)) P. With E the eye's matrix,
//          P   \   \       eye
//           \   \   \     /           M = [ E_x Pi ; E_y Pi ; depth ; E_w Pi ]
//     _______Q___Q___Q___/____ pi
//                                   is an ordinary 4x4, for suns and spots alike.
//
// Use it where most receivers lie near one plane: ground, water, a floor. Not for towers: a receiver well above the
// plane may be seen from the plane point BEHIND the eye that its light ray meets (w <= 0). Such receivers are not the
// map's; test receiver_valid, and light them by a second map.
//
// Source: T. Kwon, "View-dependent Shadow Maps Using Projective Geometry" (in Korean), Seoul National University, 2002;
// the relation to Chong and Gortler 2004: same x, y and w, another depth row. Departures: spots as well as suns; w is
// NOT always positive; the depth row is scaled, since as printed everything projected nearer than one unit is lost to
// the far plane, and measured from the plane, so that it spans the heights of a scene instead of its extent.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/map_rows.hpp>
#include <shadowmath/polytope.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/view_volume.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {

// The points p with normal . p + offset = 0. Neither length nor sign of the normal matters.
template <class T>
struct ShadowPlane {
    Vec3<T> normal{T(0), T(1), T(0)};
    T offset = T(0);
};

template <class T>
[[nodiscard]] inline ShadowPlane<T> plane_through(Vec3<T> const& point, Vec3<T> const& normal) noexcept {
    Vec3<T> const unit = safe_normalize(normal).direction;
    return {unit, -glm::dot(unit, point)};
}

// The thesis' choice: parallel to the ground, at the middle height of what is to receive shadows. An empty box gives
// the ground through the origin.
template <class T>
[[nodiscard]] inline ShadowPlane<T> mean_height_plane(Aabb<T> const& receivers, Vec3<T> const& ground_normal) noexcept {
    Vec3<T> const middle = is_empty(receivers) ? Vec3<T>(T(0)) : receivers.lo / T(2) + receivers.hi / T(2);
    return plane_through(middle, ground_normal);
}

// Moves points along the rays of the light onto the plane: Pi = I - l pi^T / (pi . l), so that Pi Pi = Pi and Pi l = 0.
// Signs and lengths of the plane and of `homogeneous_light` do not matter, and w stays 1 for a sun; for a spot it is
// the point's height below the light in heights of the light. The identity where the plane contains the light, or an
// input is not finite.
template <class T>
[[nodiscard]] inline Mat4<T> plane_projection(ShadowPlane<T> const& plane, Vec4<T> const& homogeneous_light) noexcept {
    if (!all_finite(plane.normal) || !all_finite(&plane.offset, 1) || !all_finite(homogeneous_light))
        return Mat4<T>(T(1));
    // Over its largest coordinate, each is as good as before and no product over- or underflows.
    auto const scaled = [](Vec4<T> const& v) {
        T const largest = glm::max(glm::max(std::abs(v.x), std::abs(v.y)), glm::max(std::abs(v.z), std::abs(v.w)));
        return largest > T(0) ? Vec4<T>(v.x / largest, v.y / largest, v.z / largest, v.w / largest) : v;
    };
    Vec4<T> const pi = scaled(Vec4<T>(plane.normal, plane.offset)), light = scaled(homogeneous_light);
    T const height = glm::dot(pi, light);
    if (!(std::abs(height) > T(1e-30))) return Mat4<T>(T(1));
    return Mat4<T>(T(1)) - glm::outerProduct(light, pi / height);
}

template <class T>
struct VdsmOptions {
    int map_size = 1024;
    T margin_texels = T(2);  // of the map kept free on each side, for the filter
    bool crop = true;        // zoom in on what the receivers need; false: the whole screen, as it is
    T w_min = T(0);          // metres of eye depth ON THE PLANE below which receivers are not the map's; 0: z_near
    T reach = T(2);          // how far beyond the screen the map goes, in half screens: receivers off the plane may
                             // project there; those beyond are not the map's. >= 1
    T least_sine = T(0.05);  // of the angle between the plane and a sun, or an orthographic view: below it,
                             // invalid_plane. >= 1e-3
};

// One map for what the view sees of the receivers, except those with w at or below `w_min`, or more than `reach` half
// screens out: near the eye's own depth a single such point would take the whole map. Everything on the plane and in
// view is the map's. Casters are drawn as they are; hardware clips those with w <= 0, of which no receiver here knows.
//
// invalid_plane, not visible: the plane has no normal, contains the light (least_sine; spots: 1e-4 of z_far), or
// passes the eye closer than 1e-4 of z_far (an orthographic eye: least_sine), or beyond 1e12 m. Then use a fit. Casters
// in the last 1/1024 of the way to a spot are cut.
template <class T>
[[nodiscard]] inline ShadowMap<T> view_dependent_map(ViewVolume<T> const& view, Light<T> const& light,
                                                     ShadowPlane<T> const& plane, Aabb<T> const& casters,
                                                     Aabb<T> const& receivers, VdsmOptions<T> const& options,
                                                     ClipSpace clip) noexcept {
    ShadowMap<T> map;
    map.clip = clip;
    Door<T> const in = door(view, light, casters, receivers, options.map_size, options.margin_texels);
    map.faults = in.faults;
    if (!all_finite(plane.normal) || !all_finite(&plane.offset, 1) || !all_finite(&options.w_min, 1) ||
        !all_finite(&options.reach, 1) || !all_finite(&options.least_sine, 1)) {
        map.faults |= Fault::not_finite;
        return map;
    }
    Normalized<T> const normal = safe_normalize(plane.normal);
    if (!normal.ok) map.faults |= Fault::invalid_plane;
    if (!normal.ok || in.stop) return map;
    T const least_sine = glm::max(options.least_sine, T(1e-3));
    if (!(options.reach >= T(1)) || options.w_min < T(0) || least_sine != options.least_sine)
        map.faults |= Fault::clamped_option;

    // All relative to the eye: there the plane is known to the last bit of the eye's height.
    ViewVolume<T> eye = in.view;
    Vec3<T> const origin = eye.pose.position;
    eye.pose.position = Vec3<T>(T(0));
    Light<T> const& lamp = in.light;
    bool const sun = lamp.kind == LightKind::directional;
    Vec4<T> const source = sun ? Vec4<T>(lamp.direction, T(0)) : Vec4<T>(origin - lamp.position, T(-1));
    Vec4<T> const pi(normal.direction, glm::dot(normal.direction, origin) + plane.offset / normal.length);
    if (!(std::abs(pi.w) <= T(1e12))) {
        map.faults |= Fault::invalid_plane;
        return map;
    }
    T const height_of_light = glm::dot(pi, source);
    T const least_height = T(1e-4) * eye.z_far;
    // An orthographic eye lies at infinity, against its viewing direction.
    bool const flat = eye.kind == ViewKind::orthographic;
    T const height_of_eye = flat ? glm::dot(normal.direction, eye.pose.forward) : pi.w;
    if (!(std::abs(height_of_eye) >= (flat ? least_sine : least_height)) ||
        !(std::abs(height_of_light) >= (sun ? least_sine : least_height))) {
        map.faults |= Fault::invalid_plane;
        return map;
    }
    // Signed distance from the plane, in light vectors: 0 on it, -1 at a spot. A row of Pi is then E - (E . l) along.
    Vec4<T> const along = pi / height_of_light;
    Mat4<T> const screen = clip_from_world(eye, ClipSpace{});
    auto const slid = [&](int r) { return row(screen, r) - along * glm::dot(row(screen, r), source); };
    MapRows<T> rows;
    rows.x = slid(0);
    rows.y = slid(1);
    rows.w = slid(3);
    rows.along = along;
    rows.source = source;
    rows.parallel = sun;
    constexpr T nearest = T(1) / T(1024);  // the nearest caster to a spot, as a part of the spot's height
    if (!sun) rows.along_floor = nearest - T(1);
    rows.w_min = flat ? nearest : eye.z_near;
    if (!(rows.w_min > T(0))) {
        rows.w_min = eye.z_far / T(1 << 20);
        map.faults |= Fault::near_clamped;
    }
    if (options.w_min > T(0)) rows.w_min = glm::max(options.w_min, rows.w_min / T(1024));
    rows.least_width = T(2) / T(options.map_size);
    rows.crop = options.crop;

    ConvexBody<T> body = visible_body(in.view, receivers);
    Vec4<T> const one(T(0), T(0), T(0), T(1));
    if (!sun) {
        body = clipped(body, along - one * rows.along_floor);
        // The pyramid around the cone: beyond it nothing is lit.
        LightBasis<T> const axes = light_basis(lamp.direction);
        T const slope = std::tan(lamp.half_angle_radians);
        for (Vec3<T> const& side : {axes.x, -axes.x, axes.y, -axes.y}) {
            Vec3<T> const inward = safe_normalize(axes.depth * slope - side).direction;
            body = clipped(body, Vec4<T>(inward, glm::dot(inward, Vec3<T>(source))));
        }
        body = clipped(body, Vec4<T>(-axes.depth, lamp.range - glm::dot(axes.depth, Vec3<T>(source))));
    }
    body = clipped(body, rows.w - one * rows.w_min);
    // What lies beyond the reach takes no part: neither in the region nor in the scale of depth.
    Vec4<T> const edge = rows.w * (options.crop ? glm::max(options.reach, T(1)) : T(1));
    for (Vec4<T> const& side : {edge - rows.x, edge + rows.x, edge - rows.y, edge + rows.y}) body = clipped(body, side);
    Faults const before = map.faults;
    map = map_from_rows(rows, origin, body, casters, options.map_size, options.margin_texels, clip);
    map.faults |= before;
    return map;
}

// Whether the map can answer for a receiver at all; where it can, the usual test of its sides still applies.
template <class T>
[[nodiscard]] inline bool receiver_valid(ShadowMap<T> const& map, Vec3<T> const& point) noexcept {
    return map.visible && glm::dot(row(map.clip_from_world, 3), Vec4<T>(point, T(1))) > map.w_min;
}

}  // namespace v0
}  // namespace shadowmath
