// SPDX-License-Identifier: MIT
//
// Laws of maps that are fitted to samples. The other laws of cascades hold as well: serves, well formed, the light's.
#pragma once

#include "tests/laws/cascades.hpp"
#include "tests/laws/depth_range.hpp"

#include <shadowmath/sdsm.hpp>

#include <cmath>
#include <limits>

namespace shadowmath::laws {

// The entry of the light into a box comes no later than the box's first point between the sides, found the slow way.
template <class T>
[[nodiscard]] bool is_before_the_box(T entry, LightBasis<T> const& basis, Vec2<T> const& lo, Vec2<T> const& hi,
                                     Aabb<T> const& box) {
    using Wide = long double;
    LightBasis<Wide> const exact{Vec3<Wide>(basis.x), Vec3<Wide>(basis.y), Vec3<Wide>(basis.depth)};
    Aabb<Wide> const wide_box{Vec3<Wide>(box.lo), Vec3<Wide>(box.hi)};
    Wide const size = glm::length(wide_box.lo) + glm::length(wide_box.hi) + std::abs(lo.x) + std::abs(hi.x) +
                      std::abs(lo.y) + std::abs(hi.y);
    ViewVolume<Wide> const shaft =
        orthographic_view(Pose<Wide>{Vec3<Wide>(0), exact.x, exact.y, exact.depth}, Wide(lo.x), Wide(hi.x), Wide(lo.y),
                          Wide(hi.y), -2 * size, 2 * size);
    Wide const rounding = 64 * static_cast<Wide>(std::numeric_limits<T>::epsilon()) * size;
    DepthRange<Wide> const truth = common_depths<1>(wide_box, shaft, {1e-15L * size})[0];
    return !truth.visible || Wide(entry) <= truth.lo + rounding;
}

// As holds, for a sample given relative to the eye: `rounding` metres in light space are what its scalar type lost. The
// depth row adds its own, of scale and offset, to what may be a small part of the whole depth.
template <class T>
[[nodiscard]] bool holds_sample(ShadowMap<T> const& map, SampleRays<T> const& rays, Vec3<T> const& from_eye,
                                int map_size, T margin_texels, bool pancake, long double rounding) {
    using Wide = long double;
    // Out of light space by its axes, which are orthonormal to 4 ulp; that is part of the rounding.
    Vec3<Wide> const at_light = Vec3<Wide>(rays.eye) + Vec3<Wide>(from_eye);
    Vec3<Wide> const world = Vec3<Wide>(rays.basis.x) * at_light.x + Vec3<Wide>(rays.basis.y) * at_light.y +
                             Vec3<Wide>(rays.basis.depth) * at_light.z;
    Mat4<Wide> const canonical = canonical_from_clip<Wide>(map.clip) * Mat4<Wide>(map.clip_from_world);
    Vec4<Wide> const at = canonical * Vec4<Wide>(world, 1);
    auto const lost = [&](int r) { return rounding * glm::length(Vec3<Wide>(row(canonical, r))); };
    Wide const side = 1 - 2 * Wide(margin_texels) / map_size;
    Wide const deep = lost(2) + 4 * static_cast<Wide>(std::numeric_limits<T>::epsilon());
    bool const deep_enough = at.z <= 1 + deep && (pancake || at.z >= -deep);
    return at.w == 1 && std::abs(at.x) <= side + lost(0) && std::abs(at.y) <= side + lost(1) && deep_enough;
}

}  // namespace shadowmath::laws
