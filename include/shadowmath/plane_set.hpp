// SPDX-License-Identifier: MIT
//
// Several shadow planes for one view: floor and wall, street and roofs. Each becomes a view-dependent map of its own
// (view_dependent_map), in this order; behind them stands a map that serves what none of them does, cascades or one
// uniform map. by_footprint chooses between them point by point.
//
// The dominant plane is the one on which most of what is seen gets good texels. Candidates are the tangent planes of
// the samples: a compromise between floor and wall serves neither, and least squares finds nothing else. What the plane
// serves well is then taken out, and the next one is chosen for the rest, as long as that is worth a map.
//
// Source: the thesis (Kwon 2002) names several planes as future work; Chong and Gortler 2004 draw floor and wall by two
// maps. The choice is derived here. For one plane of least distortion over all that is seen see plane_choice.hpp.
#pragma once

#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/footprint.hpp>
#include <shadowmath/judge.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/plane_choice.hpp>
#include <shadowmath/vdsm.hpp>
#include <shadowmath/view_volume.hpp>

#include <array>
#include <cmath>

namespace shadowmath {
inline namespace v0 {

inline constexpr int max_planes = 4;

template <class T>
struct PlaneSet {
    std::array<ShadowPlane<T>, max_planes> at;
    std::array<T, max_planes> share{};  // of the samples that each serves well and none before it does
    int count = 0;                      // 0: no plane is worth a map; use cascades
};

template <class T>
struct PlaneSetOptions {
    int most = 2;             // planes, 1 to max_planes
    T good_pixels = T(2);     // a texel's longer axis up to which a sample counts as well served, of a map with as many
                              // texels as the picture has pixels; > 1
    T least_share = T(0.15);  // of the samples that a plane must serve to be worth a map, (0, 1]
    T hysteresis = T(0.1);    // planes of the last frame stay until another serves so much more
};

namespace detail {

// How many of the samples a map on this plane serves well; `left`, if not null, gets those that it does not.
template <class T>
[[nodiscard]] inline int well_served(ShadowPlane<T> const& plane, Mat4<T> const& eye, Light<T> const& light,
                                     Samples<T> const& samples, T good_pixels, Samples<T>* left = nullptr) noexcept {
    Mat4<T> const slid = plane_projection(plane, homogeneous(light));
    bool const usable = slid != Mat4<T>(T(1)) && all_finite(slid);
    Mat4<T> const map = eye * slid;
    int served = 0;
    for (int i = 0; i < samples.count; ++i) {
        SurfacePoint<T> const& sample = samples.at[static_cast<std::size_t>(i)];
        T const major =
            usable ? footprint(eye, Vec2<T>(T(1000)), map, T(1000), sample.point, sample.normal).major : T(0);
        if (major > T(0) && major <= good_pixels)
            ++served;
        else if (left != nullptr)
            left->at[static_cast<std::size_t>(left->count++)] = sample;
    }
    return served;
}

}  // namespace detail

// Each plane serves more of what the ones before it leave over than any sample's tangent plane does, or is one of the
// last frame's within the hysteresis. Samples that nobody sees or that the light does not reach take no part; of more
// than max_samples every so-many-th is looked at. After at most most * (max_samples + max_planes) looks at all samples;
// for now and then, not for every frame of a small budget.
template <class T>
[[nodiscard]] inline PlaneSet<T> choose_planes(ViewVolume<T> const& view, Light<T> const& light,
                                               SurfacePoint<T> const* samples, int sample_count,
                                               PlaneSetOptions<T> const& options = {},
                                               PlaneSet<T> const* previous = nullptr) noexcept {
    SHADOWMATH_ASSERT(samples != nullptr || sample_count <= 0, "a plane needs its samples");
    PlaneSet<T> planes;
    bool const sound = all_finite(&options.good_pixels, 1) && all_finite(&options.least_share, 1) &&
                       all_finite(&options.hysteresis, 1);
    if (!sound || unusable(light) || faults_of(view).any() || sample_count <= 0) return planes;
    Mat4<T> const eye = clip_from_world(view, ClipSpace{});
    Samples<T> rest;
    int const stride = (sample_count + max_samples - 1) / max_samples;
    for (int i = 0; i < sample_count; i += stride) {
        SurfacePoint<T> const& sample = samples[i];
        bool const seen = all_finite(sample.normal) && projected(eye, sample.point).in_front;
        if (seen && !faces_away(light, sample.point, sample.normal))
            rest.at[static_cast<std::size_t>(rest.count++)] = sample;
    }
    T const all = T(rest.count);
    int const most = options.most < max_planes ? options.most : max_planes;
    // A plane of the last frame that is a little behind stays; of two such the first.
    T const kept_for = T(1) + glm::clamp(options.hysteresis, T(0), T(1));
    while (planes.count < most && rest.count > 0) {
        ShadowPlane<T> best{Vec3<T>(T(0)), T(0)};
        int most_served = 0;
        for (int i = 0; i < rest.count; ++i) {
            SurfacePoint<T> const& sample = rest.at[static_cast<std::size_t>(i)];
            ShadowPlane<T> const tangent = plane_through(sample.point, sample.normal);
            int const served = detail::well_served(tangent, eye, light, rest, options.good_pixels);
            if (served <= most_served) continue;
            most_served = served;
            best = tangent;
        }
        for (int i = 0; previous != nullptr && i < previous->count && i < max_planes; ++i) {
            ShadowPlane<T> const& last = previous->at[static_cast<std::size_t>(i)];
            int const served = detail::well_served(last, eye, light, rest, options.good_pixels);
            if (served == 0 || T(most_served) > T(served) * kept_for) continue;
            most_served = served;
            best = last;
            break;
        }
        if (most_served == 0 || T(most_served) < options.least_share * all) break;
        Samples<T> left;
        std::size_t const place = static_cast<std::size_t>(planes.count++);
        planes.at[place] = best;
        planes.share[place] = T(detail::well_served(best, eye, light, rest, options.good_pixels, &left)) / all;
        rest = left;
    }
    return planes;
}

}  // namespace v0
}  // namespace shadowmath
