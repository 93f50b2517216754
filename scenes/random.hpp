// SPDX-License-Identifier: MIT
//
// Repeatable chance for the scenes: a SplitMix64 stream and a value noise over space.
// The standard distributions are left alone because every library draws them differently. Draw into named locals:
// compilers differ in the order in which they evaluate arguments.
// Source: Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, OOPSLA 2014 (the mixing function).
#pragma once

#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>

namespace shadowmath::scenes {

[[nodiscard]] inline std::uint64_t mix_bits(std::uint64_t z) noexcept {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

class Random {
public:
    explicit Random(std::uint64_t seed) noexcept : state_(seed) {}

    [[nodiscard]] std::uint64_t bits() noexcept { return mix_bits(state_ += 0x9e3779b97f4a7c15u); }
    [[nodiscard]] double unit() noexcept { return static_cast<double>(bits() >> 11) * 0x1p-53; }  // [0, 1)
    [[nodiscard]] double between(double a, double b) noexcept { return a + (b - a) * unit(); }
    [[nodiscard]] int below(int count) noexcept { return static_cast<int>(unit() * count); }  // 0 to count - 1
    [[nodiscard]] bool chance(double probability) noexcept { return unit() < probability; }

    template <class Values>
    [[nodiscard]] auto const& pick(Values const& values) noexcept {
        return values[static_cast<std::size_t>(unit() * static_cast<double>(std::size(values)))];
    }

private:
    std::uint64_t state_;
};

// Smooth value noise, -1 to 1, one value a lattice cell.
[[nodiscard]] inline double noise(glm::dvec3 p, std::uint64_t seed) noexcept {
    glm::dvec3 const cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
    glm::dvec3 const f = p - cell;
    glm::dvec3 const s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    auto const corner = [&](double dx, double dy, double dz) {
        auto const key = [](double v) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(v)); };
        std::uint64_t h = mix_bits(seed + key(cell.x + dx) * 0x9e3779b97f4a7c15u);
        h = mix_bits(h + key(cell.y + dy) * 0xd1b54a32d192ed03u);
        h = mix_bits(h + key(cell.z + dz) * 0x8cb92ba72f3d8dd7u);
        return static_cast<double>(h >> 11) * 0x1p-52 - 1.0;
    };
    auto const blend = [](double a, double b, double t) { return a + (b - a) * t; };
    auto const edge = [&](double dy, double dz) { return blend(corner(0, dy, dz), corner(1, dy, dz), s.x); };
    return blend(blend(edge(0, 0), edge(1, 0), s.y), blend(edge(0, 1), edge(1, 1), s.y), s.z);
}

// Octaves of noise, each half as wide and half as strong as the one before; about -1 to 1.
[[nodiscard]] inline double rough_noise(glm::dvec3 p, int octaves, std::uint64_t seed) noexcept {
    double sum = 0.0;
    double strength = 0.5;
    for (int i = 0; i < octaves; ++i, p *= 2.0, strength *= 0.5)
        sum += strength * noise(p, seed + static_cast<std::uint64_t>(i));
    return sum * 1.4;
}

}  // namespace shadowmath::scenes
