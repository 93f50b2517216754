// SPDX-License-Identifier: MIT
//
// Compute passes within an OpenGL context that is current: what the runner of backends/compute.hpp is made of, and what
// a backend that also draws can hold beside its own objects. It must die while the context is current.
#pragma once

#include "backends/compute.hpp"
#include "backends/gl/objects.hpp"

#include <map>
#include <vector>

namespace shadowmath::backend::gl {

class Compute {
public:
    explicit Compute(Procs const& gl) : gl_(gl) {}

    [[nodiscard]] Storage make_storage(std::size_t byte_count);
    void write(Storage storage, std::span<std::byte const> bytes);
    void read(Storage storage, std::span<std::byte> bytes) const;
    [[nodiscard]] Texture2DArray make_texture(Extent extent, int layers, std::span<float const> texels);
    void run(Dispatch const& pass);

    [[nodiscard]] GLuint buffer(Storage storage) const { return buffers_.at(std::size_t(storage)); }

private:
    [[nodiscard]] GLuint program(shaders::Shader const& shader);

    Procs const& gl_;
    std::vector<Buffer> buffers_;
    std::vector<Texture> textures_;
    std::map<shaders::Shader const*, Program> programs_;
};

}  // namespace shadowmath::backend::gl
