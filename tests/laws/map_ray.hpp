// SPDX-License-Identifier: MIT
//
// Laws of the ray that is read from a map: it is the light's, and along it the texel stays and depth grows.
#pragma once

#include "tests/laws/shadow_map.hpp"

#include <shadowmath/map_ray.hpp>

namespace shadowmath::laws {

// A unit direction or none, whatever the matrix; an angle in [0, pi].
template <class T>
[[nodiscard]] bool is_ray(MapRay<T> const& ray) {
    T const length = glm::length(ray.direction);
    return all_finite(ray.direction) &&
           (ray.ok ? std::abs(length - T(1)) <= T(8) * std::numeric_limits<T>::epsilon() : length == T(0));
}

template <class T>
[[nodiscard]] bool is_angle(T radians) {
    return all_finite(&radians, 1) && radians >= T(0) && radians <= T(3.15);
}

// The ray of a map of this light is the light's, to `tangent`.
template <class T>
[[nodiscard]] bool sees_along_its_light(ShadowMap<T> const& map, Light<T> const& light, Vec3<T> const& point,
                                        T tangent) {
    MapRay<T> const ray = map_ray(map, point);
    return ray.ok && glm::length(ray.direction + toward(light, point)) <= tangent &&
           light_error_radians(map, light, point) <= tangent;
}

// A step along the ray stays in its texel and goes deeper; both in long double, as the map's own matrix has them.
template <class T>
[[nodiscard]] bool keeps_texel_and_gains_depth(ShadowMap<T> const& map, MapRay<T> const& ray, Vec3<T> const& point,
                                               long double step, long double ndc) {
    Mat4<long double> const canonical =
        canonical_from_clip<long double>(map.clip) * Mat4<long double>(map.clip_from_world);
    auto const place = [&](long double way) {
        Vec3<long double> const at = Vec3<long double>(point) + Vec3<long double>(ray.direction) * way;
        Vec4<long double> const image = canonical * Vec4<long double>(at, 1.0L);
        return Vec3<long double>(image) / image.w;
    };
    Vec3<long double> const moved = place(step) - place(0.0L);
    return std::abs(moved.x) <= ndc && std::abs(moved.y) <= ndc && moved.z > 0.0L;
}

}  // namespace shadowmath::laws
