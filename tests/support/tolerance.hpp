// SPDX-License-Identifier: MIT
//
// The only tolerance of the tests: a number of roundings, each of at most half an ulp of the largest magnitude that
// entered. An absolute tolerance hides errors at 100 m and invents them at 1 mm.
#pragma once

#include <limits>

namespace shadowmath::test {

// `scale`: the largest magnitude that enters the expression. `operations`: how many roundings lie between it and the
// result; write the count's derivation beside the call.
template <class T>
[[nodiscard]] constexpr T tolerance(T scale, int operations) {
    return static_cast<T>(operations) * std::numeric_limits<T>::epsilon() * scale;
}

}  // namespace shadowmath::test
