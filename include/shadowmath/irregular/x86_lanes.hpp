// SPDX-License-Identifier: MIT
//
// Sixteen floats in registers of an x86 processor:
//
//   Avx512Lanes     one register; where the compiler is told so (-march=native)
//   Avx2Lanes       two registers
//
// What each operation means is said in plain_lanes.hpp.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/irregular/plain_lanes.hpp>

#include <cstdint>
#include <limits>

#if (defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512VL__)) || (defined(__AVX2__) && defined(__FMA__))
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

#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512VL__)

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
    // See PlainLanes: rows.
    [[nodiscard]] static Avx512Doubles rows(double const* const (&row)[4]) noexcept {
        auto const two = [](double const* low, double const* high) {
            return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(low)), _mm256_loadu_pd(high), 1);
        };
        return {two(row[0], row[1]), two(row[2], row[3])};
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
    [[nodiscard]] static Avx512Lanes rows(float const* const (&row)[4]) noexcept { return {four_of(row, 0)}; }
    static void triples(float const* const (&row)[4], Avx512Lanes (&components)[3]) noexcept {
        __m512 const a = four_of(row, 0), b = four_of(row, 4), c = four_of(row, 8);  // xyzx yzxy zxyz
        __m512 const x = _mm512_shuffle_ps(b, c, _MM_SHUFFLE(1, 1, 2, 2));
        __m512 const y0 = _mm512_shuffle_ps(a, b, _MM_SHUFFLE(0, 0, 1, 1));
        __m512 const y1 = _mm512_shuffle_ps(b, c, _MM_SHUFFLE(2, 2, 3, 3));
        __m512 const z = _mm512_shuffle_ps(a, b, _MM_SHUFFLE(1, 1, 2, 2));
        components[0] = {_mm512_shuffle_ps(a, x, _MM_SHUFFLE(2, 0, 3, 0))};
        components[1] = {_mm512_shuffle_ps(y0, y1, _MM_SHUFFLE(2, 0, 2, 0))};
        components[2] = {_mm512_shuffle_ps(z, c, _MM_SHUFFLE(3, 0, 2, 0))};
    }
    template <class At>
    static void points(At const& at, Avx512Lanes (&xyz)[3]) noexcept {
        auto const four = [&at](int k) {
            auto const three = [&at](int lane) {
                float const* const from = at(lane);
                __m128 const xy = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<__m128i const*>(from)));
                return _mm_insert_ps(xy, _mm_load_ss(from + 2), 0x20);
            };
            __m256 const low = _mm256_insertf128_ps(_mm256_castps128_ps256(three(k)), three(k + 4), 1);
            __m256 const high = _mm256_insertf128_ps(_mm256_castps128_ps256(three(k + 8)), three(k + 12), 1);
            return _mm512_castpd_ps(
                _mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(low)), _mm256_castps_pd(high), 1));
        };
        auto const pairs_low = [](__m512 a, __m512 b) { return _mm512_castps_pd(_mm512_unpacklo_ps(a, b)); };
        auto const pairs_high = [](__m512 a, __m512 b) { return _mm512_castps_pd(_mm512_unpackhi_ps(a, b)); };
        __m512 const a = four(0), b = four(1), c = four(2), d = four(3);
        xyz[0] = {_mm512_castpd_ps(_mm512_unpacklo_pd(pairs_low(a, b), pairs_low(c, d)))};
        xyz[1] = {_mm512_castpd_ps(_mm512_unpackhi_pd(pairs_low(a, b), pairs_low(c, d)))};
        xyz[2] = {_mm512_castpd_ps(_mm512_unpacklo_pd(pairs_high(a, b), pairs_high(c, d)))};
    }
    void store_bytes(unsigned char* to) const noexcept {
        __m512 const inside = _mm512_min_ps(_mm512_max_ps(lanes, _mm512_setzero_ps()), _mm512_set1_ps(255.0f));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm512_cvtepi32_epi8(_mm512_cvttps_epi32(inside)));
    }
    [[nodiscard]] static Avx512Lanes narrow(Wide const& wide) noexcept {
        __m256 const low = _mm512_cvtpd_ps(wide.first), high = _mm512_cvtpd_ps(wide.second);
        return {_mm512_castpd_ps(
            _mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(low)), _mm256_castps_pd(high), 1))};
    }
    [[nodiscard]] static Avx512Lanes load_bytes(unsigned char const* from) noexcept {
        __m128i const bytes = _mm_loadu_si128(reinterpret_cast<__m128i const*>(from));
        return {_mm512_cvtepi32_ps(_mm512_cvtepu8_epi32(bytes))};
    }
    void store_words(std::uint32_t* to) const noexcept { _mm512_storeu_si512(to, _mm512_cvttps_epi32(lanes)); }

private:
    // Four numbers of each row.
    [[nodiscard]] static __m512 four_of(float const* const (&row)[4], int first) noexcept {
        __m256 const low =
            _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(row[0] + first)), _mm_loadu_ps(row[1] + first), 1);
        __m256 const high =
            _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(row[2] + first)), _mm_loadu_ps(row[3] + first), 1);
        return _mm512_castpd_ps(
            _mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(low)), _mm256_castps_pd(high), 1));
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
    [[nodiscard]] static Avx2Lanes rows(float const* const (&row)[4]) noexcept {
        return {two_of(row[0], row[1]), two_of(row[2], row[3])};
    }
    static void triples(float const* const (&row)[4], Avx2Lanes (&components)[3]) noexcept {
        halves(row[0], row[1], components[0].first, components[1].first, components[2].first);
        halves(row[2], row[3], components[0].second, components[1].second, components[2].second);
    }
    template <class At>
    static void points(At const& at, Avx2Lanes (&xyz)[3]) noexcept {
        auto const eight = [&at](int k, __m256& x, __m256& y, __m256& z) {
            auto const two = [&at](int lane) {
                auto const three = [](float const* from) {
                    __m128 const xy = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<__m128i const*>(from)));
                    return _mm_insert_ps(xy, _mm_load_ss(from + 2), 0x20);
                };
                return _mm256_set_m128(three(at(lane + 4)), three(at(lane)));
            };
            __m256 const a = two(k), b = two(k + 1), c = two(k + 2), d = two(k + 3);
            __m256 const ab = _mm256_unpacklo_ps(a, b), cd = _mm256_unpacklo_ps(c, d);
            x = _mm256_shuffle_ps(ab, cd, _MM_SHUFFLE(1, 0, 1, 0));
            y = _mm256_shuffle_ps(ab, cd, _MM_SHUFFLE(3, 2, 3, 2));
            z = _mm256_shuffle_ps(_mm256_unpackhi_ps(a, b), _mm256_unpackhi_ps(c, d), _MM_SHUFFLE(1, 0, 1, 0));
        };
        eight(0, xyz[0].first, xyz[1].first, xyz[2].first);
        eight(8, xyz[0].second, xyz[1].second, xyz[2].second);
    }
    void store_bytes(unsigned char* to) const noexcept {
        auto const inside = [](__m256 eight) {
            return _mm256_cvttps_epi32(
                _mm256_min_ps(_mm256_max_ps(eight, _mm256_setzero_ps()), _mm256_set1_ps(255.0f)));
        };
        __m256i const shorts = _mm256_packs_epi32(inside(first), inside(second));
        __m256i const ordered = _mm256_permute4x64_epi64(shorts, 0xd8);
        _mm_storeu_si128(reinterpret_cast<__m128i*>(to),
                         _mm_packus_epi16(_mm256_castsi256_si128(ordered), _mm256_extracti128_si256(ordered, 1)));
    }
    [[nodiscard]] static Avx2Lanes narrow(Wide const& wide) noexcept {
        auto const four = [&wide](int k) { return _mm256_cvtpd_ps(_mm256_loadu_pd(wide.lane + k)); };
        return {_mm256_set_m128(four(4), four(0)), _mm256_set_m128(four(12), four(8))};
    }
    [[nodiscard]] static Avx2Lanes load_bytes(unsigned char const* from) noexcept {
        auto const eight = [](unsigned char const* bytes) {
            __m128i const here = _mm_loadl_epi64(reinterpret_cast<__m128i const*>(bytes));
            return _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(here));
        };
        return {eight(from), eight(from + 8)};
    }
    void store_words(std::uint32_t* to) const noexcept {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_cvttps_epi32(first));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + 8), _mm256_cvttps_epi32(second));
    }

private:
    [[nodiscard]] static __m256 two_of(float const* low, float const* high) noexcept {
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high), 1);
    }
    static void halves(float const* low, float const* high, __m256& x, __m256& y, __m256& z) noexcept {
        __m256 const a = two_of(low, high), b = two_of(low + 4, high + 4), c = two_of(low + 8, high + 8);
        __m256 const x23 = _mm256_shuffle_ps(b, c, _MM_SHUFFLE(1, 1, 2, 2));
        __m256 const y01 = _mm256_shuffle_ps(a, b, _MM_SHUFFLE(0, 0, 1, 1));
        __m256 const y23 = _mm256_shuffle_ps(b, c, _MM_SHUFFLE(2, 2, 3, 3));
        __m256 const z01 = _mm256_shuffle_ps(a, b, _MM_SHUFFLE(1, 1, 2, 2));
        x = _mm256_shuffle_ps(a, x23, _MM_SHUFFLE(2, 0, 3, 0));
        y = _mm256_shuffle_ps(y01, y23, _MM_SHUFFLE(2, 0, 2, 0));
        z = _mm256_shuffle_ps(z01, c, _MM_SHUFFLE(3, 0, 2, 0));
    }
};

#endif

}  // namespace v0
}  // namespace shadowmath
