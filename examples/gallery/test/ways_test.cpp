// SPDX-License-Identifier: MIT
//
// The table's figures are the passes' own, and a map or picture that is unlike is counted. A backend stands in that
// draws nothing, but takes its time and may err.
#include "examples/gallery/ways.hpp"
#include "backends/null/null_backend.hpp"
#include "scenes/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace shadowmath::gallery {
namespace {

using backend::DrawWay;
using backend::DrawWork;

// The second map of geometry clones has one texel of another depth, and the picture of split by split three pixels of
// another colour. Each pass takes a millisecond less than the one before.
class Erring final : public backend::Backend {
public:
    backend::BackendInfo info() const override { return null_.info(); }
    std::vector<DrawWay> ways() const override { return null_.ways(); }
    void upload(backend::Scene const& scene) override { null_.upload(scene); }
    std::vector<std::string> take_messages() override { return null_.take_messages(); }

    DrawWork draw_depth(backend::DepthPass const& pass) override {
        errs_ = pass.way == DrawWay::geometry_clones;
        return counted(null_.draw_depth(pass));
    }
    DrawWork draw_scene(backend::ScenePass const& pass) override {
        errs_ = false;
        return counted(null_.draw_scene(pass));
    }
    DrawWork draw_split_by_split(backend::DepthPass const& maps, backend::ScenePass const& view) override {
        errs_ = true;
        shown = view.shown.size();
        return counted(null_.draw_split_by_split(maps, view));
    }
    DrawWork fit_maps(backend::FitPass const& pass) override { return null_.fit_maps(pass); }
    backend::Image<float> read_eye_depth() override { return null_.read_eye_depth(); }
    std::vector<backend::MapConstants> read_fit() override { return null_.read_fit(); }
    backend::Image<float> read_depth(int layer) override {
        auto image = null_.read_depth(layer);
        if (errs_ && layer == 1) image.at(2, 3) = 0.75f;
        return image;
    }
    backend::Frame read_frame() override {
        auto frame = null_.read_frame();
        for (int x = 0; errs_ && x < 3; ++x) frame.colour.at(x, 0) = {1, 2, 3};
        return frame;
    }

    std::size_t shown = 0;

private:
    DrawWork counted(DrawWork work) {
        work.milliseconds = milliseconds_ -= 1.0;
        work.driver = backend::DriverCount{};
        work.driver->vertex_runs = work.vertices;
        return work;
    }
    backend::NullBackend null_;
    bool errs_ = false;
    double milliseconds_ = 1000.0;
};

constexpr backend::Extent extent{64, 36};

class Ways : public ::testing::Test {
protected:
    Ways() {
        backend.upload(named.scene);
        records = measure_ways(backend, set, objects_in_splits(set, named.scene, view, extent), extent, 2);
    }

    [[nodiscard]] WayRecord const& of(std::string const& way) const {
        auto const found = std::ranges::find(records, way, &WayRecord::way);
        if (found == records.end()) throw std::runtime_error(way + " was not measured");
        return *found;
    }

    scenes::NamedScene named = scenes::make_scene("town", scenes::SceneSize::small);
    scenes::View const& view = named.views.front();
    MapSet set = fit({"cascades-4-stable", "", "", 16, 4, true}, named.scene, view, extent);
    Erring backend;
    std::vector<WayRecord> records;
};

TEST_F(Ways, AreAllMeasuredAndOnePassAMapComesFirst) {
    EXPECT_EQ(records.size(), backend.ways().size() + 2);
    EXPECT_EQ(records.front().way, name_of(DrawWay::pass_per_map));
    EXPECT_TRUE(backend.take_messages().empty());
    for (WayRecord const& record : records) EXPECT_EQ(record.maps, 4) << record.way;
}

TEST_F(Ways, TellWhatThePassesHandedOver) {
    std::vector<backend::DepthLayer> layers;
    for (Map const& map : set.maps) layers.push_back({glm::mat4(map.clip_from_world), map.casters});
    DrawWork const clones = backend.draw_depth({set.map_size, layers, true, DrawWay::geometry_clones});
    WayRecord const& told = of(name_of(DrawWay::geometry_clones));
    EXPECT_EQ(told.work.passes, 1u);
    EXPECT_EQ(told.work.draw_calls, clones.draw_calls);
    EXPECT_EQ(told.work.vertices, clones.vertices);
    EXPECT_LT(told.work.vertices, records.front().work.vertices);
}

TEST_F(Ways, CountTexelsOfAnotherDepth) {
    WayRecord const& clones = of(name_of(DrawWay::geometry_clones));
    EXPECT_EQ(clones.texels, 4 * 16 * 16);
    EXPECT_EQ(clones.unlike_texels, 1);
    EXPECT_EQ(clones.largest_difference, 0.25);
    EXPECT_EQ(of(name_of(DrawWay::instances)).unlike_texels, 0);
    EXPECT_EQ(records.front().unlike_texels, 0);
}

TEST_F(Ways, CountPixelsOfAnotherColour) {
    EXPECT_EQ(of("split by split").unlike_pixels, 3);
    EXPECT_EQ(of("split by split").pixels, 64 * 36);
    EXPECT_EQ(of("all maps, then the picture").unlike_pixels, 0);
}

TEST_F(Ways, WithThePictureAddThePassesUp) {
    WayRecord const& both = of("all maps, then the picture");
    EXPECT_EQ(both.work.passes, records.front().work.passes + 1);
    EXPECT_EQ(both.work.vertices, records.front().work.vertices + named.scene.indices.size());
    ASSERT_TRUE(both.work.driver);
    EXPECT_EQ(both.work.driver->vertex_runs, both.work.vertices);
}

TEST_F(Ways, SplitBySplitHoldsOneMapAndShowsEachObjectWhereItIs) {
    EXPECT_EQ(of("split by split").maps_in_memory, 1);
    EXPECT_EQ(of("all maps, then the picture").maps_in_memory, 4);
    EXPECT_EQ(backend.shown, 5u);
}

TEST_F(Ways, TellTheFastestRun) {
    // Each pass is faster than the one before it: of two rounds of passes the second counts.
    auto const first_round = double(records.size());
    EXPECT_EQ(records.front().work.milliseconds, 1000.0 - first_round - 1.0);
}

TEST_F(Ways, OfNoMapAreNone) {
    set.maps.clear();
    EXPECT_TRUE(measure_ways(backend, set, {}, extent, 2).empty());
}

TEST_F(Ways, ObjectsShowInEverySplitThatTheirBoxesReachInto) {
    set.maps.resize(1);
    set.frame.maps[0].depth_end = 20.0f;
    glm::vec3 const eye(view.eye), ahead(view.forward);
    auto const object_at = [&](float from, float to) {
        backend::Object object;
        glm::vec3 const a = eye + from * ahead, b = eye + to * ahead;
        object.lo = glm::min(a, b) - 0.01f;
        object.hi = glm::max(a, b) + 0.01f;
        return object;
    };
    backend::Scene scene;
    scene.objects = {object_at(5.0f, 6.0f), object_at(18.0f, 22.0f), object_at(50.0f, 60.0f),
                     object_at(-60.0f, -50.0f)};
    SplitObjects const shown = objects_in_splits(set, scene, view, extent);
    ASSERT_EQ(shown.size(), 2u);
    EXPECT_EQ(shown[0], (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(shown[1], (std::vector<std::uint32_t>{1, 2}));
}

}  // namespace
}  // namespace shadowmath::gallery
