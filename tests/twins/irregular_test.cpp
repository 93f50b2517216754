// SPDX-License-Identifier: MIT
//
// The irregular z-buffer of the drivers beside that of the CPU: the same samples in shadow, whatever the light, the
// scene and the grid.
#include "backends/irregular.hpp"
#include "tests/support/caster_scenes.hpp"
#include "tests/support/g_buffer.hpp"
#include "tests/twins/drivers.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/fit_crop.hpp>
#include <shadowmath/irregular.hpp>
#include <shadowmath/irregular/gpu.hpp>
#include <shadowmath/warp.hpp>

#include <bit>
#include <cstdio>
#include <map>
#include <numeric>

namespace {

using namespace shadowmath;
using namespace shadowmath::test;
using namespace shadowmath::twins;

class IrregularPassesTest : public OnDriver {};
INSTANTIATE_TEST_SUITE_P(Drivers, IrregularPassesTest, testing::Values(Driver::egl, Driver::osmesa, Driver::vulkan),
                         driver_name);

constexpr int width = 320, height = 180, map_size = 256;
constexpr std::size_t pixels = std::size_t(width) * height;
constexpr std::uint32_t triangles = 100'000;

enum class Grid { uniform, warp };

// A picture of a scene, its light and grid, and what the CPU says of it.
struct Case {
    CasterScene scene;
    PixelFrame<float> frame;
    std::vector<float> receivers;
    std::vector<std::uint32_t> indices;
    ShadowMap<float> grid;
    std::vector<std::uint32_t> expected;

    Case(CasterScene made, Grid kind) : scene(std::move(made)) {
        frame = pixel_frame(scene.eye, width, height);
        receivers = g_buffer(scene, width, height);
        indices.resize(3 * std::size_t{scene.triangle_count()});
        std::iota(indices.begin(), indices.end(), 0u);
        Aabb<float> const bounds{glm::vec3(-scene.extent, -scene.height, -scene.extent),
                                 glm::vec3(scene.extent, scene.height, scene.extent)};
        ViewVolume<float> seen = scene.eye;
        seen.z_far = 120.0f;
        if (scene.sun.kind == LightKind::spot) {
            grid = fit_spot(seen, scene.sun, bounds, bounds, map_size, 1.0f, gl_clip);
        } else if (kind == Grid::warp) {
            WarpOptions<float> options;
            options.map_size = map_size;
            grid = simple_perspective_map(seen, scene.sun, bounds, bounds, options, gl_clip);
        } else {
            CascadeOptions<float> options;
            options.fit = CascadeFit::tight;
            options.count = 1;
            options.map_size = map_size;
            grid = fit_cascades(seen, scene.sun, bounds, bounds, options).at[0].map;
        }
        trace_on_cpu();
    }

    void trace_on_cpu() {
        std::vector<float> scalars;
        std::vector<std::uint32_t> words;
        StorageSize const need = storage_for(width, height, map_size, 16 * width * height);
        scalars.resize(need.scalars);
        words.resize(need.words);
        Receivers<float> seen;
        seen.position = receivers.data();
        seen.normal = receivers.data() + 3;
        seen.position_stride = seen.normal_stride = 6;
        auto buffer = list_receivers(frame, seen, scene.sun, grid, map_size,
                                     shadowmath::Storage<float>{scalars.data(), words.data(), need});
        EXPECT_FALSE(buffer.faults.any()) << describe(buffer.faults);
        Casters<float> casters;
        casters.position = scene.positions.data();
        casters.vertex_count = 3 * scene.triangle_count();
        casters.triangle_count = scene.triangle_count();
        trace(buffer, casters);
        expected.resize(pixels);
        write_masks(buffer, expected.data());
    }

    [[nodiscard]] GpuIrregular constants() const {
        GpuIrregular gpu;
        Faults const faults = gpu_irregular(frame, scene.sun, grid, map_size, gpu);
        EXPECT_FALSE(faults.any()) << describe(faults);
        return gpu;
    }

    void give(IrregularPasses& passes) const {
        passes.set_casters(scene.positions, indices);
        passes.set_receivers(receivers);
    }
};

std::uint32_t unlike_samples(std::vector<std::uint32_t> const& a, std::vector<std::uint32_t> const& b) {
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += std::uint32_t(std::popcount(a[i] ^ b[i]));
    return count;
}

struct Shown {
    char const* name;
    CasterScene (*make)();
    Grid grid;
};

CasterScene under_a_lamp() {
    CasterScene scene = boxes_scene(triangles, 16.0f / 9.0f);
    scene.sun = spot<float>({-12.0f, 14.0f, 8.0f}, {0.1f, -1.0f, -0.2f}, 1.0f, 60.0f);
    return scene;
}

constexpr Shown shown[] = {
    {"terrain", [] { return terrain_scene(triangles, 16.0f / 9.0f); }, Grid::uniform},
    {"boxes", [] { return boxes_scene(triangles, 16.0f / 9.0f); }, Grid::warp},
    {"leaves", [] { return leaves_scene(triangles, 16.0f / 9.0f); }, Grid::uniform},
    {"boxes under a lamp", under_a_lamp, Grid::uniform},
};

// For what needs no crowd.
constexpr Shown few_boxes{"few boxes", [] { return boxes_scene(5'000, 16.0f / 9.0f); }, Grid::uniform};

Case const& the_case(Shown const& which) {
    static std::map<std::string, Case> cases;
    auto const known = cases.find(which.name);
    return known != cases.end() ? known->second
                                : cases.emplace(which.name, Case(which.make(), which.grid)).first->second;
}

TEST_P(IrregularPassesTest, AgreeWithTheCpuTo15SamplesInAMillionAndWithEachOtherToTheBit) {
    static std::map<std::string, std::vector<std::uint32_t>> of_first_driver;
    for (Shown const& which : shown) {
        SCOPED_TRACE(which.name);
        Case const& tried = the_case(which);
        IrregularPasses passes(*runner, {width, height, map_size});
        tried.give(passes);
        GpuIrregular const constants = tried.constants();
        IrregularWork const work = passes.trace(std::as_bytes(std::span(&constants, 1)));
        std::vector<std::uint32_t> const masks = passes.masks();
        std::uint32_t const unlike = unlike_samples(masks, tried.expected);
        std::uint64_t dark = 0, mixed = 0;
        for (std::uint32_t const mask : tried.expected) {
            dark += std::uint64_t(std::popcount(mask));
            mixed += mask != 0 && mask != every_sample;
        }
        double const all = 32.0 * double(pixels);
        std::printf("%-9s %-19s %u triangles: %5.2f ppm of samples unlike the CPU's (%.0f %% dark, %.1f %% of pixels "
                    "mixed), %.2f nodes a pixel, %u large, list %.0f ms, trace %.0f ms\n",
                    name_of(GetParam()).c_str(), which.name, tried.scene.triangle_count(), 1e6 * unlike / all,
                    100.0 * double(dark) / all, 100.0 * double(mixed) / double(pixels),
                    double(work.nodes) / double(pixels), work.large_triangles, work.ms_list, work.ms_trace);
        EXPECT_LE(unlike, 15e-6 * all);
        EXPECT_FALSE(work.storage_too_small);
        EXPECT_GT(mixed, pixels / 500);
        auto const first = of_first_driver.try_emplace(which.name, masks).first;
        EXPECT_EQ(unlike_samples(masks, first->second), 0u);
    }
}

TEST_P(IrregularPassesTest, TheOrderOfTrianglesDecidesNothing) {
    Case const& tried = the_case(few_boxes);
    IrregularPasses passes(*runner, {width, height, map_size});
    GpuIrregular const constants = tried.constants();
    tried.give(passes);
    passes.trace(std::as_bytes(std::span(&constants, 1)));
    auto const forward = passes.masks();
    std::vector<std::uint32_t> const reversed(tried.indices.rbegin(), tried.indices.rend());
    passes.set_casters(tried.scene.positions, reversed);
    passes.trace(std::as_bytes(std::span(&constants, 1)));
    EXPECT_EQ(passes.masks(), forward);
}

TEST_P(IrregularPassesTest, StorageTooSmallIsSaidWithTheSizeThatWouldDo) {
    Case const& tried = the_case(few_boxes);
    GpuIrregular const constants = tried.constants();
    auto const run = [&](std::uint32_t capacity, std::vector<std::uint32_t>& masks) {
        IrregularPasses passes(*runner, {width, height, map_size, capacity});
        tried.give(passes);
        IrregularWork const work = passes.trace(std::as_bytes(std::span(&constants, 1)));
        masks = passes.masks();
        return work;
    };
    std::vector<std::uint32_t> whole, masks;
    std::uint32_t const needed = run(0, whole).nodes;
    IrregularWork const small = run(needed - 1, masks);
    EXPECT_TRUE(small.storage_too_small);
    EXPECT_EQ(small.nodes, needed);
    EXPECT_EQ(masks, std::vector<std::uint32_t>(pixels)) << "lit everywhere";
    EXPECT_FALSE(run(needed, masks).storage_too_small);
    EXPECT_EQ(masks, whole);
}

TEST_P(IrregularPassesTest, WithoutCastersOnlyWhatFacesAwayIsDark) {
    Case const& tried = the_case(shown[0]);
    GpuIrregular const constants = tried.constants();
    IrregularPasses passes(*runner, {width, height, map_size});
    passes.set_receivers(tried.receivers);
    passes.trace(std::as_bytes(std::span(&constants, 1)));
    std::size_t dark = 0;
    auto const masks = passes.masks();
    for (std::size_t i = 0; i < pixels; ++i) {
        EXPECT_TRUE(masks[i] == 0 || (masks[i] == every_sample && tried.expected[i] == every_sample));
        dark += masks[i] != 0;
    }
    EXPECT_GT(dark, pixels / 200);
}

}  // namespace
