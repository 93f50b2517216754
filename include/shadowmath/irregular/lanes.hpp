// SPDX-License-Identifier: MIT
//
// Sixteen numbers at once: one for each pixel of a 4 x 4 tile, or for sixteen nodes of a list. The kernels of the
// irregular z-buffer are written once, on these operations; which registers hold the numbers is a type.
//
//   PlainLanes<T>             plain_lanes.hpp
//   Avx512Lanes, Avx2Lanes    x86_lanes.hpp
//   BestLanes<T>              the fastest of them in this translation unit
//
// The type is a template argument of every kernel, so translation units built for different machines can be linked.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/irregular/plain_lanes.hpp>
#include <shadowmath/irregular/x86_lanes.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {

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

// Asks for a line of the caches before it is needed, where the machine can be told.
inline void fetch_soon(void const* line) noexcept {
#if defined(__GNUC__)
    __builtin_prefetch(line);
#else
    static_cast<void>(line);
#endif
}

template <class T>
struct LanesFor {
    using Type = PlainLanes<T>;
};
#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512VL__)
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
