// SPDX-License-Identifier: MIT
//
// Sixteen numbers at once: one for each pixel of a 4 x 4 tile, or for sixteen nodes of a list. The kernels of the
// irregular z-buffer are written once, on these operations; which registers hold the numbers is a type.
//
//   PlainLanes<T>   an array, for any scalar type and machine; the twin that all others must agree with
//   Avx512Lanes     one register; where the compiler is told so (-march=native)
//   Avx2Lanes       two registers
//   BestLanes<T>    the fastest of them in this translation unit
//
// The type is a template argument of every kernel, so translation units built for different machines can be linked.
// A fused operation rounds once or twice, as the machine has it; negating an operand negates the result in any case.
#pragma once

#include <shadowmath/config.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

#if defined(__AVX512F__) || (defined(__AVX2__) && defined(__FMA__))
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push  // false alarms inside that header: GCC bug 105593
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <immintrin.h>
#pragma GCC diagnostic pop
#else
#include <immintrin.h>
#endif
#endif

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
        for (std::uint32_t k = 0; k < lane_count; ++k) {
            to[count] = from[k];
            count += bits >> k & 1u;
        }
        return count;
    }
    // Lanes of a where the bit is set, else those of b.
    friend PlainLanes chosen(std::uint32_t bits, PlainLanes const& a, PlainLanes const& b) noexcept {
        return each([&](int k) { return (bits >> k & 1u) != 0 ? a.lane[k] : b.lane[k]; });
    }
};

#if defined(__AVX512F__)

// Sixteen doubles, for what is computed once a triangle.
struct Avx512Doubles {
    using Scalar = double;
    __m512d first;
    __m512d second;

    [[nodiscard]] static Avx512Doubles all(double value) noexcept {
        return {_mm512_set1_pd(value), _mm512_set1_pd(value)};
    }
    [[nodiscard]] static Avx512Doubles load(float const* from) noexcept {
        return {_mm512_cvtps_pd(_mm256_loadu_ps(from)), _mm512_cvtps_pd(_mm256_loadu_ps(from + 8))};
    }
    void store(double* to) const noexcept {
        _mm512_storeu_pd(to, first);
        _mm512_storeu_pd(to + 8, second);
    }

    friend Avx512Doubles operator+(Avx512Doubles a, Avx512Doubles b) noexcept {
        return {_mm512_add_pd(a.first, b.first), _mm512_add_pd(a.second, b.second)};
    }
    friend Avx512Doubles operator-(Avx512Doubles a, Avx512Doubles b) noexcept {
        return {_mm512_sub_pd(a.first, b.first), _mm512_sub_pd(a.second, b.second)};
    }
    friend Avx512Doubles operator*(Avx512Doubles a, Avx512Doubles b) noexcept {
        return {_mm512_mul_pd(a.first, b.first), _mm512_mul_pd(a.second, b.second)};
    }
    friend Avx512Doubles absolute(Avx512Doubles a) noexcept {
        return {_mm512_abs_pd(a.first), _mm512_abs_pd(a.second)};
    }
    friend Avx512Doubles with_sign_of(Avx512Doubles magnitude, Avx512Doubles sign) noexcept {
        __m512i const top = _mm512_set1_epi64(std::numeric_limits<std::int64_t>::min());
        auto const signed_as = [top](__m512d m, __m512d s) {
            return _mm512_castsi512_pd(
                _mm512_ternarylogic_epi64(top, _mm512_castpd_si512(s), _mm512_castpd_si512(m), 0xca));
        };
        return {signed_as(magnitude.first, sign.first), signed_as(magnitude.second, sign.second)};
    }
    friend Avx512Doubles fused(Avx512Doubles a, Avx512Doubles b, Avx512Doubles c) noexcept {
        return {_mm512_fmadd_pd(a.first, b.first, c.first), _mm512_fmadd_pd(a.second, b.second, c.second)};
    }
    friend std::uint32_t at_least(Avx512Doubles a, Avx512Doubles b) noexcept {
        std::uint32_t const low = _mm512_cmp_pd_mask(a.first, b.first, _CMP_GE_OQ);
        return low | static_cast<std::uint32_t>(_mm512_cmp_pd_mask(a.second, b.second, _CMP_GE_OQ)) << 8;
    }
};

struct Avx512Lanes {
    using Scalar = float;
    using Wide = Avx512Doubles;
    __m512 lanes;

    [[nodiscard]] static Avx512Lanes all(float value) noexcept { return {_mm512_set1_ps(value)}; }
    [[nodiscard]] static Avx512Lanes load(float const* from) noexcept { return {_mm512_loadu_ps(from)}; }
    void store(float* to) const noexcept { _mm512_storeu_ps(to, lanes); }

    friend Avx512Lanes operator+(Avx512Lanes a, Avx512Lanes b) noexcept { return {_mm512_add_ps(a.lanes, b.lanes)}; }
    friend Avx512Lanes operator-(Avx512Lanes a, Avx512Lanes b) noexcept { return {_mm512_sub_ps(a.lanes, b.lanes)}; }
    friend Avx512Lanes operator*(Avx512Lanes a, Avx512Lanes b) noexcept { return {_mm512_mul_ps(a.lanes, b.lanes)}; }
    friend Avx512Lanes operator/(Avx512Lanes a, Avx512Lanes b) noexcept { return {_mm512_div_ps(a.lanes, b.lanes)}; }
    friend Avx512Lanes least(Avx512Lanes a, Avx512Lanes b) noexcept { return {_mm512_min_ps(a.lanes, b.lanes)}; }
    friend Avx512Lanes most(Avx512Lanes a, Avx512Lanes b) noexcept { return {_mm512_max_ps(a.lanes, b.lanes)}; }
    friend Avx512Lanes reciprocal(Avx512Lanes a) noexcept {
        __m512 const rough = _mm512_rcp14_ps(a.lanes);  // 14 bits; a step of Newton's doubles them
        return {_mm512_mul_ps(rough, _mm512_fnmadd_ps(a.lanes, rough, _mm512_set1_ps(2.0f)))};
    }
    friend Avx512Lanes absolute(Avx512Lanes a) noexcept { return {_mm512_abs_ps(a.lanes)}; }
    friend Avx512Lanes with_sign_of(Avx512Lanes magnitude, Avx512Lanes sign) noexcept {
        __m512i const top = _mm512_set1_epi32(static_cast<int>(0x80000000u));
        // a where top, else b.
        return {_mm512_castsi512_ps(_mm512_ternarylogic_epi32(top, _mm512_castps_si512(sign.lanes),
                                                              _mm512_castps_si512(magnitude.lanes), 0xca))};
    }
    friend Avx512Lanes fused(Avx512Lanes a, Avx512Lanes b, Avx512Lanes c) noexcept {
        return {_mm512_fmadd_ps(a.lanes, b.lanes, c.lanes)};
    }
    friend std::uint32_t at_least(Avx512Lanes a, Avx512Lanes b) noexcept {
        return _mm512_cmp_ps_mask(a.lanes, b.lanes, _CMP_GE_OQ);
    }
    friend float smallest(Avx512Lanes a) noexcept { return _mm512_reduce_min_ps(a.lanes); }
    friend float largest(Avx512Lanes a) noexcept { return _mm512_reduce_max_ps(a.lanes); }
    static std::uint32_t compress(std::uint32_t bits, std::uint32_t const* from, std::uint32_t* to) noexcept {
        __m512i const packed = _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), _mm512_loadu_si512(from));
        _mm512_storeu_si512(to, packed);
        return static_cast<std::uint32_t>(_mm_popcnt_u32(bits));
    }
    friend Avx512Lanes chosen(std::uint32_t bits, Avx512Lanes a, Avx512Lanes b) noexcept {
        return {_mm512_mask_blend_ps(static_cast<__mmask16>(bits), b.lanes, a.lanes)};
    }
};

#endif

#if defined(__AVX2__) && defined(__FMA__)

struct Avx2Lanes {
    using Scalar = float;
    using Wide = PlainLanes<double>;
    __m256 first;
    __m256 second;

    [[nodiscard]] static Avx2Lanes all(float value) noexcept { return {_mm256_set1_ps(value), _mm256_set1_ps(value)}; }
    [[nodiscard]] static Avx2Lanes load(float const* from) noexcept {
        return {_mm256_loadu_ps(from), _mm256_loadu_ps(from + 8)};
    }
    void store(float* to) const noexcept {
        _mm256_storeu_ps(to, first);
        _mm256_storeu_ps(to + 8, second);
    }

    friend Avx2Lanes operator+(Avx2Lanes a, Avx2Lanes b) noexcept {
        return {_mm256_add_ps(a.first, b.first), _mm256_add_ps(a.second, b.second)};
    }
    friend Avx2Lanes operator-(Avx2Lanes a, Avx2Lanes b) noexcept {
        return {_mm256_sub_ps(a.first, b.first), _mm256_sub_ps(a.second, b.second)};
    }
    friend Avx2Lanes operator*(Avx2Lanes a, Avx2Lanes b) noexcept {
        return {_mm256_mul_ps(a.first, b.first), _mm256_mul_ps(a.second, b.second)};
    }
    friend Avx2Lanes operator/(Avx2Lanes a, Avx2Lanes b) noexcept {
        return {_mm256_div_ps(a.first, b.first), _mm256_div_ps(a.second, b.second)};
    }
    friend Avx2Lanes least(Avx2Lanes a, Avx2Lanes b) noexcept {
        return {_mm256_min_ps(a.first, b.first), _mm256_min_ps(a.second, b.second)};
    }
    friend Avx2Lanes most(Avx2Lanes a, Avx2Lanes b) noexcept {
        return {_mm256_max_ps(a.first, b.first), _mm256_max_ps(a.second, b.second)};
    }
    friend Avx2Lanes reciprocal(Avx2Lanes a) noexcept { return all(1.0f) / a; }
    friend Avx2Lanes absolute(Avx2Lanes a) noexcept {
        __m256 const top = _mm256_set1_ps(-0.0f);
        return {_mm256_andnot_ps(top, a.first), _mm256_andnot_ps(top, a.second)};
    }
    friend Avx2Lanes with_sign_of(Avx2Lanes magnitude, Avx2Lanes sign) noexcept {
        __m256 const top = _mm256_set1_ps(-0.0f);
        return {_mm256_or_ps(_mm256_andnot_ps(top, magnitude.first), _mm256_and_ps(top, sign.first)),
                _mm256_or_ps(_mm256_andnot_ps(top, magnitude.second), _mm256_and_ps(top, sign.second))};
    }
    friend Avx2Lanes fused(Avx2Lanes a, Avx2Lanes b, Avx2Lanes c) noexcept {
        return {_mm256_fmadd_ps(a.first, b.first, c.first), _mm256_fmadd_ps(a.second, b.second, c.second)};
    }
    friend std::uint32_t at_least(Avx2Lanes a, Avx2Lanes b) noexcept {
        int const low = _mm256_movemask_ps(_mm256_cmp_ps(a.first, b.first, _CMP_GE_OQ));
        int const high = _mm256_movemask_ps(_mm256_cmp_ps(a.second, b.second, _CMP_GE_OQ));
        return static_cast<std::uint32_t>(low) | static_cast<std::uint32_t>(high) << 8;
    }
    friend float smallest(Avx2Lanes a) noexcept {
        __m256 const eight = _mm256_min_ps(a.first, a.second);
        __m128 const four = _mm_min_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps(eight, 1));
        __m128 const two = _mm_min_ps(four, _mm_movehl_ps(four, four));
        return _mm_cvtss_f32(_mm_min_ss(two, _mm_movehdup_ps(two)));
    }
    friend float largest(Avx2Lanes a) noexcept {
        __m256 const eight = _mm256_max_ps(a.first, a.second);
        __m128 const four = _mm_max_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps(eight, 1));
        __m128 const two = _mm_max_ps(four, _mm_movehl_ps(four, four));
        return _mm_cvtss_f32(_mm_max_ss(two, _mm_movehdup_ps(two)));
    }
    static std::uint32_t compress(std::uint32_t bits, std::uint32_t const* from, std::uint32_t* to) noexcept {
        return PlainLanes<float>::compress(bits, from, to);
    }
    friend Avx2Lanes chosen(std::uint32_t bits, Avx2Lanes a, Avx2Lanes b) noexcept {
        __m256i const lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
        auto const mask = [lane](std::uint32_t part) {
            __m256i const here = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(part)), lane);
            return _mm256_castsi256_ps(_mm256_cmpeq_epi32(here, lane));
        };
        return {_mm256_blendv_ps(b.first, a.first, mask(bits & 0xffu)),
                _mm256_blendv_ps(b.second, a.second, mask(bits >> 8))};
    }
};

#endif

namespace detail {

// The same words for a single number, so that a formula can be written once for one and for sixteen.
template <class T>
[[nodiscard]] inline T fused(T a, T b, T c) noexcept {
    return a * b + c;
}
template <class T>
[[nodiscard]] inline T absolute(T a) noexcept {
    return std::abs(a);
}
template <class T>
[[nodiscard]] inline T with_sign_of(T magnitude, T sign) noexcept {
    return std::copysign(magnitude, sign);
}

template <class T>
struct LanesFor {
    using Type = PlainLanes<T>;
};
#if defined(__AVX512F__)
template <>
struct LanesFor<float> {
    using Type = Avx512Lanes;
};
#elif defined(__AVX2__) && defined(__FMA__)
template <>
struct LanesFor<float> {
    using Type = Avx2Lanes;
};
#endif

}  // namespace detail

template <class T>
using BestLanes = typename detail::LanesFor<T>::Type;

}  // namespace v0
}  // namespace shadowmath
