// SPDX-License-Identifier: MIT
//
// How fast it could be: the same results, written by hand for one case, with nothing checked, no option read, no slack
// for rounding, and SSE as every x86-64 has it. Not to be used: a bad number poisons them.
#pragma once

#include <shadowmath/view_volume.hpp>

#include <emmintrin.h>

#include <cmath>

namespace bounds {

using shadowmath::ViewVolume;

inline __m128 spread(float value) {
    return _mm_set1_ps(value);
}

inline float root(float value) {
    return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(value)));
}

struct Axes {
    __m128 x, y, z;  // columns: lanes are the light's x, y, depth
};

// Those of light_basis, for light that comes from above.
inline Axes axes(glm::vec3 const& d) {
    float const k = 1.0f / (1.0f - d.y);
    float const cross = d.x * d.z * k;
    return {_mm_setr_ps(1.0f - d.x * d.x * k, cross, d.x, 0.0f), _mm_setr_ps(d.x, -d.z, d.y, 0.0f),
            _mm_setr_ps(-cross, d.z * d.z * k - 1.0f, d.z, 0.0f)};
}

inline __m128 along(Axes const& a, glm::vec3 const& v) {
    return _mm_add_ps(_mm_add_ps(_mm_mul_ps(a.x, spread(v.x)), _mm_mul_ps(a.y, spread(v.y))),
                      _mm_mul_ps(a.z, spread(v.z)));
}

// lambda 1/2.
inline void four_splits(float n, float f, float (&plane)[5]) {
    float const half = root(f / n), quarter = root(half), step = (f - n) * 0.125f, log = 0.5f * n;
    plane[0] = n;
    plane[1] = log * quarter + (log + step);
    plane[2] = log * half + (log + 2.0f * step);
    plane[3] = log * half * quarter + (log + 3.0f * step);
    plane[4] = f;
}

inline void write(Axes const& a, __m128 scale, __m128 offset, glm::mat4& map) {
    _mm_storeu_ps(&map[0].x, _mm_mul_ps(a.x, scale));
    _mm_storeu_ps(&map[1].x, _mm_mul_ps(a.y, scale));
    _mm_storeu_ps(&map[2].x, _mm_mul_ps(a.z, scale));
    _mm_storeu_ps(&map[3].x, offset);
}

// A symmetric or off-centre perspective.
inline void slice_boxes(ViewVolume<float> const& view, glm::vec3 const& light, glm::mat4* maps) {
    float plane[5];
    four_splits(view.z_near, view.z_far, plane);
    Axes const a = axes(light);
    __m128 const eye = along(a, view.pose.position), forward = along(a, view.pose.forward);
    __m128 const right = along(a, view.pose.right), up = along(a, view.pose.up);
    __m128 const x0 = _mm_mul_ps(right, spread(view.left)), x1 = _mm_mul_ps(right, spread(view.right));
    __m128 const y0 = _mm_mul_ps(up, spread(view.bottom)), y1 = _mm_mul_ps(up, spread(view.top));
    __m128 const least = _mm_add_ps(forward, _mm_add_ps(_mm_min_ps(x0, x1), _mm_min_ps(y0, y1)));
    __m128 const largest = _mm_add_ps(forward, _mm_add_ps(_mm_max_ps(x0, x1), _mm_max_ps(y0, y1)));
    __m128 const extent = _mm_setr_ps(2.0f, 2.0f, 1.0f, 0.0f), centre = _mm_setr_ps(0.0f, 0.0f, 0.5f, 1.0f);
    __m128 const one_in_w = _mm_setr_ps(0.0f, 0.0f, 0.0f, 1.0f);
    for (int i = 0; i < 4; ++i) {
        __m128 const n = spread(plane[i]), f = spread(plane[i + 1]);
        __m128 const lo = _mm_add_ps(eye, _mm_min_ps(_mm_mul_ps(n, least), _mm_mul_ps(f, least)));
        __m128 const hi = _mm_add_ps(eye, _mm_max_ps(_mm_mul_ps(n, largest), _mm_mul_ps(f, largest)));
        __m128 const scale = _mm_div_ps(extent, _mm_add_ps(_mm_sub_ps(hi, lo), one_in_w));
        __m128 const middle = _mm_mul_ps(_mm_add_ps(lo, hi), spread(0.5f));
        write(a, scale, _mm_sub_ps(centre, _mm_mul_ps(middle, scale)), maps[i]);
    }
}

inline __m128d along_xy_in_double(Axes const& a, glm::vec3 const& v) {
    __m128d const x = _mm_mul_pd(_mm_cvtps_pd(a.x), _mm_set1_pd(double(v.x)));
    __m128d const y = _mm_mul_pd(_mm_cvtps_pd(a.y), _mm_set1_pd(double(v.y)));
    return _mm_add_pd(_mm_add_pd(x, y), _mm_mul_pd(_mm_cvtps_pd(a.z), _mm_set1_pd(double(v.z))));
}

// A symmetric perspective; the ball of a slice wider than it is deep lies on its far face. Texels are counted in
// double, as they must be: in float, a view a kilometre from the origin would be off by one, and its shadows crawl.
inline void slice_spheres(ViewVolume<float> const& view, glm::vec3 const& light, float map_size, glm::mat4* maps) {
    float plane[5];
    four_splits(view.z_near, view.z_far, plane);
    Axes const a = axes(light);
    __m128 const eye = along(a, view.pose.position), forward = along(a, view.pose.forward);
    __m128d const eye_xy = along_xy_in_double(a, view.pose.position);
    __m128 const x = _mm_mul_ps(along(a, view.pose.right), spread(view.right));
    __m128 const y = _mm_mul_ps(along(a, view.pose.up), spread(view.top));
    __m128 const no_sign = _mm_castsi128_ps(_mm_set1_epi32(0x7fffffff));
    __m128 const side = _mm_add_ps(_mm_and_ps(x, no_sign), _mm_and_ps(y, no_sign));
    __m128 const least = _mm_sub_ps(forward, side), largest = _mm_add_ps(forward, side);
    float const k2 = view.right * view.right + view.top * view.top, k = root(k2);
    float const texels = 1.0f / map_size, per_radius = 2.0f / (map_size - 5.0f);
    __m128 const only_depth = _mm_castsi128_ps(_mm_setr_epi32(0, 0, -1, 0));
    __m128 const half = _mm_setr_ps(0.0f, 0.0f, 0.5f, 1.0f), one_in_w = _mm_setr_ps(0.0f, 0.0f, 0.0f, 1.0f);
    for (int i = 0; i < 4; ++i) {
        float const n = plane[i], f = plane[i + 1];
        float depth = f, radius = f * k;
        if (k2 * (f + n) < f - n) {
            depth = 0.5f * (f + n) * (1.0f + k2);
            radius = root((f - depth) * (f - depth) + k2 * f * f);
        }
        float const texel = radius * per_radius, per_texel = 1.0f / texel;
        __m128d const ahead = _mm_cvtps_pd(_mm_mul_ps(forward, spread(depth)));
        __m128d const centre = _mm_mul_pd(_mm_add_pd(eye_xy, ahead), _mm_set1_pd(double(per_texel)));
        __m128 const window = _mm_cvtepi32_ps(_mm_cvtpd_epi32(centre));
        __m128 const lo = _mm_add_ps(eye, _mm_min_ps(_mm_mul_ps(spread(n), least), _mm_mul_ps(spread(f), least)));
        __m128 const hi = _mm_add_ps(eye, _mm_max_ps(_mm_mul_ps(spread(n), largest), _mm_mul_ps(spread(f), largest)));
        __m128 const deep = _mm_div_ps(spread(1.0f), _mm_add_ps(_mm_sub_ps(hi, lo), one_in_w));
        __m128 const wide = spread(2.0f * texels * per_texel);
        __m128 const scale = _mm_or_ps(_mm_and_ps(only_depth, deep), _mm_andnot_ps(only_depth, wide));
        __m128 const middle = _mm_mul_ps(_mm_add_ps(lo, hi), _mm_mul_ps(spread(0.5f), deep));
        __m128 const moved = _mm_mul_ps(window, spread(2.0f * texels));
        __m128 const offset = _mm_or_ps(_mm_and_ps(only_depth, middle), _mm_andnot_ps(only_depth, moved));
        write(a, scale, _mm_sub_ps(half, _mm_mul_ps(offset, _mm_setr_ps(1.0f, 1.0f, 1.0f, 0.0f))), maps[i]);
    }
}

}  // namespace bounds
