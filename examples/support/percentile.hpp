// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace shadowmath::example {

// The value below which `share` of the values lie; 0 of none.
template <class Number>
[[nodiscard]] Number percentile(std::vector<Number> values, double share) {
    if (values.empty()) return Number(0);
    auto const at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace shadowmath::example
