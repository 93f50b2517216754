// SPDX-License-Identifier: MIT
//
// One map's memory for all splits: the maps are those of draw_depth, the picture is that of draw_depth and draw_scene.
#include "backends/null/null_backend.hpp"
#include "backends/view_plan.hpp"
#include "tests/image/cascaded_view.hpp"
#include "tests/image/contexts.hpp"
#include "tests/image/listed_objects.hpp"
#include "tests/image/quad_over_floor.hpp"

#include <algorithm>
#include <iostream>

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

int difference(Rgba8 a, Rgba8 b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

// Something within a pixel differs from it: the split, or what is seen, or whether it is lit.
bool is_edge(Frame const& frame, int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, frame.colour.extent.height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, frame.colour.extent.width - 1); ++u)
            if (frame.position.at(u, v).w != frame.position.at(x, y).w ||
                difference(frame.colour.at(u, v), frame.colour.at(x, y)) > 4)
                return true;
    return false;
}

struct Unlike {
    int pixels = 0, colour = 0, colour_off_edges = 0, map = 0, sky = 0;
};

Unlike unlike(Frame const& a, Frame const& b) {
    Unlike n;
    for (int y = 0; y < a.colour.extent.height; ++y)
        for (int x = 0; x < a.colour.extent.width; ++x) {
            bool const colour = difference(a.colour.at(x, y), b.colour.at(x, y)) > 1;  // 1: the sRGB curve's rounding
            ++n.pixels;
            n.colour += colour;
            n.colour_off_edges += colour && !is_edge(a, x, y);
            n.map += a.position.at(x, y).w != b.position.at(x, y).w;
            n.sky += is_sky(a.position.at(x, y)) != is_sky(b.position.at(x, y));
        }
    return n;
}

TEST_P(SplitBySplit, DrawsTheSamePictureButForEdgePixels) {
    for (char const* const name : {"town", "colonnade"}) {
        auto const named = make_scene(name, SceneSize::small);
        backend->upload(named.scene);
        for (std::size_t i = 0; i < 3; ++i) {
            CascadedView const view(named.scene, named.views[i], {320, 180}, 4, 512);
            backend->draw_depth(view.maps());
            backend->draw_scene(view.pass);
            Frame const whole = backend->read_frame();
            backend->draw_split_by_split(view.maps(), view.pass);
            Unlike const n = unlike(whole, backend->read_frame());
            std::cout << name << ", " << named.views[i].name << ": of " << n.pixels << " pixels " << n.colour
                      << " look unlike, " << n.map << " lie in another split, " << n.sky << " are sky in one only\n";
            // A triangle that a split's end cuts is two triangles: what is interpolated along them rounds otherwise,
            // and decides otherwise where a shadow or an outline begins.
            EXPECT_LE(n.colour, n.pixels / 1000);
            EXPECT_EQ(n.colour_off_edges, 0);
            EXPECT_LE(n.map, n.pixels / 1000);
            EXPECT_LE(n.sky, n.pixels / 10000);
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
    EXPECT_EQ(n.colour_off_edges, 0);
    EXPECT_LE(n.colour, n.pixels / 1000);
    EXPECT_EQ(n.sky, 0);
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

TEST(SplitView, PutsDepthsWhereTheWholeViewHasThem) {
    glm::mat4 const clip_from_world = glm::perspectiveRH_ZO(0.9f, 1.5f, 0.1f, 500.0f) *
                                      glm::lookAtRH(glm::vec3(1, 2, 3), glm::vec3(0, 1, -5), glm::vec3(0, 1, 0));
    FrameConstants frame;
    frame.clip_from_world = clip_from_world;
    frame.eye_position = {1, 2, 3, 1};
    frame.eye_forward = glm::vec4(glm::normalize(glm::vec3(-1, -1, -8)), 0.0f);
    float const z_begin = z_of_depth(frame, 4.0f), z_end = z_of_depth(frame, 30.0f);
    glm::mat4 const cut_view = cut(clip_from_world, z_begin, z_end);
    for (float const metres : {4.0f, 5.0f, 12.0f, 29.0f}) {
        glm::vec4 const point = frame.eye_position + metres * frame.eye_forward + glm::vec4(0.3f, 0.1f, 0.0f, 0.0f);
        glm::dvec4 const whole = glm::dmat4(clip_from_world) * glm::dvec4(point);
        glm::dvec4 const slice = glm::dmat4(cut_view) * glm::dvec4(point);
        double const z = slice.z / slice.w;
        // The cut matrix's row is rounded to float: half an ulp of numbers up to the split's 30 m, times the range.
        EXPECT_NEAR(double(z_begin) + z * (double(z_end) - double(z_begin)), whole.z / whole.w, 1e-7);
        EXPECT_EQ(slice.x, whole.x);
        EXPECT_EQ(slice.y, whole.y);
        EXPECT_EQ(slice.w, whole.w);
    }
    EXPECT_EQ(z_of_depth(frame, 1000.0f), 1.0f);
    EXPECT_EQ(z_of_depth(frame, -1.0f), 1.0f);
    EXPECT_EQ(z_of_depth(frame, INFINITY), 1.0f);
    EXPECT_EQ(z_of_depth(frame, NAN), 1.0f);
    EXPECT_EQ(z_of_depth(frame, 0.05f), 0.0f);
}

TEST(SplitPlan, SlicesLieEndToEndWhateverTheirDepths) {
    QuadOverFloor const world;
    ScenePass pass = world.pass({16, 12}, 32);
    std::array<DepthLayer, max_maps> const layers{};
    pass.frame.map_count = max_maps;
    float const ends[]{5.0f, 7.0f, 6.0f, NAN, 1.0f, INFINITY, 8.0f, -INFINITY};
    for (std::size_t i = 0; i < layers.size(); ++i) pass.frame.maps[i].depth_end = ends[i];
    SplitPlan const plan = plan_split_by_split({32, layers}, pass, world.scene.objects);
    ASSERT_EQ(plan.maps.size(), layers.size());
    ASSERT_EQ(plan.views.size(), layers.size() + 2);
    float z = 0.0f;
    for (std::size_t i = 0; i <= layers.size(); ++i) {
        EXPECT_EQ(plan.views[i].z_begin, z) << i;
        EXPECT_GE(plan.views[i].z_end, z) << i;
        EXPECT_EQ(plan.views[i].draws.empty(), plan.views[i].z_begin == plan.views[i].z_end) << i;
        z = plan.views[i].z_end;
    }
    EXPECT_EQ(z, 1.0f);
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
