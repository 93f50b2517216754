// SPDX-License-Identifier: MIT
//
// Is it finite, and how long is it: the two questions that every public function asks of its input.
//
// NOTE: under -ffast-math compilers assume that NaN and infinity do not exist and fold std::isnan, x != x and even bit
// tests of computed values to a constant. What survives is a look at the bits in the memory of the caller's inputs. So
// the test takes a pointer, and is called on inputs before any arithmetic.
#pragma once

#include <shadowmath/config.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace shadowmath {
inline namespace v0 {

// True when none of the `count` values at `values` is NaN or infinite.
[[nodiscard]] inline bool all_finite(float const* values, int count) noexcept {
    for (int i = 0; i < count; ++i) {
        std::uint32_t bits;
        std::memcpy(&bits, values + i, sizeof bits);
        if ((bits & 0x7f800000u) == 0x7f800000u) return false;
    }
    return true;
}

[[nodiscard]] inline bool all_finite(double const* values, int count) noexcept {
    constexpr std::uint64_t exponent = 0x7ff0000000000000u;
    for (int i = 0; i < count; ++i) {
        std::uint64_t bits;
        std::memcpy(&bits, values + i, sizeof bits);
        if ((bits & exponent) == exponent) return false;
    }
    return true;
}

// For the high-precision twin of tests, never run with -ffast-math: formats of long double differ between platforms.
[[nodiscard]] inline bool all_finite(long double const* values, int count) noexcept {
    for (int i = 0; i < count; ++i)
        if (!(values[i] >= std::numeric_limits<long double>::lowest() &&
              values[i] <= std::numeric_limits<long double>::max()))
            return false;
    return true;
}

// True for +infinity alone: a camera without a far plane. Its name is not used: clang warns of that under -ffast-math.
template <class T>
[[nodiscard]] inline bool is_positive_infinity(T const* value) noexcept {
    constexpr std::uint32_t of_float = 0x7f800000u;
    constexpr std::uint64_t of_double = 0x7ff0000000000000u;
    if (sizeof(T) == sizeof of_float) return std::memcmp(value, &of_float, sizeof of_float) == 0;
    if (std::numeric_limits<T>::digits == 53) return std::memcmp(value, &of_double, sizeof of_double) == 0;
    return *value > std::numeric_limits<T>::max();
}

template <class T>
[[nodiscard]] inline bool all_finite(Vec2<T> const& v) noexcept {
    return all_finite(&v.x, 2);
}
template <class T>
[[nodiscard]] inline bool all_finite(Vec3<T> const& v) noexcept {
    return all_finite(&v.x, 3);
}
template <class T>
[[nodiscard]] inline bool all_finite(Vec4<T> const& v) noexcept {
    return all_finite(&v.x, 4);
}
template <class T>
[[nodiscard]] inline bool all_finite(Mat4<T> const& m) noexcept {
    return all_finite(m[0]) && all_finite(m[1]) && all_finite(m[2]) && all_finite(m[3]);
}

template <class T>
struct Normalized {
    Vec3<T> direction{T(0)};  // unit, or zero when `ok` is false
    T length = T(0);          // of the input; may overflow to infinity for components near the largest number
    bool ok = false;
};

// Unit to 2 ulp for every finite vector but the zero vector: nothing overflows, and a length of 1e-30 in float is as
// good as one of 1. Dividing by the largest component first is what makes it so. A vector with a NaN or an infinity in
// it is as good as zero.
template <class T>
[[nodiscard]] inline Normalized<T> safe_normalize(Vec3<T> const& v) noexcept {
    if (!all_finite(v)) return {};
    Vec3<T> const magnitude(std::abs(v.x), std::abs(v.y), std::abs(v.z));
    T largest = magnitude.x > magnitude.y ? magnitude.x : magnitude.y;
    largest = largest > magnitude.z ? largest : magnitude.z;
    if (!(largest > T(0))) return {};
    // -ffast-math divides by way of the reciprocal, which overflows or vanishes for what is very short or very long. A
    // power of two first, which is exact, leaves it room.
    constexpr T up = T(0x1p100), down = T(0x1p-100);
    T const power = largest < down ? up : (largest > up ? down : T(1));
    Vec3<T> const moderate = v * power;
    T const divisor = largest * power;
    Vec3<T> const scaled(moderate.x / divisor, moderate.y / divisor, moderate.z / divisor);
    T const length = std::sqrt(glm::dot(scaled, scaled));
    return {scaled / length, length * largest, true};
}

namespace detail {

// The length of (a, b) to an ulp, where neither is NaN or infinite; no square over- or underflows. With a root alone:
// the last bit of std::hypot is the platform's.
template <class T>
[[nodiscard]] inline T hypotenuse(T a, T b) noexcept {
    using Exact = decltype(T() + double());
    Exact x = Exact(a), y = Exact(b);
    if (sizeof(T) == sizeof(float)) return T(std::sqrt(x * x + y * y));
    // By a power of two, which is exact.
    constexpr Exact up = Exact(0x1p700), down = Exact(0x1p-700);
    Exact const largest = std::abs(x) > std::abs(y) ? std::abs(x) : std::abs(y);
    Exact const power = largest < Exact(0x1p-400) ? up : (largest > Exact(0x1p400) ? down : Exact(1));
    x *= power, y *= power;
    Exact const back = power < Exact(1) ? up : (power > Exact(1) ? down : Exact(1));
    return T(std::sqrt(x * x + y * y) * back);
}

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath
