// SPDX-License-Identifier: MIT
//
// Views, lights and boxes from bytes. Good ones are what a contract asks for; spoilt ones are good ones of which up to
// three numbers were replaced by anything.
#pragma once

#include "tests/fuzz/case.hpp"

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/view_volume.hpp>

namespace shadowmath::fuzz {

template <class T>
Vec3<T> point_within(Case& c, T radius) {
    T const x = c.uniform<T>(-radius, radius);
    T const y = c.uniform<T>(-radius, radius);
    T const z = c.uniform<T>(-radius, radius);
    return Vec3<T>(x, y, z);
}

template <class T>
Vec3<T> any_vector(Case& c) {
    T const x = c.number<T>();
    T const y = c.number<T>();
    T const z = c.number<T>();
    return Vec3<T>(x, y, z);
}

template <class T>
Vec3<T> direction(Case& c) {
    Normalized<T> const unit = safe_normalize(point_within<T>(c, T(1)));
    return unit.ok ? unit.direction : Vec3<T>(T(0), T(1), T(0));
}

template <class T>
Vec3<T> in_box(Case& c, Aabb<T> const& box) {
    Vec3<T> const share = point_within<T>(c, T(0.5)) + T(0.5);
    return box.lo * (Vec3<T>(T(1)) - share) + box.hi * share;
}

template <class T>
ViewVolume<T> good_view(Case& c) {
    Vec3<T> const position = point_within<T>(c, T(100));
    Vec3<T> const forward = point_within<T>(c, T(1));
    Vec3<T> const rough_up = point_within<T>(c, T(1));
    ViewVolume<T> view;
    view.pose = pose_looking(position, forward, rough_up);
    view.kind = c.one_in(4) ? ViewKind::orthographic : ViewKind::perspective;
    T const half = view.kind == ViewKind::perspective ? c.magnitude<T>(-3, 2) : c.magnitude<T>(0, 7);
    T const aspect = c.uniform<T>(T(0.5), T(2));
    T const x = c.one_in(3) ? half * c.uniform<T>(T(-1), T(1)) : T(0);
    T const y = c.one_in(3) ? half * c.uniform<T>(T(-1), T(1)) : T(0);
    view.left = x - half * aspect;
    view.right = x + half * aspect;
    view.bottom = y - half;
    view.top = y + half;
    view.z_near = c.magnitude<T>(-5, 2);
    view.z_far = view.z_near * c.magnitude<T>(1, 10);
    return view;
}

template <class T>
void spoil(Case& c, ViewVolume<T>& view) {
    Pose<T>& pose = view.pose;
    Vec3<T>* const vectors[] = {&pose.position, &pose.right, &pose.up, &pose.forward};
    T* const scalars[] = {&view.left, &view.right, &view.bottom, &view.top, &view.z_near, &view.z_far};
    int const replaced = 1 + c.below(3);
    for (int i = 0; i < replaced; ++i) {
        int const field = c.below(18);
        (field < 12 ? (*vectors[field / 3])[field % 3] : *scalars[field - 12]) = c.number<T>();
    }
}

template <class T>
Light<T> good_sun(Case& c) {
    Vec3<T> const travel = point_within<T>(c, T(1));
    Light<T> const light = directional(travel);
    return unusable(light) ? Light<T>{} : light;
}

template <class T>
Light<T> any_light(Case& c) {
    Vec3<T> const position = any_vector<T>(c);
    Vec3<T> const axis = any_vector<T>(c);
    T const half_angle_radians = c.number<T>();
    T const range = c.number<T>();
    Light<T> light = c.one_in(2) ? spot(position, axis, half_angle_radians, range) : directional(axis);
    if (c.one_in(4)) light.direction = any_vector<T>(c);  // made by hand, around the door
    return light;
}

template <class T>
Aabb<T> good_box(Case& c) {
    Vec3<T> const centre = point_within<T>(c, T(100));
    T const x = c.magnitude<T>(-4, 8);
    T const y = c.magnitude<T>(-4, 8);
    T const z = c.magnitude<T>(-4, 8);
    Vec3<T> half(x, y, z);
    if (c.one_in(5)) half[c.below(3)] = T(0);
    return {centre - half, centre + half};
}

// As good_box, but near the origin and not of every size: for laws that judge by rounding.
template <class T>
Aabb<T> small_box(Case& c, T radius) {
    Vec3<T> const centre = point_within<T>(c, radius);
    Vec3<T> half = glm::abs(point_within<T>(c, radius)) + radius * T(1e-3);
    if (c.one_in(5)) half[c.below(3)] = T(0);
    return {centre - half, centre + half};
}

// A view, a point that it sees, receivers around the point, and what the view's rounding is worth.
template <class T>
struct SeenCase {
    ViewVolume<T> view;
    Vec3<T> point;
    Aabb<T> receivers;
};

template <class T>
SeenCase<T> seen_case(Case& c) {
    SeenCase<T> seen;
    seen.view = good_view<T>(c);
    ViewVolume<T>& view = seen.view;
    // What a float sees must not drown in the rounding of where it is.
    view.pose.position *= T(0.1) * view.z_near;
    if (view.kind == ViewKind::orthographic) {
        T const shrink = view.z_near / (view.top - view.bottom);
        for (T* const side : {&view.left, &view.right, &view.bottom, &view.top}) *side *= shrink;
    }
    T const across = c.uniform<T>(T(0.05), T(0.95)), up = c.uniform<T>(T(0.05), T(0.95));
    // Off the ends by more than the rounding of a point there, and more often near than far.
    T const share = c.uniform<T>(T(0.1), T(0.999));
    T const depth = view.z_near + (view.z_far - view.z_near) * share * share * share;
    seen.point = point_at(view, view.left + (view.right - view.left) * across,
                          view.bottom + (view.top - view.bottom) * up, depth);
    Vec3<T> half(T(0));
    for (int axis = 0; axis < 3; ++axis) half[axis] = c.one_in(5) ? T(0) : c.magnitude<T>(-10, 2) * depth;
    seen.receivers = {seen.point - half, seen.point + half};
    return seen;
}

template <class T>
Aabb<T> any_box(Case& c) {
    int const kind = c.below(4);
    if (kind == 0) return good_box<T>(c);
    if (kind == 1) return {};
    Vec3<T> const lo = any_vector<T>(c);
    Vec3<T> const hi = any_vector<T>(c);
    return {lo, hi};
}

inline ClipSpace any_clip(Case& c) {
    int const drawn = c.below(12);
    ClipSpace clip;
    clip.depth = static_cast<DepthOrder>(drawn % 3);
    clip.ndc_y = static_cast<YAxis>(drawn / 3 % 2);
    clip.texture_v = static_cast<YAxis>(drawn / 6);
    return clip;
}

}  // namespace shadowmath::fuzz
