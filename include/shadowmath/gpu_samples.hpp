// SPDX-License-Identifier: MIT
//
// What the compute shaders of a sample-distribution fit are given, laid out as std140 and std430 have it, and what
// their state looks like: the mirror of glsl/sample_layout.glsl. Nothing of it comes back: the shaders write the maps'
// matrices to a buffer, and the passes that draw and read the maps take them from there.
//
//   GpuSampleFit const fit = gpu_sample_fit(camera, camera_clip, light, width, height, casters, splits, options);
//   upload as the uniform block; run sdsm_begin, sdsm_depths, sdsm_splits, sdsm_bounds, sdsm_maps.
#pragma once

#include <shadowmath/bias.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/sample_bounds.hpp>
#include <shadowmath/sample_depths.hpp>
#include <shadowmath/sdsm.hpp>
#include <shadowmath/stored_depth.hpp>
#include <shadowmath/view_volume.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace shadowmath {
inline namespace v0 {

struct GpuSampleFit {
    Vec4<float> basis_x{0.0f};      // w: z_near, metres of eye depth
    Vec4<float> basis_y{0.0f};      // w: z_far
    Vec4<float> basis_depth{0.0f};  // w: least ratio of a split
    // 1 / basis_depth, 0 where light_entry skips the axis; w: fraction of splits that blends
    Vec4<float> inverse_along{0.0f};
    Vec4<float> eye{0.0f};         // in light space; w: texels along a side of the map
    Vec4<float> forward{0.0f};     // of the eye, in light space; w: margin as a share of the body's extent
    Vec4<float> right{0.0f};       // w: 1 / (usable texels - 1), for still maps
    Vec4<float> up{0.0f};          // w: what the depth buffer is cleared to
    Vec4<float> first_step{0.0f};  // sides at the centre of pixel (0, 0), and from pixel to pixel
    Vec4<float> casters_lo{0.0f};  // world
    Vec4<float> casters_hi{0.0f};
    Vec4<float> depth_code{0.0f};  // numerator's scale and offset, denominator's scale and offset
    Vec4<float> bias{0.0f};        // of BiasOptions: flat_texels, texels, steepest, depth_step
    Mat4<float> clip_from_canonical{1.0f};
    std::int32_t width = 0;  // pixels
    std::int32_t height = 0;
    std::int32_t count = 0;     // splits; 0 where there is nothing to fit
    std::int32_t adaptive = 0;  // 1: SampleSplits::adaptive
    std::int32_t orthographic = 0;
    std::int32_t still = 0;
    std::int32_t pancake = 0;
    std::int32_t unused = 0;
};
static_assert(offsetof(GpuSampleFit, clip_from_canonical) == 208 && offsetof(GpuSampleFit, width) == 272 &&
                  offsetof(GpuSampleFit, orthographic) == 288 && sizeof(GpuSampleFit) == 304,
              "glsl/sample_layout.glsl");

// The shaders' own: bins and boxes as bits that order as the numbers do. For tests, and to size the buffer.
struct GpuSampleState {
    std::uint32_t bin_lo[depth_bins];
    std::uint32_t bin_hi[depth_bins];
    std::uint32_t counted;
    std::uint32_t outside;
    std::uint32_t not_finite;
    std::int32_t count;                   // splits
    Vec4<float> range[max_splits];        // metres of eye depth: begin, blend_begin, end
    std::uint32_t box_lo[max_splits][4];  // light space relative to the eye
    std::uint32_t box_hi[max_splits][4];
};
static_assert(offsetof(GpuSampleState, range) == 4112 && offsetof(GpuSampleState, box_lo) == 4368 &&
                  sizeof(GpuSampleState) == 4880,
              "glsl/sample_layout.glsl");

template <class T>
struct SampleSplitOptions {
    int count = 4;
    SampleSplits kind = SampleSplits::adaptive;
    T least_ratio = T(1.05);
    T blend = T(0);
};

// The maps that the shaders make of these are those of sample_splits and fit_samples at T = float, fed with the same
// samples, to the last bit (as long as no compiler contracts a product and a sum: -ffp-contract=off, `precise`).
//
// `camera` and `camera_clip` are what the depth buffer was drawn with; samples from shadow_distance on get no shadow
// (0: camera.z_far). Inputs with faults give count = 0, and the shaders make no map.
// NOTE: a template for float alone, so that it costs nothing to compile where it is not called.
template <class T>
[[nodiscard]] inline GpuSampleFit gpu_sample_fit(ViewVolume<T> const& camera, ClipSpace camera_clip, T shadow_distance,
                                                 Light<T> const& light, int width, int height, Aabb<T> const& casters,
                                                 SampleSplitOptions<T> const& splits,
                                                 SampleFitOptions<T> const& options,
                                                 BiasOptions<T> const& bias = {}) noexcept {
    static_assert(std::numeric_limits<T>::digits == 24, "shaders compute in float");
    GpuSampleFit fit;
    bool const cut = all_finite(&shadow_distance, 1) && shadow_distance > 0.0f;
    T const z_far = cut && shadow_distance < camera.z_far ? shadow_distance : camera.z_far;
    SampleRays<T> const rays = sample_rays(camera, light, width, height);
    DepthCode<T> const code = depth_code(camera, camera_clip);
    Faults const faults = faults_of_margin(options.map_size, options.margin_texels);
    bool const usable = rays.usable && !no_depths(camera.z_near, z_far).faults.any() && all_finite(casters) &&
                        !is_empty(casters) && !faults.has(Fault::not_finite) && !faults.has(Fault::map_too_small);
    if (!usable) return fit;

    T const size = static_cast<T>(options.map_size);
    T const usable_size = usable_texels(options.map_size, options.margin_texels);
    constexpr T eps = std::numeric_limits<T>::epsilon();
    Vec4<float> inverse_along(0.0f);
    for (int k = 0; k < 3; ++k)
        if (std::abs(rays.basis.depth[k]) > detail::least_along<T>) inverse_along[k] = 1.0f / rays.basis.depth[k];
    inverse_along.w = splits.blend > 0.0f ? (splits.blend < 1.0f ? splits.blend : 1.0f) : 0.0f;
    fit.basis_x = Vec4<float>(rays.basis.x, camera.z_near);
    fit.basis_y = Vec4<float>(rays.basis.y, z_far);
    fit.basis_depth = Vec4<float>(rays.basis.depth, detail::usable_ratio(splits.least_ratio));
    fit.inverse_along = inverse_along;
    fit.eye = Vec4<float>(rays.eye, size);
    fit.forward = Vec4<float>(rays.forward, options.still ? 0.0f : 0.5f * (size - usable_size) / usable_size);
    fit.right = Vec4<float>(rays.right, 1.0f / (usable_size - 1.0f) * (1.0f + 4.0f * eps));
    fit.up = Vec4<float>(rays.up, code.sky);
    fit.first_step = Vec4<float>(rays.first.x, rays.first.y, rays.step.x, rays.step.y);
    Vec3<T> const farthest(detail::farthest_metres<T>);
    Aabb<T> const reached = intersect(casters, Aabb<T>{-farthest, farthest});
    fit.casters_lo = Vec4<float>(reached.lo, 0.0f);
    fit.casters_hi = Vec4<float>(reached.hi, 0.0f);
    fit.depth_code = Vec4<float>(code.num_scale, code.num_offset, code.den_scale, code.den_offset);
    fit.bias = Vec4<float>(detail::option(bias.flat_texels, 0.0f), detail::option(bias.texels, 0.0f),
                           detail::option(bias.steepest, 20.0f), detail::option(bias.depth_step, 0.0f));
    fit.clip_from_canonical = clip_from_canonical<T>(options.clip);
    fit.width = width;
    fit.height = height;
    fit.count = splits.count < 0 ? 0 : (splits.count > max_splits ? max_splits : splits.count);
    fit.adaptive = splits.kind == SampleSplits::adaptive ? 1 : 0;
    fit.orthographic = rays.kind == ViewKind::orthographic ? 1 : 0;
    fit.still = options.still ? 1 : 0;
    fit.pancake = options.pancake ? 1 : 0;
    return fit;
}

}  // namespace v0
}  // namespace shadowmath
