// SPDX-License-Identifier: MIT
//
// What the compute passes of the irregular z-buffer read, as it lies in memory (std140): the members of the block in
// backends/shaders/irregular_buffers.glsl. Plain numbers: who dispatches the passes needs no header of this library.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/irregular/grid.hpp>
#include <shadowmath/irregular/microquad.hpp>
#include <shadowmath/irregular/trace.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/shadow_map.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>

namespace shadowmath {
inline namespace v0 {

// Three floats in a row, whatever GLM's settings align a vec3 to.
struct GpuFloat3 {
    float x = 0.0f;
    float y = 0.0f;
    float z = 0.0f;
};

// sm_PixelFrame of glsl/irregular.glsl
struct GpuPixelFrame {
    GpuFloat3 eye;
    std::int32_t width = 0;
    GpuFloat3 across;
    std::int32_t height = 0;
    GpuFloat3 upward;
    std::int32_t orthographic = 0;
    GpuFloat3 inward;
    float origin_x = 0.0f;
    GpuFloat3 to_across;
    float origin_y = 0.0f;
    GpuFloat3 to_upward;
    float turn_limit = 1.0f;
    GpuFloat3 to_inward;
    float unused = 0.0f;
};
static_assert(offsetof(GpuPixelFrame, width) == 12 && offsetof(GpuPixelFrame, orthographic) == 44);
static_assert(offsetof(GpuPixelFrame, to_across) == 64 && offsetof(GpuPixelFrame, turn_limit) == 92);
static_assert(offsetof(GpuPixelFrame, to_inward) == 96 && sizeof(GpuPixelFrame) == 112);

struct GpuIrregular {
    GpuPixelFrame frame;
    GpuFloat3 light_at;
    std::int32_t parallel = 1;
    GpuFloat3 source;  // world: how the light travels, or where it stands
    float unused_light = 0.0f;
    Vec4<float> row[4]{};
    Vec4<float> seen[4]{};
    float texel_error = 0.0f;
    float texel_error_here = 0.0f;
    float depth_error = 0.0f;
    float depth_error_here = 0.0f;
    float ray = 0.0f;
    float reach = 0.0f;
    float contact_metres = 0.0f;
    float contact_share = 0.0f;
    float w_min = 0.0f;
    std::int32_t map_size = 0;
    std::uint32_t triangle_count = 0;  // this and what follows: of whoever dispatches
    std::uint32_t vertex_count = 0;
    std::uint32_t node_capacity = 0;
    std::uint32_t unused[3] = {};
};
static_assert(offsetof(GpuIrregular, light_at) == 112 && offsetof(GpuIrregular, parallel) == 124);
static_assert(offsetof(GpuIrregular, source) == 128);
static_assert(offsetof(GpuIrregular, row) == 144 && offsetof(GpuIrregular, seen) == 208);
static_assert(offsetof(GpuIrregular, texel_error) == 272 && offsetof(GpuIrregular, ray) == 288);
static_assert(offsetof(GpuIrregular, w_min) == 304 && offsetof(GpuIrregular, node_capacity) == 320);
static_assert(sizeof(GpuIrregular) == 336);

// Faults leave `gpu` as it was: those of the frame and the light, bad_projection where the grid is not a map of this
// light, map_too_small for a grid outside [1, largest_grid].
// NOTE: a template for float alone, so that it costs nothing to compile where it is not called.
template <class T>
[[nodiscard]] inline Faults gpu_irregular(PixelFrame<T> const& frame, Light<T> const& light, ShadowMap<T> const& grid,
                                          int map_size, GpuIrregular& gpu) noexcept {
    static_assert(std::numeric_limits<T>::digits == 24, "shaders compute in float");
    IrregularBuffer<T> buffer;
    buffer.frame = frame;
    buffer.map_size = map_size;
    Faults faults = frame.faults | faults_of(light);
    if (map_size < 1 || map_size > largest_grid) faults |= Fault::map_too_small;
    if (faults.any()) return faults;
    if (!detail::take_view(buffer, light, grid)) return Fault::bad_projection;
    GpuIrregular filled;
    auto const three = [](Vec3<T> const& v) { return GpuFloat3{v.x, v.y, v.z}; };
    bool const flat = frame.kind == ViewKind::orthographic;
    filled.frame = {three(frame.eye),       frame.width,
                    three(frame.across),    frame.height,
                    three(frame.upward),    flat ? 1 : 0,
                    three(frame.inward),    frame.origin.x,
                    three(frame.to_across), frame.origin.y,
                    three(frame.to_upward), detail::turn_limit(frame),
                    three(frame.to_inward), 0.0f};
    filled.light_at = three(buffer.light.at);
    filled.parallel = buffer.light.parallel ? 1 : 0;
    filled.source = three(buffer.light.parallel ? light.direction : light.position);
    for (int i = 0; i < 4; ++i) {
        PixelPlane<T> const plane = detail::plane_of_row(frame, buffer.row[i]);
        filled.row[i] = buffer.row[i];
        filled.seen[i] = Vec4<float>(plane.x, plane.y, plane.a, plane.b);
    }
    filled.texel_error = buffer.texel_error;
    filled.texel_error_here = buffer.texel_error_here;
    filled.depth_error = buffer.depth_error;
    filled.depth_error_here = buffer.depth_error_here;
    filled.ray = buffer.contact_ray;
    filled.reach = buffer.contact_reach;
    filled.contact_metres = buffer.contact_reach;
    filled.contact_share = contact_share<T>;
    filled.w_min = grid.w_min > 0.0f ? grid.w_min : 0.0f;
    filled.map_size = map_size;
    gpu = filled;
    return {};
}

}  // namespace v0
}  // namespace shadowmath
