// SPDX-License-Identifier: MIT
//
// Four numbers that are computed with as one: a register where the compiler has vectors of float, an array elsewhere.
// The same operations in the same order either way, so the same bits.
#pragma once

#include <shadowmath/config.hpp>

namespace shadowmath {
inline namespace v0 {
namespace detail {

template <class T>
struct Lanes {
    T at[4];

    [[nodiscard]] static Lanes of(T a, T b, T c, T d) noexcept { return {{a, b, c, d}}; }
    [[nodiscard]] T operator[](int i) const noexcept { return at[i]; }

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
    friend Lanes largest(Lanes const& a, Lanes const& b) noexcept {
        auto const more = [](T x, T y) { return x > y ? x : y; };
        return {{more(a.at[0], b.at[0]), more(a.at[1], b.at[1]), more(a.at[2], b.at[2]), more(a.at[3], b.at[3])}};
    }
};

#if defined(__GNUC__) && (defined(__SSE2__) || defined(__ARM_NEON))

template <>
struct Lanes<float> {
    using Register [[gnu::vector_size(16)]] = float;
    Register at;

    [[nodiscard]] static Lanes of(float a, float b, float c, float d) noexcept { return {Register{a, b, c, d}}; }
    [[nodiscard]] float operator[](int i) const noexcept { return at[i]; }

    friend Lanes operator+(Lanes const& a, Lanes const& b) noexcept { return {a.at + b.at}; }
    friend Lanes operator-(Lanes const& a, Lanes const& b) noexcept { return {a.at - b.at}; }
    friend Lanes operator*(Lanes const& a, Lanes const& b) noexcept { return {a.at * b.at}; }
    friend Lanes operator/(Lanes const& a, Lanes const& b) noexcept { return {a.at / b.at}; }
    friend Lanes least(Lanes const& a, Lanes const& b) noexcept { return {a.at < b.at ? a.at : b.at}; }
    friend Lanes largest(Lanes const& a, Lanes const& b) noexcept { return {a.at > b.at ? a.at : b.at}; }
};

#endif

template <class T>
[[nodiscard]] inline Lanes<T> all_four(T value) noexcept {
    return Lanes<T>::of(value, value, value, value);
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath
