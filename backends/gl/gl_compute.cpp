// SPDX-License-Identifier: MIT
#include "backends/gl/compute.hpp"
#include "backends/gl/context.hpp"
#include "backends/gl/listen.hpp"

#include <chrono>
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
    GlCompute(std::unique_ptr<Context> context, GlShaders shaders) : context_(std::move(context)) {
        Current const current(*context_);
        gl_.emplace([this](char const* name) { return context_->proc(name); });
        if (shaders == GlShaders::text) gl_->SpecializeShader = nullptr;
        listen(*gl_, messages_);
        compute_.emplace(*gl_);
    }

    ~GlCompute() override {
        context_->make_current();
        compute_.reset();
        context_->release();
    }

    BackendInfo info() const override {
        Current const current(*context_);
        auto const text = [this](GLenum what) {
            return std::string(reinterpret_cast<char const*>(gl_->GetString(what)));
        };
        return {context_->name(), text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION),
                gl_->SpecializeShader != nullptr ? "SPIR-V" : "GLSL"};
    }

    Storage make_storage(std::size_t byte_count) override {
        Current const current(*context_);
        return compute_->make_storage(byte_count);
    }
    void write(Storage storage, std::span<std::byte const> bytes) override {
        Current const current(*context_);
        compute_->write(storage, bytes);
    }
    void read(Storage storage, std::span<std::byte> bytes) override {
        Current const current(*context_);
        compute_->read(storage, bytes);
    }
    Texture2DArray make_texture(Extent extent, int layers, std::span<float const> texels) override {
        Current const current(*context_);
        return compute_->make_texture(extent, layers, texels);
    }

    double run(std::span<Dispatch const> passes) override {
        Current const current(*context_);
        gl_->Finish();
        auto const begun = std::chrono::steady_clock::now();
        for (Dispatch const& pass : passes) compute_->run(pass);
        gl_->Finish();
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
    }

    std::vector<std::string> take_messages() override { return std::exchange(messages_, {}); }

private:
    std::vector<std::string> messages_;
    std::unique_ptr<Context> context_;
    std::optional<Procs> gl_;
    std::optional<Compute> compute_;
};

}  // namespace

std::unique_ptr<ComputeRunner> make_gl_compute(GlContextKind kind, GlShaders shaders) {
    return std::make_unique<GlCompute>(kind == GlContextKind::egl ? make_egl_context() : make_osmesa_context(),
                                       shaders);
}

}  // namespace shadowmath::backend
