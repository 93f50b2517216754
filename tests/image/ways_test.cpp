// SPDX-License-Identifier: MIT
//
// Every way to draw the maps gives the same maps, and draws no triangle into a map that its object is not listed in.
// Which ways there are, and how a driver counts, is known of Mesa's software drivers; on others that part is skipped.
#include "tests/image/cascaded_view.hpp"
#include "tests/image/contexts.hpp"
#include "tests/image/triangles.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <bit>
#include <iostream>

namespace {

using namespace shadowmath::image_test;

class AnyWay : public InContext {
protected:
    [[nodiscard]] bool is_software() const {
        return backend->info().driver.find("llvmpipe") != std::string::npos;
    }
};
INSTANTIATE_TEST_SUITE_P(Contexts, AnyWay, every_context, context_name);

// Objects of three triangles all over every map, each listed in a set of maps of its own: none, one, a range, or one
// with holes. An object drawn where it is not listed would be seen.
struct Listed {
    static constexpr int map_size = 256;

    Scene scene;
    std::array<std::vector<std::uint32_t>, max_maps> objects;
    std::array<DepthLayer, max_maps> layers;
    std::uint64_t triangles_in_maps = 0, triangles_in_some_map = 0;

    Listed(std::uint32_t seed, std::size_t map_count) : scene(random_triangles(seed, 300)), map_count_(map_count) {
        std::vector<Object> objects_of_three;
        for (std::uint32_t i = 0; i < 100; ++i) {
            Object object;
            object.first_index = 9 * i;
            object.index_count = 9;
            objects_of_three.push_back(object);
        }
        scene.objects = objects_of_three;
        std::mt19937 random(seed);
        for (std::uint32_t object = 0; object < 100; ++object) {
            auto const maps = static_cast<std::uint32_t>(random() >> 8) & ((1u << map_count) - 1u);
            for (std::size_t map = 0; map < map_count; ++map)
                if ((maps >> map & 1u) != 0u) objects[map].push_back(object);
            triangles_in_maps += 3u * static_cast<std::uint64_t>(std::popcount(maps));
            triangles_in_some_map += maps != 0u ? 3u : 0u;
        }
        for (std::size_t map = 0; map < map_count; ++map) {
            float const angle = 0.4f * float(map);
            layers[map].clip_from_world = glm::perspectiveRH_ZO(1.2f - 0.05f * float(map), 1.0f, 0.3f, 4.0f) *
                                          glm::lookAtRH(glm::vec3(std::sin(angle), 0.9f, 1.6f * std::cos(angle)),
                                                        glm::vec3(0.0f), glm::vec3(0, 1, 0));
            layers[map].objects = objects[map];
        }
    }
    Listed(Listed const&) = delete;  // the layers point into it
    Listed& operator=(Listed const&) = delete;

    [[nodiscard]] DepthPass pass(DrawWay way, bool depth_clamp = true) const {
        return {map_size, {layers.data(), map_count_}, depth_clamp, way};
    }

private:
    std::size_t map_count_;
};

std::vector<std::vector<float>> draw_all(Backend& backend, DepthPass const& pass) {
    backend.draw_depth(pass);
    std::vector<std::vector<float>> maps;
    for (int map = 0; map < int(pass.layers.size()); ++map) maps.push_back(backend.read_depth(map).pixels);
    return maps;
}

TEST_P(AnyWay, EveryWayDrawsTheSameMaps) {
    for (std::size_t const map_count : {1u, 3u, 6u, 8u})
        for (bool const depth_clamp : {false, true}) {
            Listed const listed(7 + std::uint32_t(map_count), map_count);
            backend->upload(listed.scene);
            auto const expected = draw_all(*backend, listed.pass(DrawWay::pass_per_map, depth_clamp));
            for (auto const& map : expected)
                EXPECT_GT(std::ranges::count_if(map, [](float depth) { return depth < 1.0f; }), 10000);
            for (DrawWay const way : backend->ways())
                EXPECT_TRUE(draw_all(*backend, listed.pass(way, depth_clamp)) == expected)
                    << name_of(way) << ", " << map_count << " maps, " << (depth_clamp ? "clamped" : "clipped");
        }
}

TEST_P(AnyWay, NoTriangleIsDrawnIntoAMapThatItsObjectIsNotListedIn) {
    Listed const listed(3, 5);
    backend->upload(listed.scene);
    for (DrawWay const way : backend->ways()) {
        DrawWork const work = backend->draw_depth(listed.pass(way));
        EXPECT_EQ(work.triangles, listed.triangles_in_maps) << name_of(way);
        std::cout << name_of(way) << ": " << work.passes << " passes, " << work.draw_calls << " draw calls, "
                  << work.vertices << " vertices, " << work.triangles << " triangles, " << work.milliseconds << " ms\n";
        if (work.driver)
            std::cout << "  driver: " << work.driver->vertices << " vertices, " << work.driver->triangles
                      << " triangles, " << work.driver->vertex_runs << " VS, " << work.driver->geometry_runs << " GS, "
                      << work.driver->geometry_triangles << " GS out, " << work.driver->clipper_triangles
                      << " clipper, " << work.driver->raster_triangles << " raster\n";
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

TEST_P(AnyWay, SplitBySplit) {
    using namespace shadowmath::scenes;
    auto const named = make_scene("town", SceneSize::small);
    backend->upload(named.scene);
    CascadedView const view(named.scene, named.views[0], {320, 180}, 4, 512);
    auto const maps = draw_all(*backend, view.maps());
    backend->draw_scene(view.pass);
    Frame const whole = backend->read_frame();
    DrawWork const work = backend->draw_split_by_split(view.maps(), view.pass);
    Frame const split = backend->read_frame();
    int unlike = 0, unlike_map = 0, holes = 0;
    for (std::size_t i = 0; i < whole.colour.pixels.size(); ++i) {
        auto const a = whole.colour.pixels[i], b = split.colour.pixels[i];
        unlike += std::abs(a.r - b.r) > 1 || std::abs(a.g - b.g) > 1 || std::abs(a.b - b.b) > 1;
        unlike_map += whole.position.pixels[i].w != split.position.pixels[i].w;
        holes += whole.position.pixels[i].w != -2.0f && split.position.pixels[i].w == -2.0f;
    }
    std::cout << unlike << " unlike, " << unlike_map << " other map, " << holes << " holes; " << work.milliseconds
              << " ms, " << work.draw_calls << "\n";
    for (int i = 0; i < view.pass.frame.map_count; ++i)
        std::cout << "split " << i << " ends at " << view.pass.frame.maps[std::size_t(i)].depth_end << "\n";
    EXPECT_EQ(backend->read_depth(0).pixels, maps.back());
}

}  // namespace
