// SPDX-License-Identifier: MIT
//
// Laws of pixels as pieces of a plane, and of half spaces seen through them. Judged in long double.
#pragma once

#include <shadowmath/irregular/edge.hpp>

#include <cmath>
#include <limits>

namespace shadowmath::laws {

// The point at (u, v) lies on the plane through `point`, and the eye sees it at (u, v) of the pixel, each to within
// `roundings` of the numbers that enter.
template <class T>
[[nodiscard]] bool is_on_the_plane_and_in_the_pixel(PixelFrame<T> const& frame, MicroQuad<T> const& quad, int column,
                                                    int row, T u, T v, Vec3<T> const& point, Vec3<T> const& normal,
                                                    int roundings) {
    using Real = long double;
    PixelFrame<Real> const exact = frame_in<Real>(frame);
    MicroQuad<Real> const same{quad.q, quad.q_x, quad.q_y, quad.ok};
    Vec3<Real> const at = point_on(exact, same, column, row, Real(u), Real(v));
    Vec3<Real> const n = Vec3<Real>(normal) / glm::length(Vec3<Real>(normal));
    Real const eps = std::numeric_limits<T>::epsilon();
    Real const off = glm::dot(n, at - Vec3<Real>(point));
    Real const scale = glm::length(at - exact.eye) + glm::length(Vec3<Real>(point) - exact.eye);
    Vec3<Real> const seen = point_in_pixels(exact, at);
    Real const depth = frame.kind == ViewKind::perspective ? seen.z : Real(1);
    Real const x = seen.x / depth + Real(frame.width) / 2, y = seen.y / depth + Real(frame.height) / 2;
    return std::abs(off) <= roundings * eps * scale && std::abs(x - (Real(column) + Real(u))) <= 1e-9L &&
           std::abs(y - (Real(row) + Real(v))) <= 1e-9L;
}

}  // namespace shadowmath::laws
