// SPDX-License-Identifier: MIT
//
// Thirty-two samples of a pixel as the bits of a word, and which of them a half plane holds: exactly, or out of a table
// of 1024 words.
//
// Use the exact test where arithmetic is wide: it costs two fused operations and a comparison a register. The table is
// for machines where a look-up is cheaper; it moves the line by at most table_displacement of a pixel.
//
// Source: 32 Halton points and 5 + 5 bits of angle and radius, Wyman, Hoetzlein and Lefohn, I3D 2015. How the two are
// rounded is ours.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/irregular/edge.hpp>
#include <shadowmath/irregular/lanes.hpp>

#include <array>
#include <cmath>
#include <cstdint>

namespace shadowmath {
inline namespace v0 {

inline constexpr int samples_per_pixel = 32;
inline constexpr std::uint32_t every_sample = 0xffffffffu;

// Digits of `index` in this base, mirrored at the point.
template <class T>
[[nodiscard]] constexpr T radical_inverse(int base, int index) noexcept {
    T value = T(0), place = T(1) / T(base);
    for (; index > 0; index /= base, place /= T(base)) value += T(index % base) * place;
    return value;
}

// In the pixel's unit square, bit i of a mask at (u[i], v[i]): the Halton points of bases 2 and 3 from index 1 on.
template <class T>
struct PixelSamples {
    T u[samples_per_pixel];
    T v[samples_per_pixel];
};

namespace detail {

template <class T>
[[nodiscard]] constexpr PixelSamples<T> halton_samples() noexcept {
    PixelSamples<T> samples{};
    for (int i = 0; i < samples_per_pixel; ++i) {
        samples.u[i] = radical_inverse<T>(2, i + 1);
        samples.v[i] = radical_inverse<T>(3, i + 1);
    }
    return samples;
}

}  // namespace detail

template <class T>
inline constexpr PixelSamples<T> pixel_samples = detail::halton_samples<T>();

// The samples where c + x u + y v >= 0, evaluated as (c + x u) + y v. A line and its negative together hold every
// sample.
template <class Lanes, class T = typename Lanes::Scalar>
[[nodiscard]] inline std::uint32_t half_plane_mask(PixelLine<T> const& line) noexcept {
    Lanes const c = Lanes::all(line.c), x = Lanes::all(line.x), y = Lanes::all(line.y), zero = Lanes::all(T(0));
    PixelSamples<T> const& at = pixel_samples<T>;
    auto const half = [&](int first) {
        return at_least(fused(y, Lanes::load(at.v + first), fused(x, Lanes::load(at.u + first), c)), zero);
    };
    return half(0) | half(lane_count) << lane_count;
}

// The samples that all four hold.
template <class Lanes, class T = typename Lanes::Scalar>
[[nodiscard]] inline std::uint32_t half_planes_mask(PixelLine<T> const (&lines)[4]) noexcept {
    Lanes const zero = Lanes::all(T(0));
    std::uint32_t low = (1u << lane_count) - 1u, high = low;
    for (PixelLine<T> const& line : lines) {
        Lanes const c = Lanes::all(line.c), x = Lanes::all(line.x), y = Lanes::all(line.y);
        PixelSamples<T> const& at = pixel_samples<T>;
        low &= at_least(fused(y, Lanes::load(at.v), fused(x, Lanes::load(at.u), c)), zero);
        high &= at_least(fused(y, Lanes::load(at.v + lane_count), fused(x, Lanes::load(at.u + lane_count), c)), zero);
    }
    return low | high << lane_count;
}

inline constexpr int table_steps = 32;  // of angle, and of radius

// Half a step of radius, and half a step of angle where a radius is longest: sqrt(1/2) (1 / 64 + pi / 32).
inline constexpr double table_displacement = 0.0805;

// The masks of half planes n . (s - middle) >= r, by angle of n and then by r from 0 to sqrt(1/2).
struct HalfPlaneTable {
    std::array<std::uint32_t, table_steps * table_steps> masks;
};

template <class T = double>
[[nodiscard]] inline HalfPlaneTable half_plane_table() noexcept {
    HalfPlaneTable table{};
    double const step = 6.283185307179586 / table_steps, reach = 0.7071067811865476 / table_steps;
    for (int k = 0; k < table_steps; ++k)
        for (int j = 0; j < table_steps; ++j) {
            double const x = std::cos((k + 0.5) * step), y = std::sin((k + 0.5) * step);
            PixelLine<T> const line{-(x + y) / 2.0 - (j + 0.5) * reach, x, y};
            table.masks[static_cast<std::size_t>(k * table_steps + j)] = half_plane_mask<PlainLanes<T>>(line);
        }
    return table;
}

// As half_plane_mask, but that samples within table_displacement of the line may be on either side.
template <class T>
[[nodiscard]] inline std::uint32_t half_plane_mask(HalfPlaneTable const& table, PixelLine<T> const& line) noexcept {
    T const middle = line.c + (line.x + line.y) / T(2);
    T const length = std::sqrt(line.x * line.x + line.y * line.y);
    T const r = -middle;
    T const reach = T(0.70710678118654752440L) * length;
    if (!(r < reach)) return length == T(0) && r <= T(0) ? every_sample : 0u;
    if (r <= -reach) return every_sample;
    // A line beyond the middle is the complement of its opposite.
    bool const beyond = r < T(0);
    T const angle = beyond ? std::atan2(-line.y, -line.x) : std::atan2(line.y, line.x);
    constexpr T turns = T(table_steps) / T(6.283185307179586476925286766559L);
    int const k = static_cast<int>(std::floor(angle * turns)) & (table_steps - 1);
    // NOTE: as an unsigned number: under -ffast-math a length that overflows gives any j at all.
    unsigned const j = static_cast<unsigned>(static_cast<int>(std::abs(r) / reach * T(table_steps)));
    unsigned const last = table_steps - 1;
    std::uint32_t const mask = table.masks[static_cast<unsigned>(k) * table_steps + (j < last ? j : last)];
    return beyond ? ~mask : mask;
}

}  // namespace v0
}  // namespace shadowmath
