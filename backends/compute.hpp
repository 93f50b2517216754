// SPDX-License-Identifier: MIT
//
// Compute shaders on buffers that stay on the device: upload once, run many passes, read back at the end. It draws
// nothing, and like a backend it knows no technique.
//
// One numbering of bindings for both APIs, all in set 0, so that one SPIR-V serves both:
//
//   0            the uniform block, std140, if the pass has one
//   1 ... n      its storage blocks, std430, in the order of Dispatch::storage
//   n+1 ...      its sampler2DArrays, in the order of Dispatch::textures
//
// OpenGL promises eight storage bindings, of which the first is never used here: n is at most 7.
#pragma once

#include "backends/backend.hpp"
#include "backends/gl/gl_backend.hpp"
#include "backends/shaders/shader.hpp"
#include "backends/vk/vk_backend.hpp"

#include <glm/vec3.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace shadowmath::backend {

// Names of what lies on the device; they live as long as their runner.
enum class Storage : std::uint32_t {};
enum class Texture2DArray : std::uint32_t {};

inline constexpr std::size_t max_storage_blocks = 7;

struct Dispatch {
    shaders::Shader const* shader = nullptr;
    glm::uvec3 groups{1u};
    std::vector<Storage> storage;
    std::vector<Texture2DArray> textures;
    std::span<std::byte const> uniforms{};
};

class ComputeRunner {
public:
    virtual ~ComputeRunner() = default;
    ComputeRunner() = default;
    ComputeRunner(ComputeRunner const&) = delete;
    ComputeRunner& operator=(ComputeRunner const&) = delete;

    [[nodiscard]] virtual BackendInfo info() const = 0;

    [[nodiscard]] virtual Storage make_storage(std::size_t byte_count) = 0;  // of zeros
    virtual void write(Storage storage, std::span<std::byte const> bytes) = 0;
    virtual void read(Storage storage, std::span<std::byte> bytes) = 0;

    // One float a texel, layer by layer and row by row, read without a filter.
    [[nodiscard]] virtual Texture2DArray make_texture(Extent extent, int layers, std::span<float const> texels) = 0;

    // In this order, each seeing all that those before it have written. Milliseconds until the driver has finished.
    virtual double run(std::span<Dispatch const> passes) = 0;

    // As Backend::take_messages.
    [[nodiscard]] virtual std::vector<std::string> take_messages() = 0;
};

// Both throw std::runtime_error with one sentence when the driver or something that it must have is missing.
[[nodiscard]] std::unique_ptr<ComputeRunner> make_gl_compute(GlContextKind kind, GlShaders shaders = GlShaders::spirv);
[[nodiscard]] std::unique_ptr<ComputeRunner> make_vulkan_compute(VulkanOptions const& options = {});

// A vector of plain values as the bytes that the device holds, and back.
template <class Value>
[[nodiscard]] Storage upload(ComputeRunner& runner, std::vector<Value> const& values) {
    Storage const storage = runner.make_storage(values.size() * sizeof(Value));
    runner.write(storage, std::as_bytes(std::span(values)));
    return storage;
}

template <class Value>
[[nodiscard]] std::vector<Value> read_back(ComputeRunner& runner, Storage storage, std::size_t count) {
    std::vector<Value> values(count);
    runner.read(storage, std::as_writable_bytes(std::span(values)));
    return values;
}

}  // namespace shadowmath::backend
