// SPDX-License-Identifier: MIT
//
// EGL without a window: Mesa's surfaceless platform first, then each device that the driver lists (that is how a
// proprietary driver without a display is reached), then the default display.
#include "backends/gl/context.hpp"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <stdexcept>
#include <vector>

namespace shadowmath::backend::gl {
namespace {

std::vector<EGLDisplay> candidate_displays() {
    std::vector<EGLDisplay> displays{
        eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)};
    auto const query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (query_devices != nullptr &&
        query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_TRUE)
        for (EGLint i = 0; i < count; ++i)
            displays.push_back(
                eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
    displays.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
    return displays;
}

class EglContext final : public Context {
public:
    EglContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}

    // The display is left open: EGL gives every context of this process the same one, and closing it for one
    // closes it for all.
    ~EglContext() override { eglDestroyContext(display_, context_); }

    char const* name() const noexcept override { return "egl"; }
    Proc proc(char const* name) const noexcept override { return eglGetProcAddress(name); }

    void make_current() override {
        eglBindAPI(EGL_OPENGL_API);
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
            throw std::runtime_error("EGL could not make its context current without a surface");
    }
    void release() noexcept override {
        eglBindAPI(EGL_OPENGL_API);  // NOTE: EGL releases the context of the thread's bound API, which may be another
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }

private:
    EGLDisplay display_;
    EGLContext context_;
};

}  // namespace

std::unique_ptr<Context> make_egl_context() {
    // clang-format off
    constexpr std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION, 4,
                                               EGL_CONTEXT_MINOR_VERSION, 5,
                                               EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                               EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE,
                                               EGL_NONE};
    // clang-format on
    for (EGLDisplay const display : candidate_displays()) {
        if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) continue;
        if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) continue;
        EGLContext const context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
        if (context != EGL_NO_CONTEXT) return std::make_unique<EglContext>(display, context);
    }
    throw std::runtime_error("EGL offers no OpenGL 4.5 core context here; "
                             "the Debian packages libegl1 and libgl1-mesa-dri bring a software one");
}

}  // namespace shadowmath::backend::gl
