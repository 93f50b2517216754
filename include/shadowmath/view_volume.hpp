// SPDX-License-Identifier: MIT
//
// What the eye sees: a pose, four sides, and a range of depth. Perspective, off-centre, jittered, stereo and
// orthographic cameras are all one ViewVolume, and so is every slice of one.
//
// Corners come from the sides, never from the inverse of a view-projection matrix: at far/near = 1e6 the float inverse
// loses the far corners altogether, while the sides keep them to 4 ulp. So near and far distances are inputs; only the
// sides can be read from a projection matrix (view_from_projection).
//
//   pose.up    right side = right * depth          All axes are unit vectors in world space. Handedness of the world
//      |   /                                       never matters: "depth" grows along pose.forward.
//      |  /  forward
//      | /__________ pose.right
//    position
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct Pose {
    Vec3<T> position{T(0)};           // world
    Vec3<T> right{T(1), T(0), T(0)};  // world, unit, orthogonal to the other two
    Vec3<T> up{T(0), T(1), T(0)};
    Vec3<T> forward{T(0), T(0), T(-1)};  // the viewing direction
};

enum class ViewKind : std::uint8_t { perspective, orthographic };

template <class T>
struct ViewVolume {
    Pose<T> pose;
    T left = T(-1);  // sides: metres per metre of depth (perspective), or metres (orthographic)
    T right = T(1);
    T bottom = T(-1);
    T top = T(1);
    T z_near = T(0.1);  // metres along pose.forward
    T z_far = T(100);   // metres; may be infinite for a camera, not for a slice
    ViewKind kind = ViewKind::perspective;
};

// Looks from `position` along `forward`; `rough_up` only chooses the roll. Orthonormal for every input: where
// forward is (nearly) parallel to rough_up, the world axis least along forward takes its place; a forward that is zero
// or not finite becomes -z.
template <class T>
[[nodiscard]] inline Pose<T> pose_looking(Vec3<T> const& position, Vec3<T> const& forward,
                                          Vec3<T> const& rough_up) noexcept {
    Pose<T> pose;
    pose.position = position;
    Normalized<T> const direction = safe_normalize(forward);
    if (direction.ok) pose.forward = direction.direction;
    Normalized<T> const hint = safe_normalize(rough_up);
    Normalized<T> side = safe_normalize(glm::cross(pose.forward, hint.direction));
    if (!(side.length > T(1e-4))) {
        Vec3<T> const a(std::abs(pose.forward.x), std::abs(pose.forward.y), std::abs(pose.forward.z));
        Vec3<T> axis(T(0));
        axis[a.x <= a.y && a.x <= a.z ? 0 : (a.y <= a.z ? 1 : 2)] = T(1);
        side = safe_normalize(glm::cross(pose.forward, axis));
    }
    // The shorter the cross product, the less of it is orthogonal; a second look along it makes up for that.
    pose.right = safe_normalize(side.direction - pose.forward * glm::dot(pose.forward, side.direction)).direction;
    pose.up = glm::cross(pose.right, pose.forward);
    return pose;
}

// Symmetric perspective. Field of view in (0, pi), aspect = width / height > 0; anything else gives bad sides, which
// faults_of reports as bad_frustum.
template <class T>
[[nodiscard]] inline ViewVolume<T> perspective_view(Pose<T> const& pose, T fov_y_radians, T aspect, T z_near,
                                                    T z_far) noexcept {
    constexpr T pi = T(3.14159265358979323846264338327950288L);
    ViewVolume<T> view;
    view.pose = pose;
    view.top = fov_y_radians > T(0) && fov_y_radians < pi ? std::tan(fov_y_radians / T(2)) : T(0);
    view.bottom = -view.top;
    view.right = view.top * aspect;
    view.left = -view.right;
    view.z_near = z_near;
    view.z_far = z_far;
    return view;
}

template <class T>
[[nodiscard]] inline ViewVolume<T> orthographic_view(Pose<T> const& pose, T left, T right, T bottom, T top, T z_near,
                                                     T z_far) noexcept {
    return {pose, left, right, bottom, top, z_near, z_far, ViewKind::orthographic};
}

// Reads the four sides from a projection matrix of any kind and convention: right- or left-handed, y up or down,
// off-centre, reversed, infinite, orthographic. Near and far are given, because float entries have lost them. Take the
// projection without its sub-pixel jitter, or the fit will jitter too. A matrix from which no sides can be read gives
// equal sides, which faults_of reports as bad_frustum.
template <class T>
[[nodiscard]] inline ViewVolume<T> view_from_projection(Pose<T> const& pose, Mat4<T> const& clip_from_view, T z_near,
                                                        T z_far) noexcept {
    ViewVolume<T> view;
    view.pose = pose;
    view.z_near = z_near;
    view.z_far = z_far;
    view.left = view.right = view.bottom = view.top = T(0);
    T const x_scale = clip_from_view[0][0], y_scale = clip_from_view[1][1];
    if (!all_finite(clip_from_view) || x_scale == T(0) || y_scale == T(0)) return view;
    // Perspective: w = h * z_view, so a side is where scale * side + offset * sign(h) = +-|h|. Orthographic: w =
    // m[3][3].
    T const h = clip_from_view[2][3];
    view.kind = h == T(0) ? ViewKind::orthographic : ViewKind::perspective;
    bool const flat = view.kind == ViewKind::orthographic;
    T const w = std::abs(flat ? clip_from_view[3][3] : h);
    T const x_offset = flat ? clip_from_view[3][0] : (h < T(0) ? -clip_from_view[2][0] : clip_from_view[2][0]);
    T const y_offset = flat ? clip_from_view[3][1] : (h < T(0) ? -clip_from_view[2][1] : clip_from_view[2][1]);
    T const x0 = (-w - x_offset) / x_scale, x1 = (w - x_offset) / x_scale;
    T const y0 = (-w - y_offset) / y_scale, y1 = (w - y_offset) / y_scale;
    view.left = x0 < x1 ? x0 : x1;
    view.right = x0 < x1 ? x1 : x0;
    view.bottom = y0 < y1 ? y0 : y1;
    view.top = y0 < y1 ? y1 : y0;
    return view;
}

// Empty when every function may use the view as it is. An infinite z_far is no fault, a z_near of 0 neither.
template <class T>
[[nodiscard]] inline Faults faults_of(ViewVolume<T> const& view) noexcept {
    Faults faults;
    if (!all_finite(&view.left, 1) || !all_finite(&view.right, 1) || !all_finite(&view.bottom, 1) ||
        !all_finite(&view.top, 1) || !(view.left < view.right) || !(view.bottom < view.top))
        faults |= Fault::bad_frustum;
    bool const endless = is_positive_infinity(&view.z_far);
    if (!all_finite(view.pose.position) || !all_finite(view.pose.right) || !all_finite(view.pose.up) ||
        !all_finite(view.pose.forward) || !all_finite(&view.z_near, 1) || (!all_finite(&view.z_far, 1) && !endless))
        return faults | Fault::not_finite;
    if (!(view.z_near >= T(0)) || (!endless && !(view.z_near < view.z_far))) faults |= Fault::empty_range;
    Vec3<T> const &r = view.pose.right, &u = view.pose.up, &f = view.pose.forward;
    auto const differ = [](T value, T wanted) { return !(std::abs(value - wanted) <= T(1e-3)); };
    if (differ(glm::dot(r, r), T(1)) || differ(glm::dot(u, u), T(1)) || differ(glm::dot(f, f), T(1)) ||
        differ(glm::dot(r, u), T(0)) || differ(glm::dot(u, f), T(0)) || differ(glm::dot(f, r), T(0)))
        faults |= Fault::bad_pose;
    return faults;
}

// Mends a pose that is orthonormal to 1e-3 (float matrices that were multiplied often) to the last bit or two; the
// forward axis keeps its direction. A worse pose comes back as it is, and so does one that has nothing to mend.
// NOTE: products that depend on nothing are sooner known than roots of roots, which a processor then goes on without.
template <class T>
[[nodiscard]] inline Pose<T> orthonormalized(Pose<T> const& pose) noexcept {
    Vec3<T> const &r = pose.right, &u = pose.up, &f = pose.forward;
    auto const off = [](T value, T wanted) {
        return std::abs(value - wanted) <= T(4) * std::numeric_limits<T>::epsilon() ? 0 : 1;
    };
    int const how_many = (off(glm::dot(r, r), T(1)) + off(glm::dot(u, u), T(1)) + off(glm::dot(f, f), T(1))) +
                         (off(glm::dot(r, u), T(0)) + off(glm::dot(u, f), T(0)) + off(glm::dot(f, r), T(0)));
    if (how_many == 0) return pose;
    Normalized<T> const forward = safe_normalize(pose.forward);
    Normalized<T> const right =
        safe_normalize(pose.right - forward.direction * glm::dot(forward.direction, pose.right));
    if (!forward.ok || !right.ok) return pose;
    Pose<T> mended = pose;
    mended.forward = forward.direction;
    mended.right = right.direction;
    Vec3<T> const up = glm::cross(mended.right, mended.forward);
    mended.up = glm::dot(up, pose.up) < T(0) ? -up : up;  // a mirrored pose stays mirrored
    return mended;
}

namespace detail {

// In the unit of the sides, of a view without faults.
template <class T>
[[nodiscard]] inline T largest_side(ViewVolume<T> const& view) noexcept {
    auto const more = [](T a, T b) { return a > b ? a : b; };
    return more(more(std::abs(view.left), std::abs(view.right)), more(std::abs(view.bottom), std::abs(view.top)));
}

// Nothing that it sees is farther aside than `farthest` metres, which is what its far end says.
template <class T>
[[nodiscard]] inline bool sides_are_within(ViewVolume<T> const& view, T farthest) noexcept {
    T const spread = view.kind == ViewKind::perspective && view.z_far > T(1) ? view.z_far : T(1);
    return largest_side(view) <= farthest / spread;
}

}  // namespace detail

// The point seen at `side_x`, `side_y` (in the unit of the sides) and `depth` metres along the view.
template <class T>
[[nodiscard]] inline Vec3<T> point_at(ViewVolume<T> const& view, T side_x, T side_y, T depth) noexcept {
    T const spread = view.kind == ViewKind::perspective ? depth : T(1);
    return view.pose.position + view.pose.forward * depth + view.pose.right * (side_x * spread) +
           view.pose.up * (side_y * spread);
}

// The eight corners, each within 4 ulp of the larger of two ways: eye to corner, origin to eye. Bit 0 of the index
// chooses right, bit 1 top, bit 2 far; two corners share an edge when their indices differ in one bit. z_far must be
// finite.
template <class T>
[[nodiscard]] inline std::array<Vec3<T>, 8> corners(ViewVolume<T> const& view) noexcept {
    return {point_at(view, view.left, view.bottom, view.z_near), point_at(view, view.right, view.bottom, view.z_near),
            point_at(view, view.left, view.top, view.z_near),    point_at(view, view.right, view.top, view.z_near),
            point_at(view, view.left, view.bottom, view.z_far),  point_at(view, view.right, view.bottom, view.z_far),
            point_at(view, view.left, view.top, view.z_far),     point_at(view, view.right, view.top, view.z_far)};
}

// Metres along the view, positive in front of the eye.
template <class T>
[[nodiscard]] inline T eye_depth(ViewVolume<T> const& view, Vec3<T> const& point) noexcept {
    return glm::dot(view.pose.forward, point - view.pose.position);
}

// The eye's own matrix, for drawing the receivers and for measuring footprints. Written by rows: right, up and depth of
// a point against the pose, so that no handedness enters. An infinite z_far is exact. A view with faults, or too far
// from the origin for its scalar type, sees nothing.
template <class T>
[[nodiscard]] inline Mat4<T> clip_from_world(ViewVolume<T> const& view, ClipSpace clip) noexcept {
    if (faults_of(view).any()) return nowhere<T>();
    Pose<T> const& pose = view.pose;
    auto const plane = [&pose](Vec3<T> const& axis) { return Vec4<T>(axis, -glm::dot(axis, pose.position)); };
    Vec4<T> const x = plane(pose.right), y = plane(pose.up), depth = plane(pose.forward);
    Vec4<T> const one(T(0), T(0), T(0), T(1));
    bool const flat = view.kind == ViewKind::orthographic;
    Vec4<T> const& w = flat ? one : depth;
    T const width = view.right - view.left, height = view.top - view.bottom;
    T const n = view.z_near, range = view.z_far - view.z_near;
    bool const endless = is_positive_infinity(&view.z_far);
    // Depth as scale * depth + offset * one, 0 at near and w at far.
    T const scale = flat ? (endless ? T(0) : T(1) / range) : (endless ? T(1) : view.z_far / range);
    Mat4<T> const canonical =
        from_rows(T(2) / width * x - (view.right + view.left) / width * w,
                  T(2) / height * y - (view.top + view.bottom) / height * w, scale * (depth - n * one), w);
    Mat4<T> const converted = clip_from_canonical<T>(clip) * canonical;
    return all_finite(converted) ? converted : nowhere<T>();
}

}  // namespace v0
}  // namespace shadowmath
