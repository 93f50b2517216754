// SPDX-License-Identifier: MIT
#include "backends/gl/compute.hpp"
#include "backends/gl/session.hpp"

#include <optional>
#include <stdexcept>
#include <utility>

namespace shadowmath::backend {
namespace gl {

Storage Compute::make_storage(std::size_t byte_count) {
    std::vector<std::byte> const zeros(byte_count);
    buffers_.push_back(make_buffer(gl_));
    gl_.NamedBufferData(buffers_.back(), static_cast<GLsizeiptr>(byte_count), zeros.data(), GL_DYNAMIC_COPY);
    return Storage(buffers_.size() - 1);
}

void Compute::write(Storage storage, std::span<std::byte const> bytes) {
    gl_.NamedBufferSubData(buffer(storage), 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

void Compute::read(Storage storage, std::span<std::byte> bytes) const {
    gl_.GetNamedBufferSubData(buffer(storage), 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

Texture2DArray Compute::make_texture(Extent extent, int layers, std::span<float const> texels) {
    Texture texture = gl::make_texture(gl_, GL_TEXTURE_2D_ARRAY);
    gl_.TextureStorage3D(texture, 1, GL_R32F, extent.width, extent.height, layers);
    gl_.TextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_.TextureSubImage3D(texture, 0, 0, 0, 0, extent.width, extent.height, layers, GL_RED, GL_FLOAT, texels.data());
    textures_.push_back(std::move(texture));
    return Texture2DArray(textures_.size() - 1);
}

GLuint Compute::program(shaders::Shader const& shader) {
    auto const known = programs_.find(&shader);
    if (known != programs_.end()) return known->second;
    return programs_.emplace(&shader, make_program(gl_, {{GL_COMPUTE_SHADER, shader}})).first->second;
}

void Compute::run(Dispatch const& pass) {
    gl_.UseProgram(program(*pass.shader));
    Buffer const uniforms = make_buffer(gl_);
    if (!pass.uniforms.empty()) {
        gl_.NamedBufferData(uniforms, static_cast<GLsizeiptr>(pass.uniforms.size()), pass.uniforms.data(),
                            GL_STREAM_DRAW);
        gl_.BindBufferBase(GL_UNIFORM_BUFFER, 0, uniforms);
    }
    GLuint binding = 1;
    for (Storage const storage : pass.storage) gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding++, buffer(storage));
    for (Texture2DArray const texture : pass.textures)
        gl_.BindTextureUnit(binding++, textures_.at(std::size_t(texture)));
    gl_.DispatchCompute(pass.groups.x, pass.groups.y, pass.groups.z);
    gl_.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

}  // namespace gl

namespace {

using namespace gl;

class GlCompute final : public ComputeRunner {
public:
    GlCompute(GlContextKind kind, GlShaders shaders) : session_(kind, shaders), compute_(session_.procs()) {}

    ~GlCompute() override {
        Current const current = session_.current();
        compute_.reset();
    }

    BackendInfo info() const override { return session_.info(session_.procs().SpecializeShader != nullptr); }

    Storage make_storage(std::size_t byte_count) override {
        Current const current = session_.current();
        return compute_->make_storage(byte_count);
    }
    void write(Storage storage, std::span<std::byte const> bytes) override {
        Current const current = session_.current();
        compute_->write(storage, bytes);
    }
    void read(Storage storage, std::span<std::byte> bytes) override {
        Current const current = session_.current();
        compute_->read(storage, bytes);
    }
    Texture2DArray make_texture(Extent extent, int layers, std::span<float const> texels) override {
        Current const current = session_.current();
        return compute_->make_texture(extent, layers, texels);
    }

    double run(std::span<Dispatch const> passes) override {
        Current const current = session_.current();
        return session_.milliseconds_of([&] {
            for (Dispatch const& pass : passes) compute_->run(pass);
        });
    }

    std::vector<std::string> take_messages() override { return session_.take_messages(); }

private:
    Session session_;  // dies last of all that follows
    std::optional<Compute> compute_;
};

}  // namespace

std::unique_ptr<ComputeRunner> make_gl_compute(GlContextKind kind, GlShaders shaders) {
    return std::make_unique<GlCompute>(kind, shaders);
}

}  // namespace shadowmath::backend
