// SPDX-License-Identifier: MIT
//
// Perspective warps of a sun's map: texels small near the eye, large far away, in one map.
//
//   seen from the light:      \     far      /         w = 1 + (y - y_near) / a, with y along the projected view
//                              \            /          direction. All warps with one centre line are this one; they
//        eye . . . . y_near ->  \__________/           differ in a, the distance of the centre behind the near end:
//                                                      a -> infinity is the uniform map, a = z_near Stamminger's.
//
// Use it for one map and a low sun or a level view. Where light and view are parallel nothing can be gained, and the
// warp fades to a uniform map. Like every map that depends on the view it shimmers when the camera moves; cascades do
// not.
//
// Source: the "very simple perspective shadow map" of a Korean weblog (2012) in its corrected form; a as in Wimmer,
// Scherzer, Purgathofer 2004 (LiSPSM), with Scherzer's general tilt. Departures from the weblog: the whole of the map
// is filled, depth is not clipped, the centre of projection is free of the camera, and the strength follows the angle
// of the light.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/fit_crop.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/map_rows.hpp>
#include <shadowmath/polytope.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/view_volume.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {

// The warp exactly as the weblog printed it, for points of a light's NDC whose y runs along the view: rows of D3D's
// projection with y in the place of z. With w and h the width and height of the near end: y = z_near goes to 0, not to
// -1, and y = z_far to 1, so half of the map stays empty; depth above h / 2 at the near end leaves the map; y <= 0 is
// behind the centre. Here to be compared with. The identity unless 0 < z_near < z_far, w > 0 and h > 0, all finite.
template <class T>
[[nodiscard]] inline Mat4<T> printed_simple_warp(T const& w, T const& h, T const& z_near, T const& z_far) noexcept {
    bool const numbers = all_finite(&w, 1) && all_finite(&h, 1) && all_finite(&z_near, 1) && all_finite(&z_far, 1);
    if (!numbers || !(w > T(0)) || !(h > T(0)) || !(z_near > T(0)) || !(z_near < z_far)) return Mat4<T>(T(1));
    T const scale = z_far / (z_far - z_near);
    Mat4<T> const warp =
        from_rows(Vec4<T>(T(2) * z_near / w, T(0), T(0), T(0)), Vec4<T>(T(0), scale, T(0), -z_near * scale),
                  Vec4<T>(T(0), T(0), T(2) * z_near / h, T(0)), Vec4<T>(T(0), T(1), T(0), T(0)));
    return all_finite(warp) ? warp : Mat4<T>(T(1));
}

// The same, mended in its own parameters: y = z_near goes to -1 and y = z_far to 1, and depth in [0, 1] stays there. A
// body with |x| <= k y fills the width with w = 2 k z_near. The centre is still at y = 0.
template <class T>
[[nodiscard]] inline Mat4<T> corrected_simple_warp(T const& w, T const& z_near, T const& z_far) noexcept {
    bool const numbers = all_finite(&w, 1) && all_finite(&z_near, 1) && all_finite(&z_far, 1);
    if (!numbers || !(w > T(0)) || !(z_near > T(0)) || !(z_near < z_far)) return Mat4<T>(T(1));
    T const length = z_far - z_near;
    Mat4<T> const warp = from_rows(Vec4<T>(T(2) * z_near / w, T(0), T(0), T(0)),
                                   Vec4<T>(T(0), (z_far + z_near) / length, T(0), T(-2) * z_near * (z_far / length)),
                                   Vec4<T>(T(0), T(0), z_near, T(0)), Vec4<T>(T(0), T(1), T(0), T(0)));
    return all_finite(warp) ? warp : Mat4<T>(T(1));
}

// 1 / a for the a that makes the aliasing along y least: equal at both ends. `z_near`: eye depth of the near end,
// metres, > 0. `length`: of the body along y, metres, >= 0. `sine`: of the angle between view and light, [0, 1]. With
// an overhead light a = n + sqrt(n f). Goes to 0 with the sine: the reciprocal of a is what can fade.
template <class T>
[[nodiscard]] inline T optimal_inverse_centre(T z_near, T length, T sine) noexcept {
    return sine / (z_near * (T(1) + std::sqrt(T(1) + length * sine / z_near)));
}

// The warp itself, before any fit. `axes.y` points from near to far, `y_near` is where w = 1; both relative to
// the eye. `inverse_centre` = 1 / a in [0, 1 / (z_near of the eye)], 0 for the uniform map.
template <class T>
[[nodiscard]] inline MapRows<T> perspective_warp(LightBasis<T> const& axes, T y_near, T inverse_centre) noexcept {
    MapRows<T> rows;
    rows.x = Vec4<T>(axes.x, T(0));
    rows.y = Vec4<T>(axes.y, -y_near);
    rows.w = Vec4<T>(axes.y * inverse_centre, T(1) - y_near * inverse_centre);
    rows.along = Vec4<T>(axes.depth, T(0));
    rows.source = rows.along;
    rows.w_min = T(0.5);
    return rows;
}

template <class T>
struct WarpAxes {
    LightBasis<T> basis;  // y along the projected view direction
    T sine = T(0);        // of the angle between view and light
    T fade = T(0);        // of the warp: 1 from 30 degrees on, 0 below 6
};

// Light space with y along the view. As the view turns into the light its direction there fades, and what is up in the
// picture takes over: for a camera that looks down on its world, y stays where it was. No rule is continuous
// everywhere; this one turns y about only in views tilted some 6 degrees past the light, where there is no warp left to
// notice it.
template <class T>
[[nodiscard]] inline WarpAxes<T> warp_axes(Pose<T> const& eye, Vec3<T> const& travel) noexcept {
    auto const across = [&travel](Vec3<T> const& v) { return v - travel * glm::dot(travel, v); };
    constexpr T none = T(0.1), full = T(0.5);  // sines of 6 and 30 degrees
    Vec3<T> const view = across(eye.forward);
    WarpAxes<T> axes;
    axes.sine = glm::min(glm::length(view), T(1));
    T const t = glm::clamp((axes.sine - none) / (full - none), T(0), T(1));
    axes.fade = t * t * (T(3) - T(2) * t);
    axes.basis = light_basis(travel);
    // Up in the picture weighs no more than the view does where the fade begins: so the two cancel only below.
    Normalized<T> const rough = safe_normalize(view + across(eye.up) * (none * (T(1) - axes.fade)));
    // Across the light once more: what rounding left along it has grown with the normalisation.
    Normalized<T> const y = safe_normalize(across(rough.direction));
    if (!rough.ok || !y.ok) return axes;
    axes.basis.y = y.direction;
    axes.basis.x = glm::cross(travel, y.direction);
    return axes;
}

template <class T>
struct WarpOptions {
    int map_size = 1024;
    T margin_texels = T(2);  // of the map kept free on each side, for the filter
    T strength = T(1);       // [0, 1]: 1 the least aliasing along the view, 0 the uniform map
};

// One warped map of what the slice sees of the receivers, and of every caster above it; it fills the map up to the
// margin. w > 0 on all of them: w is 1 at the near end, grows from there, and is the same all along a light ray.
// Orthographic views are served uniformly, as they have no perspective to undo. Spots get the plain fit_spot.
// warp_faded tells that nothing of the warp was left; it is no fault, the map is right.
template <class T>
[[nodiscard]] inline ShadowMap<T> simple_perspective_map(ViewVolume<T> const& slice, Light<T> const& light,
                                                         Aabb<T> const& casters, Aabb<T> const& receivers,
                                                         WarpOptions<T> const& options, ClipSpace clip) noexcept {
    if (light.kind == LightKind::spot)
        return fit_spot(slice, light, casters, receivers, options.map_size, options.margin_texels, clip);
    ShadowMap<T> map;
    map.clip = clip;
    Door<T> const in = door(slice, light, casters, receivers, options.map_size, options.margin_texels);
    map.faults = in.faults;
    if (!all_finite(&options.strength, 1)) map.faults |= Fault::not_finite;
    if (in.stop || !all_finite(&options.strength, 1)) return map;
    T const strength = glm::clamp(options.strength, T(0), T(1));
    if (strength != options.strength) map.faults |= Fault::clamped_option;

    ConvexBody<T> const body = visible_body(in.view, receivers);
    if (body.edge_count == 0) return map;
    WarpAxes<T> const axes = warp_axes(in.view.pose, in.light.direction);
    detail::Extent<T> x, y, eye_metres;
    for_each_vertex(body, [&](Vec3<T> const& p) {
        x.add(glm::dot(axes.basis.x, p));
        y.add(glm::dot(axes.basis.y, p));
        eye_metres.add(glm::dot(in.view.pose.forward, p));
    });
    T inverse_centre = T(0);
    if (in.view.kind == ViewKind::perspective) {
        if (axes.fade * strength == T(0)) map.faults |= Fault::warp_faded;
        // Nearer than 2^-20 of the far distance no ratio of depths means anything.
        T const nearest = in.view.z_far / T(1 << 20);
        if (!(in.view.z_near > T(0))) map.faults |= Fault::near_clamped;
        inverse_centre =
            strength * axes.fade * optimal_inverse_centre(glm::max(eye_metres.lo, nearest), y.hi - y.lo, axes.sine);
    }
    MapRows<T> rows = perspective_warp(axes.basis, y.lo, inverse_centre);
    rows.least_width = glm::max(x.hi - x.lo, y.hi - y.lo) / T(options.map_size);
    Faults const before = map.faults;
    map = map_from_rows(rows, in.view.pose.position, body, casters, options.map_size, options.margin_texels, clip);
    map.faults |= before;
    return map;
}

}  // namespace v0
}  // namespace shadowmath
