// SPDX-License-Identifier: MIT
#pragma once

#include <shadowmath/aliasing.hpp>

#include <cmath>

namespace shadowmath::laws {

// E(z) = (1/z) / (ds/dz), with ds/dz from the map parameter s(z) itself: a central difference.
template <class Parameter>
[[nodiscard]] long double measured_along(Parameter const& s, long double z, long double step) {
    return 2 * step / (z * (s(z + step) - s(z - step)));
}

}  // namespace shadowmath::laws
