// SPDX-License-Identifier: MIT
//
// OSMesa: Mesa's software rasteriser as a plain library, with no window system and no device at all.
#include "backends/gl/context.hpp"

#include <stdexcept>

#ifdef SHADOWMATH_HAS_OSMESA

#include <GL/osmesa.h>

#include <array>

namespace shadowmath::backend::gl {
namespace {

class OsMesaContext final : public Context {
public:
    explicit OsMesaContext(OSMesaContext context) : context_(context) {}
    ~OsMesaContext() override { OSMesaDestroyContext(context_); }

    char const* name() const noexcept override { return "osmesa"; }
    Proc proc(char const* name) const noexcept override { return OSMesaGetProcAddress(name); }

    void make_current() override {
        if (OSMesaMakeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) != GL_TRUE)
            throw std::runtime_error("OSMesa could not make its context current");
    }
    void release() noexcept override { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

private:
    OSMesaContext context_;
    std::array<GLubyte, 4> pixel_{};  // OSMesa insists on a default framebuffer; nothing is drawn to it
};

}  // namespace

std::unique_ptr<Context> make_osmesa_context() {
    // clang-format off
    constexpr std::array<int, 11> attributes{OSMESA_FORMAT, OSMESA_RGBA,
                                             OSMESA_DEPTH_BITS, 0,
                                             OSMESA_PROFILE, OSMESA_CORE_PROFILE,
                                             OSMESA_CONTEXT_MAJOR_VERSION, 4,
                                             OSMESA_CONTEXT_MINOR_VERSION, 5,
                                             0};
    // clang-format on
    OSMesaContext const context = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    if (context == nullptr) throw std::runtime_error("OSMesa offers no OpenGL 4.5 core context; libosmesa6 is too old");
    return std::make_unique<OsMesaContext>(context);
}

}  // namespace shadowmath::backend::gl

#else

std::unique_ptr<shadowmath::backend::gl::Context> shadowmath::backend::gl::make_osmesa_context() {
    throw std::runtime_error("built without OSMesa; install the Debian package libosmesa6-dev and configure again");
}

#endif
