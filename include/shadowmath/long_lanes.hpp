// SPDX-License-Identifier: MIT
//
// Several fours (lanes.hpp) that are computed with as one: as many as a register of the processor holds that the
// compiler is told of. Loops take `fours` steps at a time, and are the same source for one, two and four.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/lanes.hpp>

#include <cstring>

namespace shadowmath {
inline namespace v0 {
namespace detail {

template <class T>
struct LongLanesOf {
    using Type = Lanes<T>;
};

#if defined(__GNUC__) && defined(__AVX__) && (defined(__clang__) || __GNUC__ >= 12)

struct LongFloats {
    using Scalar = float;
#if defined(__AVX512F__)
    static constexpr int fours = 4;
#else
    static constexpr int fours = 2;
#endif
    using Register [[gnu::vector_size(16 * fours)]] = float;
    Register at;

#if defined(__AVX512F__)
    [[nodiscard]] static LongFloats all(float a) noexcept {
        return {Register{a, a, a, a, a, a, a, a, a, a, a, a, a, a, a, a}};
    }
#else
    [[nodiscard]] static LongFloats all(float a) noexcept {
        return {Register{a, a, a, a, a, a, a, a}};
    }
#endif
    friend LongFloats operator+(LongFloats const& a, LongFloats const& b) noexcept {
        return {a.at + b.at};
    }
    friend LongFloats operator-(LongFloats const& a, LongFloats const& b) noexcept {
        return {a.at - b.at};
    }
    friend LongFloats operator*(LongFloats const& a, LongFloats const& b) noexcept {
        return {a.at * b.at};
    }
    friend LongFloats operator/(LongFloats const& a, LongFloats const& b) noexcept {
        return {a.at / b.at};
    }
    friend LongFloats least(LongFloats const& a, LongFloats const& b) noexcept {
        return {a.at < b.at ? a.at : b.at};
    }
    friend LongFloats largest(LongFloats const& a, LongFloats const& b) noexcept {
        return {a.at > b.at ? a.at : b.at};
    }
    friend LongFloats where_at_most(LongFloats const& a, LongFloats const& b, LongFloats const& then,
                                    LongFloats const& otherwise) noexcept {
        return {a.at <= b.at ? then.at : otherwise.at};
    }
};

template <>
struct LongLanesOf<float> {
    using Type = LongFloats;
};

#endif

template <class T>
using LongLanes = typename LongLanesOf<T>::Type;

// The same four throughout.
template <class Long, class T>
[[nodiscard]] inline Long repeated(Lanes<T> const& four) noexcept {
    if constexpr (Long::fours == 1) return four;
#if defined(__AVX512F__) && defined(__clang__)
    if constexpr (Long::fours == 4)
        return {__builtin_shufflevector(four.at, four.at, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3)};
#elif defined(__AVX512F__)
    if constexpr (Long::fours == 4)
        return {__builtin_ia32_broadcastf32x4_512(four.at, typename Long::Register{}, 0xffff)};
#elif defined(__AVX__)
    if constexpr (Long::fours == 2) return {__builtin_shufflevector(four.at, four.at, 0, 1, 2, 3, 0, 1, 2, 3)};
#endif
}

// four[first] in the first four places, four[first + 1] in the next.
template <class Long, class T>
[[nodiscard]] inline Long spread(Lanes<T> const& four, int first) noexcept {
    if constexpr (Long::fours == 1) return Long::all(four[first]);
#if defined(__AVX512F__)
    if constexpr (Long::fours == 4) {
        auto const all = repeated<Long>(four).at;
        return {__builtin_shufflevector(all, all, 0, 0, 0, 0, 5, 5, 5, 5, 10, 10, 10, 10, 15, 15, 15, 15)};
    }
#elif defined(__AVX__)
    if constexpr (Long::fours == 2) {
        auto const all = repeated<Long>(four).at;
        return first == 0 ? Long{__builtin_shufflevector(all, all, 0, 0, 0, 0, 5, 5, 5, 5)}
                          : Long{__builtin_shufflevector(all, all, 2, 2, 2, 2, 7, 7, 7, 7)};
    }
#endif
}

// Fours one behind the other.
template <class Long, class T>
[[nodiscard]] inline Long joined(Lanes<T> const* four) noexcept {
    if constexpr (Long::fours == 1) return four[0];
#if defined(__AVX__)
    if constexpr (Long::fours > 1) {
        auto const a = __builtin_shufflevector(four[0].at, four[1].at, 0, 1, 2, 3, 4, 5, 6, 7);
#if defined(__AVX512F__)
        auto const b = __builtin_shufflevector(four[2].at, four[3].at, 0, 1, 2, 3, 4, 5, 6, 7);
        return {__builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)};
#else
        return {a};
#endif
    }
#endif
}

// `four` in the last four places.
template <class Long, class T>
[[nodiscard]] inline Long with_last([[maybe_unused]] Long const& lanes, Lanes<T> const& four) noexcept {
    if constexpr (Long::fours == 1) return four;
#if defined(__AVX512F__)
    if constexpr (Long::fours == 4) {
        auto const all = repeated<Long>(four).at;
        return {__builtin_shufflevector(lanes.at, all, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 28, 29, 30, 31)};
    }
#elif defined(__AVX__)
    if constexpr (Long::fours == 2)
        return {__builtin_shufflevector(lanes.at, repeated<Long>(four).at, 0, 1, 2, 3, 12, 13, 14, 15)};
#endif
}

template <class Long, class T>
[[nodiscard]] inline Long long_at(T const* values) noexcept {
    Long lanes;
    std::memcpy(&lanes, values, sizeof lanes);
    return lanes;
}

template <class T, class Long>
inline void store_long(T* values, Long const& lanes) noexcept {
    std::memcpy(values, &lanes, sizeof lanes);
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath
