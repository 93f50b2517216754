// SPDX-License-Identifier: MIT
//
// Laws of the crop: a zoom in post-projective light space that keeps what is inside, and the spot's map made with it.
#pragma once

#include "tests/laws/fit_sphere.hpp"
#include "tests/laws/shadow_map.hpp"

#include <shadowmath/fit_crop.hpp>

#include <cmath>

namespace shadowmath::laws {

// The corners of the box land on those of the canonical clip volume, each to the rounding of extent and offset.
template <class T>
[[nodiscard]] bool fills_the_map(Aabb<T> const& box, int operations = 16) {
    Mat4<T> const crop = crop_matrix(box);
    std::array<Vec3<T>, 8> const at = corners(box);
    for (int i = 0; i < 8; ++i) {
        Vec4<long double> const image = image_of(crop, Vec4<T>(at[static_cast<std::size_t>(i)], T(1)));
        for (int axis = 0; axis < 3; ++axis) {
            long double const wanted = (i >> axis) & 1 ? 1 : (axis == 2 ? 0 : -1);
            long double const sum = std::abs(Long(box.lo[axis])) + std::abs(Long(box.hi[axis]));
            long double const scale = 1 + sum / Long(box.hi[axis] - box.lo[axis]);
            if (!(std::abs(image[axis] - wanted) <= Long(operations) * Long(std::numeric_limits<T>::epsilon()) * scale))
                return false;
        }
        if (image.w != 1) return false;
    }
    return true;
}

// The crop to `inner`, given in the NDC of `outer`'s crop, is one crop: to the box that `inner` is in the first NDC.
template <class T>
[[nodiscard]] bool composes(Aabb<T> const& outer, Aabb<T> const& inner, long double tolerance) {
    auto const back = [&](Vec3<T> const& p) {
        Vec3<T> const share(p.x * T(0.5) + T(0.5), p.y * T(0.5) + T(0.5), p.z);
        return outer.lo + (outer.hi - outer.lo) * share;
    };
    Mat4<T> const twice = crop_matrix(inner) * crop_matrix(outer);
    Mat4<T> const once = crop_matrix(Aabb<T>{back(inner.lo), back(inner.hi)});
    for (Vec3<T> const& corner : corners(outer))
        for (int axis = 0; axis < 3; ++axis) {
            long double const a = image_of(twice, Vec4<T>(corner, T(1)))[axis];
            long double const b = image_of(once, Vec4<T>(corner, T(1)))[axis];
            if (!(std::abs(a - b) <= tolerance * (1 + std::abs(a)))) return false;
        }
    return true;
}

template <class T>
[[nodiscard]] bool is_seen(ViewVolume<T> const& slice, Vec3<T> const& point) {
    ViewVolume<long double> const volume = widened_to_long(slice);
    Vec3<long double> const arm = Vec3<long double>(point) - volume.pose.position;
    long double const depth = glm::dot(arm, volume.pose.forward);
    long double const spread = volume.kind == ViewKind::perspective ? depth : 1;
    long double const x = glm::dot(arm, volume.pose.right), y = glm::dot(arm, volume.pose.up);
    return depth >= volume.z_near && depth <= volume.z_far && x >= volume.left * spread && x <= volume.right * spread &&
           y >= volume.bottom * spread && y <= volume.top * spread;
}

// The eye sees the point, and the light's pyramid holds it.
template <class T>
[[nodiscard]] bool is_seen_and_lit(ViewVolume<T> const& slice, Light<T> const& light, Vec3<T> const& point) {
    return is_seen(slice, point) && is_seen(spot_view(light, light.range / T(4096)), point);
}

// A receiver in the lit part of the slice lies inside the map, with the filter's margin; `slack` in NDC.
template <class T>
[[nodiscard]] bool serves(ShadowMap<T> const& map, int map_size, T margin_texels, Vec3<T> const& receiver, T slack) {
    T const margin = T(2) * margin_texels / T(map_size);
    // Sides with their margin, depth with the slack alone.
    Vec4<long double> const at =
        canonical_from_clip<long double>(map.clip) * image_of(map.clip_from_world, Vec4<T>(receiver, T(1)));
    long double const side = (1 - Long(margin) + Long(slack)) * at.w;
    return at.w > map.w_min && std::abs(at.x) <= side && std::abs(at.y) <= side &&
           holds(map.clip_from_world, map.clip, receiver, -slack);
}

}  // namespace shadowmath::laws
