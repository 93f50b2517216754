// SPDX-License-Identifier: MIT
//
// The light that a matrix is a map of, read from the matrix: the way in which depth grows and the texel stays the same.
// For checking at run time, against the light that it was meant for, any matrix from anywhere: a map that was not
// redrawn when the sun moved, one that was transposed on its way to the shader, a light given as the way to it.
//
// It is the law of shadow maps, M * light = (0, 0, k, 0), asked at a point: NDC x = X.p / W.p is still along a
// direction that is at a right angle to X - x W, and so for y; the cross product of the two is the ray.
#pragma once

#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/tangent.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct MapRay {
    Vec3<T> direction{T(0)};  // world, unit: the way the light goes there; zero when `ok` is false
    bool ok = false;
};

// The same for every scale of the matrix and in every convention, its depth order included. Not ok where the map does
// not hold the point (w), and where it has no ray: a singular matrix, or one whose depth is the same along it.
template <class T>
[[nodiscard]] inline MapRay<T> map_ray(ShadowMap<T> const& map, Vec3<T> const& point) noexcept {
    Projected<T> const at = projected(map.clip_from_world, point, map.w_min);
    if (!at.in_front) return {};
    Vec3<T> const w(row(map.clip_from_world, 3));
    Vec3<T> const x = Vec3<T>(row(map.clip_from_world, 0)) - w * at.at.x;
    Vec3<T> const y = Vec3<T>(row(map.clip_from_world, 1)) - w * at.at.y;
    Vec3<T> const across = glm::cross(safe_normalize(x).direction, safe_normalize(y).direction);
    Normalized<T> const ray = safe_normalize(across);
    if (!ray.ok || !(ray.length > T(1e-6))) return {};
    T const gain = gain_along(map.clip_from_world, at, ray.direction).z;
    if (!all_finite(&gain, 1) || gain == T(0)) return {};
    bool const forward = (gain > T(0)) == (map.clip.depth != DepthOrder::one_to_zero);
    return {forward ? ray.direction : -ray.direction, true};
}

// The angle at `point` between the light and the light that the map is of, [0, pi]: 0 where the law holds, pi where
// depth runs backwards. pi also where there is no ray to compare, or no light.
template <class T>
[[nodiscard]] inline T light_error_radians(ShadowMap<T> const& map, Light<T> const& light,
                                           Vec3<T> const& point) noexcept {
    MapRay<T> const ray = map_ray(map, point);
    Vec3<T> const travel = unusable(light) ? Vec3<T>(T(0)) : -toward(light, point);
    if (!ray.ok || !(glm::dot(travel, travel) > T(0))) return T(3.14159265358979323846264338327950288L);
    // Not the arc cosine, which has lost half its digits where the angle is small.
    return std::atan2(glm::length(glm::cross(ray.direction, travel)), glm::dot(ray.direction, travel));
}

}  // namespace v0
}  // namespace shadowmath
