// SPDX-License-Identifier: MIT
#pragma once

#include <shadowmath/hfts.hpp>

namespace shadowmath::laws {

template <class T>
[[nodiscard]] bool is_between(T value, T a, T b, T slack) {
    return value >= (a < b ? a : b) - slack && value <= (a < b ? b : a) + slack;
}

}  // namespace shadowmath::laws
