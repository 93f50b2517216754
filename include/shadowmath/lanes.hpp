// SPDX-License-Identifier: MIT
//
// Four numbers that are computed with as one: a register where the compiler has vectors of float, an array elsewhere.
// The same operations in the same order either way, so the same bits.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/reach.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

// One instruction each, where the compiler lets them be named.
#if defined(__SSE2__) && defined(__has_builtin)
#if __has_builtin(__builtin_ia32_sqrtps) && __has_builtin(__builtin_ia32_minps) && __has_builtin(__builtin_ia32_maxps)
#define SHADOWMATH_NAMES_SSE 1
#endif
#endif
#ifndef SHADOWMATH_NAMES_SSE
#define SHADOWMATH_NAMES_SSE 0
#endif

namespace shadowmath {
inline namespace v0 {
namespace detail {

template <class T>
struct Lanes {
    using Scalar = T;
    static constexpr int fours = 1;
    T at[4];

    [[nodiscard]] static Lanes of(T a, T b, T c, T d) noexcept { return {{a, b, c, d}}; }
    [[nodiscard]] static Lanes all(T a) noexcept { return {{a, a, a, a}}; }
    [[nodiscard]] T operator[](int i) const noexcept { return at[i]; }

    friend Lanes absolute(Lanes const& a) noexcept {
        return {{std::abs(a.at[0]), std::abs(a.at[1]), std::abs(a.at[2]), std::abs(a.at[3])}};
    }
    friend Lanes operator+(Lanes const& a, Lanes const& b) noexcept {
        return {{a.at[0] + b.at[0], a.at[1] + b.at[1], a.at[2] + b.at[2], a.at[3] + b.at[3]}};
    }
    friend Lanes operator-(Lanes const& a, Lanes const& b) noexcept {
        return {{a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2], a.at[3] - b.at[3]}};
    }
    friend Lanes operator*(Lanes const& a, Lanes const& b) noexcept {
        return {{a.at[0] * b.at[0], a.at[1] * b.at[1], a.at[2] * b.at[2], a.at[3] * b.at[3]}};
    }
    friend Lanes operator/(Lanes const& a, Lanes const& b) noexcept {
        return {{a.at[0] / b.at[0], a.at[1] / b.at[1], a.at[2] / b.at[2], a.at[3] / b.at[3]}};
    }
    friend Lanes least(Lanes const& a, Lanes const& b) noexcept {
        auto const less = [](T x, T y) { return x < y ? x : y; };
        return {{less(a.at[0], b.at[0]), less(a.at[1], b.at[1]), less(a.at[2], b.at[2]), less(a.at[3], b.at[3])}};
    }
    // Place by place, a <= b ? then : otherwise.
    friend Lanes where_at_most(Lanes const& a, Lanes const& b, Lanes const& then, Lanes const& otherwise) noexcept {
        Lanes chosen;
        for (int i = 0; i < 4; ++i) chosen.at[i] = a.at[i] <= b.at[i] ? then.at[i] : otherwise.at[i];
        return chosen;
    }
    friend Lanes root(Lanes const& a) noexcept {
        return {{std::sqrt(a.at[0]), std::sqrt(a.at[1]), std::sqrt(a.at[2]), std::sqrt(a.at[3])}};
    }
    friend Lanes largest(Lanes const& a, Lanes const& b) noexcept {
        auto const more = [](T x, T y) { return x > y ? x : y; };
        return {{more(a.at[0], b.at[0]), more(a.at[1], b.at[1]), more(a.at[2], b.at[2]), more(a.at[3], b.at[3])}};
    }
};

#if defined(__GNUC__) && (defined(__SSE2__) || defined(__ARM_NEON))

template <>
struct Lanes<float> {
    using Scalar = float;
    static constexpr int fours = 1;
    using Register [[gnu::vector_size(16)]] = float;
    Register at;

    [[nodiscard]] static Lanes of(float a, float b, float c, float d) noexcept { return {Register{a, b, c, d}}; }
    [[nodiscard]] static Lanes all(float a) noexcept { return {Register{a, a, a, a}}; }
    [[nodiscard]] float operator[](int i) const noexcept { return at[i]; }

    friend Lanes absolute(Lanes const& a) noexcept {
        using Bits [[gnu::vector_size(16)]] = std::uint32_t;
        Bits bits;
        std::memcpy(&bits, &a, sizeof bits);
        bits &= 0x7fffffffu;
        Lanes made;
        std::memcpy(&made, &bits, sizeof bits);
        return made;
    }
    friend Lanes operator+(Lanes const& a, Lanes const& b) noexcept { return {a.at + b.at}; }
    friend Lanes operator-(Lanes const& a, Lanes const& b) noexcept { return {a.at - b.at}; }
    friend Lanes operator*(Lanes const& a, Lanes const& b) noexcept { return {a.at * b.at}; }
    friend Lanes operator/(Lanes const& a, Lanes const& b) noexcept { return {a.at / b.at}; }
    friend Lanes where_at_most(Lanes const& a, Lanes const& b, Lanes const& then, Lanes const& otherwise) noexcept {
        return {a.at <= b.at ? then.at : otherwise.at};
    }
#if SHADOWMATH_NAMES_SSE
    friend Lanes least(Lanes const& a, Lanes const& b) noexcept {
        return {__builtin_ia32_minps(a.at, b.at)};
    }
    friend Lanes largest(Lanes const& a, Lanes const& b) noexcept {
        return {__builtin_ia32_maxps(a.at, b.at)};
    }
    friend Lanes root(Lanes const& a) noexcept {
        return {__builtin_ia32_sqrtps(a.at)};
    }
#else
    friend Lanes least(Lanes const& a, Lanes const& b) noexcept {
        return {a.at < b.at ? a.at : b.at};
    }
    friend Lanes largest(Lanes const& a, Lanes const& b) noexcept {
        return {a.at > b.at ? a.at : b.at};
    }
    friend Lanes root(Lanes const& a) noexcept {
        return of(std::sqrt(a.at[0]), std::sqrt(a.at[1]), std::sqrt(a.at[2]), std::sqrt(a.at[3]));
    }
#endif
};

#endif

// The last three of the four, and `after` them.
// NOTE: to be preferred to loading them where the four have just been written one by one.
template <class T>
[[nodiscard]] inline Lanes<T> moved_up(Lanes<T> const& four, T after) noexcept {
    return Lanes<T>::of(four[1], four[2], four[3], after);
}

// The places a, b, c and d of the four; 4 to 7 are those of `more`.
template <int a, int b, int c, int d, class T>
[[nodiscard]] inline Lanes<T> picked(Lanes<T> const& four, Lanes<T> const& more) noexcept {
    auto const at = [&](int i) { return i < 4 ? four[i] : more[i - 4]; };
    return Lanes<T>::of(at(a), at(b), at(c), at(d));
}

// Place by place, brought from `lo` to `hi`, 0 < lo: by their bits, so that nothing is raised by what is no number.
template <class T>
[[nodiscard]] inline Lanes<T> between(Lanes<T> const& four, T lo, T hi) noexcept {
    auto const brought = [lo, hi](T at) {
        return order_of(at) < order_of(lo) ? lo : order_of(hi) < order_of(at) ? hi : at;
    };
    return Lanes<T>::of(brought(four[0]), brought(four[1]), brought(four[2]), brought(four[3]));
}

// Whether any of them is beyond reach (reach.hpp), for several at a time.
template <class T>
class BeyondReach {
public:
    void look_at(Lanes<T> const& four) noexcept {
        for (int i = 0; i < 4; ++i) beyond_ |= beyond_reach(std::abs(four[i]));
    }
    // Parts of unit vectors: 2 and more is beyond, as the rounding that is allowed for would be too little.
    void look_at_parts(Lanes<T> const& four) noexcept { look_at(four * Lanes<T>::of(big, big, big, big)); }
    // Whatever is finite is within reach.
    void look_for_finite(Lanes<T> const& four) noexcept {
        for (int i = 0; i < 4; ++i) beyond_ |= all_finite(&four.at[i], 1) ? 0 : ~decltype(beyond_)(0);
    }
    [[nodiscard]] bool any() const noexcept { return beyond_ >> (8 * sizeof beyond_ - 1) != 0; }

private:
    static constexpr T big = T(0x1p59);
    decltype(beyond_reach(T(0))) beyond_ = 0;
};

#if defined(__GNUC__) && (defined(__SSE2__) || defined(__ARM_NEON))

#if defined(__clang__) || __GNUC__ >= 12
template <>
[[nodiscard]] inline Lanes<float> moved_up(Lanes<float> const& four, float after) noexcept {
    return {__builtin_shufflevector(four.at, Lanes<float>::Register{after}, 1, 2, 3, 4)};
}

template <int a, int b, int c, int d>
[[nodiscard]] inline Lanes<float> picked(Lanes<float> const& four, Lanes<float> const& more) noexcept {
    return {__builtin_shufflevector(four.at, more.at, a, b, c, d)};
}
#endif

template <>
[[nodiscard]] inline Lanes<float> between(Lanes<float> const& four, float lo, float hi) noexcept {
    using Bits [[gnu::vector_size(16)]] = std::int32_t;
    Bits at;
    std::memcpy(&at, &four, sizeof at);
    Bits const least = Bits{} + order_of(lo), most = Bits{} + order_of(hi);
    at = at < least ? least : at;
    at = at > most ? most : at;
    Lanes<float> made;
    std::memcpy(&made, &at, sizeof at);
    return made;
}

template <>
class BeyondReach<float> {
public:
    void look_at(Lanes<float> const& four) noexcept {
        Bits bits;
        std::memcpy(&bits, &four, sizeof bits);
        beyond_ |= (bits & 0x7fffffffu) + (0x80000000u - 0x5d800000u);
    }
    void look_at_parts(Lanes<float> const& four) noexcept {
        Bits bits;
        std::memcpy(&bits, &four, sizeof bits);
        beyond_ |= (bits & 0x7fffffffu) + (0x80000000u - 0x40000000u);
    }
    void look_for_finite(Lanes<float> const& four) noexcept {
        Bits bits;
        std::memcpy(&bits, &four, sizeof bits);
        beyond_ |= (bits & 0x7fffffffu) + (0x80000000u - 0x7f800000u);
    }
    [[nodiscard]] bool any() const noexcept {
        std::uint64_t halves[2];
        std::memcpy(halves, &beyond_, sizeof halves);
        return ((halves[0] | halves[1]) & 0x8000000080000000u) != 0;
    }

private:
    using Bits [[gnu::vector_size(16)]] = std::uint32_t;
    Bits beyond_ = {};
};

#endif

template <int a, int b, int c, int d, class T>
[[nodiscard]] inline Lanes<T> picked(Lanes<T> const& four) noexcept {
    return picked<a, b, c, d>(four, four);
}

// Rows for columns.
template <class T>
inline void transpose(Lanes<T> (&rows)[4]) noexcept {
    Lanes<T> const a = picked<0, 4, 1, 5>(rows[0], rows[1]), b = picked<0, 4, 1, 5>(rows[2], rows[3]);
    Lanes<T> const c = picked<2, 6, 3, 7>(rows[0], rows[1]), d = picked<2, 6, 3, 7>(rows[2], rows[3]);
    rows[0] = picked<0, 1, 4, 5>(a, b);
    rows[1] = picked<2, 3, 6, 7>(a, b);
    rows[2] = picked<0, 1, 4, 5>(c, d);
    rows[3] = picked<2, 3, 6, 7>(c, d);
}

template <class T>
[[nodiscard]] inline Lanes<T> four_at(T const* values) noexcept {
    Lanes<T> four;
    static_assert(sizeof four == 4 * sizeof(T), "numbers without a gap");
    std::memcpy(&four, values, sizeof four);
    return four;
}

template <class T>
[[nodiscard]] inline Lanes<T> all_four(T value) noexcept {
    return Lanes<T>::of(value, value, value, value);
}

// What edges are divided by to find where they meet a plane; nothing is divided by less. Planes are moved some epsilon
// of the reach of what they bound: along what leans less, none is met within a million times the length of an edge.
template <class T>
inline constexpr T least_divisor = T(1e-6) * std::numeric_limits<T>::epsilon();

template <class T>
[[nodiscard]] inline T not_zero(T value) noexcept {
    return std::abs(value) >= least_divisor<T> ? value : least_divisor<T>;
}
template <class T>
[[nodiscard, gnu::always_inline]] inline Lanes<T> not_zero(Lanes<T> const& value) noexcept {
    Lanes<T> const least = all_four(least_divisor<T>);
    return where_at_most(least, absolute(value), value, least);
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath
