// SPDX-License-Identifier: MIT
//
// The theory that the footprint is measured against: perspective aliasing in closed form, for light from straight
// above (at a right angle to the view) and a map fitted to the eye depths [n, f] of a symmetric view.
//
//   along   E(z)  = (1/z) dz/ds      eye depth that a step s of the map covers, over the eye depth
//   across  Ex(z)                    the same beside the view axis, 1 where the view's far end fills the map
//
// times pixels_per_texel these are eye pixels per texel. Source: Wimmer, Scherzer, Purgathofer, EGSR 2004, and Lloyd
// et al., EGSR 2006; derived anew here, since the latter give bounds where these are exact. For tilted light replace
// n and f by n / sin(tilt) and n / sin(tilt) + D, D the length of the body across the light.
//
// Every function is 0 for arguments outside its range: 0 < n < f, z > 0, centre > 0.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {
namespace closed_form {

template <class T>
[[nodiscard]] inline bool is_range(T const& z_near, T const& z_far) noexcept {
    return all_finite(&z_near, 1) && all_finite(&z_far, 1) && z_near > T(0) && z_near < z_far;
}

template <class T>
[[nodiscard]] inline bool is_positive(T const& value) noexcept {
    return all_finite(&value, 1) && value > T(0);
}

// Eye pixels per texel for an error of 1 on a surface at half a right angle to both eye and light.
template <class T>
[[nodiscard]] inline T pixels_per_texel(T eye_pixels, T tan_half_fov, T map_texels) noexcept {
    if (!is_positive(tan_half_fov) || !is_positive(map_texels) || !is_positive(eye_pixels)) return T(0);
    return eye_pixels / (T(2) * tan_half_fov * map_texels);
}

// One map over [n, f], not warped: worst at the near end, f/n - 1.
template <class T>
[[nodiscard]] inline T uniform_along(T z, T z_near, T z_far) noexcept {
    return is_range(z_near, z_far) && is_positive(z) ? (z_far - z_near) / z : T(0);
}

template <class T>
[[nodiscard]] inline T uniform_across(T z, T z_near, T z_far) noexcept {
    return is_range(z_near, z_far) && is_positive(z) ? z_far / z : T(0);
}

// The same error everywhere: the least that any map of [n, f] can have at worst.
template <class T>
[[nodiscard]] inline T logarithmic_along(T z_near, T z_far) noexcept {
    return is_range(z_near, z_far) ? std::log(z_far / z_near) : T(0);
}

// A perspective warp with its centre of projection `centre` metres before the near end.
template <class T>
[[nodiscard]] inline T warped_along(T z, T z_near, T z_far, T centre) noexcept {
    if (!is_range(z_near, z_far) || !is_positive(z) || !is_positive(centre)) return T(0);
    T const length = z_far - z_near, w = z - z_near + centre;
    return length * (w / centre) * (w / (centre + length)) / z;
}

// Sound for centre >= n; nearer, the view's near end would no longer fit into the map.
template <class T>
[[nodiscard]] inline T warped_across(T z, T z_near, T z_far, T centre) noexcept {
    if (!is_range(z_near, z_far) || !is_positive(z) || !is_positive(centre)) return T(0);
    return z_far / z * ((z - z_near + centre) / (centre + z_far - z_near));
}

// The larger of the two ends, between which the error has no maximum.
template <class T>
[[nodiscard]] inline T warped_worst(T z_near, T z_far, T centre) noexcept {
    T const at_near = warped_along(z_near, z_near, z_far, centre);
    T const at_far = warped_along(z_far, z_near, z_far, centre);
    return at_near > at_far ? at_near : at_far;
}

// The centre for which both ends are alike and the worst error is least: n + sqrt(n f).
template <class T>
[[nodiscard]] inline T best_centre(T z_near, T z_far) noexcept {
    return is_range(z_near, z_far) ? z_near + std::sqrt(z_near) * std::sqrt(z_far) : T(0);
}

// Worst error along the view of `count` maps over logarithmic splits.
template <class T>
[[nodiscard]] inline T split_uniform_worst(T z_near, T z_far, int count) noexcept {
    return is_range(z_near, z_far) && count > 0 ? std::expm1(std::log(z_far / z_near) / T(count)) : T(0);
}

template <class T>
[[nodiscard]] inline T split_warped_worst(T z_near, T z_far, int count) noexcept {
    return is_range(z_near, z_far) && count > 0 ? T(2) * std::sinh(std::log(z_far / z_near) / T(2 * count)) : T(0);
}

template <class T>
[[nodiscard]] inline T split_logarithmic_worst(T z_near, T z_far, int count) noexcept {
    return count > 0 ? logarithmic_along(z_near, z_far) / T(count) : T(0);
}

// Eye pixels per texel, as an area, of a view-dependent map as fine as the picture (the map is Kwon's, 2002; the
// formula is derived here): 1 on the plane itself. The four projections are lengths along unit normals; w_point and
// w_plane are the eye depths of the point and of its image on the plane along the light.
template <class T>
[[nodiscard]] inline T plane_map_area(T point_normal_to_eye, T plane_normal_to_eye, T point_normal_to_light,
                                      T plane_normal_to_light, T w_point, T w_plane) noexcept {
    for (T const divisor : {w_point, plane_normal_to_eye, point_normal_to_light})
        if (!(std::abs(divisor) > T(0))) return T(0);
    T const bend = w_plane / w_point;
    T const tilt = (point_normal_to_eye / plane_normal_to_eye) * (plane_normal_to_light / point_normal_to_light);
    T const result = std::abs(tilt * bend * bend * bend);
    return is_positive(result) ? result : T(0);
}

}  // namespace closed_form
}  // namespace v0
}  // namespace shadowmath
