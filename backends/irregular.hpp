// SPDX-License-Identifier: MIT
//
// The irregular z-buffer on a device: a G-buffer and triangles in, one word of 32 samples a pixel out. Four compute
// passes (clear, list, trace, trace what is large) on any driver with double precision and atomics in buffers. No
// fragment stage, so neither interlock nor conservative rasterisation. OpenGL and Vulkan run the same SPIR-V.
//
// Memory on the device: a pixel takes 24 bytes of G-buffer, 16 of quad, 4 of mask and 8 a node, of which four will do;
// a texel of the grid 4.6; a triangle 16 and its vertices.
#pragma once

#include "backends/compute.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace shadowmath::backend {

struct IrregularSize {
    int width = 0;
    int height = 0;
    int map_size = 0;                 // texels along the grid's side
    std::uint32_t node_capacity = 0;  // 0: four a pixel, which is always enough
};

struct IrregularWork {
    double ms_list = 0.0;  // clearing included
    double ms_trace = 0.0;
    std::uint32_t nodes = 0;            // that the lists have, or would need
    std::uint32_t large_triangles = 0;  // traced by a group each
    bool storage_too_small = false;     // nodes exceed the capacity: nothing was traced, nothing written past the end
};

class IrregularPasses {
public:
    // The runner must outlive it.
    IrregularPasses(ComputeRunner& runner, IrregularSize const& size);

    // Three floats a vertex in world space; three indices a triangle.
    void set_casters(std::span<float const> vertices, std::span<std::uint32_t const> indices);

    // Three floats of world position and three of the surface's normal a pixel, row by row; sky has no normal.
    void set_receivers(std::span<float const> receivers);

    // `constants` is the block of shaders/irregular_buffers.glsl; its counts of triangles, vertices and nodes are
    // filled in here.
    IrregularWork trace(std::span<std::byte const> constants);

    // Of the last trace. Bit i: sample i is dark. All lit where the storage was too small.
    [[nodiscard]] std::vector<std::uint32_t> masks();

private:
    [[nodiscard]] Dispatch pass(shaders::Shader const& shader, std::size_t invocations) const;

    ComputeRunner& runner_;
    IrregularSize size_;
    std::size_t pixel_count_ = 0;
    std::size_t word_count_ = 0;
    std::uint32_t triangle_count_ = 0;
    std::uint32_t vertex_count_ = 0;
    Storage receivers_{}, quads_{}, masks_{}, grid_{}, nodes_{}, vertices_{}, triangles_{};
    std::vector<std::byte> constants_;
    IrregularWork last_;
};

}  // namespace shadowmath::backend
