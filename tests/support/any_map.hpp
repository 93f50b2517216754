// SPDX-License-Identifier: MIT
//
// A shadow map of any of the three kinds that exist, made from first principles and not by the fits: affine, warped by
// a perspective across the light, or of a spot; in any convention. With it the light that it is a map of.
#pragma once

#include "gen.hpp"

#include <shadowmath/light_box.hpp>
#include <shadowmath/shadow_map.hpp>

#include <glm/matrix.hpp>

#include <cmath>

namespace shadowmath::test {

template <class T>
struct AnyMap {
    ShadowMap<T> map;
    Light<T> light;
};

template <class T>
void showValue(AnyMap<T> const& any, std::ostream& out) {
    showValue(any.light, out);
    out << " clip ";
    showValue(any.map.clip, out);
    out << " matrix ";
    showValue(any.map.clip_from_world, out);
}

template <class T>
Mat4<T> in_convention(Mat4<T> const& canonical, ClipSpace clip) {
    return clip_from_canonical<T>(clip) * canonical;
}

// Up to 100 m from the origin, texels up to three times as long as wide.
template <class T>
rc::Gen<LightBox<T>> light_box_near_origin(Light<T> light) {
    return rc::gen::exec([=] {
        LightBox<T> box;
        box.basis = light_basis(light.direction);
        Vec3<T> const centre = *point_within<T>(T(100));
        T const half = *log_uniform<T>(T(0.5), T(200));
        T const aspect = *log_uniform<T>(T(0.35), T(3));
        T const depth = *log_uniform<T>(T(1), T(1000));
        box.lo = Vec2<T>(centre.x - half, centre.y - half * aspect);
        box.hi = Vec2<T>(centre.x + half, centre.y + half * aspect);
        box.depth_lo = centre.z - depth;
        box.depth_hi = centre.z + depth;
        return box;
    });
}

// w = 1 + p . (x, y) of the map below, |p.x| + |p.y| <= 0.8: positive all over both maps.
template <class T>
rc::Gen<Mat4<T>> warp_across() {
    return rc::gen::exec([] {
        T const x = *centred<T>(T(0.4));
        T const y = *centred<T>(T(0.4));
        Mat4<T> warp(T(1));
        warp[0][3] = x;
        warp[1][3] = y;
        warp[2][2] = T(0.2);
        return warp;
    });
}

template <class T>
rc::Gen<AnyMap<T>> any_directional_map() {
    return rc::gen::exec([] {
        AnyMap<T> any;
        any.light = *sun<T>();
        any.map.clip = *clip_space();
        any.map.visible = true;
        LightBox<T> const box = *light_box_near_origin<T>(any.light);
        Mat4<T> const warp = *warp_across<T>();
        bool const warped = *one_in(2);
        Mat4<T> const plain = clip_from_world(box, gl_zero_to_one_clip);
        any.map.clip_from_world = in_convention(warped ? warp * plain : plain, any.map.clip);
        return any;
    });
}

template <class T>
rc::Gen<AnyMap<T>> any_spot_map() {
    return rc::gen::exec([] {
        AnyMap<T> any;
        Vec3<T> const position = *point_within<T>(T(100));
        Vec3<T> const axis = *direction<T>();
        T const half_angle_radians = *log_uniform<T>(T(0.1), T(1.3));
        T const z_near = *log_uniform<T>(T(0.1), T(2));
        T const ratio = *log_uniform<T>(T(4), T(200));
        any.light = spot(position, axis, half_angle_radians, z_near * ratio);
        any.map.clip = *clip_space();
        any.map.visible = true;
        Pose<T> const pose = pose_looking(position, axis, Vec3<T>(T(0), T(1), T(0)));
        ViewVolume<T> const view = perspective_view(pose, half_angle_radians * T(2), T(1), z_near, z_near * ratio);
        any.map.clip_from_world = in_convention(clip_from_world(view, gl_zero_to_one_clip), any.map.clip);
        return any;
    });
}

template <class T>
rc::Gen<AnyMap<T>> any_map() {
    return rc::gen::exec([] {
        bool const positional = *one_in(3);
        AnyMap<T> const any = positional ? *any_spot_map<T>() : *any_directional_map<T>();
        return any;
    });
}

template <class T>
rc::Gen<ShadowMap<T>> nasty_map() {
    return rc::gen::exec([] {
        ShadowMap<T> map = (*any_map<T>()).map;
        std::uint64_t const replaced = 1 + *below(4);
        for (std::uint64_t i = 0; i < replaced; ++i) {
            auto const entry = static_cast<int>(*below(16));
            map.clip_from_world[entry / 4][entry % 4] = *nasty<T>();
        }
        bool const whole = *one_in(4);
        if (whole) map.w_min = *nasty<T>();
        return map;
    });
}

// The world point that the map has at `texture`: u, v and stored depth; the origin if it has none.
template <class T>
Vec3<T> point_at_texture(ShadowMap<T> const& map, Vec3<T> const& texture) {
    using L = long double;
    Mat4<L> const texture_from = texture_from_clip<L>(map.clip) * Mat4<L>(map.clip_from_world);
    if (glm::determinant(texture_from) == L(0)) return Vec3<T>(T(0));
    Vec4<L> const world = glm::inverse(texture_from) * Vec4<L>(Vec3<L>(texture), L(1));
    return world.w == L(0) ? Vec3<T>(T(0)) : Vec3<T>(Vec3<L>(world) / world.w);
}

// A point well inside the map.
template <class T>
rc::Gen<Vec3<T>> point_in(ShadowMap<T> map) {
    return rc::gen::exec([=] {
        T const u = *uniform<T>(T(0.05), T(0.95));
        T const v = *uniform<T>(T(0.05), T(0.95));
        T const depth = *uniform<T>(T(0.05), T(0.95));
        return point_at_texture(map, Vec3<T>(u, v, depth));
    });
}

// Unit, turned away from the light at `point` by at most the angle whose tangent is `steepest`.
template <class T>
rc::Gen<Vec3<T>> normal_facing(Light<T> light, Vec3<T> point, T steepest) {
    return rc::gen::exec([=] {
        Vec3<T> const to_light = toward(light, point);
        Vec3<T> const aside = *direction<T>();
        T const tilt = *uniform<T>(T(0), steepest);
        Vec3<T> const across = safe_normalize(glm::cross(to_light, aside)).direction;
        return safe_normalize(to_light + across * tilt).direction;
    });
}

}  // namespace shadowmath::test
