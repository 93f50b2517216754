// SPDX-License-Identifier: MIT
//
// What each way hands to the driver, written out for a few objects.
#include "backends/draw_plan.hpp"
#include "backends/null/null_backend.hpp"
#include "tests/image/triangles.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace {

using namespace shadowmath::image_test;

// Five objects of 3, 6, 9, 12, 15 indices. Maps 0, 1, 2, 3 list
//   object 0: {0, 1}   object 1: {0, 1}   object 2: {}   object 3: {0, 2, 3}   object 4: {3}
struct FiveObjects {
    Scene scene = triangles(std::vector<glm::vec3>(45));
    std::array<std::vector<std::uint32_t>, 4> listed{{{3, 1, 0}, {0, 1, 1}, {3}, {4, 3}}};
    std::array<DepthLayer, 4> layers;

    FiveObjects() {
        scene.objects = {{0, 3}, {3, 6}, {9, 9}, {18, 12}, {30, 15}};
        for (std::size_t i = 0; i < layers.size(); ++i) layers[i].objects = listed[i];
    }
    FiveObjects(FiveObjects const&) = delete;
    FiveObjects& operator=(FiveObjects const&) = delete;

    [[nodiscard]] DepthPass pass(DrawWay way) const { return {16, layers, true, way}; }
};

struct Said {
    MapSet maps;
    std::vector<std::array<std::uint32_t, 4>> draws;  // first index, index count, first instance, instances

    bool operator==(Said const&) const = default;
};

std::vector<Said> said(std::vector<DrawGroup> const& groups) {
    std::vector<Said> all;
    for (DrawGroup const& group : groups) {
        Said& one = all.emplace_back(Said{group.maps, {}});
        for (Draw const& d : group.draws)
            one.draws.push_back({d.first_index, d.index_count, d.first_instance, d.instance_count});
    }
    return all;
}

TEST(DrawPlan, PassPerMapDrawsNeighboursTogether) {
    FiveObjects const world;
    EXPECT_EQ(said(plan_draws(world.pass(DrawWay::pass_per_map), world.scene.objects)),
              (std::vector<Said>{{0b0001, {{0, 9, 0, 1}, {18, 12, 0, 1}}},
                                 {0b0010, {{0, 9, 0, 1}}},
                                 {0b0100, {{18, 12, 0, 1}}},
                                 {0b1000, {{18, 27, 0, 1}}}}));
}

TEST(DrawPlan, ClonesGetTheirSetOfMapsAsNumber) {
    FiveObjects const world;
    EXPECT_EQ(said(plan_draws(world.pass(DrawWay::geometry_clones), world.scene.objects)),
              (std::vector<Said>{{0b1111, {{0, 9, 0b0011, 1}, {18, 12, 0b1101, 1}, {30, 15, 0b1000, 1}}}}));
}

TEST(DrawPlan, InstancesAreTheMapsOfARun) {
    FiveObjects const world;
    EXPECT_EQ(said(plan_draws(world.pass(DrawWay::instances), world.scene.objects)),
              (std::vector<Said>{{0b1111, {{0, 9, 0, 2}, {18, 12, 0, 1}, {18, 12, 2, 2}, {30, 15, 3, 1}}}}));
}

TEST(DrawPlan, MultiviewDrawsEachSetOfMapsOnce) {
    FiveObjects const world;
    auto const plan = [&](std::uint32_t at_once) {
        return said(plan_draws(world.pass(DrawWay::multiview), world.scene.objects, at_once));
    };
    EXPECT_EQ(plan(8),
              (std::vector<Said>{{0b0011, {{0, 9, 0, 1}}}, {0b1101, {{18, 12, 0, 1}}}, {0b1000, {{30, 15, 0, 1}}}}));
    EXPECT_EQ(plan(3),
              (std::vector<Said>{{0b0011, {{0, 9, 0, 1}}}, {0b0101, {{18, 12, 0, 1}}}, {0b1000, {{18, 27, 0, 1}}}}));
    EXPECT_EQ(plan(1), said(plan_draws(world.pass(DrawWay::pass_per_map), world.scene.objects)));
}

TEST(DrawPlan, CountsEachTriangleOnceAMap) {
    FiveObjects const world;
    NullBackend backend;
    backend.upload(world.scene);
    auto const expect = [&](DrawWay way, std::uint64_t passes, std::uint64_t draw_calls, std::uint64_t vertices) {
        DrawWork const work = backend.draw_depth(world.pass(way));
        EXPECT_EQ(work.passes, passes) << name_of(way);
        EXPECT_EQ(work.draw_calls, draw_calls) << name_of(way);
        EXPECT_EQ(work.vertices, vertices) << name_of(way);
        EXPECT_EQ(work.triangles, 2u * 3u + 3u * 4u + 5u) << name_of(way);
        EXPECT_FALSE(work.driver) << name_of(way);
    };
    expect(DrawWay::pass_per_map, 4, 5, 69);
    expect(DrawWay::geometry_clones, 1, 3, 36);
    expect(DrawWay::instances, 1, 4, 69);
    expect(DrawWay::multiview, 4, 3, 36);
    EXPECT_EQ(backend.take_messages().size(), 0u);
}

TEST(DrawPlan, DrawsNothingOfObjectsWithoutIndices) {
    Scene scene;
    scene.objects = {{0, 0}};
    std::array<std::uint32_t, 1> const it{0};
    DepthLayer const layer{glm::mat4(1.0f), it};
    for (DrawWay const way : every_way)
        for (DrawGroup const& group : plan_draws({4, {&layer, 1}, true, way}, scene.objects))
            EXPECT_TRUE(group.draws.empty()) << name_of(way);
}

}  // namespace
