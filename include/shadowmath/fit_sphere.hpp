// SPDX-License-Identifier: MIT
//
// The smallest ball around a slice: the fit that does not change when the camera turns. Put it on a texel grid and
// shadow edges stand still. A ball wastes what a box would use (about half of the texels, near half a right angle
// more); use fit_box where crawling edges do not show.
//
// Source: the closed form for symmetric perspective is that of lxjk, "Tight bounding sphere for cascaded shadow maps"
// (2017). Departures: orthographic and off-centre views (stereo, jitter, tiles) get the exact smallest ball too, and
// the radius is computed in view space and scaled, so that it is the same to the last bit wherever the camera stands.
//
//   far face decides           both faces decide
//    ________                    ______
//    \      /   centre on        \    /    centre between,
//     \    /    the far face      |  |     all eight corners
//      \  /                       |  |     on the sphere
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/view_volume.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace shadowmath {
inline namespace v0 {

namespace detail {

// The smallest ball of eight points that lie within a few units of the origin.
// It is the circumsphere of two, three or four of them. Any centre is good with the radius that it needs, so the least
// of those radii is the answer: no test has a tolerance, and a flat set of four costs nothing but a bad candidate.
template <class T>
[[nodiscard]] inline Sphere<T> smallest_ball(std::array<Vec3<T>, 8> const& points) noexcept {
    Sphere<T> best{Vec3<T>(T(0)), std::numeric_limits<T>::max()};  // the radius is squared until the end
    auto const consider = [&](Vec3<T> const& center) {
        T needed = T(0);
        for (Vec3<T> const& point : points) {
            Vec3<T> const arm = point - center;
            T const square = glm::dot(arm, arm);
            needed = square > needed ? square : needed;
        }
        if (needed < best.radius) best = {center, needed};
    };
    for (std::size_t i = 0; i < 8; ++i) {
        for (std::size_t j = i + 1; j < 8; ++j) {
            Vec3<T> const a = points[j] - points[i];
            consider(points[i] + a * T(0.5));
            for (std::size_t k = j + 1; k < 8; ++k) {
                Vec3<T> const b = points[k] - points[i], normal = glm::cross(a, b);
                T const aa = glm::dot(a, a), bb = glm::dot(b, b), area2 = glm::dot(normal, normal);
                if (area2 > T(0)) consider(points[i] + glm::cross(aa * b - bb * a, normal) / (T(2) * area2));
                for (std::size_t l = k + 1; l < 8; ++l) {
                    Vec3<T> const d = points[l] - points[i];
                    T const volume = glm::dot(normal, d);
                    if (volume == T(0)) continue;
                    Vec3<T> const sum = aa * glm::cross(b, d) + bb * glm::cross(d, a) + glm::dot(d, d) * normal;
                    consider(points[i] + sum / (T(2) * volume));
                }
            }
        }
    }
    best.radius = std::sqrt(best.radius);
    return best;
}

// A perspective slice whose far plane is at depth 1; view space is (right, up, forward).
template <class T>
[[nodiscard]] inline Sphere<T> ball_of_unit_slice(ViewVolume<T> const& view, T n) noexcept {
    if (view.left == -view.right && view.bottom == -view.top) {
        T const k2 = view.right * view.right + view.top * view.top;  // k: corner radius per metre of depth
        if (k2 * (T(1) + n) >= T(1) - n) return {Vec3<T>(T(0), T(0), T(1)), std::sqrt(k2)};
        T const c = T(0.5) * (T(1) + n) * (T(1) + k2), behind = T(1) - c;
        return {Vec3<T>(T(0), T(0), c), std::sqrt(behind * behind + k2)};
    }
    std::array<Vec3<T>, 8> points;
    for (std::size_t i = 0; i < 8; ++i) {
        T const depth = (i & 4u) != 0 ? T(1) : n;
        points[i] = Vec3<T>(((i & 1u) != 0 ? view.right : view.left) * depth,
                            ((i & 2u) != 0 ? view.top : view.bottom) * depth, depth);
    }
    return smallest_ball(points);
}

template <class T>
struct BallInView {
    Vec3<T> center{T(0)};  // (right, up, forward), in units
    T unit = T(1);         // metres
    T radius_metres = T(0);
};

// Of a slice without faults, of any kind.
template <class T>
[[nodiscard]] inline BallInView<T> ball_in_view(ViewVolume<T> const& slice) noexcept {
    bool const flat = slice.kind == ViewKind::orthographic;
    T const side = largest_side(slice);
    T const unit = flat ? std::fmax(side, slice.z_far) : slice.z_far;
    Sphere<T> ball;
    if (flat) {
        T const half = T(0.5) / unit;
        Vec3<T> const extent((slice.right - slice.left) * half, (slice.top - slice.bottom) * half,
                             (slice.z_far - slice.z_near) * half);
        ball.center = Vec3<T>((slice.left + slice.right) * half, (slice.bottom + slice.top) * half,
                              (slice.z_near + slice.z_far) * half);
        ball.radius = std::sqrt(glm::dot(extent, extent));
    } else {
        ball = ball_of_unit_slice(slice, slice.z_near / slice.z_far);
    }
    // Up by what the coordinates of corner and centre were rounded by.
    T const slack = T(8) * std::numeric_limits<T>::epsilon();
    return {ball.center, unit, (ball.radius + slack * (T(1) + ball.radius)) * unit};
}

}  // namespace detail

// Holds all eight corners, each to the rounding of its own world coordinates, and no smaller ball does, but for a few
// ulp. World centre, metres. The radius depends on sides, near and far only: bit for bit the same for every pose.
// Radius 0: there is no such ball, because faults_of(slice) is not empty, z_far is infinite, or something lies beyond
// 1e18 m.
template <class T>
[[nodiscard]] inline Sphere<T> bounding_sphere(ViewVolume<T> const& slice) noexcept {
    if (faults_of(slice).any() || is_positive_infinity(&slice.z_far)) return {};
    bool const flat = slice.kind == ViewKind::orthographic;
    Vec3<T> const &p = slice.pose.position, &f = slice.pose.forward, &r = slice.pose.right, &u = slice.pose.up;
    T const side = detail::largest_side(slice);
    if (!(std::fmax(slice.z_far, detail::largest_of(p)) <= detail::farthest_metres<T>) ||
        !(side <= (flat ? detail::farthest_metres<T> : T(1e9))) ||
        (!flat && !(side * slice.z_far <= detail::farthest_metres<T>)))
        return {};
    detail::BallInView<T> const seen = detail::ball_in_view(slice);
    Vec3<T> const& c = seen.center;
    return {p + (f * c.z + r * c.x + u * c.y) * seen.unit, seen.radius_metres};
}

}  // namespace v0
}  // namespace shadowmath
