// SPDX-License-Identifier: MIT
//
// Which plane a view-dependent map should be drawn on, from the surfaces that the eye sees. Judged by one number: how
// far the map's texels are from the picture's pixels, as the mean square of the logarithms of the footprint's axes. 0
// is one texel a pixel everywhere, 0.48 twice too long along one axis.
//
//   median height    parallel to the ground, half of what is seen above it: the thesis' choice, made of points; and
//                    with each point's weight that of its pixels, so that the far does not outvote the near
//   least squares    through the points as they lie: slopes, walls
//   least distortion the best of these, moved along its normal until the number is least
//
// A plane that changes makes shadows jump: the one of the last frame is kept until another is better by a tenth.
//
// Source: Kwon 2002 names the problem and the mean height; the rest is derived here.
#pragma once

#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/footprint.hpp>
#include <shadowmath/judge.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/vdsm.hpp>
#include <shadowmath/view_volume.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct PlaneChoice {
    ShadowPlane<T> plane;
    T distortion = T(0);   // of this plane
    bool kept = false;     // it is the previous one
    bool visible = false;  // false: no samples, or no plane that serves any of them
};

namespace detail {

// The direction in which a symmetric matrix (xx, yy, zz; xy, yz, zx) is least; zero where two are least alike.
template <class T>
[[nodiscard]] inline Vec3<T> least_eigenvector(Vec3<T> const& square, Vec3<T> const& mixed) noexcept {
    // By the trigonometric formula for the roots, about the mean of the diagonal.
    T const mean = (square.x + square.y + square.z) / T(3);
    Vec3<T> const off = square - mean;
    T const spread = std::sqrt((glm::dot(off, off) + T(2) * glm::dot(mixed, mixed)) / T(6));
    if (!(spread > T(0))) return Vec3<T>(T(0));
    Vec3<T> const d = off / spread, m = mixed / spread;
    T const half_det =
        (d.x * (d.y * d.z - m.y * m.y) - m.x * (m.x * d.z - m.y * m.z) + m.z * (m.x * m.y - d.y * m.z)) / T(2);
    constexpr T third_of_a_turn = T(2.09439510239319549230842892218633526L);
    T const root = T(2) * std::cos(std::acos(glm::clamp(half_det, T(-1), T(1))) / T(3) + third_of_a_turn);
    // The rows of what is left over are all across the eigenvector.
    Vec3<T> const x(d.x - root, m.x, m.z), y(m.x, d.y - root, m.y), z(m.z, m.y, d.z - root);
    Vec3<T> best(T(0));
    for (Vec3<T> const& across : {glm::cross(x, y), glm::cross(y, z), glm::cross(z, x)})
        if (glm::dot(across, across) > glm::dot(best, best)) best = across;
    return glm::dot(best, best) > T(1e-8) ? safe_normalize(best).direction : Vec3<T>(T(0));
}

}  // namespace detail

// Least sum of squared distances, each over the square of the point's eye depth, so that the far does not outvote the
// near. Its normal is on the side of the eye. A normal of 0: fewer than three points, or all on one line.
template <class T>
[[nodiscard]] inline ShadowPlane<T> least_squares_plane(ViewVolume<T> const& view, SurfacePoint<T> const* samples,
                                                        int sample_count) noexcept {
    SHADOWMATH_ASSERT(samples != nullptr || sample_count <= 0, "a plane needs its samples");
    Vec3<T> const eye = view.pose.position;
    auto const weighted_sum = [&](auto const& add) {
        T total = T(0);
        for (int i = 0; i < sample_count; ++i) {
            Vec3<T> const p = samples[i].point - eye;
            T const depth = glm::dot(p, view.pose.forward);
            if (!all_finite(samples[i].point) || !(depth > T(0)) || !(depth < T(1e9))) continue;
            T const weight = T(1) / std::fmax(depth * depth, T(1e-12));
            total += weight;
            add(p, weight);
        }
        return total;
    };
    Vec3<T> middle(T(0)), square(T(0)), mixed(T(0));
    T const total = weighted_sum([&](Vec3<T> const& p, T weight) { middle += p * weight; });
    if (!(total > T(0))) return {Vec3<T>(T(0)), T(0)};
    middle /= total;
    weighted_sum([&](Vec3<T> const& p, T weight) {
        Vec3<T> const q = p - middle;
        square += q * q * weight;
        mixed += Vec3<T>(q.x * q.y, q.y * q.z, q.z * q.x) * weight;
    });
    Vec3<T> normal = detail::least_eigenvector(square / total, mixed / total);
    if (glm::dot(normal, middle) > T(0)) normal = -normal;
    return {normal, -glm::dot(normal, middle + eye)};
}

// Across `normal`, with half of the points above it and half below; of more than max_samples points every so many-th is
// looked at. A normal of 0 comes back as it is, and so does one without points, through the origin.
template <class T>
[[nodiscard]] inline ShadowPlane<T> median_plane(Vec3<T> const& normal, SurfacePoint<T> const* samples,
                                                 int sample_count) noexcept {
    SHADOWMATH_ASSERT(samples != nullptr || sample_count <= 0, "a plane needs its samples");
    Vec3<T> const unit = safe_normalize(normal).direction;
    std::array<T, max_samples> height;
    std::size_t count = 0;
    int const stride = (sample_count + max_samples - 1) / max_samples;
    for (int i = 0; i < sample_count; i += stride) {
        if (!all_finite(samples[i].point)) continue;
        T const h = glm::dot(unit, samples[i].point);
        std::size_t at = count++;
        for (; at > 0 && height[at - 1] > h; --at) height[at] = height[at - 1];
        height[at] = h;
    }
    return {unit, count > 0 ? -height[count / 2] : T(0)};
}

// Across `normal`, with half of the weight on either side: one over the square of a point's eye depth, as for
// least_squares_plane. Points behind the eye have none. Otherwise as median_plane.
template <class T>
[[nodiscard]] inline ShadowPlane<T> weighted_median_plane(ViewVolume<T> const& view, Vec3<T> const& normal,
                                                          SurfacePoint<T> const* samples, int sample_count) noexcept {
    SHADOWMATH_ASSERT(samples != nullptr || sample_count <= 0, "a plane needs its samples");
    Vec3<T> const unit = safe_normalize(normal).direction;
    std::array<T, max_samples> height, weight;
    std::size_t count = 0;
    T total = T(0);
    int const stride = (sample_count + max_samples - 1) / max_samples;
    for (int i = 0; i < sample_count; i += stride) {
        T const depth = eye_depth(view, samples[i].point);
        if (!all_finite(samples[i].point) || !(depth > T(0)) || !(depth < T(1e9))) continue;
        T const h = glm::dot(unit, samples[i].point), w = T(1) / std::fmax(depth * depth, T(1e-12));
        std::size_t at = count++;
        for (; at > 0 && height[at - 1] > h; --at) {
            height[at] = height[at - 1];
            weight[at] = weight[at - 1];
        }
        height[at] = h;
        weight[at] = w;
        total += w;
    }
    T below = T(0);
    for (std::size_t i = 0; i < count; ++i) {
        below += weight[i];
        if (below * T(2) >= total) return {unit, -height[i]};
    }
    return {unit, T(0)};
}

// Mean square of ln(major) and ln(minor) over the samples, of a map of as many texels as the picture has pixels, before
// any crop. Points that the plane cannot serve count as footprint_limit. The largest number where nothing is served, or
// the plane is none.
template <class T>
[[nodiscard]] inline T plane_distortion(ShadowPlane<T> const& plane, ViewVolume<T> const& view, Light<T> const& light,
                                        SurfacePoint<T> const* samples, int sample_count) noexcept {
    SHADOWMATH_ASSERT(samples != nullptr || sample_count <= 0, "a plane needs its samples");
    T const worst = std::numeric_limits<T>::max();
    Mat4<T> const eye = clip_from_world(view, ClipSpace{});
    Mat4<T> const slid = plane_projection(plane, homogeneous(light));
    if (slid == Mat4<T>(T(1)) || !all_finite(slid)) return worst;
    Mat4<T> const map = eye * slid;
    T sum = T(0);
    int count = 0, served = 0;
    for (int i = 0; i < sample_count; ++i) {
        Footprint<T> const f = footprint(eye, Vec2<T>(T(1000)), map, T(1000), samples[i].point, samples[i].normal);
        if (!(f.major > T(0))) continue;
        T const along = std::log(f.major), across = std::log(std::fmax(f.minor, T(1) / footprint_limit<T>));
        sum += along * along + across * across;
        served += f.major < footprint_limit<T> ? 1 : 0;
        ++count;
    }
    return served > 0 ? sum / T(count) : worst;
}

// The plane of least distortion among: across `ground_normal` at the two median heights, the least squares, and the
// best one's parallels between the points, to a hundredth of their height. `previous`, if not null, is kept while no
// other has less than 1 - `hysteresis` times its distortion.
template <class T>
[[nodiscard]] inline PlaneChoice<T> choose_plane(ViewVolume<T> const& view, Light<T> const& light,
                                                 SurfacePoint<T> const* samples, int sample_count,
                                                 Vec3<T> const& ground_normal, ShadowPlane<T> const* previous = nullptr,
                                                 T hysteresis = T(0.1)) noexcept {
    PlaneChoice<T> best;
    best.distortion = std::numeric_limits<T>::max();
    if (unusable(light) || faults_of(view).any()) return best;
    auto const consider = [&](ShadowPlane<T> const& plane) {
        T const distortion = plane_distortion(plane, view, light, samples, sample_count);
        if (!(distortion < best.distortion)) return;
        best = {plane, distortion, false, true};
    };
    consider(median_plane(ground_normal, samples, sample_count));
    consider(weighted_median_plane(view, ground_normal, samples, sample_count));
    consider(least_squares_plane(view, samples, sample_count));
    if (best.visible) {
        Vec3<T> const normal = best.plane.normal;
        T lo = std::numeric_limits<T>::max(), hi = std::numeric_limits<T>::lowest();
        for (int i = 0; i < sample_count; ++i) {
            if (!all_finite(samples[i].point)) continue;
            lo = std::fmin(lo, glm::dot(normal, samples[i].point));
            hi = std::fmax(hi, glm::dot(normal, samples[i].point));
        }
        for (int round = 0; round < 3 && lo < hi; ++round) {
            constexpr int steps = 8;
            T const step = (hi - lo) / T(steps);
            for (int i = 0; i <= steps; ++i) consider({normal, -(lo + step * T(i))});
            T const height = -best.plane.offset;
            lo = height - step;
            hi = height + step;
        }
    }
    if (previous == nullptr || !all_finite(previous->normal) || !all_finite(&previous->offset, 1)) return best;
    T const kept = plane_distortion(*previous, view, light, samples, sample_count);
    T const share = all_finite(&hysteresis, 1) ? glm::clamp(T(1) - hysteresis, T(0), T(1)) : T(1);
    if (kept < std::numeric_limits<T>::max() && !(best.visible && best.distortion < kept * share))
        best = {*previous, kept, true, true};
    return best;
}

}  // namespace v0
}  // namespace shadowmath
