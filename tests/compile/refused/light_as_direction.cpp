// SPDX-License-Identifier: MIT
//
// Axes are made from a direction, not from the light that has one.
// refused: (no matching function for call to .*light_basis|mismatched types)
#include <shadowmath/light.hpp>

namespace sm = shadowmath;

sm::LightBasis<float> axes(sm::Light<float> const& sun) {
#ifdef WRONG
    return sm::light_basis(sun);
#else
    return sm::light_basis(sun.direction);
#endif
}
