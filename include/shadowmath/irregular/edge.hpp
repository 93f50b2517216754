// SPDX-License-Identifier: MIT
//
// The shadow volume of a triangle as four half spaces, each arranged so that one pixel of a surface sees it as a half
// plane: one through the light and each edge, and the triangle's own plane.
//
//   a sample is in shadow  <=>  it is on the inner side of all three edge planes, and behind the triangle
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

template <class T>
struct ShadowVolume {
    PixelPlane<T> behind;
    PixelPlane<T> edge[3];
    bool casts = false;  // false: no area as seen from the light, or not finite
};

// The vertices are points of the pixel frame. The margin is taken along the triangle's normal, up to sqrt(3) times as
// much off the axes.
template <class T>
[[nodiscard]] inline ShadowVolume<T> shadow_volume(PixelFrame<T> const& frame, PixelLight<T> const& light,
                                                   Vec3<T> const& p0, Vec3<T> const& p1, Vec3<T> const& p2,
                                                   ContactMargin<T> const& margin) noexcept {
    ShadowVolume<T> volume;
    Vec3<T> const normal = glm::cross(p1 - p0, p2 - p0);
    T const along = glm::dot(normal, light.parallel ? light.at : p0 - light.at);
    if (!(along < T(0)) && !(along > T(0))) return volume;
    volume.casts = true;
    // Where the light meets the other side, everything is turned over.
    T const sign = along > T(0) ? T(1) : T(-1);
    Vec3<T> const inner = normal * sign;
    Vec3<T> const in_world = frame.to_across * inner.x + frame.to_upward * inner.y + frame.to_inward * inner.z;
    T const unit = std::abs(in_world.x) + std::abs(in_world.y) + std::abs(in_world.z);
    volume.behind = pixel_plane(frame.kind, inner - Vec3<T>(T(0), T(0), unit * margin.share),
                                -glm::dot(inner, p0) - unit * margin.metres);
    Vec3<T> const points[3] = {p0, p1, p2};
    for (int i = 0; i < 3; ++i) {
        Vec3<T> const &from = points[i], &to = points[(i + 1) % 3];
        Vec3<T> const both = from + to;
        Vec3<T> const away = light.parallel ? light.at : both - light.at * T(2);
        Vec3<T> const n = glm::cross(away, (to - from) * sign);
        volume.edge[i] = pixel_plane(frame.kind, n, glm::dot(n, both) * T(-0.5));
    }
    return volume;
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
