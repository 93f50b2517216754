// SPDX-License-Identifier: MIT
//
// Sixteen numbers at once, as an array: for any scalar type and machine, and the twin that lanes in registers must
// agree with. What an operation means is said here.
//
// A fused operation rounds once or twice, as the machine has it; negating an operand negates the result in any case.
#pragma once

#include <shadowmath/config.hpp>

#include <cmath>
#include <cstdint>

namespace shadowmath {
inline namespace v0 {

inline constexpr int lane_count = 16;

namespace detail {

template <class T>
struct WiderThan {
    using Type = T;
};
template <>
struct WiderThan<float> {
    using Type = double;
};

[[nodiscard]] inline int lowest_bit(std::uint32_t bits) noexcept {
#if defined(__GNUC__)
    return __builtin_ctz(bits);
#else
    int place = 0;
    while ((bits >> place & 1u) == 0) ++place;
    return place;
#endif
}

// Keys are numbers that are only compared: within a byte each, so that sixteen are compared at once. NaN is the last.
template <class T>
[[nodiscard]] inline unsigned char byte_of(T value) noexcept {
    return value < T(255) ? static_cast<unsigned char>(value > T(0) ? value : T(0)) : 255;
}

}  // namespace detail

// What sums of float products are taken in, where their terms cancel; double and long double are their own.
template <class T>
using Wider = typename detail::WiderThan<T>::Type;

template <class T>
struct PlainLanes {
    using Scalar = T;
    using Wide = PlainLanes<Wider<T>>;
    T lane[lane_count];

    [[nodiscard]] static PlainLanes all(T value) noexcept {
        return each([value](int) { return value; });
    }
    template <class From>
    [[nodiscard]] static PlainLanes load(From const* from) noexcept {
        return each([from](int k) { return static_cast<T>(from[k]); });
    }
    [[nodiscard]] static PlainLanes narrow(Wide const& wide) noexcept { return load(wide.lane); }
    void store(T* to) const noexcept {
        for (int k = 0; k < lane_count; ++k) to[k] = lane[k];
    }
    template <class Value>
    [[nodiscard]] static PlainLanes each(Value const& value) noexcept {
        PlainLanes made;
        for (int k = 0; k < lane_count; ++k) made.lane[k] = value(k);
        return made;
    }

    friend PlainLanes operator+(PlainLanes const& a, PlainLanes const& b) noexcept {
        return each([&](int k) { return a.lane[k] + b.lane[k]; });
    }
    friend PlainLanes operator-(PlainLanes const& a, PlainLanes const& b) noexcept {
        return each([&](int k) { return a.lane[k] - b.lane[k]; });
    }
    friend PlainLanes operator*(PlainLanes const& a, PlainLanes const& b) noexcept {
        return each([&](int k) { return a.lane[k] * b.lane[k]; });
    }
    friend PlainLanes operator/(PlainLanes const& a, PlainLanes const& b) noexcept {
        return each([&](int k) { return a.lane[k] / b.lane[k]; });
    }
    // The second where either is NaN.
    friend PlainLanes least(PlainLanes const& a, PlainLanes const& b) noexcept {
        return each([&](int k) { return a.lane[k] < b.lane[k] ? a.lane[k] : b.lane[k]; });
    }
    friend PlainLanes most(PlainLanes const& a, PlainLanes const& b) noexcept {
        return each([&](int k) { return a.lane[k] > b.lane[k] ? a.lane[k] : b.lane[k]; });
    }
    // 1 / a to four roundings; anything where a is 0 or not finite.
    friend PlainLanes reciprocal(PlainLanes const& a) noexcept {
        return each([&](int k) { return a.lane[k] != T(0) ? T(1) / a.lane[k] : T(0); });
    }
    friend PlainLanes absolute(PlainLanes const& a) noexcept {
        return each([&](int k) { return std::abs(a.lane[k]); });
    }
    friend PlainLanes with_sign_of(PlainLanes const& magnitude, PlainLanes const& sign) noexcept {
        return each([&](int k) { return std::copysign(magnitude.lane[k], sign.lane[k]); });
    }
    friend PlainLanes fused(PlainLanes const& a, PlainLanes const& b, PlainLanes const& c) noexcept {
        return each([&](int k) { return a.lane[k] * b.lane[k] + c.lane[k]; });
    }
    // Bit k: a >= b in lane k. Not where either is NaN.
    friend std::uint32_t at_least(PlainLanes const& a, PlainLanes const& b) noexcept {
        std::uint32_t bits = 0;
        for (int k = 0; k < lane_count; ++k) bits |= (a.lane[k] >= b.lane[k] ? 1u : 0u) << k;
        return bits;
    }
    friend T smallest(PlainLanes const& a) noexcept {
        T found = a.lane[0];
        for (int k = 1; k < lane_count; ++k) found = a.lane[k] < found ? a.lane[k] : found;
        return found;
    }
    friend T largest(PlainLanes const& a) noexcept {
        T found = a.lane[0];
        for (int k = 1; k < lane_count; ++k) found = a.lane[k] > found ? a.lane[k] : found;
        return found;
    }
    // Writes those of the sixteen words from `from` on whose bit is set, without gaps; the words behind them, up to
    // sixteen in all, may be anything. Gives how many.
    static std::uint32_t compress(std::uint32_t bits, std::uint32_t const* from, std::uint32_t* to) noexcept {
        std::uint32_t count = 0;
        for (; bits != 0; bits &= bits - 1) to[count++] = from[detail::lowest_bit(bits)];
        return count;
    }
    // Lane 4 j + i: row[j][i].
    [[nodiscard]] static PlainLanes rows(T const* const (&row)[4]) noexcept {
        return each([&row](int k) { return row[k / 4][k % 4]; });
    }
    // The same of three components: row[j][3 i + component].
    static void triples(T const* const (&row)[4], PlainLanes (&components)[3]) noexcept {
        for (int axis = 0; axis < 3; ++axis)
            components[axis] = each([&row, axis](int k) { return row[k / 4][3 * (k % 4) + axis]; });
    }
    // Lane k: the three numbers at at(k).
    template <class At>
    static void points(At const& at, PlainLanes (&xyz)[3]) noexcept {
        for (int axis = 0; axis < 3; ++axis) xyz[axis] = each([&at, axis](int k) { return at(k)[axis]; });
    }
    // From 0 to 255, what is beyond them at the nearer end, without the fraction.
    void store_bytes(unsigned char* to) const noexcept {
        for (int k = 0; k < lane_count; ++k) to[k] = detail::byte_of(lane[k]);
    }
    [[nodiscard]] static PlainLanes load_bytes(unsigned char const* from) noexcept {
        return each([from](int k) { return static_cast<T>(from[k]); });
    }
    // Whole numbers from 0 to 2^31 - 1, without the fraction.
    void store_words(std::uint32_t* to) const noexcept {
        for (int k = 0; k < lane_count; ++k) to[k] = static_cast<std::uint32_t>(static_cast<std::int32_t>(lane[k]));
    }
    // Lanes of a where the bit is set, else those of b.
    friend PlainLanes chosen(std::uint32_t bits, PlainLanes const& a, PlainLanes const& b) noexcept {
        return each([&](int k) { return (bits >> k & 1u) != 0 ? a.lane[k] : b.lane[k]; });
    }
};

}  // namespace v0
}  // namespace shadowmath
