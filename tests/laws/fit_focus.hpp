// SPDX-License-Identifier: MIT
//
// Laws of the focus: nothing that can be seen in shadow is outside, and nothing outside the slice's box is inside.
#pragma once

#include "tests/laws/fit_rectangle.hpp"
#include "tests/laws/polytope.hpp"
#include "tests/laws/sweep.hpp"

#include <shadowmath/fit_focus.hpp>

namespace shadowmath::laws {

// The point is in every half-space of the receivers, its caster in those of the casters and at a depth of the map.
template <class T>
[[nodiscard]] bool focuses(Focus<T> const& focus, Vec3<T> const& travel, Vec3<T> const& point, Vec3<T> const& caster,
                           T slack) {
    if (!focus.visible) return false;
    for (int i = 0; i < focus.receivers.face_count; ++i) {
        Vec4<T> const& h = focus.receivers.half_space[static_cast<std::size_t>(i)];
        if (glm::dot(h, Vec4<T>(point, T(1))) < -slack * glm::length(Vec3<T>(h))) return false;
    }
    T const here = glm::dot(travel, point), above = glm::dot(travel, caster);
    return may_contain(focus.receivers, point, slack) && inside(focus.casters, caster, slack) &&
           focus.depth.lo <= above + slack && here <= focus.depth.hi + slack && focus.first_receiver <= here + slack;
}

// Sides within those of the box, but for `slack` metres.
template <class T>
[[nodiscard]] bool is_within(LightBox<T> const& inner, LightBox<T> const& outer, T slack) {
    return inner.lo.x >= outer.lo.x - slack && inner.lo.y >= outer.lo.y - slack && inner.hi.x <= outer.hi.x + slack &&
           inner.hi.y <= outer.hi.y + slack;
}

}  // namespace shadowmath::laws
