// SPDX-License-Identifier: MIT
//
// Light and view the wrong way round.
// refused: (no matching function for call to .*fit_cascades|could not match|mismatched types)
#include <shadowmath/cascades.hpp>

namespace sm = shadowmath;

bool cascades(sm::ViewVolume<float> const& view, sm::Light<float> const& sun, sm::Aabb<float> const& box) {
#ifdef WRONG
    return sm::fit_cascades(sun, view, box, box, sm::CascadeOptions<float>{}).count > 0;
#else
    return sm::fit_cascades(view, sun, box, box, sm::CascadeOptions<float>{}).count > 0;
#endif
}
