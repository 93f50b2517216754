// SPDX-License-Identifier: MIT
//
// The shadow volume of a triangle as four half spaces, each arranged so that one pixel of a surface sees it as a half
// plane: the triangle's own plane, and one through the light and each edge.
//
//   a sample is in shadow  <=>  it is behind the triangle, and on the inner side of all three edge planes
//                          <=>  the segment from the sample to the light meets the triangle
//
// An edge's plane depends on its two ends alone and changes nothing but its sign when they are exchanged: the two
// triangles at a shared edge see exactly opposite values, to the last bit. A value of 0 is inside for both, so no light
// leaks between them. Triangles cast on both sides, however they wind.
//
// Source: Wyman, Hoetzlein and Lefohn, I3D 2015; the sums over both ends instead of one are ours.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/irregular/lanes.hpp>
#include <shadowmath/irregular/microquad.hpp>
#include <shadowmath/light.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {

// The light in the pixel frame: how it travels, or where it stands.
template <class T>
struct PixelLight {
    Vec3<T> at{T(0)};
    bool parallel = true;
};

template <class T>
[[nodiscard]] inline PixelLight<T> pixel_light(PixelFrame<T> const& frame, Light<T> const& light) noexcept {
    if (light.kind == LightKind::directional) return {direction_in_pixels(frame, light.direction), true};
    return {point_in_pixels(frame, light.position), false};
}

// A sample nearer to the plane of a triangle than this is not in its shadow: it lies on that triangle, or on a
// neighbour in the same plane, and the side on which rounding left it means nothing.
template <class T>
struct ContactMargin {
    T metres = T(0);
    T share = T(0);  // of the sample's depth, on top
};

// Of one triangle where V is a scalar, of sixteen where it is Lanes. planes[0] is the triangle's own, then its edges'.
template <class V>
struct ShadowVolume {
    PixelPlane<V> planes[4];
    V along;  // the triangle's normal with the light: 0 where it has no area as seen from there, and casts nothing
};

namespace detail {

template <class V>
struct Triple {
    V x, y, z;
};

template <class V>
[[nodiscard]] inline Triple<V> difference(Triple<V> const& a, Triple<V> const& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
[[nodiscard]] inline Triple<V> sum(Triple<V> const& a, Triple<V> const& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
[[nodiscard]] inline Triple<V> scaled(Triple<V> const& a, V const& by) noexcept {
    return {a.x * by, a.y * by, a.z * by};
}
template <class V>
[[nodiscard]] inline V inner(Triple<V> const& a, Triple<V> const& b) noexcept {
    return fused(a.x, b.x, fused(a.y, b.y, a.z * b.z));
}
// Negated to the last bit when b is.
template <class V>
[[nodiscard]] inline Triple<V> crossed(Triple<V> const& a, Triple<V> const& b) noexcept {
    V const zero = a.x - a.x;
    return {fused(a.y, b.z, zero - a.z * b.y), fused(a.z, b.x, zero - a.x * b.z), fused(a.x, b.y, zero - a.y * b.x)};
}

// `all` makes a V of a scalar.
template <class V, class T, class All>
[[nodiscard]] inline ShadowVolume<V> volume_of(PixelFrame<T> const& frame, PixelLight<T> const& light,
                                               Triple<V> const (&p)[3], V const& margin_metres, T margin_share,
                                               All const& all) noexcept {
    auto const triple = [&all](Vec3<T> const& v) { return Triple<V>{all(v.x), all(v.y), all(v.z)}; };
    auto const plane = [&frame](Triple<V> const& n, V const& offset) {
        if (frame.kind == ViewKind::perspective) return PixelPlane<V>{n.x, n.y, n.z, offset};
        return PixelPlane<V>{n.x, n.y, offset, n.z};
    };
    Triple<V> const source = triple(light.at);
    Triple<V> const normal = crossed(difference(p[1], p[0]), difference(p[2], p[0]));
    ShadowVolume<V> volume;
    volume.along = inner(normal, light.parallel ? source : difference(p[0], source));
    // Where the light meets the other side, everything is turned over.
    V const sign = with_sign_of(all(T(1)), volume.along);
    Triple<V> const facing = scaled(normal, sign);
    Triple<V> const in_world =
        sum(scaled(triple(frame.to_across), facing.x),
            sum(scaled(triple(frame.to_upward), facing.y), scaled(triple(frame.to_inward), facing.z)));
    V const unit = absolute(in_world.x) + absolute(in_world.y) + absolute(in_world.z);
    volume.planes[0] = plane({facing.x, facing.y, facing.z - unit * all(margin_share)},
                             all(T(0)) - fused(unit, margin_metres, inner(facing, p[0])));
    for (int i = 0; i < 3; ++i) {
        Triple<V> const &from = p[i], &to = p[(i + 1) % 3];
        Triple<V> const both = sum(from, to);
        Triple<V> const away = light.parallel ? source : difference(both, scaled(source, all(T(2))));
        Triple<V> const n = crossed(away, scaled(difference(to, from), sign));
        volume.planes[1 + i] = plane(n, inner(n, both) * all(T(-0.5)));
    }
    return volume;
}

}  // namespace detail

// The vertices are points of the pixel frame, finite. The margin is taken along the triangle's normal: exactly along
// the axes, up to sqrt(3) times as much off them.
template <class T>
[[nodiscard]] inline ShadowVolume<T> shadow_volume(PixelFrame<T> const& frame, PixelLight<T> const& light,
                                                   Vec3<T> const& p0, Vec3<T> const& p1, Vec3<T> const& p2,
                                                   ContactMargin<T> const& margin) noexcept {
    detail::Triple<T> const p[3] = {{p0.x, p0.y, p0.z}, {p1.x, p1.y, p1.z}, {p2.x, p2.y, p2.z}};
    return detail::volume_of(frame, light, p, margin.metres, margin.share, [](T value) { return value; });
}

// What a pixel sees of a half space: inside where c + x u + y v >= 0, u and v from 0 to 1 over the pixel.
template <class T>
struct PixelLine {
    T c = T(0);
    T x = T(0);
    T y = T(0);
};

template <class T>
[[nodiscard]] inline PixelLine<T> line_across(PixelFrame<T> const& frame, PixelPlane<T> const& plane,
                                              MicroQuad<T> const& quad, int column, int row) noexcept {
    T const x = T(column) - T(frame.width) / T(2), y = T(row) - T(frame.height) / T(2);
    return {plane.x * x + plane.y * y + plane.a + plane.b * quad.q, plane.x + plane.b * quad.q_x,
            plane.y + plane.b * quad.q_y};
}

}  // namespace v0
}  // namespace shadowmath
