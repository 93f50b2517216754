// SPDX-License-Identifier: MIT
//
// One map's memory for all splits: the maps are those of draw_depth, the picture is that of draw_depth and draw_scene.
#include "backends/null/null_backend.hpp"
#include "backends/view_plan.hpp"
#include "tests/image/cascaded_view.hpp"
#include "tests/image/contexts.hpp"
#include "tests/image/listed_objects.hpp"
#include "tests/image/quad_over_floor.hpp"

namespace {

using namespace shadowmath::image_test;
using shadowmath::scenes::make_scene;
using shadowmath::scenes::SceneSize;

class SplitBySplit : public InContext {};
INSTANTIATE_TEST_SUITE_P(Contexts, SplitBySplit, every_context, context_name);

TEST_P(SplitBySplit, DrawsTheSameMapsInTurn) {
    auto const town = make_scene("town", SceneSize::small);
    backend->upload(town.scene);
    CascadedView const view(town.scene, town.views[0], {64, 36}, 4, 256);
    auto const expected = draw_maps(*backend, view.maps());
    // The last map stays: so as many splits are drawn as there are maps up to the one that is looked at.
    for (std::size_t splits = 1; splits <= expected.size(); ++splits) {
        DepthPass maps = view.maps();
        maps.layers = maps.layers.first(splits);
        ScenePass pass = view.pass;
        pass.frame.map_count = static_cast<int>(splits);
        backend->draw_split_by_split(maps, pass);
        EXPECT_EQ(backend->read_depth(0).pixels, expected[splits - 1]) << "map " << splits - 1;
        EXPECT_THROW(static_cast<void>(backend->read_depth(1)), std::runtime_error) << "memory for one map";
    }
}

// Bit for bit: colours, what is seen, and which map it reads.
struct Unlike {
    int colour = 0, map = 0, position = 0;
};

Unlike unlike(Frame const& a, Frame const& b) {
    Unlike n;
    for (std::size_t i = 0; i < a.colour.pixels.size(); ++i) {
        Rgba8 const p = a.colour.pixels[i], q = b.colour.pixels[i];
        Texel4 const u = a.position.pixels[i], v = b.position.pixels[i];
        n.colour += p.r != q.r || p.g != q.g || p.b != q.b;
        n.map += u.w != v.w;
        n.position += u.x != v.x || u.y != v.y || u.z != v.z;
    }
    return n;
}

TEST_P(SplitBySplit, DrawsTheSamePicture) {
    for (char const* const name : {"town", "colonnade", "forest"}) {
        auto const named = make_scene(name, SceneSize::small);
        backend->upload(named.scene);
        for (std::size_t i = 0; i < 3; ++i) {
            SCOPED_TRACE(std::string(name) + ", " + named.views[i].name);
            CascadedView const view(named.scene, named.views[i], {320, 180}, 4, 512);
            backend->draw_depth(view.maps());
            backend->draw_scene(view.pass);
            Frame const whole = backend->read_frame();
            backend->draw_split_by_split(view.maps(), view.pass);
            Unlike const n = unlike(whole, backend->read_frame());
            EXPECT_EQ(n.colour, 0);
            EXPECT_EQ(n.map, 0);
            EXPECT_EQ(n.position, 0);
        }
    }
}

// One split, which ends within the floor and the quad. Biased, so that rounding shadows nothing.
ScenePass cut_short(QuadOverFloor const& world) {
    ScenePass pass = world.pass({160, 120}, 256);
    pass.frame.maps[0].depth_end = pass.frame.maps[0].blend_begin = 8.0f;
    pass.frame.maps[0].bias_constant = 1e-4f;
    return pass;
}

TEST_P(SplitBySplit, DrawsTheObjectsShownInEachSplit) {
    QuadOverFloor const world;
    backend->upload(world.scene);
    ScenePass pass = cut_short(world);
    std::array<std::uint32_t, 2> const both{0, 1};
    DepthLayer const layer{pass.frame.maps[0].clip_from_world, both};
    DepthPass const maps{256, {&layer, 1}};
    DrawWork const of_all = backend->draw_split_by_split(maps, pass);
    Frame const all = backend->read_frame();

    std::array<std::span<std::uint32_t const>, 2> const everything{both, both};
    pass.shown = everything;
    EXPECT_EQ(backend->draw_split_by_split(maps, pass).vertices, of_all.vertices);
    Frame const listed = backend->read_frame();
    EXPECT_EQ(unlike(all, listed).colour, 0);

    std::array<std::span<std::uint32_t const>, 2> const floor_ahead{both, std::span(both).first(1)};
    pass.shown = floor_ahead;
    EXPECT_LT(backend->draw_split_by_split(maps, pass).vertices, of_all.vertices);
    Frame const without_quad_beyond = backend->read_frame();
    int quad_beyond = 0;
    for (std::size_t i = 0; i < all.position.pixels.size(); ++i) {
        Texel4 const& before = all.position.pixels[i];
        Texel4 const& after = without_quad_beyond.position.pixels[i];
        bool const of_quad_beyond = !is_sky(before) && !is_floor(before) && before.w == -1.0f;
        quad_beyond += of_quad_beyond;
        EXPECT_EQ(of_quad_beyond, is_sky(before) != is_sky(after) || is_floor(before) != is_floor(after)) << i;
    }
    EXPECT_GT(quad_beyond, 100);
}

TEST_P(SplitBySplit, DrawsObjectsThatReceiveNothingInTheirPlace) {
    QuadOverFloor world;
    world.scene.objects[QuadOverFloor::quad].receives = false;
    ScenePass pass = cut_short(world);
    Frame const whole = draw_quad_over_floor(*backend, world, pass);
    std::array<std::uint32_t, 2> const both{0, 1};
    DepthLayer const layer{pass.frame.maps[0].clip_from_world, both};
    backend->draw_split_by_split({256, {&layer, 1}}, pass);
    Unlike const n = unlike(whole, backend->read_frame());
    EXPECT_EQ(n.colour, 0);
    EXPECT_EQ(n.position, 0);
}

TEST_P(SplitBySplit, HandsOverWhatThePlanSays) {
    auto const town = make_scene("town", SceneSize::small);
    CascadedView const view(town.scene, town.views[0], {64, 36}, 4, 256);
    NullBackend null;
    null.upload(town.scene);
    backend->upload(town.scene);
    DrawWork const planned = null.draw_split_by_split(view.maps(), view.pass);
    DrawWork const work = backend->draw_split_by_split(view.maps(), view.pass);
    EXPECT_TRUE(null.take_messages().empty());
    EXPECT_EQ(work.passes, 8u) << "a map and a part of the picture in each of four splits";
    EXPECT_EQ(work.draw_calls, planned.draw_calls);
    EXPECT_EQ(work.vertices, planned.vertices);
    EXPECT_EQ(work.triangles, planned.triangles);
    EXPECT_EQ(work.driver ? work.driver->vertices : work.vertices, work.vertices);
}

// A point reads the first map that ends beyond it, so one that ends nearer than one before it is read by none.
TEST(SplitPlan, DrawsWhatASplitCanHoldWhateverTheirDepths) {
    QuadOverFloor const world;
    ScenePass pass = world.pass({16, 12}, 32);
    std::array<DepthLayer, max_maps> const layers{};
    pass.frame.map_count = max_maps;
    float const ends[]{5.0f, 7.0f, 6.0f, NAN, 1.0f, INFINITY, 8.0f, -INFINITY};
    bool const holds[]{true, true, false, false, false, true, false, false, false};
    for (std::size_t i = 0; i < layers.size(); ++i) pass.frame.maps[i].depth_end = ends[i];
    SplitPlan const plan = plan_split_by_split({32, layers}, pass, world.scene.objects);
    ASSERT_EQ(plan.maps.size(), layers.size());
    ASSERT_EQ(plan.views.size(), layers.size() + 2);
    for (std::size_t i = 0; i <= layers.size(); ++i) {
        EXPECT_EQ(plan.views[i].frame.split, static_cast<int>(i));
        EXPECT_EQ(plan.views[i].draws.empty(), !holds[i]) << i;
    }
    EXPECT_EQ(plan.views.back().frame.map_count, 0);
}

TEST(SplitPlan, SaysWhatCannotBeDrawnSplitBySplit) {
    QuadOverFloor const world;
    std::array<DepthLayer, 2> const layers{};
    auto const complaint_of = [&](auto const& change) {
        NullBackend backend;
        backend.upload(world.scene);
        ScenePass pass = world.pass({16, 12}, 32);
        pass.frame.map_count = 2;
        change(pass);
        DrawWork const work = backend.draw_split_by_split({32, layers}, pass);
        auto const messages = backend.take_messages();
        EXPECT_EQ(work.passes, messages.empty() ? 4u : 0u);
        return messages.empty() ? std::string() : messages[0];
    };
    std::array<std::uint32_t, 1> const missing{7};
    std::array<std::span<std::uint32_t const>, 3> const shows_missing{missing};
    EXPECT_EQ(complaint_of([](ScenePass&) {}), "");
    EXPECT_EQ(complaint_of([](ScenePass& pass) { pass.frame.map_count = 1; }),
              "split by split: 2 maps are drawn, but 1 are read");
    EXPECT_EQ(complaint_of([](ScenePass& pass) { pass.frame.choice = MapChoice::by_map; }),
              "split by split: the maps are not chosen by depth");
    EXPECT_EQ(complaint_of([&](ScenePass& pass) { pass.shown = std::span(shows_missing).first(2); }),
              "split by split: 2 lists of what is shown, not one a map and one");
    EXPECT_EQ(complaint_of([&](ScenePass& pass) { pass.shown = shows_missing; }),
              "split by split: shows object 7, which is not there");
}

}  // namespace
