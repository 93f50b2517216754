// SPDX-License-Identifier: MIT
//
// A light as one homogeneous point, and the axes to look along it by.
//
// The law of shadow maps: a matrix M is a map of the light l exactly when M * homogeneous(l) = (0, 0, k, 0) with k > 0
// (k < 0 where depth is reversed) and w > 0 on what it must see. Then every light ray is one texel, and depth along it
// is ordered. l = (L, 0) for light that travels along L, l = (-p, -1) for a light at p.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

namespace shadowmath {
inline namespace v0 {

enum class LightKind : std::uint8_t { directional, spot };

template <class T>
struct Light {
    LightKind kind = LightKind::directional;
    Vec3<T> direction{T(0), T(-1), T(0)};  // world, unit: how the light TRAVELS; of a spot, its axis
    Vec3<T> position{T(0)};                // world; spots only
    T half_angle_radians = T(0.5);         // spots only: from the axis to the edge of the cone, [1e-3, 1.5]
    T range = T(100);                      // spots only: metres that the light reaches, > 0
    Faults faults;                         // of the making: zero_light, not_finite, cone_clamped
};

// `travel` is the way the light goes (a sun overhead travels along -up), of any length.
template <class T>
[[nodiscard]] inline Light<T> directional(Vec3<T> const& travel) noexcept {
    Light<T> light;
    if (!all_finite(travel)) {
        light.faults = Fault::not_finite;
        return light;
    }
    Normalized<T> const unit = safe_normalize(travel);
    if (unit.ok)
        light.direction = unit.direction;
    else
        light.faults = Fault::zero_light;
    return light;
}

// The angle is HALF the cone: from its axis to its edge. It is clamped to [1e-3, 1.5] rad (86 degrees): beyond, the
// tangent that a map needs leaves every range of depth and resolution.
template <class T>
[[nodiscard]] inline Light<T> spot(Vec3<T> const& position, Vec3<T> const& axis, T half_angle_radians,
                                   T range) noexcept {
    Light<T> light = directional(axis);
    light.kind = LightKind::spot;
    if (!all_finite(position) || !all_finite(&half_angle_radians, 1) || !all_finite(&range, 1)) {
        light.faults |= Fault::not_finite;
        return light;
    }
    light.position = position;
    light.range = range;
    light.half_angle_radians = half_angle_radians;
    if (!(half_angle_radians >= T(1e-3))) light.half_angle_radians = T(1e-3);
    if (!(half_angle_radians <= T(1.5))) light.half_angle_radians = T(1.5);
    if (light.half_angle_radians != half_angle_radians) light.faults |= Fault::cone_clamped;
    if (!(range > T(0))) light.faults |= Fault::empty_range;
    return light;
}

// What a light made by hand or loaded from a file has wrong; includes the faults of its making.
template <class T>
[[nodiscard]] inline Faults faults_of(Light<T> const& light) noexcept {
    if (!all_finite(light.direction) || !all_finite(light.position) || !all_finite(&light.half_angle_radians, 1) ||
        !all_finite(&light.range, 1))
        return light.faults | Fault::not_finite;
    T const length2 = glm::dot(light.direction, light.direction);
    return std::abs(length2 - T(1)) <= T(1e-3) ? light.faults : light.faults | Fault::zero_light;
}

// True for a light from which no map can be made.
template <class T>
[[nodiscard]] inline bool unusable(Light<T> const& light) noexcept {
    Faults const faults = faults_of(light);
    return faults.has(Fault::not_finite) || faults.has(Fault::zero_light) || faults.has(Fault::empty_range);
}

template <class T>
[[nodiscard]] inline Vec4<T> homogeneous(Light<T> const& light) noexcept {
    return light.kind == LightKind::directional ? Vec4<T>(light.direction, T(0)) : Vec4<T>(-light.position, T(-1));
}

// From a point to the light: unit, or zero when the point is the light's own position.
template <class T>
[[nodiscard]] inline Vec3<T> toward(Light<T> const& light, Vec3<T> const& point) noexcept {
    if (light.kind == LightKind::directional) return -light.direction;
    return safe_normalize(light.position - point).direction;
}

// True where a plane with this normal sees nothing of the light: below a horizon, behind a wall.
template <class T>
[[nodiscard]] inline bool faces_away(Light<T> const& light, Vec3<T> const& point, Vec3<T> const& normal) noexcept {
    return !(glm::dot(normal, toward(light, point)) > T(0));
}

// Light space: x and y across the light, depth along it. right * up = -depth, so that a map keeps the winding of
// triangles as a camera would.
template <class T>
struct LightBasis {
    Vec3<T> x{T(1), T(0), T(0)};
    Vec3<T> y{T(0), T(0), T(-1)};
    Vec3<T> depth{T(0), T(-1), T(0)};  // the direction in which the light travels
};

// Orthonormal to 4 ulp for every direction, and continuous for all but one: light that travels straight along +y.
// The axes are those of light straight along -y, carried along the shortest turn. No up vector to be parallel to, and a
// sun that crosses the zenith makes no jump. `travel` is unit; one that is not finite gives the default axes.
template <class T>
[[nodiscard]] inline LightBasis<T> light_basis(Vec3<T> const& travel) noexcept {
    if (!all_finite(travel)) return {};
    Vec3<T> const& d = travel;
    // 1 + cos of the turn; past a right angle written so that nothing cancels.
    T const flat = d.x * d.x + d.z * d.z;
    T const k = d.y <= T(0) ? T(1) - d.y : flat / (T(1) + d.y);
    LightBasis<T> basis;
    basis.depth = d;
    // Closer to the one singular direction than a rounding error: its own axes are as good, and no denormals enter.
    constexpr T eps = std::numeric_limits<T>::epsilon();
    if (!(k > eps * eps)) {
        basis.y = Vec3<T>(T(0), T(0), T(1));
        return basis;
    }
    basis.x = Vec3<T>(T(1) - d.x * d.x / k, d.x, -d.x * d.z / k);
    basis.y = Vec3<T>(d.x * d.z / k, -d.z, d.z * d.z / k - T(1));
    return basis;
}

// Coordinates of a world point in light space: (x, y, depth), metres from the world origin.
template <class T>
[[nodiscard]] inline Vec3<T> in_light(LightBasis<T> const& basis, Vec3<T> const& point) noexcept {
    return Vec3<T>(glm::dot(basis.x, point), glm::dot(basis.y, point), glm::dot(basis.depth, point));
}

}  // namespace v0
}  // namespace shadowmath
