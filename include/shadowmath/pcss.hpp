// SPDX-License-Identifier: MIT
//
// Percentage-closer soft shadows: edges that are sharp where the occluder touches and wide where it is far, from one
// ordinary map. Look for occluders, take their mean gap, filter as wide as the penumbra of that gap.
//
// Use it for one light whose shadows are close to the eye, where softness tells how far the caster is; where it would
// not be noticed, filter.hpp costs a tenth. It takes occluders for one plane across the light: where a low and a high
// one overlap, the width of the edge lies in between.
//
// Source: Fernando, SIGGRAPH 2005 Sketches; the disk of taps is Vogel's, Mathematical Biosciences 44, 1979.
// Departures: gaps instead of linear depths (penumbra.hpp). The search counts an occluder only from inside the cone
// that the light subtends at its gap, for from elsewhere it takes no light away: the answer does not depend on how far
// the map's near end is. Taps of the search crowd toward the middle, so that every height of occluder has its share.
#pragma once

#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/filter.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/penumbra.hpp>
#include <shadowmath/shadow_map.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {

inline constexpr int largest_tap_count = 256;

template <class T>
struct PcssOptions {
    int search_taps = 32;      // texels read to find occluders, 1 to largest_tap_count
    int filter_taps = 32;      // places compared, four texels each, 1 to largest_tap_count
    Vec2<T> turn{T(1), T(0)};  // cosine and sine: turns the taps, one angle a pixel trades bands for noise
};

template <class T>
struct SoftShadow {
    T visibility = T(1);   // share of the light that is seen, [0, 1]
    T gap = T(0);          // mean of the occluders found; 0 without any
    bool blocked = false;  // some were found
};

// Directions at the golden angle to each other. A rotation by a constant, so that no two compilers' sines differ.
template <class T>
[[nodiscard]] constexpr Vec2<T> next_direction(Vec2<T> const& direction) noexcept {
    T const cosine = T(-0.737368878078319693498L), sine = T(0.675490294261523644571L);
    return Vec2<T>(direction.x * cosine - direction.y * sine, direction.x * sine + direction.y * cosine);
}

namespace detail {

// The map as the taps see it: depth grows away from the light, outside nothing is held.
template <class T, class StoredDepth>
struct TapMap {
    StoredDepth const& stored_depth;
    int size;
    bool reversed_depth;

    [[nodiscard]] bool holds(int x, int y) const noexcept { return x >= 0 && y >= 0 && x < size && y < size; }
    [[nodiscard]] T depth(int x, int y) const noexcept {
        T const stored = T(stored_depth(x, y));
        return reversed_depth ? T(1) - stored : stored;
    }
};

// A receiver and the plane through it, depth growing away from the light.
template <class T>
struct TapPlane {
    Vec2<T> texel;
    T depth;
    DepthSlope<T> slope;

    // The plane's depth at the centre of a texel, as a map would store it.
    [[nodiscard]] T at(int x, int y) const noexcept {
        T const rise = slope.x * (T(x) + T(0.5) - texel.x) + slope.y * (T(y) + T(0.5) - texel.y);
        T const there = depth + rise;
        return there > T(0) ? (there < T(1) ? there : T(1)) : T(0);
    }
};

// Texels of a place, at most one outside of the map; false where it is farther away or nowhere.
template <class T>
[[nodiscard]] inline bool texel_of(Vec4<T> const& place, int map_size, Vec2<T>& texel) noexcept {
    if (!(place.w > T(0))) return false;
    T const size = T(map_size);
    texel = Vec2<T>(place) * size / place.w;
    return texel.x >= T(-1) && texel.y >= T(-1) && texel.x <= size + T(1) && texel.y <= size + T(1);
}

// The four texels around a place, and the mean of what they say by the distance to it: exactly 0 and 1 where they
// agree.
template <class T>
struct Around {
    int x, y;  // of the lower left one
    Vec2<T> share;

    explicit Around(Vec2<T> const& texel) noexcept {
        Vec2<T> const corner(std::floor(texel.x - T(0.5)), std::floor(texel.y - T(0.5)));
        x = static_cast<int>(corner.x);
        y = static_cast<int>(corner.y);
        share = texel - T(0.5) - corner;
    }
    template <class Value>
    [[nodiscard]] T mean(Value const& at) const noexcept {
        T const lower = at(x, y) * (T(1) - share.x) + at(x + 1, y) * share.x;
        T const upper = at(x, y + 1) * (T(1) - share.x) + at(x + 1, y + 1) * share.x;
        return lower * (T(1) - share.y) + upper * share.y;
    }
};

// Mean gap of the occluders that stand in the cone. Its tip is as wide as a texel: the first tap weighs the four around
// the point, so that the edge of a shadow in contact fades on both sides.
template <class T, class StoredDepth>
[[nodiscard]] inline SoftShadow<T> search(TapMap<T, StoredDepth> const& map, TapPlane<T> const& plane,
                                          Vec4<T> const& receiver, MapPenumbra<T> const& penumbra, int taps,
                                          Vec2<T> direction) noexcept {
    // The map holds nothing nearer to the light than depth 0.
    T const nothing_beyond = gap_at(penumbra, receiver, T(0));
    T const allowed = penumbra.largest_gap < widest_gap<T> ? penumbra.largest_gap : widest_gap<T>;
    T const widest = nothing_beyond < allowed ? nothing_beyond : allowed;
    if (!(widest > T(0))) return {};
    // 0 where there is no occluder in the cone.
    auto const gap_in_cone = [&](int x, int y, Vec4<T> const& place, T least_gap) {
        if (!map.holds(x, y)) return T(0);
        T const depth = map.depth(x, y), gap = gap_at(penumbra, place, depth);
        if (!(depth < plane.at(x, y)) || !(gap >= least_gap)) return T(0);
        return gap < widest ? gap : widest;
    };
    T sum = T(0), found = T(0);
    Vec2<T> texel;
    if (texel_of(receiver, map.size, texel)) {
        Around<T> const four(texel);
        sum = four.mean([&](int x, int y) { return gap_in_cone(x, y, receiver, T(0)); });
        found = four.mean([&](int x, int y) { return gap_in_cone(x, y, receiver, T(0)) > T(0) ? T(1) : T(0); });
    }
    for (int i = 1; i < taps; ++i) {
        direction = next_direction(direction);
        T const share = (T(i) + T(0.5)) / T(taps), reach = share * share;
        Vec4<T> const place = across(penumbra, receiver, direction * reach, widest);
        if (!texel_of(place, map.size, texel)) continue;
        int const x = static_cast<int>(std::floor(texel.x)), y = static_cast<int>(std::floor(texel.y));
        T const gap = gap_in_cone(x, y, place, reach * widest);
        if (!(gap > T(0))) continue;
        sum += gap;
        found += T(1);
    }
    if (!(found > T(0))) return {};
    T const mean = sum / found;
    return {T(0), mean < widest ? mean : widest, true};
}

// Share of the four texels around a place that are lit, by their distance to it.
template <class T, class StoredDepth>
[[nodiscard]] inline T lit_around(TapMap<T, StoredDepth> const& map, TapPlane<T> const& plane,
                                  Vec2<T> const& texel) noexcept {
    return Around<T>(texel).mean(
        [&](int x, int y) { return !map.holds(x, y) || !(plane.at(x, y) > map.depth(x, y)) ? T(1) : T(0); });
}

[[nodiscard]] constexpr int tap_count(int asked) noexcept {
    return asked < 1 ? 1 : (asked > largest_tap_count ? largest_tap_count : asked);
}

template <class T>
[[nodiscard]] inline bool is_finite(MapPenumbra<T> const& penumbra) noexcept {
    return all_finite(penumbra.rim_x) && all_finite(penumbra.rim_y) && all_finite(&penumbra.depth_of_gap, 1) &&
           all_finite(&penumbra.largest_gap, 1);
}

}  // namespace detail

// Share of light that reaches a receiver whose clip w is `w`, in [0, 1]. Without an occluder in the cone exactly 1; the
// taps follow the receiver's plane, so that no plane shadows itself however wide the kernel. `stored_depth(x, y)` is
// asked for texels of the map only. What is not finite is lit.
template <class T, class StoredDepth>
[[nodiscard]] inline SoftShadow<T> soft_filtered(Receiver<T> const& receiver, T w, MapPenumbra<T> const& penumbra,
                                                 int map_size, ClipSpace clip, PcssOptions<T> const& options,
                                                 StoredDepth const& stored_depth) noexcept {
    if (map_size < 1 || map_size > largest_map_size || !all_finite(&w, 1) || !(w > T(0))) return {};
    if (!all_finite(receiver.texel) || !all_finite(&receiver.depth, 1) || !all_finite(&receiver.slope.x, 1) ||
        !all_finite(&receiver.slope.y, 1) || !detail::is_finite(penumbra) || !(penumbra.depth_of_gap > T(0)))
        return {};
    bool const reversed_depth = clip.depth == DepthOrder::one_to_zero;
    detail::TapMap<T, StoredDepth> const map{stored_depth, map_size, reversed_depth};
    detail::TapPlane<T> plane{receiver.texel, receiver.depth, receiver.slope};
    if (reversed_depth) {
        plane.depth = T(1) - receiver.depth;
        plane.slope = {-receiver.slope.x, -receiver.slope.y};
    }
    Vec2<T> turn = options.turn;
    if (!all_finite(turn) || !(std::abs(glm::dot(turn, turn) - T(1)) <= T(1e-3))) turn = Vec2<T>(T(1), T(0));
    Vec4<T> const place = Vec4<T>(receiver.texel / T(map_size), plane.depth, T(1)) * w;
    SoftShadow<T> shadow = detail::search(map, plane, place, penumbra, detail::tap_count(options.search_taps), turn);
    if (!shadow.blocked) return {};
    int const taps = detail::tap_count(options.filter_taps);
    T lit = T(0);
    Vec2<T> direction = turn;
    for (int i = 0; i < taps; ++i, direction = next_direction(direction)) {
        Vec2<T> const u = direction * std::sqrt((T(i) + T(0.5)) / T(taps));
        Vec2<T> texel;
        bool const in_map = detail::texel_of(across(penumbra, place, u, shadow.gap), map_size, texel);
        lit += in_map ? detail::lit_around(map, plane, texel) : T(1);
    }
    T const visibility = lit / T(taps);
    shadow.visibility = visibility < T(1) ? visibility : T(1);
    return shadow;
}

// What a receiver shader does for one map: project the point and the plane through it, subtract the bias, search,
// filter. Lit where the map does not hold the point. `normal` is the surface's own, not the interpolated one.
template <class T, class StoredDepth>
[[nodiscard]] inline SoftShadow<T> soft_visibility(ShadowMap<T> const& map, int map_size, Vec3<T> const& point,
                                                   Vec3<T> const& normal, MapBias<T> const& bias,
                                                   MapPenumbra<T> const& penumbra, PcssOptions<T> const& options,
                                                   StoredDepth const& stored_depth) noexcept {
    detail::Seen<T> const seen = detail::seen_by(map, map_size, point, normal, bias, true);
    if (!seen.in_map) return {};
    return soft_filtered(seen.receiver, seen.w, penumbra, map_size, map.clip, options, stored_depth);
}

}  // namespace v0
}  // namespace shadowmath
