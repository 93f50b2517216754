// SPDX-License-Identifier: MIT
//
// How wide the edge of a shadow is under a light that has a size: one formula for suns and lamps, in any map.
//
//         light   ====*====   radius r
//                  \  |  /            gap of an occluder, from the receiver's side:
//      occluder  ---- o ----            sun   metres between the two, along the light
//                   \ | /               lamp  (receiver's distance - occluder's) / occluder's
//      receiver  ----\|/----
//                     p               penumbra, metres across the light:  2 r gap
//
// r is a sun's tangent of its angular radius and a lamp's radius in metres. With the light l of light.hpp, the cone
// from a point p to the rim of the light is, in homogeneous coordinates,
//
//   p + gap (r u - l)      u: unit, across the light
//
// for both kinds, and the law of shadow maps (M l = (0, 0, k, 0)) turns it into M p + gap (r M u - (0, 0, k, 0)): an
// occluder's gap is linear in its stored depth, without any linearisation, and a kernel in metres is two vectors a map.
// So penumbrae are the same metres in every cascade, warp and convention, and do not jump between them.
//
// A lamp is a disk at a right angle to the spot's axis. Maps drawn with depth clamp (pancaking) do not know how far
// away the casters before their near end are: give those maps a near end that holds the casters.
//
// Source: the similar triangles of Fernando, Percentage-Closer Soft Shadows, SIGGRAPH 2005 Sketches. Departure: those
// need linear depth and hold for one kind of map each.
#pragma once

#include <shadowmath/bias.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/tangent.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {

// Angular radius of the real sun: 16 minutes of arc.
template <class T>
inline constexpr T sun_angular_radius_radians = T(0.00465);

// Gaps are kept at or below this.
template <class T>
inline constexpr T widest_gap = T(1e6);

// The radius of a sun, for what follows: the tangent of its angular radius, which is clamped to [0, 1.5] radians.
template <class T>
[[nodiscard]] inline T sun_radius(T angular_radius_radians) noexcept {
    if (!all_finite(&angular_radius_radians, 1) || !(angular_radius_radians > T(0))) return T(0);
    return std::tan(angular_radius_radians < T(1.5) ? angular_radius_radians : T(1.5));
}

// Metres across the light over which its shadow fades: from no light to all of it.
template <class T>
[[nodiscard]] constexpr T penumbra_metres(T light_radius, T gap) noexcept {
    return T(2) * light_radius * gap;
}

// The gap of an occluder so many metres from the point on its way to the light. A lamp's occluders lie between it and
// the point: gaps end at widest_gap there.
template <class T>
[[nodiscard]] inline T gap_of_metres(Light<T> const& light, Vec3<T> const& point, T metres) noexcept {
    if (!all_finite(&metres, 1) || !(metres > T(0)) || !all_finite(point) || unusable(light)) return T(0);
    if (light.kind == LightKind::directional) return metres < widest_gap<T> ? metres : widest_gap<T>;
    T const distance = safe_normalize(point - light.position).length;
    return metres < distance ? bounded_quotient(metres, distance - metres, widest_gap<T>) : widest_gap<T>;
}

// And back: the metres of a gap.
template <class T>
[[nodiscard]] inline T metres_of_gap(Light<T> const& light, Vec3<T> const& point, T gap) noexcept {
    if (!all_finite(&gap, 1) || !(gap > T(0)) || !all_finite(point) || unusable(light)) return T(0);
    T const kept = gap < widest_gap<T> ? gap : widest_gap<T>;
    if (light.kind == LightKind::directional) return kept;
    T const metres = safe_normalize(point - light.position).length * (kept / (T(1) + kept));
    return all_finite(&metres, 1) ? metres : T(0);
}

// What a shader needs of one map. Places in it are (u w, v w, depth w, w) with depth growing away from the light, in
// any convention: a map whose depth is reversed is read as 1 - depth.
template <class T>
struct MapPenumbra {
    Vec4<T> rim_x{T(0)};            // what a place gains per unit of gap from the cone's axis to its rim
    Vec4<T> rim_y{T(0)};            // and at a right angle to it
    T depth_of_gap = T(1);          // k: depth w lost per unit of gap along the axis, > 0
    T largest_gap = widest_gap<T>;  // what is farther counts as this far: lower it where heights are known
};

// The matrix whose places a MapPenumbra speaks of.
template <class T>
[[nodiscard]] inline Mat4<T> place_from_world(ShadowMap<T> const& map) noexcept {
    Mat4<T> matrix = texture_from_world(map);
    if (map.clip.depth != DepthOrder::one_to_zero) return matrix;
    for (int column = 0; column < 4; ++column) matrix[column].z = matrix[column].w - matrix[column].z;
    return matrix;
}

// Linear in the light's radius. Where that is negative or not finite, or light or map cannot be used, it is 0: shadows
// are hard.
template <class T>
[[nodiscard]] inline MapPenumbra<T> penumbra_for(ShadowMap<T> const& map, Light<T> const& light,
                                                 T light_radius) noexcept {
    MapPenumbra<T> penumbra;
    T const gain = depth_gain(map, light);
    Tangents<T> const disk = tangents(light.direction);
    if (!(gain > T(0)) || !disk.ok || !all_finite(&light_radius, 1)) return penumbra;
    penumbra.depth_of_gap = gain;
    Mat4<T> const place = place_from_world(map);
    T const radius = light_radius > T(0) ? light_radius : T(0);
    Vec4<T> const rim_x = place * Vec4<T>(disk.s * radius, T(0)), rim_y = place * Vec4<T>(disk.t * radius, T(0));
    if (!all_finite(rim_x) || !all_finite(rim_y)) return penumbra;
    penumbra.rim_x = rim_x;
    penumbra.rim_y = rim_y;
    return penumbra;
}

// Where the plane across the light through the receiver is met by the light ray that passes the cone from `receiver` to
// the light at `gap`, toward `u` in the unit disk. Exact in any map; what stands there at that gap lies gap *
// depth_of_gap nearer.
template <class T>
[[nodiscard]] inline Vec4<T> across(MapPenumbra<T> const& penumbra, Vec4<T> const& receiver, Vec2<T> const& u,
                                    T gap) noexcept {
    return receiver + (penumbra.rim_x * u.x + penumbra.rim_y * u.y) * gap;
}

// The gap of what is stored at a place; negative for what lies behind the receiver's plane across the light.
template <class T>
[[nodiscard]] inline T gap_at(MapPenumbra<T> const& penumbra, Vec4<T> const& place, T depth) noexcept {
    return (place.z - depth * place.w) / penumbra.depth_of_gap;
}

// Half the width and height, in texels, of the box around the kernel of a gap, to first order in gap. For choosing a
// filter, or the margin of a map; taps themselves come from across().
template <class T>
[[nodiscard]] inline Vec2<T> kernel_texels(MapPenumbra<T> const& penumbra, Vec4<T> const& receiver, int map_size,
                                           T gap) noexcept {
    if (!all_finite(receiver) || !(receiver.w > T(0)) || !all_finite(&gap, 1) || map_size < 1) return Vec2<T>(T(0));
    T const scale = gap * T(map_size) / receiver.w;
    Vec2<T> const at = Vec2<T>(receiver) / receiver.w;
    Vec2<T> const x = Vec2<T>(penumbra.rim_x) - at * penumbra.rim_x.w;
    Vec2<T> const y = Vec2<T>(penumbra.rim_y) - at * penumbra.rim_y.w;
    Vec2<T> const half_axes(safe_normalize(Vec3<T>(x.x, y.x, T(0))).length,
                            safe_normalize(Vec3<T>(x.y, y.y, T(0))).length);
    Vec2<T> const texels = half_axes * scale;
    return all_finite(texels) ? texels : Vec2<T>(T(0));
}

}  // namespace v0
}  // namespace shadowmath
