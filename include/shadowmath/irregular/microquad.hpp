// SPDX-License-Identifier: MIT
//
// A pixel as a piece of the surface it shows: the tangent plane at the pixel's point, seen through the pixel's four
// corners. Three numbers a pixel are all that it takes.
//
// Everything irregular is computed in the PIXEL FRAME, the eye's own axes scaled so that a point of depth d that is
// seen at (x, y) pixels from the middle of the picture is d * (x, y, 1); of an orthographic eye it is (x, y, d). There
//
//   one over the depth of a plane is affine in x and y (the depth itself, for an orthographic eye), so a plane is
//   three numbers: q at the pixel's corner, and its gain for a pixel in x and in y;
//   the sign of a half space n . p + c at a point of the surface is that of n.x x + n.y y + n.z + c q, which is affine
//   in x and y as well: seen through one pixel, any half space is a half plane with a straight border, exactly.
//
// Source: Wyman, Hoetzlein and Lefohn, I3D 2015, for the quad and its three stored distances. Here they are inverse
// distances along the eye's axis, which makes every later test linear.
#pragma once

#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/view_volume.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {

// The eye's picture, width x height pixels, as a frame of space.
template <class T>
struct PixelFrame {
    Vec3<T> eye{T(0)};                    // world
    Vec3<T> across{T(1), T(0), T(0)};     // world: one pixel to the right, at depth 1
    Vec3<T> upward{T(0), T(1), T(0)};     // one row on
    Vec3<T> inward{T(0), T(0), T(-1)};    // one metre of depth, through the middle of the picture
    Vec3<T> to_across{T(1), T(0), T(0)};  // rows of the inverse: dotted with point - eye
    Vec3<T> to_upward{T(0), T(1), T(0)};
    Vec3<T> to_inward{T(0), T(0), T(-1)};
    Vec2<T> origin{T(0)};  // orthographic: pixels from the eye's axis to the middle of the picture
    int width = 0;
    int height = 0;
    ViewKind kind = ViewKind::perspective;
    Faults faults;  // of the view; map_too_small for a picture without pixels
};

// `rows`: whether rows of the picture count upward (OpenGL's and this library's backends) or downward.
template <class T>
[[nodiscard]] inline PixelFrame<T> pixel_frame(ViewVolume<T> const& view, int width, int height,
                                               YAxis rows = YAxis::up) noexcept {
    PixelFrame<T> frame;
    frame.faults = faults_of(view);
    if (width < 1 || height < 1) frame.faults |= Fault::map_too_small;
    if (frame.faults.any()) return frame;
    frame.width = width;
    frame.height = height;
    frame.kind = view.kind;
    frame.eye = view.pose.position;
    Vec3<T> const& right = view.pose.right;
    Vec3<T> const up = rows == YAxis::up ? view.pose.up : -view.pose.up;
    T const x_step = (view.right - view.left) / T(width), y_step = (view.top - view.bottom) / T(height);
    T const x_middle = (view.left + view.right) / T(2);
    T const y_middle = (view.bottom + view.top) / (rows == YAxis::up ? T(2) : T(-2));
    frame.across = right * x_step;
    frame.upward = up * y_step;
    frame.to_across = right / x_step;
    frame.to_upward = up / y_step;
    frame.inward = frame.to_inward = view.pose.forward;
    if (view.kind == ViewKind::orthographic) {
        frame.origin = Vec2<T>(x_middle / x_step, y_middle / y_step);
        return frame;
    }
    frame.inward += right * x_middle + up * y_middle;
    frame.to_across -= view.pose.forward * (x_middle / x_step);
    frame.to_upward -= view.pose.forward * (y_middle / y_step);
    return frame;
}

// The same in another scalar type: the three steps as they are, their inverse anew.
template <class Real, class T>
[[nodiscard]] inline PixelFrame<Real> frame_in(PixelFrame<T> const& frame) noexcept {
    PixelFrame<Real> same;
    same.eye = Vec3<Real>(frame.eye);
    same.across = Vec3<Real>(frame.across);
    same.upward = Vec3<Real>(frame.upward);
    same.inward = Vec3<Real>(frame.inward);
    same.origin = Vec2<Real>(frame.origin);
    same.width = frame.width;
    same.height = frame.height;
    same.kind = frame.kind;
    same.faults = frame.faults;
    Vec3<Real> const normal = glm::cross(same.across, same.upward);
    Real const volume = glm::dot(normal, same.inward);
    if (volume == Real(0)) return same;
    same.to_across = glm::cross(same.upward, same.inward) / volume;
    same.to_upward = glm::cross(same.inward, same.across) / volume;
    same.to_inward = normal / volume;
    return same;
}

// A direction, or a point relative to a perspective eye.
template <class T>
[[nodiscard]] inline Vec3<T> direction_in_pixels(PixelFrame<T> const& frame, Vec3<T> const& v) noexcept {
    return Vec3<T>(glm::dot(frame.to_across, v), glm::dot(frame.to_upward, v), glm::dot(frame.to_inward, v));
}

template <class T>
[[nodiscard]] inline Vec3<T> point_in_pixels(PixelFrame<T> const& frame, Vec3<T> const& point) noexcept {
    return direction_in_pixels(frame, point - frame.eye) - Vec3<T>(frame.origin, T(0));
}

// A covector of the pixel frame, arranged so that its value at a point of a surface is x X + y Y + a + b q: half
// spaces are made of it, and the rows of a map's matrix.
template <class T>
struct PixelPlane {
    T x;
    T y;
    T a;
    T b;
};

// The plane whose value at a point of the pixel frame is normal . point + offset, over the point's depth where the eye
// is one of perspective: the same sign.
template <class T>
[[nodiscard]] inline PixelPlane<T> pixel_plane(ViewKind kind, Vec3<T> const& normal, T offset) noexcept {
    if (kind == ViewKind::perspective) return {normal.x, normal.y, normal.z, offset};
    return {normal.x, normal.y, offset, normal.z};
}

template <class T>
struct MicroQuad {
    T q = T(0);    // at the pixel's corner of least x and y: 1 / depth, or depth for an orthographic eye
    T q_x = T(0);  // gained from there to the next corner in x
    T q_y = T(0);
    bool ok = false;
};

// How far one over the depth may change within half a pixel, as a share of its value in the middle: from 2/3 of the
// depth to twice it. A plane that is seen more nearly edge-on is turned toward the eye until it is not.
template <class T>
inline constexpr T steepest_quad = T(0.5);

// The same for an orthographic eye: how many pixels deep half a pixel may be.
template <class T>
inline constexpr T deepest_quad = T(1000);

namespace detail {

// The covector of a world normal: dotted with a point of the pixel frame it is what the normal is with that point.
template <class T>
[[nodiscard]] inline Vec3<T> normal_in_pixels(PixelFrame<T> const& frame, Vec3<T> const& normal) noexcept {
    return Vec3<T>(glm::dot(frame.across, normal), glm::dot(frame.upward, normal), glm::dot(frame.inward, normal));
}

// How much |n.x| + |n.y| weighs against what faces the eye: the reciprocal of twice the limits above.
template <class T>
[[nodiscard]] inline T turn_limit(PixelFrame<T> const& frame) noexcept {
    if (frame.kind == ViewKind::perspective) return T(1) / (T(2) * steepest_quad<T>);
    return T(1) / (T(2) * deepest_quad<T> * glm::length(frame.across));
}

}  // namespace detail

// The piece of the plane through `depth` in the middle of pixel (column, row). The normal is the surface's own, not the
// one for shading; its length and sign do not matter. Not ok where anything is not finite, the normal has no length,
// or the depth is not positive before an eye of perspective.
template <class T>
[[nodiscard]] inline MicroQuad<T> micro_quad(PixelFrame<T> const& frame, int column, int row, T const& depth,
                                             Vec3<T> const& normal_in_world) noexcept {
    bool const flat = frame.kind == ViewKind::orthographic;
    if (!all_finite(&depth, 1) || !all_finite(normal_in_world) || (!flat && !(depth > T(0)))) return {};
    Vec3<T> const n = detail::normal_in_pixels(frame, normal_in_world);
    T const x = T(column) + T(0.5) - T(frame.width) / T(2), y = T(row) + T(0.5) - T(frame.height) / T(2);
    T const facing = flat ? -n.z : n.x * x + n.y * y + n.z;
    T const steep = (std::abs(n.x) + std::abs(n.y)) * detail::turn_limit(frame);
    T const divisor = std::copysign(std::abs(facing) > steep ? std::abs(facing) : steep, facing);
    T const inverse = flat ? divisor : divisor * depth;
    if (inverse == T(0)) return {};
    T const scale = T(1) / inverse;
    MicroQuad<T> quad;
    quad.q_x = n.x * scale;
    quad.q_y = n.y * scale;
    quad.q = (flat ? depth : divisor * scale) - (quad.q_x + quad.q_y) / T(2);
    quad.ok = all_finite(&quad.q, 1) && all_finite(&quad.q_x, 1) && all_finite(&quad.q_y, 1);
    return quad;
}

// The world point of the surface at (u, v) of the pixel, each from 0 at its corner to 1 at the next.
template <class T>
[[nodiscard]] inline Vec3<T> point_on(PixelFrame<T> const& frame, MicroQuad<T> const& quad, int column, int row, T u,
                                      T v) noexcept {
    T const x = T(column) + u - T(frame.width) / T(2), y = T(row) + v - T(frame.height) / T(2);
    T const q = quad.q + quad.q_x * u + quad.q_y * v;
    if (frame.kind == ViewKind::orthographic)
        return frame.eye + frame.across * (x + frame.origin.x) + frame.upward * (y + frame.origin.y) + frame.inward * q;
    return frame.eye + (frame.across * x + frame.upward * y + frame.inward) / q;
}

}  // namespace v0
}  // namespace shadowmath
