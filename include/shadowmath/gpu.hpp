// SPDX-License-Identifier: MIT
//
// What shaders read, as it lies in memory: the structs of glsl/layout.glsl, member by member, and the functions that
// fill them. The layout is the same in std140 and std430, and every offset is asserted here.
//
// In the engine:
//
//   GpuCascades const shadows = gpu_cascades(fit_cascades(view, light, casters, receivers, options), light, options);
//   // Upload it as a uniform block; draw the casters into layer i by shadows.at[i].map.clip_from_world.
//
// In its shader (glslangValidator and shaderc want #extension GL_GOOGLE_include_directive; else paste the files):
//
//   #include "shadowmath/glsl/layout.glsl"
//   #include "shadowmath/glsl/cascades.glsl"
//   layout(std140, binding = 0) uniform Shadows { sm_Cascades shadows; };
//   layout(binding = 1) uniform sampler2DArray depths;
//
//   sm_LookUp look_up = sm_by_depth(shadows.ranges, shadows.count, eye_depth);
//   float lit = sm_cascaded_visibility(depths, look_up, shadows.at[max(look_up.first, 0)],
//                                      shadows.at[max(look_up.second, 0)], shadows.map_size, point, plane_normal,
//                                      shadows.filter_radius, shadows.tap_plane != 0);
//
// A map of any other technique (a warp, a view-dependent map, a spot's) is gpu_map's, and sm_visibility reads it.
#pragma once

#include <shadowmath/bias.hpp>
#include <shadowmath/cascade.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/penumbra.hpp>
#include <shadowmath/shadow_map.hpp>

#include <cstddef>
#include <cstdint>

namespace shadowmath {
inline namespace v0 {

// sm_ShadowMap
struct GpuShadowMap {
    Mat4<float> clip_from_world = nowhere<float>();
    float w_min = 0.0f;
    std::int32_t depth_order = 0;  // DepthOrder
    std::int32_t flip_v = 0;       // 1: texture v counts against NDC y
    std::int32_t visible = 0;
};
static_assert(offsetof(GpuShadowMap, clip_from_world) == 0);
static_assert(offsetof(GpuShadowMap, w_min) == 64);
static_assert(offsetof(GpuShadowMap, depth_order) == 68);
static_assert(offsetof(GpuShadowMap, flip_v) == 72);
static_assert(offsetof(GpuShadowMap, visible) == 76);
static_assert(sizeof(GpuShadowMap) == 80);

// sm_MapBias
using GpuMapBias = MapBias<float>;
static_assert(offsetof(GpuMapBias, constant) == 0);
static_assert(offsetof(GpuMapBias, per_inverse_w) == 4);
static_assert(offsetof(GpuMapBias, slope_texels) == 8);
static_assert(offsetof(GpuMapBias, slope_limit) == 12);
static_assert(sizeof(GpuMapBias) == 16);

// sm_Cascade: any map, and what its receivers are biased by.
struct GpuCascade {
    GpuShadowMap map;
    GpuMapBias bias;
};
static_assert(offsetof(GpuCascade, map) == 0);
static_assert(offsetof(GpuCascade, bias) == 80);
static_assert(sizeof(GpuCascade) == 96);

// sm_MapPenumbra of glsl/penumbra.glsl: what soft shadows need of one map.
struct GpuMapPenumbra {
    Vec4<float> rim_x{0.0f};
    Vec4<float> rim_y{0.0f};
    float depth_of_gap = 1.0f;
    float largest_gap = 0.0f;
    float unused[2] = {};
};
static_assert(offsetof(GpuMapPenumbra, rim_x) == 0);
static_assert(offsetof(GpuMapPenumbra, rim_y) == 16);
static_assert(offsetof(GpuMapPenumbra, depth_of_gap) == 32);
static_assert(offsetof(GpuMapPenumbra, largest_gap) == 36);
static_assert(sizeof(GpuMapPenumbra) == 48);

// sm_Ranges: metres of eye depth.
struct GpuRanges {
    float blend_begin[max_splits] = {};
    float end[max_splits] = {};
};
static_assert(offsetof(GpuRanges, blend_begin) == 0);
static_assert(offsetof(GpuRanges, end) == 64);
static_assert(sizeof(GpuRanges) == 128);

// sm_Cascades
struct GpuCascades {
    GpuCascade at[max_splits];
    GpuRanges ranges;
    std::int32_t count = 0;
    std::int32_t map_size = 0;
    std::int32_t filter_radius = 0;
    std::int32_t tap_plane = 0;
};
static_assert(offsetof(GpuCascades, at) == 0);
static_assert(offsetof(GpuCascades, ranges) == 1536);
static_assert(offsetof(GpuCascades, count) == 1664);
static_assert(offsetof(GpuCascades, map_size) == 1668);
static_assert(offsetof(GpuCascades, filter_radius) == 1672);
static_assert(offsetof(GpuCascades, tap_plane) == 1676);
static_assert(sizeof(GpuCascades) == 1680);

// Finite whatever T is: a map that float cannot hold serves nothing.
template <class T>
[[nodiscard]] inline GpuShadowMap gpu_shadow_map(ShadowMap<T> const& map) noexcept {
    GpuShadowMap gpu;
    Mat4<float> const clip_from_world(map.clip_from_world);
    float const w_min = static_cast<float>(map.w_min);
    if (map.visible && all_finite(clip_from_world) && all_finite(&w_min, 1)) {
        gpu.clip_from_world = clip_from_world;
        gpu.w_min = w_min;
        gpu.visible = 1;
    }
    gpu.depth_order = static_cast<std::int32_t>(map.clip.depth);
    gpu.flip_v = map.clip.ndc_y == map.clip.texture_v ? 0 : 1;
    return gpu;
}

template <class T>
[[nodiscard]] inline GpuCascade gpu_map(ShadowMap<T> const& map, Light<T> const& light, int map_size,
                                        BiasOptions<T> const& options) noexcept {
    MapBias<T> const bias = bias_for(map, light, map_size, options);
    GpuMapBias gpu{static_cast<float>(bias.constant), static_cast<float>(bias.per_inverse_w),
                   static_cast<float>(bias.slope_texels), static_cast<float>(bias.slope_limit)};
    float const numbers[] = {gpu.constant, gpu.per_inverse_w, gpu.slope_texels, gpu.slope_limit};
    return {gpu_shadow_map(map), all_finite(numbers, 4) ? gpu : GpuMapBias{}};
}

// Hard shadows where float cannot hold the numbers.
template <class T>
[[nodiscard]] inline GpuMapPenumbra gpu_penumbra(MapPenumbra<T> const& penumbra) noexcept {
    GpuMapPenumbra gpu;
    gpu.rim_x = Vec4<float>(penumbra.rim_x);
    gpu.rim_y = Vec4<float>(penumbra.rim_y);
    gpu.depth_of_gap = static_cast<float>(penumbra.depth_of_gap);
    gpu.largest_gap = static_cast<float>(penumbra.largest_gap);
    bool const finite = all_finite(gpu.rim_x) && all_finite(gpu.rim_y) && all_finite(&gpu.depth_of_gap, 2);
    return finite && gpu.depth_of_gap > 0.0f ? gpu : GpuMapPenumbra{};
}

// Everything that a receiver shader needs of the cascades. `options` are those that they were fitted with; the filter
// radius of `bias` is taken from there.
template <class T>
[[nodiscard]] inline GpuCascades gpu_cascades(Cascades<T> const& cascades, Light<T> const& light,
                                              CascadeOptions<T> const& options, BiasOptions<T> bias = {}) noexcept {
    GpuCascades gpu;
    Faults told_already;
    bias.filter_radius = detail::kernel_radius(options, told_already);
    gpu.count = cascades.count;
    gpu.map_size = options.map_size;
    gpu.filter_radius = bias.filter_radius;
    gpu.tap_plane = bias.tap_plane ? 1 : 0;
    for (int i = 0; i < cascades.count; ++i) {
        gpu.at[i] = gpu_map(cascades.at[i].map, light, options.map_size, bias);
        gpu.ranges.blend_begin[i] = static_cast<float>(cascades.at[i].range.blend_begin);
        gpu.ranges.end[i] = static_cast<float>(cascades.at[i].range.end);
    }
    return gpu;
}

}  // namespace v0
}  // namespace shadowmath
