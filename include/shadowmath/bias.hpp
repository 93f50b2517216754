// SPDX-License-Identifier: MIT
//
// How much a receiver must be moved toward the light so that it does not shadow itself: given in texels or metres,
// turned into depth of a particular map, the filter's kernel included. Fields go to the shader, which computes
//
//   bias = constant + per_inverse_w / w + slope_texels * (|slope.x| + |slope.y|)
//
// with slope the change of depth per texel on the receiver's plane, less the map's own lean where taps follow the
// plane. It is an amount of stored depth in favour of light, not negative on anything that the map holds: subtract it
// where depth grows away from the light, add it where it is reversed.
//
// Why 1/w: by the law of shadow maps a metre along a directional light adds k to clip depth and nothing to the other
// three coordinates, in a warp or a view-dependent map as in a plain one. So a bias in metres is constant before the
// division.
//
// Source: the slope on the receiver's plane is that of Isidoro, GDC 2006, and Dou et al., I3D 2014; taken from the
// normal instead of screen derivatives, which are wrong at every silhouette. The normal offset is Holbert's, GDC
// 2011.
#pragma once

#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/tangent.hpp>

#include <cmath>
#include <limits>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct DepthSlope {
    T x = T(0);  // stored depth gained per texel
    T y = T(0);
};

// Exact for every projective map, because those take planes to planes: on the plane, depth at a texel is depth at the
// point + slope . (texel - point). Each axis is clamped to [-limit, limit], which is also its value on a plane that
// the light grazes. Zero where the map does not hold the point or the normal has no length; never NaN.
template <class T>
[[nodiscard]] inline DepthSlope<T> slope(ShadowMap<T> const& map, int map_size, Vec3<T> const& point,
                                         Vec3<T> const& normal, T limit) noexcept {
    if (!all_finite(map.clip_from_world)) return {};
    Mat4<T> const texture = texture_from_world(map);
    Projected<T> const at = projected(texture, point, map.w_min);
    Tangents<T> const plane = tangents(normal);
    if (!at.in_front || !plane.ok || map_size < 1 || !all_finite(&limit, 1) || !(limit > T(0))) return {};
    Vec3<T> s = gain_along(texture, at, plane.s);
    Vec3<T> t = gain_along(texture, at, plane.t);
    // Over the largest of them, the product of two gains neither under- nor overflows.
    T largest = T(0);
    for (T const gain : {s.x, s.y, t.x, t.y}) largest = std::abs(gain) > largest ? std::abs(gain) : largest;
    if (!(largest > T(0)) || !all_finite(s) || !all_finite(t)) return {};
    s = s / largest;
    t = t / largest;
    T const area = (s.x * t.y - s.y * t.x) * T(map_size);
    return {bounded_quotient(s.z * t.y - s.y * t.z, area, limit), bounded_quotient(s.x * t.z - s.z * t.x, area, limit)};
}

// The slope of the plane across the light: 0 in an affine map; in any other what the map itself adds to the slope of
// every receiver. No part of it makes a surface shadow itself, as long as each tap is compared with the plane at that
// tap.
template <class T>
[[nodiscard]] inline DepthSlope<T> lean(ShadowMap<T> const& map, int map_size, Vec3<T> const& point, T limit) noexcept {
    if (!all_finite(map.clip_from_world)) return {};
    Mat4<T> const texture = texture_from_world(map);
    Projected<T> const at = projected(texture, point, map.w_min);
    if (!at.in_front) return {};
    // Along a light ray neither u nor v changes: it is at a right angle to both of these.
    Vec3<T> const w(row(texture, 3));
    Vec3<T> const u = Vec3<T>(row(texture, 0)) - at.at.x * w;
    Vec3<T> const v = Vec3<T>(row(texture, 1)) - at.at.y * w;
    return slope(map, map_size, point, glm::cross(safe_normalize(u).direction, safe_normalize(v).direction), limit);
}

// The k of the law: matrix * light = (0, 0, k, 0). For a directional light it is the clip depth that a metre along
// the light adds. Canonical, so positive in every convention; 0 for a light or a map that cannot be used.
template <class T>
[[nodiscard]] inline T depth_gain(ShadowMap<T> const& map, Light<T> const& light) noexcept {
    if (!all_finite(map.clip_from_world) || unusable(light)) return T(0);
    Mat4<T> const canonical = canonical_from_clip<T>(map.clip) * map.clip_from_world;
    T const gain = glm::dot(row(canonical, 2), homogeneous(light));
    return all_finite(&gain, 1) ? std::abs(gain) : T(0);
}

// Stored depth between a point and itself `metres` (>= 0) nearer to the light: exact for any map of this light. The
// way toward a spot is at most half of the distance to it. 0 where the map does not hold the point.
template <class T>
[[nodiscard]] inline T depth_shift(ShadowMap<T> const& map, Light<T> const& light, Vec3<T> const& point,
                                   T metres) noexcept {
    Projected<T> const at = projected(map.clip_from_world, point, map.w_min);
    if (!at.in_front || !all_finite(&metres, 1) || !(metres > T(0)) || unusable(light)) return T(0);
    T way = metres;
    if (light.kind == LightKind::spot) {
        // (p, 1) + s * l / (1 - s) is the point pulled by the share s of the way: clip z gains k s / (1 - s).
        T const distance = safe_normalize(point - light.position).length;
        T const pulled = metres < distance * T(0.5) ? metres : distance * T(0.5);
        way = bounded_quotient(pulled, distance - pulled, T(1));
    }
    T const shift = depth_gain(map, light) * way / at.w;
    return all_finite(&shift, 1) && shift < T(1) ? shift : T(1);
}

// What the shader needs of one map.
template <class T>
struct MapBias {
    T constant = T(0);
    T per_inverse_w = T(0);
    T slope_texels = T(0);
    T slope_limit = T(1);  // the largest change of depth a texel that slope terms believe
};

template <class T>
struct BiasOptions {
    T flat_texels = T(0.75);  // texels of a plane at half a right angle to the light, whatever the receiver's slope:
                              // for steps smaller than a texel, and for curved surfaces
    T texels = T(0.1);        // texels of the receiver's own slope: for surfaces that are not quite their planes
    T metres = T(0);          // along the light, on top
    int filter_radius = 1;    // half width of the kernel, texels
    bool tap_plane = true;    // each tap is compared with the plane's depth there; false: the kernel goes into
                              // slope_texels
    T steepest = T(20);       // tangent of the angle between light and normal beyond which slopes are cut
    T depth_step = T(1) / T(1 << 23);  // of the stored format: 2^-23 for float and for 24 bits, 2^-16 for 16 bits
};

// The bias of one shader invocation: `w` is the receiver's clip w, `at_receiver` its slope.
template <class T>
[[nodiscard]] inline T depth_bias(MapBias<T> const& bias, T w, DepthSlope<T> const& at_receiver) noexcept {
    if (w == T(0)) return T(0);
    T const amount = bias.constant + bias.per_inverse_w / w +
                     bias.slope_texels * (std::abs(at_receiver.x) + std::abs(at_receiver.y));
    return all_finite(&amount, 1) && amount > T(0) ? amount : T(0);
}

// Half the kernel's width and half a texel, as a stored depth is that of its texel's centre. Texels.
template <class T>
[[nodiscard]] constexpr T kernel_reach_texels(int filter_radius) noexcept {
    return (filter_radius > 0 ? T(filter_radius) : T(0)) + T(0.5);
}

// Metres to move a receiver along its unit normal before projecting it, instead of a slope bias: a plane then does
// not shadow itself, and the amount stays bounded at grazing light. `to_light` is unit; 0 for a normal along the
// light.
template <class T>
[[nodiscard]] inline T normal_offset_metres(T texel_metres, int filter_radius, Vec3<T> const& normal,
                                            Vec3<T> const& to_light) noexcept {
    if (!all_finite(normal) || !all_finite(to_light) || !all_finite(&texel_metres, 1) || !(texel_metres > T(0)))
        return T(0);
    T const sine = glm::length(glm::cross(normal, to_light));
    T const reach_metres = kernel_reach_texels<T>(filter_radius) * texel_metres;
    T const offset = T(1.41421356237309504880168872420969808L) * reach_metres * (sine < T(1) ? sine : T(1));
    return all_finite(&offset, 1) ? offset : T(0);
}

// The same for any map, warped and view-dependent ones included, whose texels differ from place to place: the least
// metres along the unit `normal` with which the plane through `point` does not shadow itself in this map. Exact for
// suns: on a plane stored depth is linear in texels, and w is linear in the metres. Of a spot to first order in the
// offset over the distance to it. At most `most_metres`, which is also its value where the map is edge-on to the plane,
// and where a warp's own w runs away from the offset; 0 where the plane faces away, or the map does not hold the point.
template <class T>
[[nodiscard]] inline T normal_offset_at(ShadowMap<T> const& map, Light<T> const& light, int map_size, int filter_radius,
                                        Vec3<T> const& point, Vec3<T> const& normal, T most_metres) noexcept {
    Projected<T> const at = projected(map.clip_from_world, point, map.w_min);
    if (!at.in_front || !all_finite(normal) || !all_finite(&most_metres, 1) || !(most_metres > T(0)) ||
        unusable(light) || !(depth_gain(map, light) > T(0)))
        return T(0);
    T const cosine = glm::dot(normal, toward(light, point));
    if (!(cosine > T(0))) return T(0);
    DepthSlope<T> const s = slope(map, map_size, point, normal, T(1e6));
    // What the kernel needs of clip depth, before the division by w.
    T const needed = kernel_reach_texels<T>(filter_radius) * (std::abs(s.x) + std::abs(s.y)) / depth_gain(map, light);
    T offset = T(0);
    if (light.kind == LightKind::directional) {
        // needed * (w + offset * gain of w) = offset / cosine
        T const gain_of_w = glm::dot(Vec3<T>(row(map.clip_from_world, 3)), normal);
        T const left = T(1) - needed * cosine * gain_of_w;
        offset = left > T(0) ? bounded_quotient(needed * cosine * at.w, left, most_metres) : most_metres;
    } else {
        // The way to the lamp, shortened by the share s, gains k s / (1 - s).
        T const distance = safe_normalize(point - light.position).length, raised = needed * at.w;
        offset = cosine * distance * bounded_quotient(raised, T(1) + raised, T(1));
    }
    return all_finite(&offset, 1) && offset < most_metres ? offset : most_metres;
}

namespace detail {

// In a map so shallow that a texel of a steep plane spans its depth a million times over, nothing can be told apart.
template <class T>
inline constexpr T steepest_slope = T(1e6);

// The most stored depth that a texel can span anywhere in the map along one axis, when w times depth changes by at most
// this per metre across the light. NDC x = X.p / W.p changes by |X - x W| / w per metre, so a texel in metres grows as
// w, its depth shrinks as 1 / w, and only the least of |X - x W| over the map is left.
template <class T>
[[nodiscard]] inline T spanned_by_texel(Mat4<T> const& canonical, int axis, int map_size, T change_per_metre) noexcept {
    Vec3<T> const w_row(row(canonical, 3)), side(row(canonical, axis));
    T const nearest = bounded_quotient(glm::dot(side, w_row), glm::dot(w_row, w_row), T(1));
    T const change = safe_normalize(side - w_row * nearest).length;
    return bounded_quotient(T(2) * change_per_metre, change * T(map_size), steepest_slope<T>);
}

// Of the two axes the one whose texels are longer.
template <class T>
[[nodiscard]] inline T steepest_texel(Mat4<T> const& canonical, int map_size, T change_per_metre) noexcept {
    return glm::max(spanned_by_texel(canonical, 0, map_size, change_per_metre),
                    spanned_by_texel(canonical, 1, map_size, change_per_metre));
}

// And the one whose texels are shorter: across a warp, where depth a texel is the same from near to far. Along it a
// texel at the far end is so long that a bias made for it would hide the contact of everything near.
template <class T>
[[nodiscard]] inline T flattest_texel(Mat4<T> const& canonical, int map_size, T change_per_metre) noexcept {
    return glm::min(spanned_by_texel(canonical, 0, map_size, change_per_metre),
                    spanned_by_texel(canonical, 1, map_size, change_per_metre));
}

// How much longer a texel is than its two sides are apart: 1 where the map's axes cross at a right angle everywhere.
// Along x, with y held, a plane's depth changes by that much more than the change of x alone tells. The worst of a
// sun's map is at a corner, since a convex function over a positive affine one has no maximum inside.
template <class T>
[[nodiscard]] inline T worst_shear(Mat4<T> const& canonical) noexcept {
    Vec3<T> const x_row(row(canonical, 0)), y_row(row(canonical, 1)), w_row(row(canonical, 3));
    T worst = T(1);
    for (T const x : {T(-1), T(1)})
        for (T const y : {T(-1), T(1)}) {
            Vec3<T> const along_x = safe_normalize(x_row - w_row * x).direction;
            Vec3<T> const along_y = safe_normalize(y_row - w_row * y).direction;
            T const sine = glm::length(glm::cross(along_x, along_y));
            worst = glm::max(worst, bounded_quotient(T(1), sine, T(1e3)));
        }
    return worst;
}

// 1 / w on the axis of a spot's map where depth is 0 and where it is 1: on the axis depth = A - k / w.
template <class T>
struct InverseW {
    T nearest = T(0);
    T farthest = T(0);
};

template <class T>
[[nodiscard]] inline InverseW<T> ends_of_axis(Mat4<T> const& canonical, Light<T> const& light, T gain) noexcept {
    Vec4<T> const axis(light.direction, T(0));
    T const w_along = glm::dot(row(canonical, 3), axis);
    if (!(w_along > T(0))) return {};
    T const at_infinity = glm::dot(row(canonical, 2), axis) / w_along;
    InverseW<T> const ends{at_infinity / gain, (at_infinity - T(1)) / gain};
    if (!all_finite(&ends.nearest, 1) || !all_finite(&ends.farthest, 1) || !(ends.nearest > T(0))) return {};
    return {ends.nearest, ends.farthest > T(0) ? ends.farthest : T(0)};
}

template <class T>
[[nodiscard]] inline bool is_affine(Mat4<T> const& matrix) noexcept {
    return row(matrix, 3) == Vec4<T>(T(0), T(0), T(0), T(1));
}

template <class T>
[[nodiscard]] inline T option(T const& value, T fallback) noexcept {
    return all_finite(&value, 1) && value >= T(0) ? value : fallback;
}

// Everything but the metres. Per metre, w times depth changes by `along` in the direction of the light, and by `across`
// on a plane at a right angle to it.
template <class T>
[[nodiscard]] inline MapBias<T> bias_of_kernel(Mat4<T> const& canonical, int map_size, T along, T across,
                                               BiasOptions<T> const& options) noexcept {
    MapBias<T> bias;
    // One step where the map is written and one where it is read. Shaders compute in float whatever T is, and a clip
    // coordinate is a sum of terms as large as its offset from the world's origin: four roundings of half an epsilon
    // when the map is written, four when it is read.
    T const rounding = T(4) * T(std::numeric_limits<float>::epsilon());
    bias.constant = T(2) * option(options.depth_step, T(0));
    bias.per_inverse_w = rounding * std::abs(canonical[3][2]);
    bias.slope_texels = option(options.texels, T(0));
    if (!options.tap_plane) bias.slope_texels += kernel_reach_texels<T>(options.filter_radius);
    if (is_affine(canonical)) {
        T const x = std::abs(canonical[3][0]), y = std::abs(canonical[3][1]);
        bias.slope_texels += rounding * (x > y ? x : y) * T(map_size) * T(0.5);
    }
    T const change = option(options.steepest, T(20)) * along + across;
    T const limit = steepest_texel(canonical, map_size, change);
    bias.slope_limit = limit > T(0) ? limit : T(1);
    return bias;
}

template <class T>
[[nodiscard]] inline MapBias<T> harmless(MapBias<T> const& bias) noexcept {
    bool const finite = all_finite(&bias.constant, 1) && all_finite(&bias.per_inverse_w, 1) &&
                        all_finite(&bias.slope_texels, 1) && all_finite(&bias.slope_limit, 1);
    return finite ? bias : MapBias<T>{};
}

}  // namespace detail

// The bias of a whole map. Of a directional light, `metres` are exact everywhere, in every technique; where w is 1
// everywhere they are part of `constant`. Of a spot the bias in depth falls as 1 / w^2, for which the shader has no
// term: the chord of that curve between the map's ends is used, at least `metres` everywhere, exact at both ends of
// the axis and more between (to first order in metres over distance). For maps of spots whose depth runs along the
// axis, as fit_spot's does; for any other, and where that is too much, use bias_at. Nothing finite to say: no bias.
template <class T>
[[nodiscard]] inline MapBias<T> bias_for(ShadowMap<T> const& map, Light<T> const& light, int map_size,
                                         BiasOptions<T> const& options) noexcept {
    T const gain = depth_gain(map, light);
    if (!(gain > T(0)) || map_size < 1) return {};
    Mat4<T> const canonical = canonical_from_clip<T>(map.clip) * map.clip_from_world;
    T const metres = detail::option(options.metres, T(0));
    T const flat_texels = detail::option(options.flat_texels, T(0));
    if (light.kind == LightKind::directional) {
        // A warp's own w makes depth lean on planes across the light: by Z - depth * W, of which the ends are the most.
        Vec3<T> const z_row(row(canonical, 2)), w_row(row(canonical, 3));
        Vec3<T> const lean = z_row - light.direction * glm::dot(z_row, light.direction);
        T const at_near_end = glm::length(lean), at_far_end = glm::length(lean - w_row);
        T const across = at_near_end > at_far_end ? at_near_end : at_far_end;
        MapBias<T> bias = detail::bias_of_kernel(canonical, map_size, gain, across, options);
        bias.slope_limit *= detail::worst_shear(canonical);
        // A texel in metres grows as w and depth a metre falls as 1 / w: in a bias in texels the two cancel.
        bias.constant += flat_texels * detail::flattest_texel(canonical, map_size, gain);
        bias.per_inverse_w += gain * metres;
        if (detail::is_affine(canonical)) {
            bias.constant += bias.per_inverse_w;
            bias.per_inverse_w = T(0);
        }
        return detail::harmless(bias);
    }
    detail::InverseW<T> const ends = detail::ends_of_axis(canonical, light, gain);
    T const w_per_metre = safe_normalize(Vec3<T>(row(canonical, 3))).length;
    T const at_near_end = gain * w_per_metre * ends.nearest;
    MapBias<T> bias = detail::bias_of_kernel(canonical, map_size, at_near_end, at_near_end, options);
    // Here depth a metre falls as 1 / w^2, so a texel's depth falls as 1 / w from what it is at the near end.
    if (ends.nearest > T(0))
        bias.per_inverse_w += flat_texels * detail::flattest_texel(canonical, map_size, at_near_end) / ends.nearest;
    T const curve = gain * w_per_metre * metres;
    bias.constant -= curve * ends.nearest * ends.farthest;
    bias.per_inverse_w += curve * (ends.nearest + ends.farthest);
    return detail::harmless(bias);
}

// The same with `metres` exact at one point, of any map: for shaders that compute bias per object or per pixel.
template <class T>
[[nodiscard]] inline MapBias<T> bias_at(ShadowMap<T> const& map, Light<T> const& light, int map_size,
                                        BiasOptions<T> const& options, Vec3<T> const& point) noexcept {
    BiasOptions<T> without_metres = options;
    without_metres.metres = T(0);
    MapBias<T> bias = bias_for(map, light, map_size, without_metres);
    bias.constant += depth_shift(map, light, point, detail::option(options.metres, T(0)));
    return detail::harmless(bias);
}

}  // namespace v0
}  // namespace shadowmath
