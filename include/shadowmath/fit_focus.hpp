// SPDX-License-Identifier: MIT
//
// What a map for a sun must hold, and not a corner more: the receivers that the eye sees and that something can
// shadow, and of the casters only those whose shadow it sees. Both as convex bodies, not as boxes.
//
//     focus.receivers = slice of the view  n  receivers' box  n  casters' box swept down the light
//     focus.casters   = receivers swept up to the light           half-spaces, to cull with
//     focus.depth     = from the first caster in there to the last receiver
//
// Fit any rectangle around it (fit_focus, fit_rectangle). Points outside that rectangle must read as lit: nothing that
// casts reaches them, or nobody sees them.
//
// Source: Wimmer, Scherzer, Purgathofer 2004, the body B. Departures: planes that cut instead of points that are added,
// so the swept part needs no hull; receivers that no caster reaches are left out.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/depth_range.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/fit_box.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/light_box.hpp>
#include <shadowmath/polytope.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/sweep.hpp>
#include <shadowmath/view_volume.hpp>

#include <cmath>
#include <limits>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct Focus {
    ConvexBody<T> receivers;  // world
    HalfSpaces<T> casters;    // world; may_meet is false only for what casts on none of them
    DepthRange<T> depth;      // metres along the light, from the world origin
    T first_receiver = T(0);  // where the depth may begin if casters are pancaked
    bool visible = false;     // false: nobody sees a shadow here
};

// Every point of the slice inside `receivers` and below anything inside `casters` is in focus, and so is everything of
// `casters` between it and the light; `padding` widens the casters' half-spaces only. Depth is no more than what those
// span, but for rounding. Not visible: a spot, a light or view with faults, an endless slice, or something beyond 1e12
// m; and where nothing is seen or nothing casts on it. Casters higher above the slice than 65536 times its size, and
// not below that, are cut.
template <class T>
[[nodiscard]] inline Focus<T> focus_of(ViewVolume<T> const& slice, Light<T> const& light, Aabb<T> const& casters,
                                       Aabb<T> const& receivers, SweepPadding<T> const& padding = {}) noexcept {
    Focus<T> focus;
    constexpr T eps = std::numeric_limits<T>::epsilon();
    constexpr T farthest = T(1e12);
    bool const usable = light.kind == LightKind::directional && !unusable(light) && !faults_of(slice).any() &&
                        !is_positive_infinity(&slice.z_far) && all_finite(casters) && all_finite(receivers) &&
                        !is_empty(casters) && !is_empty(receivers);
    if (!usable) return focus;
    if (!detail::sides_are_within(slice, farthest) || !(slice.z_far <= farthest) ||
        !(detail::largest_of(slice.pose.position) <= farthest))
        return focus;
    Vec3<T> const eye = slice.pose.position, travel = light.direction;
    Vec4<T> const down(travel, T(0));
    Aabb<T> const seen = bounds_of(corners(slice));
    T const size = detail::largest_of(seen.hi - seen.lo);
    Vec3<T> const reach(T(65536) * size);
    Aabb<T> const cast_box = intersect(casters, Aabb<T>{seen.lo - reach, seen.hi + reach});
    if (is_empty(cast_box)) return focus;
    // Sixteen roundings stand behind a vertex: a plane, a cut, and the eye's own place. Those of casters are larger.
    T const slack = T(16) * eps * (size + detail::largest_of(seen) + detail::largest_of(eye));
    T const far_slack = slack + T(16) * eps * detail::largest_of(cast_box);

    ConvexBody<T> const casting = convex_body(cast_box);
    focus.receivers = clipped(translated(visible_body(slice, receivers, slack), eye),
                              swept_to_light(casting, -down, SweepPadding<T>{far_slack, T(0)}));
    ConvexBody<T> const shadowing =
        clipped(casting, swept_to_light(focus.receivers, down, SweepPadding<T>{far_slack, T(0)}));
    if (shadowing.edge_count == 0) return focus;
    T first = std::numeric_limits<T>::max(), last = std::numeric_limits<T>::lowest(), caster = first;
    for_each_vertex(focus.receivers, [&](Vec3<T> const& v) {
        first = std::fmin(first, glm::dot(travel, v));
        last = std::fmax(last, glm::dot(travel, v));
    });
    for_each_vertex(shadowing, [&](Vec3<T> const& v) { caster = std::fmin(caster, glm::dot(travel, v)); });
    detail::widen(first, last, std::fmax(T(2) * slack, T(1e-6)));
    focus.first_receiver = first - slack;
    focus.depth = {std::fmin(focus.first_receiver, caster - far_slack), last + slack, true};
    SweepPadding<T> wide = padding;
    wide.metres = std::fmax(wide.metres, T(0)) + slack;
    focus.casters = swept_to_light(focus.receivers, down, wide);
    focus.visible = true;
    return focus;
}

// The light-space box around the focus in the axes given: with sides inside those of fit_box for the whole slice, but
// for rounding. Of a focus that is not visible, the box [-1, 1]^2 x [0, 1].
template <class T>
[[nodiscard]] inline LightBox<T> fit_focus(LightBasis<T> const& basis, Focus<T> const& focus, int map_size,
                                           T margin_texels) noexcept {
    if (!focus.visible || !detail::has_unit_axes(basis)) return {};
    Aabb<T> body;
    for_each_vertex(focus.receivers, [&](Vec3<T> const& v) { body = merge(body, in_light(basis, v)); });
    LightBox<T> box = box_around(basis, body, map_size, margin_texels);
    box.depth_lo = focus.depth.lo;
    box.depth_hi = focus.depth.hi;
    return box;
}

}  // namespace v0
}  // namespace shadowmath
