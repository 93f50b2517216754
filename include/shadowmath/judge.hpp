// SPDX-License-Identifier: MIT
//
// What a set of cascades is worth, measured: the footprint at points that the eye sees, each in the map that serves it.
// For showing to a user, for tests of a renderer's own maps, and for choose.hpp.
//
// Points come from the renderer (a depth buffer read back, with its normals) or from receivers' bounds alone, where no
// surface is known (samples_in). There each point gets the neutral normal, which leans as far from the eye as from the
// light: the footprint is then perspective aliasing alone, the part that a fit can do something about.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/cascade.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/footprint.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/sampling.hpp>
#include <shadowmath/view_volume.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct SurfacePoint {
    Vec3<T> point{T(0)};   // world
    Vec3<T> normal{T(0)};  // world, of any length
};

inline constexpr int max_samples = 256;

template <class T>
struct Samples {
    std::array<SurfacePoint<T>, max_samples> at;
    int count = 0;
};

// Equally far from the eye and the light in angle; toward the eye where the two are opposite.
template <class T>
[[nodiscard]] inline Vec3<T> neutral_normal(ViewVolume<T> const& view, Light<T> const& light,
                                            Vec3<T> const& point) noexcept {
    bool const flat = view.kind == ViewKind::orthographic;
    Vec3<T> const to_eye = flat ? -view.pose.forward : safe_normalize(view.pose.position - point).direction;
    Normalized<T> const half = safe_normalize(to_eye + toward(light, point));
    return half.length > T(1e-3) ? half.direction : to_eye;
}

// Where a ray of the view is inside a box.
template <class T>
struct DepthSpan {
    T first = T(0);  // eye depth
    T last = T(-1);  // below first: it misses
};

// The ray through (side_x, side_y) of the view's sides, between its near and far ends.
template <class T>
[[nodiscard]] inline DepthSpan<T> depths_in_box(ViewVolume<T> const& view, T side_x, T side_y,
                                                Aabb<T> const& box) noexcept {
    Vec3<T> const start = point_at(view, side_x, side_y, view.z_near);
    Vec3<T> const way = point_at(view, side_x, side_y, view.z_far) - start;
    T first = T(0), last = T(1);  // of the way
    for (int axis = 0; axis < 3; ++axis) {
        T const to_lo = box.lo[axis] - start[axis], to_hi = box.hi[axis] - start[axis];
        if (std::abs(way[axis]) > T(0)) {
            T const a = to_lo / way[axis], b = to_hi / way[axis];
            first = std::fmax(first, std::fmin(a, b));
            last = std::fmin(last, std::fmax(a, b));
        } else if (to_lo > T(0) || to_hi < T(0)) {
            return {};
        }
    }
    T const range = view.z_far - view.z_near;
    return first <= last ? DepthSpan<T>{view.z_near + first * range, view.z_near + last * range} : DepthSpan<T>{};
}

namespace detail {

// Where the ray through the middle of cell `ray`, of `across` by `up` that divide the picture, meets the view's sides.
template <class T>
[[nodiscard]] inline Vec2<T> side_of_ray(ViewVolume<T> const& view, int ray, int across, int up) noexcept {
    T const x = (T(ray % across) + T(0.5)) / T(across), y = (T(ray / across) + T(0.5)) / T(up);
    return {view.left + (view.right - view.left) * x, view.bottom + (view.top - view.bottom) * y};
}

}  // namespace detail

// Points inside the box as the eye sees it: on a grid of eight by eight rays, four on each, evenly over the orders of
// depth from where the ray enters to where it leaves; one where the box is a surface. None of a view with faults, or
// without an end.
template <class T>
[[nodiscard]] inline Samples<T> samples_in(ViewVolume<T> const& view, Light<T> const& light,
                                           Aabb<T> const& receivers) noexcept {
    Samples<T> samples;
    if (faults_of(view).any() || is_positive_infinity(&view.z_far) || unusable(light) || !all_finite(receivers) ||
        is_empty(receivers))
        return samples;
    constexpr int rays = 8, on_each = 4;
    for (int ray = 0; ray < rays * rays; ++ray) {
        Vec2<T> const side = detail::side_of_ray(view, ray, rays, rays);
        DepthSpan<T> const inside = depths_in_box(view, side.x, side.y, receivers);
        if (!(inside.first <= inside.last)) continue;
        T const begin = inside.first, end = inside.last;
        T const floor = std::fmax(begin, end * T(1e-6)), ratio = end / floor;
        int const count = ratio > T(1.001) ? on_each : 1;
        for (int i = 0; i < count; ++i) {
            T const depth = floor * std::pow(ratio, (T(i) + T(0.5)) / T(count));
            Vec3<T> const point = point_at(view, side.x, side.y, depth);
            if (!all_finite(point)) continue;
            samples.at[static_cast<std::size_t>(samples.count++)] = {point, neutral_normal(view, light, point)};
        }
    }
    return samples;
}

template <class T>
struct Worth {
    T worst = T(0);    // eye pixels per texel along the longer axis of the footprint, at the worst point
    T mean = T(0);     // of all points
    T price = T(0);    // the mean of price_of
    int count = 0;     // points
    int unserved = 0;  // of them: no map holds them; they count as footprint_limit
};

template <class T>
struct Judgement {
    Worth<T> all;
    std::array<Worth<T>, max_splits> map;  // of each cascade, over the points at its depths
};

// Each point is judged in the first map whose range holds its depth. Points that the eye does not see (w <= 0) and
// those behind the last range are left out. `eye_pixels`: the size of the picture.
template <class T>
[[nodiscard]] inline Judgement<T> judge(Cascades<T> const& cascades, int map_size, ViewVolume<T> const& view,
                                        Vec2<T> const& eye_pixels, SurfacePoint<T> const* samples,
                                        int sample_count) noexcept {
    SHADOWMATH_ASSERT(samples != nullptr || sample_count <= 0, "judge needs its samples");
    Judgement<T> judgement;
    Mat4<T> const eye = clip_from_world(view, ClipSpace{});
    auto const take = [](Worth<T>& worth, T major) {
        worth.worst = std::fmax(worth.worst, major);
        worth.mean += major;  // sums until the end
        worth.price += price_of(major);
        worth.unserved += major >= footprint_limit<T> ? 1 : 0;
        ++worth.count;
    };
    for (int i = 0; i < sample_count; ++i) {
        SurfacePoint<T> const& sample = samples[i];
        if (!all_finite(sample.point)) continue;
        T const depth = eye_depth(view, sample.point);
        for (int c = 0; c < cascades.count; ++c) {
            Cascade<T> const& cascade = cascades.at[c];
            if (!(depth <= cascade.range.end)) continue;
            T major = footprint_limit<T>;
            // Half a texel for the rounding of points on the map's very side.
            if (contains(cascade.map, map_size, T(-0.5), sample.point)) {
                Footprint<T> const measured =
                    footprint(eye, eye_pixels, cascade.map.clip_from_world, T(map_size), sample.point, sample.normal);
                major = measured.major;
            }
            if (!(major > T(0))) break;
            take(judgement.all, major);
            take(judgement.map[static_cast<std::size_t>(c)], major);
            break;
        }
    }
    auto const close = [](Worth<T>& worth) {
        T const count = T(worth.count > 0 ? worth.count : 1);
        worth.mean /= count;
        worth.price /= count;
    };
    close(judgement.all);
    for (Worth<T>& worth : judgement.map) close(worth);
    return judgement;
}

// Of one map over all the points, whatever their depth.
template <class T>
[[nodiscard]] inline Worth<T> worth_of(ShadowMap<T> const& map, int map_size, ViewVolume<T> const& view,
                                       Vec2<T> const& eye_pixels, SurfacePoint<T> const* samples,
                                       int sample_count) noexcept {
    Cascades<T> alone;
    alone.count = 1;
    alone.at[0].map = map;
    alone.at[0].range.end = std::numeric_limits<T>::max();
    return judge(alone, map_size, view, eye_pixels, samples, sample_count).all;
}

// Whether a map drawn for an earlier view will do for this one: no point has lost its map, and the worst texel is at
// most `factor` times as large as when the map was drawn, or at most `factor` pixels. As long as light and casters are
// what they were its shadows are right in any case; this is about their edges alone.
template <class T>
[[nodiscard]] inline bool still_good(Worth<T> const& drawn, Worth<T> const& now, T factor = T(1.5)) noexcept {
    T const before = drawn.worst > T(1) ? drawn.worst : T(1);
    return now.unserved <= drawn.unserved && now.worst <= before * factor;
}

}  // namespace v0
}  // namespace shadowmath
