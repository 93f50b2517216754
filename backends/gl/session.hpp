// SPDX-License-Identifier: MIT
//
// A context, its entry points and what its driver complains of: what drawing and computing both stand on.
#pragma once

#include "backends/backend.hpp"
#include "backends/gl/context.hpp"
#include "backends/gl/gl_backend.hpp"
#include "backends/gl/listen.hpp"
#include "backends/gl/procs.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace shadowmath::backend::gl {

// The driver holds the address of `messages`: a session stays where it was made.
class Session {
public:
    Session(GlContextKind kind, GlShaders shaders)
        : context_(kind == GlContextKind::egl ? make_egl_context() : make_osmesa_context()) {
        Current const current(*context_);
        gl_.emplace([this](char const* name) { return context_->proc(name); });
        if (shaders == GlShaders::text) gl_->SpecializeShader = nullptr;
        listen(*gl_, messages_);
    }
    Session(Session const&) = delete;
    Session& operator=(Session const&) = delete;

    // Its entry points may be called while this lives.
    [[nodiscard]] Current current() const { return Current(*context_); }
    [[nodiscard]] Procs const& procs() const { return *gl_; }

    [[nodiscard]] BackendInfo info(bool takes_spirv) const {
        Current const now = current();
        auto const text = [this](GLenum what) {
            return std::string(reinterpret_cast<char const*>(gl_->GetString(what)));
        };
        return {context_->name(), text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION), takes_spirv ? "SPIR-V" : "GLSL"};
    }

    // From an idle driver until it has finished what `work` asks of it; the context is current.
    template <class Do>
    [[nodiscard]] double milliseconds_of(Do const& work) const {
        gl_->Finish();
        auto const begun = std::chrono::steady_clock::now();
        work();
        gl_->Finish();
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
    }

    [[nodiscard]] std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }

private:
    std::vector<std::string> messages_;
    std::unique_ptr<Context> context_;
    std::optional<Procs> gl_;
};

}  // namespace shadowmath::backend::gl
