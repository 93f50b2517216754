// SPDX-License-Identifier: MIT
//
// A headless OpenGL 4.5 core context, from EGL without a surface or from OSMesa.
//
// Mesa's EGL and its OSMesa keep the current context in one shared place, behind each other's backs. So a context is
// current only while a Current lives, and nothing is current between calls: then both kinds work in one process.
#pragma once

#include <memory>

namespace shadowmath::backend::gl {

class Context {
public:
    using Proc = void (*)();

    Context() = default;
    Context(Context const&) = delete;
    Context& operator=(Context const&) = delete;
    virtual ~Context() = default;

    [[nodiscard]] virtual char const* name() const noexcept = 0;           // "egl", "osmesa"
    [[nodiscard]] virtual Proc proc(char const* name) const noexcept = 0;  // null if the driver has no such function
    virtual void make_current() = 0;
    virtual void release() noexcept = 0;
};

class Current {
public:
    explicit Current(Context& context) : context_(context) { context_.make_current(); }
    Current(Current const&) = delete;
    Current& operator=(Current const&) = delete;
    ~Current() { context_.release(); }

private:
    Context& context_;
};

// Both throw std::runtime_error with one sentence that says what is missing.
[[nodiscard]] std::unique_ptr<Context> make_egl_context();
[[nodiscard]] std::unique_ptr<Context> make_osmesa_context();

}  // namespace shadowmath::backend::gl
