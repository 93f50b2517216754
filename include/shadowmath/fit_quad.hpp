// SPDX-License-Identifier: MIT
//
// The best four lines around a set of samples: the map in which their texels look smallest in the picture.
//
//   supports      how far the samples reach in each of 64 directions: that is all of their shape that matters
//   start         the best of the sixteen rectangles
//   descent       one side is turned by 45, 22, 11, 6 degrees while that helps, the others stay; then again finer
//
// A side is always a line that touches the samples, so every candidate holds all of them, and no hull is built.
// Directions are even in a frame in which the samples are as wide as they are long: under a low sun they are not.
//
// Source: none; "trapezoids" (Martin and Tan 2004) turn two of the four sides.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/footprint.hpp>
#include <shadowmath/light_samples.hpp>
#include <shadowmath/quad_map.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace shadowmath {
inline namespace v0 {

// Eye pixels along the longer axis of a texel of the quadrilateral's map at the sample.
template <class T>
[[nodiscard]] inline T major_at(Quad<T> const& quad, T usable_texels, LightSample<T> const& sample) noexcept {
    QuadGain<T> const map = gain_at(quad, usable_texels, sample.place);
    T const det = map.x.x * map.y.y - map.x.y * map.y.x;
    // G * adjugate(M), column by column.
    Vec2<T> const p = sample.gain_x * map.y.y - sample.gain_y * map.x.y;
    Vec2<T> const q = sample.gain_y * map.x.x - sample.gain_x * map.y.x;
    T const sum = glm::dot(p, p) + glm::dot(q, q), cross = p.x * q.y - p.y * q.x;
    T const rest = sum * sum - T(4) * cross * cross;
    T const stretch = std::sqrt(T(0.5) * (sum + std::sqrt(rest > T(0) ? rest : T(0))));
    T const size = std::abs(det);
    return stretch < footprint_limit<T> * size ? stretch / size : footprint_limit<T>;
}

// Samples as wide as they are long: coordinates in which directions are told apart.
template <class T>
struct SampleFrame {
    Vec2<T> middle{T(0)};
    Vec2<T> a{T(1), T(0)};  // what a coordinate gains for a metre of the light's plane
    Vec2<T> b{T(0), T(1)};
};

inline constexpr int quad_directions = 64;

template <class T>
struct Supports {
    SampleFrame<T> frame;
    std::array<Vec2<T>, quad_directions> direction;  // in the light's plane, outward
    std::array<T, quad_directions> reach;            // the most of direction . (place - middle)
    int count = 0;                                   // samples
};

// Directions evenly around.
template <class T>
[[nodiscard]] inline Supports<T> no_supports(SampleFrame<T> const& frame) noexcept {
    Supports<T> supports;
    supports.frame = frame;
    constexpr T turn = T(6.28318530717958647692528676655900577L);
    for (int i = 0; i < quad_directions; ++i) {
        T const angle = turn * T(i) / T(quad_directions);
        supports.direction[static_cast<unsigned>(i)] = frame.a * std::cos(angle) + frame.b * std::sin(angle);
        supports.reach[static_cast<unsigned>(i)] = std::numeric_limits<T>::lowest();
    }
    return supports;
}

template <class T>
inline void add(Supports<T>& supports, Vec2<T> const& place) noexcept {
    Vec2<T> const p = place - supports.frame.middle;
    for (unsigned i = 0; i < unsigned(quad_directions); ++i) {
        T const reach = supports.direction[i].x * p.x + supports.direction[i].y * p.y;
        supports.reach[i] = reach > supports.reach[i] ? reach : supports.reach[i];
    }
    ++supports.count;
}

template <class T>
inline void add(Supports<T>& supports, LightSample<T> const& sample) noexcept {
    Vec2<T> const p = sample.place - supports.frame.middle;
    for (unsigned i = 0; i < unsigned(quad_directions); ++i) {
        Vec2<T> const& d = supports.direction[i];
        T const reach = glm::dot(d, p) + std::abs(glm::dot(d, sample.reach_x)) + std::abs(glm::dot(d, sample.reach_y));
        supports.reach[i] = reach > supports.reach[i] ? reach : supports.reach[i];
    }
    ++supports.count;
}

// Between the four sides that touch the samples in these directions (left, right, bottom, top; whole turns never
// matter), moved out by what rounding may take.
template <class T>
[[nodiscard]] inline Quad<T> quad_at(Supports<T> const& supports, std::array<int, 4> const& direction) noexcept {
    QuadSides<T> sides;
    static_assert((quad_directions & (quad_directions - 1)) == 0, "whole turns must not matter below zero");
    for (unsigned k = 0; k < 4; ++k) {
        auto const i = static_cast<unsigned>(direction[k]) % unsigned(quad_directions);
        // Coordinates of the frame are about 1 at the samples' ends.
        T const reach = supports.reach[i], slack = T(1e-4) * std::fmax(T(1), std::abs(reach));
        sides[k] = Vec3<T>(-supports.direction[i], reach + slack);
    }
    return moved(quad_between(sides), supports.frame.middle);
}

template <class T>
struct QuadFit {
    Quad<T> quad;
    std::array<int, 4> direction{};           // of left, right, bottom, top
    T price = std::numeric_limits<T>::max();  // the sum over all samples
};

namespace detail {

// Every stride-th of the samples listed.
template <class T>
[[nodiscard]] inline T price_in(Quad<T> const& quad, T usable_texels, LightSample<T> const* samples,
                                std::uint16_t const* list, int count, int stride) noexcept {
    T sum = T(0);
    for (int i = 0; i < count; i += stride) {
        LightSample<T> const& sample = samples[list[i]];
        if (sample.weight > T(0)) sum += sample.weight * shadowmath::price_of(major_at(quad, usable_texels, sample));
    }
    return sum * T(stride);
}

template <class T>
inline void consider(QuadFit<T>& best, Supports<T> const& supports, std::array<int, 4> const& direction,
                     T usable_texels, LightSample<T> const* samples, std::uint16_t const* list, int count,
                     int stride) noexcept {
    Quad<T> const quad = quad_at(supports, direction);
    if (!quad.visible) return;
    // Of no samples the smallest is as good as any.
    T const price = count > 0 ? price_in(quad, usable_texels, samples, list, count, stride) : area(quad);
    if (!(price < best.price)) return;
    best = {quad, direction, price};
}

}  // namespace detail

// The frame of the samples listed: their principal axes, one unit to their ends.
template <class T>
[[nodiscard]] inline SampleFrame<T> frame_of(LightSample<T> const* samples, std::uint16_t const* list,
                                             int count) noexcept {
    SampleFrame<T> frame;
    if (count <= 0) return frame;
    Vec2<T> sum(T(0));
    for (int i = 0; i < count; ++i) sum += samples[list[i]].place;
    frame.middle = sum / T(count);
    T xx = T(0), xy = T(0), yy = T(0);
    for (int i = 0; i < count; ++i) {
        Vec2<T> const p = samples[list[i]].place - frame.middle;
        xx += p.x * p.x;
        xy += p.x * p.y;
        yy += p.y * p.y;
    }
    T const angle = T(0.5) * std::atan2(T(2) * xy, xx - yy);
    Vec2<T> const a(std::cos(angle), std::sin(angle)), b(-a.y, a.x);
    T reach_a = T(0), reach_b = T(0);
    for (int i = 0; i < count; ++i) {
        LightSample<T> const& sample = samples[list[i]];
        Vec2<T> const p = sample.place - frame.middle;
        auto const along = [&](Vec2<T> const& axis) {
            return std::abs(glm::dot(axis, p)) + std::abs(glm::dot(axis, sample.reach_x)) +
                   std::abs(glm::dot(axis, sample.reach_y));
        };
        reach_a = std::fmax(reach_a, along(a));
        reach_b = std::fmax(reach_b, along(b));
    }
    T const least = std::fmax(std::fmax(reach_a, reach_b) * T(1e-4), T(1e-6));
    frame.a = a / std::fmax(reach_a, least);
    frame.b = b / std::fmax(reach_b, least);
    return frame;
}

// No single turn of a side by a 64th makes the price less. `stride` leaves samples out of the price, never out of the
// map. Not visible where there are no supports.
template <class T>
[[nodiscard]] inline QuadFit<T> fit_quad(Supports<T> const& supports, LightSample<T> const* samples,
                                         std::uint16_t const* list, int count, T usable_texels,
                                         int stride = 1) noexcept {
    QuadFit<T> best;
    if (supports.count == 0) return best;
    constexpr int quarter = quad_directions / 4;
    for (int r = 0; r < quarter; ++r)
        detail::consider(best, supports, {r + 2 * quarter, r, r + 3 * quarter, r + quarter}, usable_texels, samples,
                         list, count, stride);
    for (int step = quarter / 2; step >= 1;) {
        QuadFit<T> const before = best;
        for (unsigned k = 0; k < 4; ++k)
            for (int const turn : {-step, step}) {
                std::array<int, 4> moved = best.direction;
                moved[k] += turn;
                detail::consider(best, supports, moved, usable_texels, samples, list, count, stride);
            }
        // Two at once: a trapezoid's legs.
        for (int const turn : {-step, step}) {
            std::array<int, 4> legs = best.direction, ends = best.direction;
            legs[0] += turn, legs[1] -= turn;
            ends[2] += turn, ends[3] -= turn;
            detail::consider(best, supports, legs, usable_texels, samples, list, count, stride);
            detail::consider(best, supports, ends, usable_texels, samples, list, count, stride);
        }
        if (!(best.price < before.price * T(0.999))) step /= 2;
    }
    return best;
}

}  // namespace v0
}  // namespace shadowmath
