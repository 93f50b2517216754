// SPDX-License-Identifier: MIT
//
// Laws of the depth range, and an oracle for what a box and a view volume have in common.
#pragma once

#include "tests/laws/fit_sphere.hpp"

#include <shadowmath/depth_range.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace shadowmath::laws {

// Where three of the twelve planes of box and volume meet, inside all twelve within a slack: the corners of the common
// part, found the slow way. Returns the depths between them, for each slack.
template <std::size_t N>
[[nodiscard]] std::array<DepthRange<Long>, N> common_depths(Aabb<Long> const& box, ViewVolume<Long> const& volume,
                                                            std::array<Long, N> const& slacks) {
    std::array<Vec4<Long>, 12> planes;
    std::array<Vec4<Long>, 6> const sides = detail::inner_planes(volume);
    for (std::size_t i = 0; i < 6; ++i) {
        Vec4<Long> face(0);
        face[static_cast<int>(i / 2)] = i % 2 == 0 ? 1 : -1;
        face.w = i % 2 == 0 ? -box.lo[static_cast<int>(i / 2)] : box.hi[static_cast<int>(i / 2)];
        planes[i] = face;
        planes[6 + i] = sides[i] / glm::length(Vec3<Long>(sides[i]));
    }
    std::array<DepthRange<Long>, N> ranges;
    ranges.fill({volume.z_far, volume.z_near, false});
    Long const largest_slack = *std::max_element(slacks.begin(), slacks.end());
    for (std::size_t i = 0; i < 12; ++i)
        for (std::size_t j = i + 1; j < 12; ++j) {
            Vec3<Long> const a(planes[i]), b(planes[j]), along = glm::cross(a, b);
            for (std::size_t k = j + 1; k < 12; ++k) {
                Vec3<Long> const c(planes[k]);
                Long const volume6 = glm::dot(along, c);
                if (std::abs(volume6) < 1e-12L) continue;
                Vec3<Long> const weighted = b * planes[i].w - a * planes[j].w;
                Vec3<Long> const point = -(glm::cross(weighted, c) + along * planes[k].w) / volume6;
                Long least = std::numeric_limits<Long>::max();
                for (Vec4<Long> const& plane : planes) {
                    least = std::min(least, glm::dot(plane, Vec4<Long>(point, 1)));
                    if (least < -largest_slack) break;
                }
                for (std::size_t s = 0; s < N; ++s)
                    if (DepthRange<Long>& range = ranges[s]; least >= -slacks[s]) {
                        Long const depth = eye_depth(volume, point);
                        range = {std::min(range.lo, depth), std::max(range.hi, depth), true};
                    }
            }
        }
    return ranges;
}

// depths_inside finds what the oracle finds: it loses nothing, and adds no more than `slack` metres at either end.
// Where the two only just touch, within the slack, either answer is right.
template <class T>
[[nodiscard]] bool finds_the_common_depths(Aabb<T> const& box, ViewVolume<T> const& volume, Long slack) {
    Aabb<Long> const exact_box{Vec3<Long>(box.lo), Vec3<Long>(box.hi)};
    DepthRange<T> const found = depths_inside(box, volume);
    auto const [inner, outer] =
        common_depths<2>(exact_box, widened_to_long(volume), {1e-15L * Long(volume.z_far), slack});
    if (inner.visible &&
        !(found.visible && Long(found.lo) <= inner.lo + slack * 1e-3L && Long(found.hi) >= inner.hi - slack * 1e-3L))
        return false;
    return !found.visible ||
           (outer.visible && Long(found.lo) >= outer.lo - slack && Long(found.hi) <= outer.hi + slack);
}

// The range reaches a receiver at this point, if it is one that the slice and the sides hold.
template <class T>
[[nodiscard]] bool reaches(DepthRange<T> const& range, LightBox<T> const& sides, DepthRange<T> const& slice,
                           Vec3<T> const& receiver) {
    Vec3<T> const at = in_light(sides.basis, receiver);
    bool const concerns = at.x >= sides.lo.x && at.x <= sides.hi.x && at.y >= sides.lo.y && at.y <= sides.hi.y &&
                          at.z >= slice.lo && at.z <= slice.hi;
    return !concerns || !range.visible || (at.z >= range.lo && at.z <= range.hi);
}

// The range starts before a caster at this point, if it can shadow anything inside the sides.
template <class T>
[[nodiscard]] bool starts_before(DepthRange<T> const& range, LightBox<T> const& sides, Vec3<T> const& caster) {
    Vec3<T> const at = in_light(sides.basis, caster);
    bool const concerns =
        at.x >= sides.lo.x && at.x <= sides.hi.x && at.y >= sides.lo.y && at.y <= sides.hi.y && at.z <= range.hi;
    return !concerns || !range.visible || at.z >= range.lo;
}

template <class T>
[[nodiscard]] bool is_a_range(DepthRange<T> const& range) {
    return all_finite(&range.lo, 1) && all_finite(&range.hi, 1) && range.lo < range.hi;
}

}  // namespace shadowmath::laws
