// SPDX-License-Identifier: MIT
//
// All slices of a view at once, and nothing but the slices: what fit_box and fit_sphere with texel_grid give, twenty
// times as fast as from an inverse matrix and eight corners. For thousands of views, and for renderers whose casters
// are drawn with depth clamp; where scene bounds are to decide how deep a map is, use fit_cascades.
//
//   Along a light axis a, what is seen from depth n to f spans      a.eye + [min(n k, f k), max(n K, f K)],
//   k = a.forward + the least of a.right * side_x + a.up * side_y,  K with the largest.
//
// Four dot products an axis therefore serve every slice, no corner is computed, and the three axes are the lanes of one
// vector: the loops over `axis` below are one instruction a line.
//
// Source: ours; the closed forms of the spheres are those of fit_sphere.
#pragma once

#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fit_sphere.hpp>
#include <shadowmath/lanes.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/margin.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/splits.hpp>
#include <shadowmath/view_volume.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace shadowmath {
inline namespace v0 {

namespace detail {

// A view in light space. Lanes are the light's axes: x, y, depth; the fourth is zero.
template <class T>
struct ViewInLight {
    Lanes<T> x, y, z;   // columns of the rotation into light space
    Lanes<T> eye_lo;    // at depth 0, the least, and less by what it may be rounded by
    Lanes<T> eye_hi;    // and the largest
    Lanes<T> slope_lo;  // by which they grow with depth
    Lanes<T> slope_hi;
    Lanes<T> eye, forward, right, up;  // the view's pose
    T sides;                           // how far they are from the middle, all together
    T rounding_slope;                  // by which the rounding of a coordinate grows with depth
};

template <class T>
[[nodiscard]] inline T absolute_sum(Vec3<T> const& v) noexcept {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

// False, where a number is not finite or beyond 2^60 m, a side is crossed, or an axis of the light is no unit vector.
// NOTE: not inlined, it would hand over its twelve registers by way of memory.
template <class T>
[[nodiscard, gnu::always_inline]] inline bool look(LightBasis<T> const& basis, ViewVolume<T> const& view,
                                                   ViewInLight<T>& seen) noexcept {
    seen.x = Lanes<T>::of(basis.x.x, basis.y.x, basis.depth.x, T(0));
    seen.y = Lanes<T>::of(basis.x.y, basis.y.y, basis.depth.y, T(0));
    seen.z = Lanes<T>::of(basis.x.z, basis.y.z, basis.depth.z, T(0));
    BeyondReach<T> beyond;
    if constexpr (sizeof view.pose == 12 * sizeof(T)) {
        for (int i = 0; i < 12; i += 4) beyond.look_at(four_at(&view.pose.position.x + i));
    } else {
        // GLM's aligned vectors have a gap behind each.
        for (Vec3<T> const* v : {&view.pose.position, &view.pose.forward, &view.pose.right, &view.pose.up})
            beyond.look_at(Lanes<T>::of(v->x, v->y, v->z, T(0)));
    }
    beyond.look_at(four_at(&view.left));
    beyond.look_at_parts(seen.x);
    beyond.look_at_parts(seen.y);
    beyond.look_at_parts(seen.z);
    if (beyond.any() || !(view.left < view.right) || !(view.bottom < view.top)) return false;
    auto const along = [&seen](Vec3<T> const& v) {
        return seen.x * all_four(v.x) + seen.y * all_four(v.y) + seen.z * all_four(v.z);
    };
    Pose<T> const& pose = view.pose;
    Lanes<T> const eye = along(pose.position), forward = along(pose.forward);
    Lanes<T> const right = along(pose.right), up = along(pose.up);
    seen.eye = eye, seen.forward = forward, seen.right = right, seen.up = up;
    Lanes<T> const a = right * all_four(view.left), b = right * all_four(view.right);
    Lanes<T> const c = up * all_four(view.bottom), d = up * all_four(view.top);
    Lanes<T> const lo = least(a, b) + least(c, d), hi = largest(a, b) + largest(c, d);
    T const sides = std::abs(view.left) + std::abs(view.right) + std::abs(view.bottom) + std::abs(view.top);
    seen.sides = sides;
    constexpr T unit = T(8) * std::numeric_limits<T>::epsilon();
    if (view.kind == ViewKind::orthographic) {
        Lanes<T> const rounding = all_four(unit * (absolute_sum(pose.position) + sides));
        seen.eye_lo = eye + lo - rounding;
        seen.eye_hi = eye + hi + rounding;
        seen.slope_lo = seen.slope_hi = forward;
        seen.rounding_slope = unit;
    } else {
        Lanes<T> const rounding = all_four(unit * absolute_sum(pose.position));
        seen.eye_lo = eye - rounding;
        seen.eye_hi = eye + rounding;
        seen.slope_lo = forward + lo;
        seen.slope_hi = forward + hi;
        seen.rounding_slope = unit * (T(1) + sides);
    }
    return true;
}

// Neither so near that a reciprocal overflows nor out of reach; increasing, as all functions make them.
template <class T>
[[nodiscard, gnu::always_inline]] inline bool in_range(Splits<T> const& splits) noexcept {
    if (splits.count < 1 || splits.count > max_splits) return false;
    T const* const p = splits.plane;
    auto const zero = order_of(T(0)), nearest = order_of(least_metres<T>), farthest = order_of(farthest_metres<T>);
    if (splits.count == 4) {
        // NOTE: one by one, as they have just been written; a vector of them would wait for the last.
        auto const a = order_of(p[0]), b = order_of(p[1]), c = order_of(p[2]), d = order_of(p[3]), e = order_of(p[4]);
        return (a >= zero) & (b >= nearest) & (a < b) & (b < c) & (c < d) & (d < e) & (e <= farthest);
    }
    auto last = order_of(splits.plane[0]);
    bool good = last >= zero;
    for (int i = 1; i <= splits.count; ++i) {
        auto const next = order_of(splits.plane[i]);
        good = good & (last < next);
        last = next;
    }
    auto const first_end = order_of(p[1]);
    return good & (first_end >= nearest) & (last <= farthest);
}

// As bounding_sphere asks of a slice.
template <class T>
[[nodiscard]] inline bool ball_in_reach(ViewVolume<T> const& view, T farthest) noexcept {
    T const side = largest_side(view);
    return view.kind == ViewKind::orthographic || (side <= T(1e9) && side * farthest <= farthest_metres<T>);
}

// Extent of the map on each axis, and its middle, in the convention.
template <class T>
struct MapInLanes {
    Lanes<T> extent;
    Lanes<T> middle;  // 1 in the fourth: w
};

// `side`: how much of [-1, 1] is used.
template <class T>
[[nodiscard]] inline MapInLanes<T> map_in_lanes(ClipSpace clip, T side) noexcept {
    T const y = clip.ndc_y == YAxis::up ? side : -side;
    T depth = T(1), middle = T(0.5);
    if (clip.depth == DepthOrder::one_to_zero) depth = T(-1);
    if (clip.depth == DepthOrder::minus_one_to_one) depth = T(2), middle = T(0);
    return {Lanes<T>::of(side, y, depth, T(0)), Lanes<T>::of(T(0), T(0), middle, T(1))};
}

template <class T>
inline void write_columns(ViewInLight<T> const& seen, Lanes<T> const& scale, Lanes<T> const& offset,
                          Mat4<T>& clip_from_world) noexcept {
    Lanes<T> const x = seen.x * scale, y = seen.y * scale, z = seen.z * scale;
    static_assert(4 * sizeof x == sizeof clip_from_world, "columns without a gap");
    std::memcpy(&clip_from_world[0].x, &x, sizeof x);
    std::memcpy(&clip_from_world[1].x, &y, sizeof y);
    std::memcpy(&clip_from_world[2].x, &z, sizeof z);
    std::memcpy(&clip_from_world[3].x, &offset, sizeof offset);
}

}  // namespace detail

// clip_from_world[i] is the map of slice i: the smallest light-space box around it, and no depth but the slice's own.
// Each corner of each slice is inside. `border` is the part of the map's side that is kept free on each of the four
// sides, for filters: 2.0f / 2048 for two texels; [0, 0.49]. Writes splits.count matrices and says true; or nowhere()
// and false, where a number is not finite or beyond 2^60 m, an axis is no axis, a side is crossed, or the border
// outside its range.
// NOTE: inlined, as what it is given has mostly just been made.
template <class T>
[[nodiscard, gnu::always_inline]] inline bool fit_slice_boxes(ViewVolume<T> const& view, LightBasis<T> const& basis,
                                                              Splits<T> const& splits, T border, ClipSpace clip,
                                                              Mat4<T>* clip_from_world) noexcept {
    using Lanes = detail::Lanes<T>;
    detail::ViewInLight<T> seen;
    if (!detail::look(basis, view, seen) || !detail::in_range(splits) ||
        !(detail::order_of(border) >= detail::order_of(T(0)) &&
          detail::order_of(border) <= detail::order_of(T(0.49)))) {
        for (int i = 0; i < splits.count; ++i) clip_from_world[i] = nowhere<T>();
        return false;
    }
    detail::MapInLanes<T> const map = detail::map_in_lanes(clip, T(2) - T(4) * border);
    Lanes const slope = detail::all_four(seen.rounding_slope), half = detail::all_four(T(0.5));
    Lanes const n = detail::all_four(splits.plane[0]);
    Lanes n_lo = n * seen.slope_lo, n_hi = n * seen.slope_hi;
    for (int i = 0; i < splits.count; ++i) {
        Lanes const f = detail::all_four(splits.plane[i + 1]), rounding = f * slope;
        Lanes const f_lo = f * seen.slope_lo, f_hi = f * seen.slope_hi;
        Lanes const lo = seen.eye_lo + (least(n_lo, f_lo) - rounding);
        Lanes const hi = seen.eye_hi + (largest(n_hi, f_hi) + rounding);
        Lanes const scale = map.extent / (hi - lo);
        detail::write_columns(seen, scale, map.middle - (lo + hi) * half * scale, clip_from_world[i]);
        n_lo = f_lo, n_hi = f_hi;
    }
    return true;
}

namespace detail {

// What the maps of all spheres of a view have in common.
template <class T>
struct SphereMaps {
    using Exact = decltype(T() + double());
    ViewInLight<T> seen;
    MapInLanes<T> map;
    T texel_per_radius;
    int size;      // texels along a map's side
    Exact eye[2];  // across the light, metres

    // The window around the centre of a ball at these coordinates; false where its texels cannot be counted. Depth is
    // scaled by `along`, and moved by `offset`.
    [[nodiscard, gnu::always_inline]] bool write(Exact x, Exact y, T texel, T along, T offset,
                                                 Mat4<T>& clip_from_world) const noexcept {
        Exact const per_side = 2 / Exact(size), texels = 1 / Exact(texel),
                    middle = Exact(0.5) - Exact(size) * Exact(0.5);
        Exact const left = x * texels + middle, bottom = y * texels + middle;
        if (!(std::abs(left) < Exact(0x1p51) && std::abs(bottom) < Exact(0x1p51)) || !(texel >= least_metres<T>))
            return false;
        auto const whole = [](Exact value) {
            auto const truncated = static_cast<Exact>(static_cast<std::int64_t>(value));
            return truncated - (truncated > value ? Exact(1) : Exact(0));
        };
        T const across = T(per_side * texels), up = map.extent[1];
        T const offset_x = T(-(whole(left) * per_side + 1)), offset_y = T(-(whole(bottom) * per_side + 1));
        write_columns(seen, Lanes<T>::of(across, across * up, along, T(0)),
                      Lanes<T>::of(offset_x, offset_y * up, offset, T(1)), clip_from_world);
        return true;
    }
};

// Slices of a view whose sides are equal, four at a time: the ball around one lies on its axis, no farther than its far
// face. False where one map is too far out or too fine for it: then all are made as those of any view.
// NOTE: loops of a constant length over arrays are what compilers make vectors of.
template <class T>
[[nodiscard, gnu::always_inline]] inline bool write_centred_spheres(SphereMaps<T> const& maps,
                                                                    ViewVolume<T> const& view, Splits<T> const& splits,
                                                                    Mat4<T>* clip_from_world) noexcept {
    using Lanes = Lanes<T>;
    using Exact = typename SphereMaps<T>::Exact;
    auto const all = [](T value) { return all_four(value); };
    T const k2 = view.right * view.right + view.top * view.top;  // k: radius of a face per metre of its depth
    T const per_radius = maps.texel_per_radius, nearest = splits.plane[1] * per_radius;
    T const ahead_x = maps.seen.forward[0], ahead_y = maps.seen.forward[1];
    Exact const eye_x = maps.eye[0], eye_y = maps.eye[1];
    T const farthest =
        T(std::abs(eye_x)) + T(std::abs(eye_y)) + (std::abs(ahead_x) + std::abs(ahead_y)) * splits.plane[splits.count];
    // No texel is finer than that of a ball of the first far face. 2^28 of them, and they no longer count in 32 bits.
    T const finest2 = k2 * nearest * nearest;
    if (!(finest2 >= T(1e-30)) || !(farthest * farthest < T(0x1p56) * finest2) || maps.size > (1 << 28)) return false;
    constexpr T slack = T(8) * std::numeric_limits<T>::epsilon();
    Lanes const lo_0 = all(maps.seen.eye_lo[2]), lo_slope = all(maps.seen.slope_lo[2]);
    Lanes const hi_0 = all(maps.seen.eye_hi[2]), hi_slope = all(maps.seen.slope_hi[2]);
    // Raised so that all places are positive, and conversion to an integer rounds downward.
    constexpr std::int32_t raised = 1 << 29;
    std::int32_t const back = maps.size - 2 * raised;
    Exact const middle = Exact(raised) + Exact(0.5) - Exact(maps.size) * Exact(0.5);
    for (int first = 0; first < splits.count; first += 4) {
        int const left = splits.count - first < 4 ? splits.count - first : 4;
        T const* const p = splits.plane + first;
        Lanes n = four_at(p), f;
        if (left == 4) {
            f = moved_up(n, p[4]);
        } else {
            // The last slice once more in the places that are left.
            n = Lanes::of(p[0], p[left > 1 ? 1 : 0], p[left > 2 ? 2 : left - 1], p[left - 1]);
            f = Lanes::of(p[1], p[left > 1 ? 2 : 1], p[left > 2 ? 3 : left], p[left]);
        }
        // 1 where the ball is centred on the far face: where its half width is no less than its depth.
        Lanes const centre = least((all(T(1)) + n / f) * all(T(0.5)) * all(T(1) + k2), all(T(1)));
        Lanes const behind = all(T(1)) - centre, radius = root(behind * behind + all(k2));
        Lanes const texel = radius * (f * all(per_radius + per_radius * slack)) + f * all(per_radius * slack);
        Lanes const per_texel = all(T(1)) / texel;
        T ahead_in_x[4], ahead_in_y[4], texels[4];
        Lanes const x_ahead = centre * f * all(ahead_x), y_ahead = centre * f * all(ahead_y);
        std::memcpy(ahead_in_x, &x_ahead, sizeof ahead_in_x);
        std::memcpy(ahead_in_y, &y_ahead, sizeof ahead_in_y);
        std::memcpy(texels, &per_texel, sizeof texels);
        Exact x[4], y[4];
        std::int32_t column[4], row[4];
        T offset_x[4], offset_y[4];
        for (int i = 0; i < 4; ++i) {
            x[i] = (eye_x + Exact(ahead_in_x[i])) * Exact(texels[i]) + middle;
            y[i] = (eye_y + Exact(ahead_in_y[i])) * Exact(texels[i]) + middle;
        }
        for (int i = 0; i < 4; ++i) column[i] = static_cast<std::int32_t>(x[i]) * 2 + back;
        for (int i = 0; i < 4; ++i) row[i] = static_cast<std::int32_t>(y[i]) * 2 + back;
        for (int i = 0; i < 4; ++i) offset_x[i] = static_cast<T>(-column[i]);
        for (int i = 0; i < 4; ++i) offset_y[i] = static_cast<T>(-row[i]);
        Lanes const rounding = f * all(maps.seen.rounding_slope);
        Lanes const lo = lo_0 + (least(n * lo_slope, f * lo_slope) - rounding);
        Lanes const hi = hi_0 + (largest(n * hi_slope, f * hi_slope) + rounding);
        Lanes const along = all(maps.map.extent[2]) / (hi - lo);
        T const per_side = T(1) / T(maps.size), up = maps.map.extent[1];
        Lanes scale[4] = {per_texel * all(T(2) * per_side), per_texel * all(T(2) * per_side * up), along, all(T(0))};
        Lanes move[4] = {four_at(offset_x) * all(per_side), four_at(offset_y) * all(per_side * up),
                         all(maps.map.middle[2]) - (lo + hi) * all(T(0.5)) * along, all(T(1))};
        transpose(scale);
        transpose(move);
        for (int i = 0; i < left; ++i) write_columns(maps.seen, scale[i], move[i], clip_from_world[first + i]);
    }
    return true;
}

// Slices of any view, one after the other; nowhere() for those that no map can be made of.
template <class T>
[[nodiscard, gnu::noinline]] inline bool write_spheres(SphereMaps<T> const& maps, ViewVolume<T> const& view,
                                                       LightBasis<T> const& basis, Splits<T> const& splits,
                                                       Mat4<T>* clip_from_world) noexcept {
    using Exact = typename SphereMaps<T>::Exact;
    auto const exact = [](Vec3<T> const& axis, Vec3<T> const& v) {
        return Exact(axis.x) * Exact(v.x) + Exact(axis.y) * Exact(v.y) + Exact(axis.z) * Exact(v.z);
    };
    ViewInLight<T> const& seen = maps.seen;
    Pose<T> const& pose = view.pose;
    ViewVolume<T> part = view;
    bool good = true;
    for (int i = 0; i < splits.count; ++i) {
        T const n = splits.plane[i], f = splits.plane[i + 1];
        part.z_near = n, part.z_far = f;
        BallInView<T> const ball = ball_in_view(part);
        Exact const unit = Exact(ball.unit), depth = Exact(ball.center.z) * unit;
        Exact const right = Exact(ball.center.x) * unit, up = Exact(ball.center.y) * unit;
        auto const across = [&](Vec3<T> const& axis) {
            return exact(axis, pose.forward) * depth + (exact(axis, pose.right) * right + exact(axis, pose.up) * up);
        };
        Exact const x = maps.eye[0] + across(basis.x), y = maps.eye[1] + across(basis.y);
        T const n_lo = n * seen.slope_lo[2], f_lo = f * seen.slope_lo[2];
        T const n_hi = n * seen.slope_hi[2], f_hi = f * seen.slope_hi[2];
        T const rounding = seen.rounding_slope * f;
        T const lo = seen.eye_lo[2] + ((n_lo < f_lo ? n_lo : f_lo) - rounding);
        T const hi = seen.eye_hi[2] + ((n_hi > f_hi ? n_hi : f_hi) + rounding);
        T const along = maps.map.extent[2] / (hi - lo), offset = maps.map.middle[2] - (lo + hi) * T(0.5) * along;
        if (!maps.write(x, y, ball.radius_metres * maps.texel_per_radius, along, offset, clip_from_world[i])) {
            clip_from_world[i] = nowhere<T>();
            good = false;
        }
    }
    return good;
}

}  // namespace detail

// As fit_slice_boxes, with the window of the slice's bounding sphere on the texel grid (texel_grid.hpp) for sides: what
// casts no shimmering shadows. Nothing of the sphere is lost in x and y, and no corner of the slice in depth. False as
// well where the margin leaves no texel, or the view is so far out that its texels cannot be counted.
template <class T>
[[nodiscard]] inline bool fit_slice_spheres(ViewVolume<T> const& view, LightBasis<T> const& basis,
                                            Splits<T> const& splits, int map_size, T margin_texels, ClipSpace clip,
                                            Mat4<T>* clip_from_world) noexcept {
    detail::SphereMaps<T> maps;
    using Exact = typename detail::SphereMaps<T>::Exact;
    Faults const margin = faults_of_margin(map_size, margin_texels);
    if (!detail::look(basis, view, maps.seen) || !detail::in_range(splits) || margin.has(Fault::not_finite) ||
        margin.has(Fault::map_too_small) || !detail::ball_in_reach(view, splits.plane[splits.count])) {
        for (int i = 0; i < splits.count; ++i) clip_from_world[i] = nowhere<T>();
        return false;
    }
    maps.map = detail::map_in_lanes(clip, T(1));
    maps.texel_per_radius =
        (T(2) + T(16) * std::numeric_limits<T>::epsilon()) / (usable_texels(map_size, margin_texels) - T(1));
    maps.size = map_size;
    // Both axes side by side: compilers make one vector of them.
    Exact const x[2] = {Exact(basis.x.x), Exact(basis.y.x)}, y[2] = {Exact(basis.x.y), Exact(basis.y.y)};
    Exact const z[2] = {Exact(basis.x.z), Exact(basis.y.z)};
    Vec3<T> const& eye = view.pose.position;
    for (int i = 0; i < 2; ++i) maps.eye[i] = x[i] * Exact(eye.x) + y[i] * Exact(eye.y) + z[i] * Exact(eye.z);
    bool const centred = view.left == -view.right && view.bottom == -view.top;
    if (centred && view.kind == ViewKind::perspective &&
        detail::write_centred_spheres(maps, view, splits, clip_from_world))
        return true;
    return detail::write_spheres(maps, view, basis, splits, clip_from_world);
}

}  // namespace v0
}  // namespace shadowmath
