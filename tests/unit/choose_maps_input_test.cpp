// SPDX-License-Identifier: MIT
#include "tests/laws/choose_maps.hpp"
#include "tests/support/street.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/choose_maps.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <vector>

using namespace shadowmath;
using test::Street;
using test::street_view;
using test::V2;
using test::V3;

namespace {

Light<double> const& morning = test::street_morning;
Aabb<double> const& town = test::street_town;

}  // namespace

TEST(ChooseMaps, OfNothingIsNothingAndNoFault) {
    Street street;
    MapSearch<double> static work;
    MapLimits<double> const limits;
    auto const is_nothing = [](ChosenMaps<double> const& chosen) { return chosen.count == 0 && !chosen.faults.any(); };
    EXPECT_TRUE(is_nothing(choose_maps(street.view, morning, Aabb<double>{}, street.samples.data(),
                                       int(street.samples.size()), street.tiles(), limits, work)))
        << "no casters";
    EXPECT_TRUE(is_nothing(choose_maps(street.view, morning, town, street.samples.data(), int(street.samples.size()),
                                       DepthTiles<double>{}, limits, work)))
        << "no tiles";
    EXPECT_TRUE(is_nothing(choose_maps(street.view, morning, town, street.boxes.data(), 0, limits, work)))
        << "no boxes";
    EXPECT_TRUE(
        is_nothing(choose_maps(street.view, morning, town, street.samples.data(), int(street.samples.size()),
                               DepthTiles<double>{street.nearest.data(), street.farthest.data(), 4, 0}, limits, work)))
        << "no row of tiles";
    MapLimits<double> countless;
    countless.eye_pixels = V2(std::numeric_limits<double>::max());
    EXPECT_TRUE(is_nothing(street.chosen(countless))) << "more pixels than can be counted for a metre";
    EXPECT_TRUE(is_nothing(street.chosen_from_boxes(countless))) << "the same";
    street.nearest.assign(street.nearest.size(), 1.0);
    street.farthest.assign(street.farthest.size(), 0.5);
    EXPECT_TRUE(is_nothing(street.chosen())) << "nothing is seen";
}

TEST(ChooseMaps, EveryBadInputHasItsFaultAndHarmlessMaps) {
    struct Row {
        char const* what;
        Fault fault;
        bool visible;
        ViewVolume<double> view;
        Light<double> light;
        MapLimits<double> limits;
    };
    ViewVolume<double> const view = street_view();
    std::vector<Row> rows;
    auto const row = [&](char const* what, Fault fault, bool visible, auto const& spoil) {
        Row bad{what, fault, visible, view, morning, {}};
        spoil(bad);
        rows.push_back(bad);
    };
    row("a pose with NaN", Fault::not_finite, false, [](Row& r) { r.view.pose.position.x = test::nan_; });
    row("a range turned over", Fault::empty_range, false, [](Row& r) { r.view.z_far = 0.01; });
    row("sides crossed", Fault::bad_frustum, false, [](Row& r) { r.view.left = 2.0; });
    row("axes askew", Fault::bad_pose, false, [](Row& r) { r.view.pose.up = r.view.pose.right; });
    row("no light", Fault::zero_light, false, [](Row& r) { r.light = directional(V3(0)); });
    row("a light of NaN", Fault::not_finite, false, [](Row& r) { r.light = directional(V3(test::nan_)); });
    row("a spot", Fault::clamped_option, false, [](Row& r) { r.light = spot(V3(0, 9, 0), V3(0, -1, 0), 0.5, 30.0); });
    row("no pixels", Fault::clamped_option, false, [](Row& r) { r.limits.eye_pixels = V2(0, 9); });
    row("no rows of pixels", Fault::clamped_option, false, [](Row& r) { r.limits.eye_pixels = V2(9, 0); });
    row("pixels of NaN", Fault::clamped_option, false, [](Row& r) { r.limits.eye_pixels = V2(test::nan_, 9); });
    row("a map of four texels", Fault::map_too_small, false, [](Row& r) { r.limits.map_size = 4; });
    row("a margin of NaN", Fault::not_finite, false, [](Row& r) { r.limits.margin_texels = test::nan_; });
    row("no maps", Fault::count_clamped, true, [](Row& r) { r.limits.maps = 0; });
    row("nine maps", Fault::count_clamped, true, [](Row& r) { r.limits.maps = 9; });
    row("an infinite far", Fault::far_clamped, true, [](Row& r) { r.view.z_far = test::inf; });
    row("a light year away", Fault::precision_lost, false, [](Row& r) { r.view.pose.position = V3(1e16); });
    for (Row const& bad : rows) {
        Street street;
        street.view = bad.view;
        for (auto const& chosen :
             {street.chosen(bad.limits, bad.light), street.chosen_from_boxes(bad.limits, bad.light)}) {
            EXPECT_TRUE(chosen.faults.has(bad.fault)) << bad.what;
            EXPECT_EQ(chosen.count > 0, bad.visible) << bad.what;
            for (auto const& made : chosen) EXPECT_TRUE(laws::harmless(made.map)) << bad.what;
        }
    }
}

TEST(ChooseMaps, DepthsAndSamplesThatAreNoNumbersAreLeftOut) {
    Street street;
    ChosenMaps<double> const clean = street.chosen();
    for (double const depth : {test::nan_, test::inf, -test::inf, -5.0, 0.0}) {
        Street spoilt = street;
        // Sky, to begin with.
        std::size_t sky = 0;
        while (spoilt.nearest[sky] <= spoilt.farthest[sky]) ++sky;
        spoilt.nearest[sky] = depth;
        spoilt.farthest[sky] = depth;
        spoilt.samples.push_back({V3(test::nan_), V3(0, 1, 0)});
        spoilt.samples.push_back({V3(0, 0, -5), V3(test::inf)});
        auto const watched = test::watched([&] { return spoilt.chosen(); });
        EXPECT_TRUE(watched.calm());
        EXPECT_TRUE(laws::same(watched.result, clean)) << depth;
    }
    Street boxes = street;
    boxes.boxes.push_back({V3(test::nan_), V3(1)});
    boxes.boxes.push_back({V3(1), V3(0)});
    EXPECT_TRUE(laws::same(boxes.chosen_from_boxes(), street.chosen_from_boxes()));
}

// 1200 tiles and no sample, some of them with depths that are none.
TEST(ChooseMaps, OfMoreTilesThanASearchHoldsItLooksAtSomeFromEverywhere) {
    Street street(street_view(), 48, 30);
    street.samples.clear();
    ChosenMaps<double> const clean = street.chosen();
    int looked_at = 0;
    for (auto const& made : clean) looked_at += made.samples;
    EXPECT_LE(looked_at, max_search_samples);
    EXPECT_GT(looked_at, max_search_samples / 4);
    for (int i = 0; i < street.width * street.height; ++i) {
        auto const tile = std::size_t(i);
        if (!(street.nearest[tile] <= street.farthest[tile])) continue;
        V3 const point =
            point_at(street.view, Street::side_of(i % 48, 48, street.view.left, street.view.right),
                     Street::side_of(i / 48, 30, street.view.bottom, street.view.top), street.farthest[tile]);
        EXPECT_GE(laws::server_of(clean, MapLimits<double>{}, point, 1e-9), 0);
    }
    // Of the sky, and so none before either: not finite, turned over, behind the eye, beyond the view.
    struct Depths {
        double nearest, farthest;
    };
    for (Depths const depths : {Depths{test::nan_, 9.0}, Depths{9.0, test::inf}, Depths{9.0, 8.0}, Depths{-9.0, -8.0},
                                Depths{500.0, 600.0}, Depths{0.0, 0.0}}) {
        Street spoilt = street;
        for (std::size_t tile = 0; tile < spoilt.nearest.size(); ++tile)
            if (!(street.nearest[tile] <= street.farthest[tile]))
                spoilt.nearest[tile] = depths.nearest, spoilt.farthest[tile] = depths.farthest;
        EXPECT_TRUE(laws::same(spoilt.chosen(), clean)) << depths.nearest;
    }
}

// A tile of it is none, but the others are.
TEST(ChooseMaps, ThePlaneOfAnOrthographicEyeIsNoTile) {
    ViewVolume<double> const flat =
        orthographic_view(pose_looking(V3(0, 10, 0), V3(0, -1, 0), V3(0, 0, -1)), -20.0, 20.0, -20.0, 20.0, 0.0, 50.0);
    MapSearch<double> static work;
    std::vector<double> depth(16, 10.0);
    SurfacePoint<double> const* const none = nullptr;
    DepthTiles<double> const tiles{depth.data(), depth.data(), 4, 4};
    MapLimits<double> limits;
    limits.maps = 1;
    ChosenMaps<double> const ground = choose_maps(flat, morning, town, none, 0, tiles, limits, work);
    ASSERT_EQ(ground.count, 1);
    EXPECT_TRUE(laws::are_maps_of(ground, morning, gl_clip));
    EXPECT_EQ(ground.at[0].samples, 16);
    depth[0] = 0.0;
    ChosenMaps<double> const but_one = choose_maps(flat, morning, town, none, 0, tiles, limits, work);
    ASSERT_EQ(but_one.count, 1);
    EXPECT_EQ(but_one.at[0].samples, 15);
    EXPECT_GE(laws::server_of(but_one, limits, point_at(flat, -5.0, -15.0, 10.0), 1e-9), 0);
}

TEST(ChooseMaps, BoxesWithoutAnEndAreCutToTheView) {
    Street street;
    double const most = std::numeric_limits<double>::max();
    street.boxes = {{V3(-most, -1, -most), V3(most, 0, most)}};
    MapLimits<double> const limits;
    ChosenMaps<double> const chosen = street.chosen_from_boxes(limits);
    ASSERT_GT(chosen.count, 0);
    EXPECT_GE(laws::server_of(chosen, limits, V3(20, -0.5, -60), 1e-9), 0);
}
