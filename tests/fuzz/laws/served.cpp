// SPDX-License-Identifier: MIT
//
// A point in view and a caster on its light ray: every technique holds both, in their order, and a judge adds up.
#include "tests/fuzz/inputs.hpp"
#include "tests/laws/fit_crop.hpp"
#include "tests/laws/judge.hpp"
#include "tests/laws/vdsm.hpp"
#include "tests/laws/warp.hpp"

#include <shadowmath/choose.hpp>
#include <shadowmath/plane_choice.hpp>

namespace shadowmath::fuzz {
namespace {

template <class T>
void require_served(Case& c, ShadowMap<T> const& map, Light<T> const& light, Vec3<T> const& point,
                    Vec3<T> const& caster, T margin_ndc) {
    c.require(laws::harmless(map) && map.visible, "what is seen has a map");
    c.require(laws::is_map_of(map.clip_from_world, light, map.clip, 256), "a map is a map of its light");
    c.require(laws::serves(map, point, margin_ndc) && laws::serves(map, caster, margin_ndc),
              "a point in view and its caster are inside");
    c.require(laws::keeps_the_order(map, caster, point), "the caster is before the point");
}

template <class T>
void try_warp(Case& c) {
    SeenCase<T> const seen = seen_case<T>(c);
    Light<T> const sun = good_sun<T>(c);
    WarpAxes<T> const axes = c.call([&] { return warp_axes(seen.view.pose, sun.direction); });
    c.require(laws::is_a_basis_along_the_view(axes, seen.view.pose), "the axes of a warp are a basis");
    T const distance = c.magnitude<T>(-10, 7) * glm::length(seen.point - seen.view.pose.position);
    Vec3<T> const caster = seen.point - sun.direction * distance;
    WarpOptions<T> options;
    options.strength = c.uniform<T>(T(0), T(2));
    options.rule = static_cast<WarpRule>(c.below(3));
    options.focus_metres = distance;
    ShadowMap<T> const map = c.calm_call([&] {
        return simple_perspective_map(seen.view, sun, merge(seen.receivers, caster), seen.receivers, options,
                                      any_clip(c));
    });
    require_served(c, map, sun, seen.point, caster, T(2) * options.margin_texels / T(options.map_size));
    c.hash(map.clip_from_world);
}

template <class T>
void try_plane(Case& c) {
    SeenCase<T> const seen = seen_case<T>(c);
    Light<T> const sun = good_sun<T>(c);
    Vec3<T> const normal = direction<T>(c);
    ShadowPlane<T> const plane = plane_through(seen.point, normal);
    bool const flat = seen.view.kind == ViewKind::orthographic;
    Vec3<T> const ray = seen.point - seen.view.pose.position;
    // Neither along the light nor through the eye.
    if (!(std::abs(glm::dot(normal, sun.direction)) > T(0.06))) return;
    if (!(std::abs(flat ? glm::dot(normal, seen.view.pose.forward) : glm::dot(normal, ray)) >
          (flat ? T(0.06) : T(2e-4) * seen.view.z_far)))
        return;
    c.require(laws::projects_onto(plane, homogeneous(sun), seen.point), "the plane's matrix projects onto it");
    Vec3<T> const caster = seen.point - sun.direction * (c.magnitude<T>(-10, 7) * glm::length(ray));
    VdsmOptions<T> const options;
    ShadowMap<T> const map = c.calm_call([&] {
        return view_dependent_map(seen.view, sun, plane, merge(seen.receivers, caster), seen.receivers, options,
                                  any_clip(c));
    });
    require_served(c, map, sun, seen.point, caster, T(2) * options.margin_texels / T(options.map_size));
    c.hash(map.clip_from_world);
}

template <class T>
void try_lamp(Case& c) {
    ViewVolume<T> view = good_view<T>(c);
    T const angle = c.uniform<T>(T(0.05), T(1.4)), range = c.uniform<T>(T(1), T(50));
    Vec3<T> const place = point_within<T>(c, T(10)), axis = direction<T>(c);
    Light<T> const lamp = spot(place, axis, angle, range);
    Vec3<T> const spread = point_within<T>(c, angle * T(0.2));
    Vec3<T> const point = lamp.position + (lamp.direction + spread) * (c.uniform<T>(T(0.01), T(0.9)) * range);
    Vec3<T> const eye = point_within<T>(c, T(10));
    view.pose = pose_looking(eye, point - eye, direction<T>(c));
    Vec3<T> const extent = glm::abs(point_within<T>(c, T(5)));
    Aabb<T> const receivers{point - extent, point + extent};
    Vec3<T> const caster = lamp.position + (point - lamp.position) * c.uniform<T>(T(0.05), T(0.95));
    int const size = 64 + c.below(4000);
    ShadowMap<T> const map =
        c.call([&] { return fit_spot(view, lamp, merge(receivers, caster), receivers, size, T(2), any_clip(c)); });
    c.require(laws::harmless(map) && !map.faults.any(), "a lamp's map is harmless");
    // The law's own volumes have no rounding to spare: stay clear of their sides.
    bool const lit =
        laws::is_seen_and_lit(view, lamp, point) && glm::dot(lamp.direction, caster - lamp.position) > range / T(2048);
    if (!lit) return;
    c.require(map.visible, "what is seen and lit has a map");
    T const w = glm::dot(lamp.direction, point - lamp.position);
    c.require(laws::serves(map, size, T(2), point, T(1024) * std::numeric_limits<T>::epsilon() * T(size) / w),
              "what is seen and lit is inside");
    T const lo = c.uniform<T>(T(-1), T(0.9)), hi = lo + c.uniform<T>(T(0.01), T(0.1));
    c.require(laws::fills_the_map(Aabb<T>{Vec3<T>(lo, lo, T(0)), Vec3<T>(hi, hi, T(1))}), "a crop fills its map");
}

template <class T>
void try_judge(Case& c) {
    ViewVolume<T> view = good_view<T>(c);
    Light<T> const sun = good_sun<T>(c);
    Aabb<T> const world = good_box<T>(c);
    CascadeOptions<T> options;
    options.count = 1 + c.below(3);
    Cascades<T> const cascades = fit_cascades(view, sun, world, world, options);
    std::array<SurfacePoint<T>, 4> points;
    for (SurfacePoint<T>& p : points) {
        p.point = c.one_in(3) ? any_vector<T>(c) : in_box(c, world);
        p.normal = c.one_in(3) ? any_vector<T>(c) : direction<T>(c);
    }
    if (c.one_in(2)) spoil(c, view);
    Vec2<T> const pixels(c.one_in(4) ? c.number<T>() : T(800), T(600));
    Judgement<T> const judgement =
        c.call([&] { return judge(cascades, options.map_size, view, pixels, points.data(), 4); });
    c.require(laws::adds_up(judgement), "a judgement adds up");
    ShadowPlane<T> const previous{any_vector<T>(c), c.number<T>()};
    Vec3<T> const ground = any_vector<T>(c);
    T const hysteresis = c.number<T>();
    auto const choice =
        c.call([&] { return choose_plane(view, sun, points.data(), 4, ground, &previous, hysteresis); });
    c.require(!choice.visible || (all_finite(choice.plane.normal) && choice.distortion >= T(0)),
              "a chosen plane is a plane");
}

template <class T>
void try_served(Case& c) {
    switch (c.below(4)) {
        case 0: return try_warp<T>(c);
        case 1: return try_plane<T>(c);
        case 2: return try_lamp<T>(c);
        default: return try_judge<T>(c);
    }
}

[[maybe_unused]] bool const served_target =
    add_target("served", [](Case& c) { c.one_in(2) ? try_served<float>(c) : try_served<double>(c); });

}  // namespace
}  // namespace shadowmath::fuzz
