// SPDX-License-Identifier: MIT
#pragma once

#include <shadowmath/penumbra.hpp>

#include <algorithm>
#include <cmath>

namespace shadowmath::laws {

using Wide = long double;

template <class T>
[[nodiscard]] Vec4<Wide> place_of(ShadowMap<T> const& map, Vec3<Wide> const& point) {
    Mat4<Wide> texture = texture_from_clip<Wide>(map.clip) * Mat4<Wide>(map.clip_from_world);
    Vec4<Wide> place = texture * Vec4<Wide>(point, Wide(1));
    if (map.clip.depth == DepthOrder::one_to_zero) place.z = place.w - place.z;
    return place;
}

// Where the segment from the point to a point of the light is when it is `gap` away, by plain geometry: metres along a
// sun's light; of a lamp the share gap / (1 + gap) of the way.
template <class T>
[[nodiscard]] Vec3<Wide> toward_disk(Light<T> const& light, Wide radius, Vec3<T> const& point, Vec2<T> const& u,
                                     Wide gap) {
    Tangents<T> const plane = tangents(light.direction);
    Vec3<Wide> const p(point), off = (Vec3<Wide>(plane.s) * Wide(u.x) + Vec3<Wide>(plane.t) * Wide(u.y)) * radius;
    if (light.kind == LightKind::directional) return p + (off - Vec3<Wide>(light.direction)) * gap;
    return p + (Vec3<Wide>(light.position) + off - p) * (gap / (Wide(1) + gap));
}

// Distance between two places as the map sees them: texture widths, and depth.
[[nodiscard]] inline Wide apart(Vec4<Wide> const& a, Vec4<Wide> const& b) {
    Vec3<Wide> const d = Vec3<Wide>(a) / a.w - Vec3<Wide>(b) / b.w;
    return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
}

template <class T>
[[nodiscard]] bool is_harmless(MapPenumbra<T> const& penumbra) {
    return all_finite(penumbra.rim_x) && all_finite(penumbra.rim_y) && all_finite(&penumbra.depth_of_gap, 1) &&
           penumbra.depth_of_gap > T(0) && penumbra.largest_gap >= T(0);
}

template <class T>
[[nodiscard]] bool is_gap(T gap) {
    return all_finite(&gap, 1) && gap >= T(0) && gap <= widest_gap<T>;
}

}  // namespace shadowmath::laws
