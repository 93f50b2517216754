// SPDX-License-Identifier: MIT
#include "backends/null/null_backend.hpp"
#include "tests/image/quad_over_floor.hpp"

#include <gtest/gtest.h>

namespace {

using namespace shadowmath::image_test;

TEST(NullBackend, RecordsWhatItIsAsked) {
    NullBackend backend;
    QuadOverFloor const world;
    ScenePass const pass = world.pass({16, 12}, 32);
    Frame const frame = draw_quad_over_floor(backend, world, pass);
    EXPECT_TRUE(backend.take_messages().empty());
    ASSERT_EQ(backend.calls().size(), 4u);
    EXPECT_EQ(std::get<UploadCall>(backend.calls()[0]).object_count, 2u);
    auto const& depth = std::get<DrawDepthCall>(backend.calls()[1]);
    EXPECT_EQ(depth.map_size, 32);
    ASSERT_EQ(depth.layers.size(), 1u);
    EXPECT_EQ(depth.layers[0].clip_from_world, world.clip_from_world_of_sun());
    EXPECT_EQ(depth.layers[0].objects, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(std::get<DrawSceneCall>(backend.calls()[2]).pass.extent.width, 16);
    EXPECT_TRUE(std::holds_alternative<ReadFrameCall>(backend.calls()[3]));
    ASSERT_EQ(frame.colour.pixels.size(), 16u * 12u);
    EXPECT_EQ(frame.position.at(3, 3).w, -2.0f);
    EXPECT_EQ(backend.read_depth(0).pixels, std::vector<float>(32 * 32, 1.0f));
}

TEST(NullBackend, SaysWhatIsWrongWithACall) {
    NullBackend backend;
    QuadOverFloor const world;
    auto const complaint_of = [&](auto const& call) {
        backend.upload(world.scene);
        DepthLayer const layer{glm::mat4(1.0f), {}};
        backend.draw_depth({8, {&layer, 1}, true});
        EXPECT_TRUE(backend.take_messages().empty());
        call();
        auto const messages = backend.take_messages();
        return messages.size() == 1 ? messages[0] : std::string();
    };
    auto const depth_with = [&](auto const& change) {
        std::vector<DepthLayer> layers(1);
        std::vector<std::uint32_t> objects{0};
        DepthPass pass;
        change(pass, layers, objects);
        for (DepthLayer& layer : layers) layer.objects = objects;
        pass.layers = layers;
        return complaint_of([&] { backend.draw_depth(pass); });
    };
    auto const scene_with = [&](auto const& change) {
        ScenePass pass = world.pass({8, 8}, 8);
        change(pass);
        return complaint_of([&] { backend.draw_scene(pass); });
    };
    EXPECT_EQ(depth_with([](auto&, auto&, auto&) {}), "");
    EXPECT_EQ(depth_with([](auto& pass, auto&, auto&) { pass.map_size = 0; }), "depth pass: map_size is 0");
    EXPECT_EQ(depth_with([](auto&, auto& layers, auto&) { layers.clear(); }), "depth pass: 0 layers, not 1 to 8");
    EXPECT_EQ(depth_with([](auto&, auto& layers, auto&) { layers.resize(9); }), "depth pass: 9 layers, not 1 to 8");
    EXPECT_EQ(depth_with([](auto&, auto&, auto& objects) { objects[0] = 2; }),
              "depth pass: layer 0 draws object 2, which is not there");
    EXPECT_EQ(depth_with([](auto&, auto& layers, auto&) { layers[0].clip_from_world[2][1] = NAN; }),
              "depth pass: layer 0 has a matrix that is not finite");
    EXPECT_EQ(scene_with([](auto&) {}), "");
    EXPECT_EQ(scene_with([](auto& pass) { pass.extent.width = 0; }), "scene pass: the extent is empty");
    EXPECT_EQ(scene_with([](auto& pass) { pass.frame.map_count = 2; }), "scene pass: reads 2 maps, but 1 are drawn");
    EXPECT_EQ(scene_with([](auto& pass) { pass.frame.filter_radius = 3; }),
              "scene pass: filter_radius is not 0, 1 or 2");
    EXPECT_EQ(scene_with([](auto& pass) { pass.frame.maps[0].clip_from_world[0][0] = INFINITY; }),
              "scene pass: map 0 has a matrix that is not finite");
    EXPECT_EQ(complaint_of([&] { static_cast<void>(backend.read_depth(1)); }), "read_depth: layer 1 of 1");
    EXPECT_EQ(depth_with([](auto& pass, auto&, auto&) { pass.fitted = true; }),
              "a pass takes fitted maps, but none were fitted");
    EXPECT_EQ(scene_with([](auto& pass) { pass.fitted = true; }), "a pass takes fitted maps, but none were fitted");
    EXPECT_EQ(complaint_of([&] { backend.fit_maps({}); }), "fit: the extent is empty");
    std::vector<ComputeStep> const without_shader(1);
    EXPECT_EQ(complaint_of([&] {
                  backend.fit_maps({{8, 8}, glm::mat4(1.0f), without_shader, {}, 0});
              }),
              "fit: a step has no shader");
    Scene broken = world.scene;
    broken.objects[1].index_count = 300;
    EXPECT_EQ(complaint_of([&] { backend.upload(broken); }),
              "scene 'quad_over_floor': object 1 reaches past the last index");
}

}  // namespace
