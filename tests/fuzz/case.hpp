// SPDX-License-Identifier: MIT
//
// The laws, driven by bytes: what a fuzzer turns into inputs, and what any compiler, setting or processor can be tried
// with, since nothing here needs a framework. A file of laws/ registers one target; the drivers are libfuzzer.cpp,
// which looks for bytes that break a law, and replay.cpp, which runs stored and pseudo-random ones.
//
//   [[maybe_unused]] bool const splits_target = add_target("splits", [](Case& c) {
//       float const z_near = c.number<float>();
//       ...
//       auto const splits = c.call([&] { return uniform_splits(z_near, z_far, count); });
//       c.require(laws::is_ordered(splits, z_near, z_far, count), "splits rise from near to far");
//   });
#pragma once

#include "tests/support/watched.hpp"

#include <shadowmath/config.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace shadowmath::fuzz {

// -ffast-math promises neither the last bits nor flags (it divides before it asks whether it should).
#if defined(__FAST_MATH__)
inline constexpr bool fast_math = true;
#else
inline constexpr bool fast_math = false;
#endif

// Nor, by a clang newer than 14, anything of what overflows on the way from finite numbers: it takes the question
// whether it did for answered.
#if defined(__FAST_MATH__) && defined(__clang_major__) && __clang_major__ > 14
inline constexpr bool overflow_unseen = true;
#else
inline constexpr bool overflow_unseen = false;
#endif

enum class Numbers : std::uint8_t { any, finite };

class Case {
public:
    Case(std::uint8_t const* bytes, std::size_t size, Numbers numbers)
        : bytes_(bytes), left_(size), numbers_(numbers) {}

    [[nodiscard]] Numbers numbers() const { return numbers_; }

    // The next `count` bytes as a number; zeros behind the last.
    std::uint64_t bits(int count) {
        std::uint64_t value = 0;
        for (int i = 0; i < count && left_ > 0; ++i, --left_) value |= std::uint64_t(*bytes_++) << (8 * i);
        return value;
    }
    int below(int count) { return static_cast<int>(bits(2) % static_cast<std::uint64_t>(count)); }
    bool one_in(int count) { return below(count) + 1 == count; }

    // In [lo, hi).
    template <class T>
    T uniform(T lo, T hi) {
        T const share = static_cast<T>(bits(4)) / T(4294967296.0);
        return lo * (T(1) - share) + hi * share;
    }
    // Of any magnitude in [2^lo, 2^hi); without the library's pow, whose last bit differs between platforms.
    template <class T>
    T magnitude(int lo, int hi) {
        T const mantissa = uniform<T>(T(1), T(2));
        return std::ldexp(mantissa, lo + below(hi - lo));
    }
    // Whatever fits into the type: a moderate number, a special one, any bit pattern.
    template <class T>
    T number() {
        using Limits = std::numeric_limits<T>;
        T const special[] = {T(0), Limits::denorm_min(), Limits::min(), Limits::epsilon(),  T(1),
                             T(2), Limits::max(),        T(1e18),       Limits::infinity(), Limits::quiet_NaN()};
        int const kind = below(4);
        bool const negative = one_in(2);
        T value = kind < 2 ? magnitude<T>(-30, 30) : special[below(numbers_ == Numbers::finite ? 8 : 10)];
        if (kind == 3) {
            std::uint64_t const pattern = bits(static_cast<int>(sizeof(T)));
            std::memcpy(&value, &pattern, sizeof value);
            if (numbers_ == Numbers::finite && !all_bits_finite(value)) value = T(1);
        }
        return negative ? -value : value;
    }

    // What the call gives; a law is broken if it allocates.
    template <class Call>
    auto call(Call const& call) -> decltype(call()) {
        auto const done = test::watched(call);
        require(done.allocations == 0, "nothing allocates");
        return done.result;
    }
    // The same for inputs that are all in their ranges: no floating-point exception either.
    template <class Call>
    auto calm_call(Call const& call) -> decltype(call()) {
        auto const done = test::watched(call);
        require(done.allocations == 0, "nothing allocates");
        require(fast_math || done.raised == 0, "good inputs raise no floating-point exception");
        return done.result;
    }

    void require(bool holds, char const* law) {
        if (!holds && broken_law_ == nullptr) broken_law_ = law;
    }
    [[nodiscard]] char const* broken_law() const { return broken_law_; }

    // Numbers that every platform must compute alike, to the bit: what comes before any tan or pow. FNV-1a.
    template <class T>
    void hash(T const* values, int count) {
        for (int i = 0; i < count; ++i) {
            unsigned char bytes[sizeof(T)];
            T const value = values[i] == T(0) ? T(0) : values[i];  // compilers may choose the sign of a zero
            std::memcpy(bytes, &value, sizeof bytes);
            for (unsigned char const byte : bytes) hash_ = (hash_ ^ byte) * 0x100000001b3u;
        }
    }
    template <class T>
    void hash(Mat4<T> const& matrix) {
        for (int column = 0; column < 4; ++column) hash(&matrix[column].x, 4);
    }
    [[nodiscard]] std::uint64_t hash() const { return hash_; }

private:
    template <class T>
    static bool all_bits_finite(T const& value) {
        constexpr int exponent_bits = sizeof(T) == 4 ? 8 : 11;
        std::uint64_t pattern = 0;
        std::memcpy(&pattern, &value, sizeof value);
        std::uint64_t const all_ones = (std::uint64_t(1) << exponent_bits) - 1;
        return ((pattern >> (std::numeric_limits<T>::digits - 1)) & all_ones) != all_ones;
    }

    std::uint8_t const* bytes_;
    std::size_t left_;
    Numbers numbers_;
    char const* broken_law_ = nullptr;
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

struct Target {
    char const* name;
    void (*laws)(Case&);
};

inline std::vector<Target>& targets() {
    static std::vector<Target> all;
    return all;
}

// Once for each file of laws/, which are also compiled as one: let the names in it be its own.
inline bool add_target(char const* name, void (*laws)(Case&)) {
    targets().push_back({name, laws});
    return true;
}

}  // namespace shadowmath::fuzz
