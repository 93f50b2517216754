// SPDX-License-Identifier: MIT
//
// A fit whose result nobody takes does nothing.
// refused: (ignoring return value|nodiscard)
#include <shadowmath/cascades.hpp>

namespace sm = shadowmath;

int cascades(sm::ViewVolume<float> const& view, sm::Light<float> const& sun, sm::Aabb<float> const& box) {
#ifdef WRONG
    sm::fit_cascades(view, sun, box, box, sm::CascadeOptions<float>{});
    return 0;
#else
    return sm::fit_cascades(view, sun, box, box, sm::CascadeOptions<float>{}).count;
#endif
}
