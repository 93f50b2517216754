// SPDX-License-Identifier: MIT
//
// That gpu.hpp and layout.glsl agree: every driver reads every member where the C++ has put it, as a uniform and as
// storage, and OpenGL, asked for its offsets, names those that gpu.hpp asserts.
#include "tests/twins/drivers.hpp"

#include "backends/gl/context.hpp"
#include "backends/gl/objects.hpp"
#include "twins/embedded.hpp"

#include <shadowmath/gpu.hpp>

#include <array>
#include <cstring>
#include <numeric>

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class Layout : public OnDriver {};
INSTANTIATE_TEST_SUITE_P(Drivers, Layout, every_driver, driver_name);

// The shader gives the members in the order of their declaration, and the layout has no gaps.
TEST_P(Layout, EveryMemberIsReadWhereItWasPut) {
    constexpr std::size_t word_count = sizeof(GpuCascades) / 4;
    std::array<std::uint32_t, word_count> words;
    std::iota(words.begin(), words.end(), 0x3f800000u);  // from 1.0f upward, all different
    GpuCascades block;
    std::memcpy(static_cast<void*>(&block), words.data(), sizeof block);
    auto const bytes = std::as_bytes(std::span(&block, 1));
    Storage const stored = runner->make_storage(sizeof block), seen = runner->make_storage(2 * sizeof block);
    runner->write(stored, bytes);
    Dispatch const pass{&shaders::layout_comp, {1, 1, 1}, {stored, seen}, {}, bytes};
    runner->run({&pass, 1});
    auto const found = read_back<std::uint32_t>(*runner, seen, 2 * word_count);
    for (std::size_t i = 0; i < word_count; ++i) {
        ASSERT_EQ(found[i], words[i]) << "uniform, word " << i;
        ASSERT_EQ(found[word_count + i], words[i]) << "storage, word " << i;
    }
}

struct Member {
    char const* name;
    std::size_t offset;
};

TEST(Layout, OpenGlNamesTheOffsetsThatAreAsserted) {
    auto const context = gl::make_egl_context();
    gl::Current const current(*context);
    gl::Procs gl([&](char const* name) { return context->proc(name); });
    gl.SpecializeShader = nullptr;  // of a compiled program it would not know the names
    auto const index_of =
        reinterpret_cast<decltype(&::glGetProgramResourceIndex)>(context->proc("glGetProgramResourceIndex"));
    auto const value_of =
        reinterpret_cast<decltype(&::glGetProgramResourceiv)>(context->proc("glGetProgramResourceiv"));
    gl::Program const program = gl::make_program(gl, {{GL_COMPUTE_SHADER, shaders::layout_comp}});

    constexpr std::size_t second = sizeof(GpuCascade), bias = offsetof(GpuCascade, bias);
    constexpr std::size_t ranges = offsetof(GpuCascades, ranges);
    Member const members[] = {{".at[0].map.clip_from_world", offsetof(GpuShadowMap, clip_from_world)},
                              {".at[0].map.w_min", offsetof(GpuShadowMap, w_min)},
                              {".at[0].map.depth_order", offsetof(GpuShadowMap, depth_order)},
                              {".at[0].map.flip_v", offsetof(GpuShadowMap, flip_v)},
                              {".at[0].map.visible", offsetof(GpuShadowMap, visible)},
                              {".at[0].bias.constant", bias + offsetof(GpuMapBias, constant)},
                              {".at[0].bias.per_inverse_w", bias + offsetof(GpuMapBias, per_inverse_w)},
                              {".at[0].bias.slope_texels", bias + offsetof(GpuMapBias, slope_texels)},
                              {".at[0].bias.slope_limit", bias + offsetof(GpuMapBias, slope_limit)},
                              {".at[1].map.clip_from_world", second},
                              {".at[15].bias.constant", 15 * second + bias},
                              {".ranges.blend_begin[0]", ranges + offsetof(GpuRanges, blend_begin)},
                              {".ranges.end[0]", ranges + offsetof(GpuRanges, end)},
                              {".count", offsetof(GpuCascades, count)},
                              {".map_size", offsetof(GpuCascades, map_size)},
                              {".filter_radius", offsetof(GpuCascades, filter_radius)},
                              {".tap_plane", offsetof(GpuCascades, tap_plane)}};
    for (auto const& [block, interface_of_block] :
         {std::pair{"cascades", GL_UNIFORM}, std::pair{"stored", GL_BUFFER_VARIABLE}})
        for (Member const& member : members) {
            std::string const name = std::string(block) + member.name;
            GLuint const index = index_of(program, GLenum(interface_of_block), name.c_str());
            ASSERT_NE(index, GL_INVALID_INDEX) << name;
            GLenum const offset = GL_OFFSET;
            GLint found = -1;
            value_of(program, GLenum(interface_of_block), index, 1, &offset, 1, nullptr, &found);
            EXPECT_EQ(found, GLint(member.offset)) << name;
        }
}

}  // namespace
