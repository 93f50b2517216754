// SPDX-License-Identifier: MIT
//
// What a backend that draws promises of contexts, depth maps and errors. Of the frame: receiver_test.cpp.
#include "tests/image/contexts.hpp"
#include "tests/image/quad_over_floor.hpp"
#include "tests/image/triangles.hpp"

#include <cstdlib>
#include <iostream>
#include <limits>

namespace {

using namespace shadowmath::image_test;

constexpr float epsilon = std::numeric_limits<float>::epsilon();

class AnyBackend : public InContext {};
INSTANTIATE_TEST_SUITE_P(Contexts, AnyBackend, every_context, context_name);

TEST_P(AnyBackend, KnowsItsName) {
    EXPECT_EQ(backend->info().name, name_of(GetParam()));
    EXPECT_NE(backend->info().driver.find(GetParam() == Context::vulkan ? "Vulkan" : "OpenGL"), std::string::npos);
}

TEST_P(AnyBackend, DrawsATrianglesDepthWhereItsCornersSay) {
    constexpr int size = 64;
    Image<float> const map = draw_map(
        *backend, triangles({{-0.5f, -0.5f, 0.25f}, {0.53f, -0.5f, 0.25f}, {-0.5f, 0.5f, 0.75f}}), size, false, {0});
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
            double const x = (column + 0.5) * 2.0 / size - 1.0;
            double const y = (row + 0.5) * 2.0 / size - 1.0;
            bool const covered = x > -0.5 && y > -0.5 && (x + 0.5) / 1.03 + (y + 0.5) < 1.0;
            // A plane equation in float: a handful of roundings of values below 1. A rasteriser may also snap corners
            // to 1/256 texel, which moves depth by the slope (0.5 / 32 a texel) times as much.
            double const expected = covered ? 0.25 + 0.5 * (y + 0.5) : 1.0;
            double const tolerance = covered ? 8.0 * double(epsilon) + 0.5 / 32.0 / 256.0 : 0.0;
            ASSERT_NEAR(double(map.at(column, row)), expected, tolerance) << column << ", " << row;
        }
}

TEST_P(AnyBackend, PancakesWhatLiesInFrontOfTheMapOnlyWhenClamped) {
    Scene const in_front = triangles({{-1, -1, -3}, {3, -1, -3}, {-1, 3, -3}});
    EXPECT_EQ(draw_map(*backend, in_front, 8, true, {0}).pixels, std::vector<float>(64, 0.0f));
    EXPECT_EQ(draw_map(*backend, in_front, 8, false, {0}).pixels, std::vector<float>(64, 1.0f));
}

TEST_P(AnyBackend, DrawsTheListedObjectsOnly) {
    Scene const scene = triangles({{-1, -1, 0.2f},
                                   {3, -1, 0.2f},
                                   {-1, 3, 0.2f},  //
                                   {-1, -1, 0.4f},
                                   {3, -1, 0.4f},
                                   {-1, 3, 0.4f},  //
                                   {-1, -1, 0.6f},
                                   {3, -1, 0.6f},
                                   {-1, 3, 0.6f}});
    EXPECT_EQ(draw_map(*backend, scene, 4, true, {}).at(1, 1), 1.0f);
    EXPECT_FLOAT_EQ(draw_map(*backend, scene, 4, true, {0, 1, 2}).at(1, 1), 0.2f);
    EXPECT_FLOAT_EQ(draw_map(*backend, scene, 4, true, {1, 2}).at(1, 1), 0.4f);
    EXPECT_FLOAT_EQ(draw_map(*backend, scene, 4, true, {2, 1}).at(1, 1), 0.4f);
    EXPECT_FLOAT_EQ(draw_map(*backend, scene, 4, true, {0, 2}).at(1, 1), 0.2f);
    EXPECT_FLOAT_EQ(draw_map(*backend, scene, 4, true, {2}).at(1, 1), 0.6f);
}

TEST_P(AnyBackend, KeepsEachLayerApart) {
    backend->upload(
        triangles({{-1, -1, 0.2f}, {3, -1, 0.2f}, {-1, 3, 0.2f}, {-1, -1, 0.4f}, {3, -1, 0.4f}, {-1, 3, 0.4f}}));
    std::array<std::uint32_t, 2> const objects{0, 1};
    std::array<DepthLayer, max_maps> layers;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        layers[i].clip_from_world[3][2] = 0.0625f * float(i);
        layers[i].objects = std::span(objects).subspan(i % 2, 1);
    }
    backend->draw_depth({16, layers, true});
    for (int i = 0; i < max_maps; ++i)
        EXPECT_FLOAT_EQ(backend->read_depth(i).at(8, 8), (i % 2 == 0 ? 0.2f : 0.4f) + 0.0625f * float(i)) << i;
    EXPECT_THROW(static_cast<void>(backend->read_depth(max_maps)), std::runtime_error);
}

TEST_P(AnyBackend, DrawsTheSameTwiceAndAfterOtherSizes) {
    QuadOverFloor const world;
    auto const colours = [&](Extent extent, int map_size) {
        Frame const frame = draw_quad_over_floor(*backend, world, world.pass(extent, map_size));
        std::vector<std::uint32_t> packed;
        for (Rgba8 const& c : frame.colour.pixels)
            packed.push_back(std::uint32_t{c.r} << 16u | std::uint32_t{c.g} << 8u | c.b);
        return packed;
    };
    auto const first = colours({160, 120}, 256);
    EXPECT_EQ(colours({160, 120}, 256), first);
    EXPECT_NE(colours({33, 77}, 100), first);
    EXPECT_EQ(colours({160, 120}, 256), first);
}

TEST_P(AnyBackend, TellsWhatTheDriverRefusesAndGoesOn) {
    DepthLayer const layer;
    EXPECT_THROW(backend->draw_depth({1 << 20, {&layer, 1}, true}), std::runtime_error);
    // Vulkan is asked beforehand what it can hold, and has no error to tell.
    EXPECT_EQ(backend->take_messages().empty(), GetParam() == Context::vulkan) << "the driver's error was not heard";
    EXPECT_TRUE(backend->take_messages().empty()) << "messages are told once";
    EXPECT_EQ(draw_map(*backend, Scene{}, 4, true, {}).pixels, std::vector<float>(16, 1.0f));
}

TEST_P(AnyBackend, RejectsPassesThatCannotBeDrawn) {
    DepthLayer layer;
    std::array<std::uint32_t, 1> const missing{7};
    EXPECT_THROW(backend->draw_depth({64, {}, true}), std::runtime_error);
    EXPECT_THROW(backend->draw_depth({0, {&layer, 1}, true}), std::runtime_error);
    layer.objects = missing;
    EXPECT_THROW(backend->draw_depth({64, {&layer, 1}, true}), std::runtime_error);
    ScenePass pass{{8, 8}, {}};
    pass.frame.map_count = 2;
    EXPECT_THROW(backend->draw_scene(pass), std::runtime_error);
    std::array<DepthLayer, 2> const two;
    backend->draw_depth({64, two, true});
    EXPECT_NO_THROW(backend->draw_scene(pass));
    backend->draw_depth({64, {two.data(), 1}, true});
    EXPECT_THROW(backend->draw_scene(pass), std::runtime_error) << "reads a layer of an older pass";
    Scene scene = triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    scene.indices[1] = 9;
    EXPECT_THROW(backend->upload(scene), std::runtime_error);
}

TEST(GlContexts, TwoKindsTakeTurnsInOneProcessAndDrawTheSameBits) {
    auto const egl = make_gl_backend(GlContextKind::egl);
    auto const osmesa = make_gl_backend(GlContextKind::osmesa);
    Scene const scene = random_triangles(7, 200);
    std::vector<std::uint32_t> const all = all_objects(scene);

    auto const in_egl = draw_map(*egl, scene, 256, true, all).pixels;
    auto const in_osmesa = draw_map(*osmesa, scene, 256, true, all).pixels;
    EXPECT_EQ(draw_map(*egl, scene, 256, true, all).pixels, in_egl);
    EXPECT_TRUE(egl->take_messages().empty());
    EXPECT_TRUE(osmesa->take_messages().empty());
    if (egl->info().driver != osmesa->info().driver) GTEST_SKIP() << "EGL drives " << egl->info().driver;
    EXPECT_EQ(in_egl, in_osmesa);
}

TEST(GlContexts, OneOfAKindOutlivesAnother) {
    for (GlContextKind const kind : {GlContextKind::egl, GlContextKind::osmesa}) {
        auto survivor = make_gl_backend(kind);
        make_gl_backend(kind).reset();
        EXPECT_EQ(draw_map(*survivor, Scene{}, 4, true, {}).pixels, std::vector<float>(16, 1.0f));
        EXPECT_TRUE(survivor->take_messages().empty());
    }
}

TEST(GlContextsDeathTest, AMissingDriverIsOneSentence) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    auto const report = [] {
        setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json", 1);
        try {
            auto const backend = make_gl_backend(GlContextKind::egl);
        } catch (std::runtime_error const& error) {
            std::cerr << error.what() << '\n';
            std::exit(3);
        }
    };
    EXPECT_EXIT(report(), testing::ExitedWithCode(3), "no OpenGL 4.5 core context.*libegl1");
}

}  // namespace
