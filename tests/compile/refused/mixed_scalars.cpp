// SPDX-License-Identifier: MIT
//
// A float light in a double world: one of them would have to be rounded, and nobody says which.
// refused: (no matching function for call to .*fit_cascades|deduced conflicting types)
#include <shadowmath/cascades.hpp>

namespace sm = shadowmath;

#ifdef WRONG
using OfLight = float;
#else
using OfLight = double;
#endif

bool cascades(sm::ViewVolume<double> const& view, sm::Light<OfLight> const& sun, sm::Aabb<double> const& box) {
    return sm::fit_cascades(view, sun, box, box, sm::CascadeOptions<double>{}).count > 0;
}
