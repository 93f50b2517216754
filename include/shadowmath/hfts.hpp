// SPDX-License-Identifier: MIT
//
// Hybrid frustum-traced shadows: exact where the occluder touches, soft where it is far. An exact test (a ray or an
// irregular z-buffer) leaves no gap at contacts and has no texels, but knows nothing of the light's size; PCSS knows
// that, and fails at contacts. The occluder's gap says whom to believe.
//
// Use it for the few metres around the eye. Far away, where a texel of the map is a pixel, PCSS alone is as good.
//
// Source: Story and Wyman, SIGGRAPH 2016 Talks. Departure: gaps (penumbra.hpp), so the same number serves every cascade
// and every light; and where the exact test found nothing, the soft one's own occluders decide: else the outer half of
// each penumbra would be cut off.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/pcss.hpp>

namespace shadowmath {
inline namespace v0 {

// What an exact test says of one receiver.
template <class T>
struct ExactShadow {
    T visibility = T(1);  // share of its samples that are lit, [0, 1]
    T gap = T(0);         // of the occluder nearest to the receiver, >= 0
};

// Share of the soft answer: 0 in contact, growing in proportion to the gap, 1 from `soft_gap` on. A soft_gap of 0 or
// less: all soft.
template <class T>
[[nodiscard]] inline T softness(T gap, T soft_gap) noexcept {
    if (!all_finite(&gap, 1) || !all_finite(&soft_gap, 1)) return T(0);
    if (!(gap < soft_gap)) return T(1);
    return gap > T(0) ? gap / soft_gap : T(0);
}

// Between the two answers, the exact one in contact; 1 where neither found an occluder. What is not finite gives the
// exact answer, or light where that is not finite either.
template <class T>
[[nodiscard]] inline T hybrid_visibility(ExactShadow<T> const& exact, SoftShadow<T> const& soft, T soft_gap) noexcept {
    if (!all_finite(&exact.visibility, 1)) return T(1);
    T const hard = exact.visibility > T(0) ? (exact.visibility < T(1) ? exact.visibility : T(1)) : T(0);
    if (!all_finite(&soft.visibility, 1) || !all_finite(&soft.gap, 1) || !all_finite(&exact.gap, 1)) return hard;
    bool const traced = hard < T(1);
    if (!traced && !soft.blocked) return T(1);
    T gap = traced ? exact.gap : soft.gap;
    if (traced && soft.blocked && soft.gap < gap) gap = soft.gap;
    T const mixed_in = soft.visibility > T(0) ? (soft.visibility < T(1) ? soft.visibility : T(1)) : T(0);
    T const share = softness(gap, soft_gap);
    return hard * (T(1) - share) + mixed_in * share;
}

}  // namespace v0
}  // namespace shadowmath
