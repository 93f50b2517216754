// SPDX-License-Identifier: MIT
//
// Every way to draw the maps gives the same maps, and draws no triangle into a map that its object is not listed in.
// Which ways there are, and how the driver counts, is known of Mesa's software drivers; on others that part is skipped.
#include "backends/null/null_backend.hpp"
#include "tests/image/cascaded_view.hpp"
#include "tests/image/contexts.hpp"
#include "tests/image/listed_objects.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace {

using namespace shadowmath::image_test;

class AnyWay : public InContext {};
INSTANTIATE_TEST_SUITE_P(Contexts, AnyWay, every_context, context_name);

bool is_mesa_software(Backend const& backend) {
    return backend.info().driver.find("llvmpipe") != std::string::npos;
}

// Two maps of one size.
int texels_unlike(std::vector<float> const& a, std::vector<float> const& b) {
    int unlike = 0;
    for (std::size_t i = 0; i < a.size(); ++i) unlike += a[i] != b[i];
    return unlike;
}

void expect_same_maps(Backend& backend, DepthPass pass, std::vector<DrawWay> const& ways) {
    pass.way = DrawWay::pass_per_map;
    auto const expected = draw_maps(backend, pass);
    for (DrawWay const way : ways) {
        pass.way = way;
        auto const drawn = draw_maps(backend, pass);
        for (std::size_t map = 0; map < drawn.size(); ++map)
            EXPECT_EQ(texels_unlike(drawn[map], expected[map]), 0)
                << name_of(way) << ", map " << map << " of " << drawn.size() << " of " << pass.map_size << " texels, "
                << (pass.depth_clamp ? "clamped" : "clipped");
    }
}

TEST_P(AnyWay, DrawsTheSameMapsTexelByTexel) {
    for (std::size_t const map_count : {1u, 3u, 8u})
        for (bool const depth_clamp : {false, true}) {
            ListedObjects const world(7, map_count);
            backend->upload(world.scene);
            expect_same_maps(*backend, world.pass(DrawWay::pass_per_map, 256, depth_clamp), backend->ways());
        }
}

TEST_P(AnyWay, DrawsTheSameMapsOfAnySizeWhereTheViewportRoundsAlike) {
    std::vector<DrawWay> ways = backend->ways();
    std::erase(ways, DrawWay::geometry_clones);
    ListedObjects const world(9, 5);
    backend->upload(world.scene);
    for (int const map_size : {1, 100, 193}) expect_same_maps(*backend, world.pass({}, map_size), ways);
}

// A viewport of 193 texels rounds a corner by up to half an ulp of 193, 2^-17 texel, and may do so elsewhere than where
// no geometry shader is. Corners are then snapped to 1/256 texel: one in 512 coordinates, one in 85 triangles, may snap
// to another step, and shift its edges and depths by a 256th of a texel's. Few texels show that: one in a thousand.
TEST_P(AnyWay, ClonesOfAnySizeAreTheSameButForRounding) {
    auto const ways = backend->ways();
    if (std::ranges::find(ways, DrawWay::geometry_clones) == ways.end()) GTEST_SKIP() << "NOT TESTED: no clones here";
    ListedObjects const world(9, 5);
    backend->upload(world.scene);
    auto const expected = draw_maps(*backend, world.pass(DrawWay::pass_per_map, 193));
    auto const drawn = draw_maps(*backend, world.pass(DrawWay::geometry_clones, 193));
    int covered = 0, rounded = 0, unlike = 0;
    for (std::size_t map = 0; map < drawn.size(); ++map)
        for (std::size_t i = 0; i < drawn[map].size(); ++i) {
            float const difference = std::fabs(drawn[map][i] - expected[map][i]);
            covered += expected[map][i] < 1.0f;
            rounded += difference > 0.0f;
            unlike += difference > 1e-4f;
        }
    std::cout << rounded << " of " << covered << " texels round otherwise, " << unlike << " by more than 1e-4\n";
    EXPECT_GT(covered, 10000);
    EXPECT_LE(unlike, covered / 1000);
}

TEST_P(AnyWay, DrawsTheSameMapsOfATown) {
    auto const town = shadowmath::scenes::make_scene("town", shadowmath::scenes::SceneSize::small);
    backend->upload(town.scene);
    CascadedView const view(town.scene, town.views[0], {320, 180}, 4, 512);
    expect_same_maps(*backend, view.maps(), backend->ways());
    for (DrawWay const way : backend->ways()) {
        DrawWork const work = backend->draw_depth(view.maps(way));
        std::cout << name_of(way) << ": " << work.passes << " passes, " << work.draw_calls << " draw calls, "
                  << work.vertices << " vertices, " << work.triangles << " triangles, " << work.milliseconds << " ms\n";
    }
}

TEST_P(AnyWay, DrawsAnObjectIntoTheMapsThatItIsListedInAlone) {
    ListedObjects const world(5, 4);
    for (DrawWay const way : backend->ways()) {
        backend->upload(world.scene);
        auto const drawn = draw_maps(*backend, world.pass(way, 64));
        for (std::size_t map = 0; map < drawn.size(); ++map)
            EXPECT_EQ(texels_unlike(drawn[map],
                                    draw_map(*backend, world.objects_of_map(map), 64, true,
                                             all_objects(world.objects_of_map(map)), world.layers[map].clip_from_world)
                                        .pixels),
                      0)
                << name_of(way) << ", map " << map;
    }
}

TEST_P(AnyWay, LeavesMapsClearThatNothingCastsInto) {
    ListedObjects world(5, 4);
    backend->upload(world.scene);
    std::vector<float> const clear(64 * 64, 1.0f);
    for (DrawWay const way : backend->ways()) {
        static_cast<void>(draw_maps(*backend, world.pass(way, 64)));
        auto layers = world.layers;
        for (std::size_t const empty : {0u, 2u}) layers[empty].objects = {};
        auto const drawn = draw_maps(*backend, {64, std::span(layers).first(4), true, way});
        EXPECT_EQ(drawn[0], clear) << name_of(way);
        EXPECT_NE(drawn[1], clear) << name_of(way);
        EXPECT_EQ(drawn[2], clear) << name_of(way);
        EXPECT_NE(drawn[3], clear) << name_of(way);
        for (DepthLayer& layer : layers) layer.objects = {};
        for (auto const& map : draw_maps(*backend, {64, std::span(layers).first(4), true, way}))
            EXPECT_EQ(map, clear) << name_of(way);
    }
}

TEST_P(AnyWay, HandsOverNoTriangleForAMapThatItsObjectIsNotListedIn) {
    ListedObjects const world(3, 5);
    NullBackend null;
    null.upload(world.scene);
    backend->upload(world.scene);
    for (DrawWay const way : backend->ways()) {
        DrawWork const work = backend->draw_depth(world.pass(way));
        bool const each_once = way == DrawWay::geometry_clones;
        EXPECT_EQ(work.triangles, world.triangles_in_maps) << name_of(way);
        if (way == DrawWay::multiview) continue;  // how many views at once is the driver's affair
        EXPECT_EQ(work.vertices, 3 * (each_once ? world.triangles_in_some_map : world.triangles_in_maps));
        EXPECT_EQ(work.passes, way == DrawWay::pass_per_map ? 5u : 1u) << name_of(way);
        EXPECT_EQ(work.draw_calls, null.draw_depth(world.pass(way)).draw_calls) << name_of(way);
    }
}

TEST_P(AnyWay, TheDriverProcessesNoTriangleForAMapThatItsObjectIsNotListedIn) {
    if (!is_mesa_software(*backend)) GTEST_SKIP() << "NOT TESTED: how " << backend->info().driver << " counts";
    ListedObjects const world(3, 5);
    backend->upload(world.scene);
    for (DrawWay const way : backend->ways()) {
        DrawWork const work = backend->draw_depth(world.pass(way));
        ASSERT_TRUE(work.driver) << name_of(way);
        DriverCount const& counted = *work.driver;
        bool const clones = way == DrawWay::geometry_clones;
        EXPECT_EQ(counted.clipper_triangles, world.triangles_in_maps) << name_of(way);
        EXPECT_EQ(counted.vertices, work.vertices) << name_of(way);
        EXPECT_EQ(counted.vertex_runs, work.vertices) << name_of(way) << ": no vertex is shared";
        EXPECT_EQ(counted.triangles, clones ? world.triangles_in_some_map : world.triangles_in_maps) << name_of(way);
        EXPECT_EQ(counted.geometry_runs, clones ? world.triangles_in_some_map : 0u) << name_of(way);
        EXPECT_EQ(counted.geometry_triangles, clones ? world.triangles_in_maps : 0u) << name_of(way);
    }
}

TEST_P(AnyWay, AWayThatTheDriverLacksIsOneSentence) {
    DepthLayer const layer;
    auto const ways = backend->ways();
    for (DrawWay const way : every_way) {
        if (std::ranges::find(ways, way) != ways.end()) continue;
        try {
            backend->draw_depth({8, {&layer, 1}, true, way});
            ADD_FAILURE() << name_of(way);
        } catch (std::runtime_error const& error) {
            EXPECT_EQ(error.what(), std::string("depth pass: this driver cannot draw maps by ") + name_of(way));
        }
    }
}

TEST_P(AnyWay, MesasSoftwareDriversHaveEveryWay) {
    if (!is_mesa_software(*backend)) GTEST_SKIP() << "NOT TESTED: the ways of " << backend->info().driver;
    std::vector<DrawWay> expected(every_way.begin(), every_way.end());
    if (GetParam() != Context::vulkan) std::erase(expected, DrawWay::multiview);
    EXPECT_EQ(backend->ways(), expected);
}

// Mesa 22.3's Vulkan driver draws one view at once (vk_backend.cpp). Chromium brings one that draws six.
TEST(MultiviewDeathTest, DrawsSeveralMapsAtOnceWhereADriverDoes) {
    constexpr char const* driver = "/usr/lib/chromium/vk_swiftshader_icd.json";
    std::unique_ptr<Backend> any;
    if (!try_vulkan(any, {.validation = true})) GTEST_SKIP() << not_tested;
    if (!std::filesystem::exists(driver))
        GTEST_SKIP() << "NOT TESTED: several views at once; the Debian package chromium brings a driver, " << driver;
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    auto const report = [&] {
        setenv("VK_DRIVER_FILES", driver, 1);
        setenv("VK_ICD_FILENAMES", driver, 1);
        auto const backend = make_vulkan_backend({.validation = true});
        ListedObjects const world(7, 8);
        backend->upload(world.scene);
        auto const expected = draw_maps(*backend, world.pass(DrawWay::pass_per_map, 193));
        bool same = draw_maps(*backend, world.pass(DrawWay::multiview, 193)) == expected;
        DrawWork const work = backend->draw_depth(world.pass(DrawWay::multiview, 193));
        same = same && work.triangles == world.triangles_in_maps && work.vertices < 3 * work.triangles;
        for (std::string const& message : backend->take_messages()) std::cerr << message << '\n';
        std::cerr << backend->info().driver << ": " << work.passes << " passes, "
                  << (same ? "the same maps" : "other maps") << '\n';
        std::exit(same ? 3 : 4);
    };
    EXPECT_EXIT(report(), testing::ExitedWithCode(3), "^SwiftShader.* passes, the same maps\n$");
}

}  // namespace
