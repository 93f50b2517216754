// SPDX-License-Identifier: MIT
//
// Perspective warps of a sun's map: texels small near the eye, large far away, in one map.
//
//   seen from the light:      \     far      /         w = 1 + (y - y_near) / a, with y along the projected view
//                              \            /          direction. All warps with one centre line are this one; they
//        eye . . . . y_near ->  \__________/           differ in a, the distance of the centre behind the near end:
//                                                      a -> infinity is the uniform map, a = z_near Stamminger's.
//
//   strength 0   uniform                                   the identity of the family, bit for bit
//   strength 1   the least worst error along the view      LiSPSM (Wimmer 2004): a = (n + sqrt(n f)) / sine
//   strength 2   texels as wide as pixels                  PSM (Stamminger 2002): a = n / sine; worst at the far end
//   between      Lloyd's eta + 1 (2006) above 1, a share of 1 / a below
//   trapezoid    80 % of the map up to a given depth       TSM (Martin and Tan 2004)
//   extended     w grows by a constant per metre           XPSM (Gusev 2007)
//
// PSM is here without its troubles: light from behind the viewer, which turns its depth around, and casters behind
// the eye are ordinary, as depth is measured along the light and w is 1 at the nearest receiver.
//
// Use it for one map and a low sun or a level view. Where light and view are parallel nothing can be gained, and the
// warp fades to a uniform map. Like every map that depends on the view it shimmers when the camera moves; cascades do
// not.
//
// Source: the "very simple perspective shadow map" of a Korean weblog (2012) in its corrected form; a as in the papers
// named above, LiSPSM with Scherzer's general tilt. Departures from the weblog: the whole map is filled, depth is not
// clipped, the centre of projection is free of the camera, and the strength follows the angle of the light. From the
// papers: the warped view is fitted anew, and every warp fades with the same angle.
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
#include <cstdint>

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

// The same for Lloyd's eta in [-1, 1]: -1 uniform, 0 the optimum above, 1 Stamminger's z_near / sine. Increases with
// eta.
template <class T>
[[nodiscard]] inline T lloyd_inverse_centre(T eta, T z_near, T length, T sine) noexcept {
    T const growth = length * sine / z_near, root = std::sqrt(T(1) + growth);
    T const share = eta < T(0) ? (T(1) + eta) / (T(1) + root - eta * growth) : (T(1) + eta * root) / (T(1) + root);
    return sine / z_near * share;
}

// Lloyd's fall-off of eta, for a light whose rays are `angle` radians from the view's axis: -1 while the light is
// nearly in the middle of the picture, 0 where it is well outside. `half_fov_radians`: half the view's angle in the
// plane of the light. Continuous; with the first transition mended as later engines have it.
template <class T>
[[nodiscard]] inline T lloyd_eta(T angle, T half_fov_radians) noexcept {
    constexpr T quarter_turn = T(1.57079632679489661923132169163975144L), at_edge = T(-0.2);
    T const gamma = angle > quarter_turn ? T(2) * quarter_turn - angle : angle;
    T const first = half_fov_radians / T(3), edge = half_fov_radians;
    T const last = edge + T(0.3) * (quarter_turn - edge);
    if (!(gamma > first)) return T(-1);
    if (gamma < edge)
        return (at_edge + T(1)) * (T(1) - std::cos(quarter_turn * (gamma - first) / (edge - first))) - T(1);
    if (gamma < last) return at_edge * (T(1) - std::sin(quarter_turn * (gamma - edge) / (last - edge)));
    return T(0);
}

// 1 / a that spreads the first `focus_length` metres of the body over `share` of the map; Martin and Tan's eta is this
// a. 0 where that is no more than they have anyway. `focus_length` and `length` > 0, `share` in (0, 1).
template <class T>
[[nodiscard]] inline T trapezoid_inverse_centre(T length, T focus_length, T share = T(0.8)) noexcept {
    T const inverse = (share / focus_length - T(1) / length) / (T(1) - share);
    return inverse > T(0) ? inverse : T(0);
}

// 1 / a for Gusev's w = 1 + (coefficient / sine) y, y in metres from the eye, of a body that begins at `y_near`. Where
// that is behind the eye w is kept at 0.15 or more, as his demo does.
template <class T>
[[nodiscard]] inline T extended_inverse_centre(T coefficient, T sine, T y_near) noexcept {
    T const slope = glm::clamp(coefficient, T(0), T(1e9)) / glm::max(sine, T(1e-9));
    T const most = y_near < T(0) ? T(-0.85) / y_near : slope;
    T const growth = slope < most ? slope : most;
    return growth / (T(1) + growth * y_near);
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
    Vec3<T> const rough = safe_normalize(view + across(eye.up) * (none * (T(1) - axes.fade))).direction;
    // Across the light once more: what rounding left along it has grown with the normalisation.
    Normalized<T> const y = safe_normalize(across(rough));
    if (!y.ok) return axes;
    axes.basis.y = y.direction;
    axes.basis.x = glm::cross(travel, y.direction);
    return axes;
}

enum class WarpRule : std::uint8_t { by_strength, trapezoid, extended };

template <class T>
struct WarpOptions {
    int map_size = 1024;
    T margin_texels = T(2);  // of the map kept free on each side, for the filter
    T strength = T(1);       // [0, 2]: 0 the uniform map, 1 the least aliasing along the view, 2 Stamminger's;
                             // of the other rules a factor of 1 / a
    WarpRule rule = WarpRule::by_strength;
    T focus_metres = T(20);   // trapezoid: eye depth up to which 80 % of the map go
    T coefficient = T(0.05);  // extended: what w grows by, for a metre across a light at a right angle
};

namespace detail {

// 1 / a by the rules' own measures, none of them stronger than Stamminger's.
template <class T>
[[nodiscard]] inline T inverse_centre(WarpOptions<T> const& options, T strength, T z_near, T y_near, T length,
                                      T sine) noexcept {
    T const most = sine / z_near;
    T inverse = T(0);
    if (options.rule == WarpRule::by_strength) {
        if (strength > T(1)) return lloyd_inverse_centre(strength - T(1), z_near, length, sine);
        return strength * optimal_inverse_centre(z_near, length, sine);
    }
    if (options.rule == WarpRule::trapezoid) {
        // Of eye depth, along the ground: a metre of depth is 1 / sine of light space.
        T const focus = (options.focus_metres - z_near) / glm::max(sine, T(1e-3));
        T const least = length * T(1e-3);
        if (length > T(0)) inverse = trapezoid_inverse_centre(length, focus > least ? focus : least);
    } else {
        inverse = extended_inverse_centre(options.coefficient, sine, y_near);
    }
    return glm::clamp(strength * inverse, T(0), most);
}

}  // namespace detail

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
    bool const finite =
        all_finite(&options.strength, 1) && all_finite(&options.focus_metres, 1) && all_finite(&options.coefficient, 1);
    if (!finite) map.faults |= Fault::not_finite;
    if (in.stop || !finite) return map;
    T const strength = glm::clamp(options.strength, T(0), T(2));
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
        inverse_centre = axes.fade * detail::inverse_centre(options, strength, glm::max(eye_metres.lo, nearest), y.lo,
                                                            y.hi - y.lo, axes.sine);
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
