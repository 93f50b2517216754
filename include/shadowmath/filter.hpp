// SPDX-License-Identifier: MIT
//
// Percentage-closer filtering as the receiver shader does it, with depths fetched from wherever they are: a test, an
// offline tool, or a reference image. Comparisons are filtered, never depths (Reeves, Salesin, Cook 1987).
//
// The kernel is a box 2 * radius texels wide, centred on the point: taps at its rim are weighted by the part of their
// texel that it covers, so visibility is continuous everywhere. Radius 0 is the single texel that holds the point.
//
// Texel (x, y) has its centre at (x + 0.5, y + 0.5) texels from texture u = v = 0.
#pragma once

#include <shadowmath/bias.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/tangent.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {

inline constexpr int largest_filter_radius = 64;
inline constexpr int largest_map_size =
    1 << 24;  // texels a side: beyond, float coordinates have no fraction to filter by

struct FilterOptions {
    int radius = 1;         // half width of the kernel, texels, 0 to largest_filter_radius: 1, 3x3, 5x5, ... taps
    bool tap_plane = true;  // compare each tap with the receiver plane's depth there, not with the point's
};

// Texels that the kernel covers of texel `tap` (-radius to radius from the one that holds the point) along one axis,
// when the point lies the `fraction` [0, 1) into its texel.
template <class T>
[[nodiscard]] constexpr T covered_texels(int tap, int radius, T fraction) noexcept {
    if (radius == 0) return T(1);
    return tap == -radius ? T(1) - fraction : (tap == radius ? fraction : T(1));
}

// The same as a share of the kernel: the taps of an axis sum to 1.
template <class T>
[[nodiscard]] constexpr T tap_weight(int tap, int radius, T fraction) noexcept {
    return radius == 0 ? T(1) : covered_texels(tap, radius, fraction) / T(2 * radius);
}

// A receiver as the map sees it.
template <class T>
struct Receiver {
    Vec2<T> texel{T(0)};  // from texture u = v = 0
    T depth = T(0);       // stored depth, already moved toward the light by its bias
    DepthSlope<T> slope;  // on its plane
};

// Share of light that reaches the receiver, in [0, 1]: the weighted part of taps with nothing nearer to the light; 1
// and 0 are exact where all taps agree.
// `stored_depth(x, y)` is asked for texels of the map only; those outside hold nothing. Depths are compared within
// [0, 1], as they are stored: a receiver beyond the far end is lit by the cleared map. What is not finite is lit.
template <class T, class StoredDepth>
[[nodiscard]] inline T filtered(Receiver<T> const& receiver, int map_size, ClipSpace clip, FilterOptions options,
                                StoredDepth const& stored_depth) noexcept {
    int const radius =
        options.radius < 0 ? 0 : (options.radius > largest_filter_radius ? largest_filter_radius : options.radius);
    T const reach = T(radius + 1), size = T(map_size);
    Vec2<T> const& at = receiver.texel;
    if (map_size < 1 || map_size > largest_map_size) return T(1);
    if (!all_finite(at) || !all_finite(&receiver.depth, 1) || !all_finite(&receiver.slope.x, 1) ||
        !all_finite(&receiver.slope.y, 1))
        return T(1);
    if (!(at.x >= -reach && at.y >= -reach && at.x <= size + reach && at.y <= size + reach)) return T(1);
    bool const reversed_depth = clip.depth == DepthOrder::one_to_zero;
    auto const is_lit = [&](int x, int y, T depth) {
        if (x < 0 || y < 0 || x >= map_size || y >= map_size) return true;
        T const stored = T(stored_depth(x, y));
        T const kept = depth > T(0) ? (depth < T(1) ? depth : T(1)) : T(0);
        return !(reversed_depth ? kept < stored : kept > stored);
    };
    int const home_x = static_cast<int>(std::floor(at.x)), home_y = static_cast<int>(std::floor(at.y));
    Vec2<T> const fraction(at.x - T(home_x), at.y - T(home_y));
    T lit = T(0), dark = T(0);
    for (int j = -radius; j <= radius; ++j) {
        for (int i = -radius; i <= radius; ++i) {
            T const weight = covered_texels(i, radius, fraction.x) * covered_texels(j, radius, fraction.y);
            Vec2<T> const to_tap = Vec2<T>(T(i), T(j)) + T(0.5) - fraction;
            T const rise = options.tap_plane ? receiver.slope.x * to_tap.x + receiver.slope.y * to_tap.y : T(0);
            (is_lit(home_x + i, home_y + j, receiver.depth + rise) ? lit : dark) += weight;
        }
    }
    return dark == T(0) ? T(1) : lit / (lit + dark);
}

namespace detail {

template <class T>
struct Seen {
    Receiver<T> receiver;
    T w = T(1);           // clip w of the receiver
    bool in_map = false;  // false: the map cannot answer, the point is lit
};

template <class T>
[[nodiscard]] inline Seen<T> seen_by(ShadowMap<T> const& map, int map_size, Vec3<T> const& point, Vec3<T> const& normal,
                                     MapBias<T> const& bias, bool tap_plane) noexcept {
    if (!map.visible || map_size < 1 || !all_finite(map.clip_from_world)) return {};
    Projected<T> const at = projected(texture_from_world(map), point, map.w_min);
    if (!at.in_front) return {};
    DepthSlope<T> const on_plane = slope(map, map_size, point, normal, bias.slope_limit);
    DepthSlope<T> const own = tap_plane ? lean(map, map_size, point, bias.slope_limit) : DepthSlope<T>{};
    T const toward_light = depth_bias(bias, at.w, {on_plane.x - own.x, on_plane.y - own.y});
    bool const reversed_depth = map.clip.depth == DepthOrder::one_to_zero;
    T const depth = reversed_depth ? at.at.z + toward_light : at.at.z - toward_light;
    return {Receiver<T>{Vec2<T>(at.at) * T(map_size), depth, on_plane}, at.w, true};
}

}  // namespace detail

// What a receiver shader does for one map: project the point and the plane through it, subtract the bias, filter. 1
// where the map does not hold the point. `normal` is the surface's own, not the interpolated one.
template <class T, class StoredDepth>
[[nodiscard]] inline T visibility(ShadowMap<T> const& map, int map_size, Vec3<T> const& point, Vec3<T> const& normal,
                                  MapBias<T> const& bias, FilterOptions options,
                                  StoredDepth const& stored_depth) noexcept {
    detail::Seen<T> const seen = detail::seen_by(map, map_size, point, normal, bias, options.tap_plane);
    if (!seen.in_map) return T(1);
    return filtered(seen.receiver, map_size, map.clip, options, stored_depth);
}

}  // namespace v0
}  // namespace shadowmath
