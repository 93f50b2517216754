// SPDX-License-Identifier: MIT
#include "tests/laws/choose_maps.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/choose_maps.hpp>
#include <shadowmath/footprint.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace shadowmath;

namespace {

using V2 = glm::dvec2;
using V3 = glm::dvec3;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double endless = std::numeric_limits<double>::infinity();

ViewVolume<double> street_view() {
    return perspective_view(pose_looking(V3(0, 1.7, 0), V3(0.4, -0.05, -1), V3(0, 1, 0)), 1.0, 1.6, 0.1, 150.0);
}

Light<double> const morning = directional(V3(0.8, -0.5, 0.4));
Aabb<double> const town{V3(-300, -1, -300), V3(300, 20, 300)};

// The ground at 0 and walls 8 m to either side, seen through the view: every tile's nearest and farthest depth, and a
// surface in its middle.
struct Street {
    ViewVolume<double> view = street_view();
    int width, height;
    std::vector<double> nearest, farthest;
    std::vector<SurfacePoint<double>> samples;
    std::vector<Aabb<double>> boxes{
        {V3(-300, -1, -300), V3(300, 0, 300)}, {V3(-18, 0, -300), V3(-8, 12, 300)}, {V3(8, 0, -300), V3(18, 15, 300)}};

    explicit Street(ViewVolume<double> const& seen = street_view(), int tiles_x = 40, int tiles_y = 25,
                    int sample_every = 4)
        : view(seen), width(tiles_x), height(tiles_y) {
        nearest.assign(std::size_t(width * height), std::numeric_limits<double>::max());
        farthest.assign(std::size_t(width * height), std::numeric_limits<double>::lowest());
        constexpr int fine = 4;
        for (int y = 0; y < fine * height; ++y)
            for (int x = 0; x < fine * width; ++x) {
                auto const hit = surface(side_of(x, fine * width, view.left, view.right),
                                         side_of(y, fine * height, view.bottom, view.top));
                double const depth = eye_depth(view, hit.point);
                if (!(depth > view.z_near && depth < view.z_far)) continue;
                auto const tile = std::size_t(y / fine * width + x / fine);
                nearest[tile] = std::min(nearest[tile], depth);
                farthest[tile] = std::max(farthest[tile], depth);
                if (x % sample_every == sample_every / 2 && y % sample_every == sample_every / 2)
                    samples.push_back(hit);
            }
    }
    static double side_of(int i, int count, double lo, double hi) { return lo + (hi - lo) * (i + 0.5) / count; }

    [[nodiscard]] SurfacePoint<double> surface(double side_x, double side_y) const {
        V3 const eye = view.pose.position, way = point_at(view, side_x, side_y, 1.0) - eye;
        double nearest_hit = endless;
        V3 normal(0, 1, 0);
        auto const try_plane = [&](V3 n, double offset) {
            double const t = -(glm::dot(n, eye) + offset) / glm::dot(n, way);
            if (t > 0.0 && t < nearest_hit) nearest_hit = t, normal = n;
        };
        try_plane(V3(0, 1, 0), 0.0);
        try_plane(V3(1, 0, 0), 8.0);
        try_plane(V3(-1, 0, 0), 8.0);
        return {eye + way * std::min(nearest_hit, 1e6), normal};
    }
    [[nodiscard]] DepthTiles<double> tiles() const { return {nearest.data(), farthest.data(), width, height}; }
    [[nodiscard]] ChosenMaps<double> chosen(MapLimits<double> const& limits = {},
                                            Light<double> const& light = morning) const {
        static MapSearch<double> work;
        return choose_maps(view, light, town, samples.data(), int(samples.size()), tiles(), limits, work);
    }
    [[nodiscard]] ChosenMaps<double> chosen_from_boxes(MapLimits<double> const& limits = {},
                                                       Light<double> const& light = morning) const {
        static MapSearch<double> work;
        return choose_maps(view, light, town, boxes.data(), int(boxes.size()), limits, work);
    }
};

// Mean footprint of the samples, each where by_map looks it up.
double mean_footprint(Street const& street, std::vector<ShadowMap<double>> const& maps, int map_size) {
    double sum = 0.0;
    int count = 0;
    for (auto const& sample : street.samples) {
        if (faces_away(morning, sample.point, sample.normal)) continue;
        LookUp<double> const at = by_map(maps.data(), int(maps.size()), map_size, 2.0, sample.point);
        if (at.first < 0) return footprint_limit<double>;
        sum += footprint(clip_from_world(street.view, ClipSpace{}), V2(1920, 1080),
                         maps[std::size_t(at.first)].clip_from_world, double(map_size), sample.point, sample.normal)
                   .major;
        ++count;
    }
    return sum / count;
}

std::vector<ShadowMap<double>> maps_of(ChosenMaps<double> const& chosen) {
    std::vector<ShadowMap<double>> maps;
    for (auto const& made : chosen) maps.push_back(made.map);
    return maps;
}

}  // namespace

TEST(ChooseMaps, EveryTileIsInAMapFromItsNearestToItsFarthestDepth) {
    Street const street;
    for (V3 const travel : {V3(0.8, -0.5, 0.4), V3(0, -1, 0), V3(0.4, -0.05, -1), V3(-0.4, -0.1, 1), V3(1, -0.05, 0)})
        for (int const count : {1, 2, 3, 4}) {
            MapLimits<double> limits;
            limits.maps = count;
            limits.clip = count % 2 == 0 ? vulkan_clip : reversed(d3d_clip);
            Light<double> const light = directional(travel);
            ChosenMaps<double> const chosen = street.chosen(limits, light);
            ASSERT_GT(chosen.count, 0);
            EXPECT_LE(chosen.count, count);
            EXPECT_TRUE(laws::are_maps_of(chosen, light, limits.clip));
            ViewVolume<double> const& view = street.view;
            for (int i = 0; i < street.width * street.height; ++i) {
                auto const tile = std::size_t(i);
                for (int step = 0; step < 5 && street.nearest[tile] <= street.farthest[tile]; ++step)
                    for (double const x : {0.0, 0.5, 1.0})
                        for (double const y : {0.0, 0.5, 1.0}) {
                            double const side_x =
                                view.left + (view.right - view.left) * (i % street.width + x) / street.width;
                            double const side_y =
                                view.bottom + (view.top - view.bottom) * (i / street.width + y) / street.height;
                            double const depth =
                                street.nearest[tile] + (street.farthest[tile] - street.nearest[tile]) * step / 4;
                            EXPECT_GE(laws::server_of(chosen, limits, point_at(view, side_x, side_y, depth), 1e-9), 0);
                        }
            }
        }
}

TEST(ChooseMaps, EveryPointOfTheBoxesInViewIsInAMap) {
    Street const street;
    for (V3 const travel : {V3(0.8, -0.5, 0.4), V3(0, -1, 0), V3(0.4, -0.05, -1), V3(1, -0.05, 0)}) {
        MapLimits<double> const limits;
        Light<double> const light = directional(travel);
        ChosenMaps<double> const chosen = street.chosen_from_boxes(limits, light);
        ASSERT_GT(chosen.count, 0);
        EXPECT_TRUE(laws::are_maps_of(chosen, light, limits.clip));
        int asked = 0;
        for (int x = 0; x <= 12; ++x)
            for (int y = 0; y <= 12; ++y)
                for (int z = 0; z <= 40; ++z) {
                    ViewVolume<double> const& view = street.view;
                    V3 const p = point_at(view, view.left + (view.right - view.left) * x / 12,
                                          view.bottom + (view.top - view.bottom) * y / 12,
                                          view.z_near * std::pow(view.z_far / view.z_near, z / 40.0));
                    bool received = false;
                    for (auto const& box : street.boxes) received = received || contains(box, p);
                    if (!received) continue;
                    ++asked;
                    EXPECT_GE(laws::server_of(chosen, limits, p, 1e-9), 0) << p.x << ' ' << p.y << ' ' << p.z;
                }
        EXPECT_GT(asked, 300);
    }
}

// Whatever casts on a point lies on the way to the light: with the point itself it must be in the map that serves it.
TEST(ChooseMaps, EveryCasterOnTheWayToTheLightIsInTheMapThatServes) {
    Street const street;
    MapLimits<double> limits;
    limits.clip = gl_zero_to_one_clip;
    ChosenMaps<double> const chosen = street.chosen(limits);
    for (auto const& sample : street.samples) {
        if (faces_away(morning, sample.point, sample.normal)) continue;
        int const k = laws::server_of(chosen, limits, sample.point, 1e-9);
        ASSERT_GE(k, 0);
        for (double const metres : {0.5, 5.0, 20.0, 35.0}) {
            V3 const caster = sample.point - morning.direction * metres;
            if (!contains(town, caster)) continue;
            EXPECT_TRUE(laws::holds(chosen.at[std::size_t(k)].map.clip_from_world, limits.clip, caster, -1e-9));
        }
    }
}

TEST(ChooseMaps, TheFootprintThatItSearchesByIsThatOfTheMapsDrawn) {
    Street const street;
    MapLimits<double> limits;
    limits.maps = 1;
    limits.margin_texels = 0.0;
    ChosenMaps<double> const chosen = street.chosen(limits);
    ASSERT_EQ(chosen.count, 1);
    LightSampler<double> const sampler = light_sampler(street.view, morning, limits.eye_pixels, V2(40, 25));
    double worst = 0.0;
    for (auto const& sample : street.samples) {
        LightSample<double> const seen = light_sample(sampler, sample);
        if (!seen.usable || seen.weight == 0.0) continue;
        worst = std::max(worst, footprint(clip_from_world(street.view, ClipSpace{}), limits.eye_pixels,
                                          chosen.at[0].map.clip_from_world, 1024.0, sample.point, sample.normal)
                                    .major);
    }
    // The search looks at every one of these few samples.
    EXPECT_NEAR(chosen.at[0].worst, worst, 1e-6 * worst);
}

TEST(ChooseMaps, IsFinerThanAnyCascadesOfAsManyTexels) {
    Street const street;
    double const mine = mean_footprint(street, maps_of(street.chosen()), 1024);
    double const from_boxes = mean_footprint(street, maps_of(street.chosen_from_boxes()), 1024);
    double least = footprint_limit<double>;
    for (CascadeFit const fit : {CascadeFit::stable, CascadeFit::tight, CascadeFit::rectangle, CascadeFit::warped})
        for (double const lambda : {0.3, 0.5, 0.7, 0.9}) {
            CascadeOptions<double> options;
            options.map_size = 1024;
            options.fit = fit;
            options.lambda = lambda;
            auto const cascades = fit_cascades(street.view, morning, town, town, options);
            std::vector<ShadowMap<double>> maps;
            for (auto const& cascade : cascades) maps.push_back(cascade.map);
            least = std::min(least, mean_footprint(street, maps, 1024));
        }
    EXPECT_LT(mine, 0.6 * least);
    EXPECT_LT(from_boxes, least);
}

TEST(ChooseMaps, MoreMapsCostLess) {
    Street const street;
    double last = std::numeric_limits<double>::max();
    for (int const count : {1, 2, 3, 4}) {
        MapLimits<double> limits;
        limits.maps = count;
        ChosenMaps<double> const chosen = street.chosen(limits);
        EXPECT_LT(chosen.price, last);
        EXPECT_LE(chosen.price, chosen.one_map * 1.05);
        last = chosen.price;
    }
}

TEST(ChooseMaps, TheSameInputsGiveTheSameMapsWithoutTheHeap) {
    Street const street;
    auto const once = test::watched([&] { return street.chosen(); });
    EXPECT_TRUE(once.calm());
    EXPECT_TRUE(laws::same(once.result, street.chosen()));
    auto const boxes = test::watched([&] { return street.chosen_from_boxes(); });
    EXPECT_TRUE(boxes.calm());
    EXPECT_TRUE(laws::same(boxes.result, street.chosen_from_boxes()));
    // By depth alone 7 cuts in two for each of seven parts, freely 21; then 54 moves of up to four parts, twice.
    EXPECT_LE(once.result.tried, 1 + 14 * 7 + 1 + 42 * 7 + 2 * 54 * 4);
}

TEST(ChooseMaps, WithoutSamplesTheTilesWeighAlike) {
    Street street;
    street.samples.clear();
    MapLimits<double> const limits;
    for (V3 const travel : {morning.direction, V3(0, 1, 0)}) {
        ChosenMaps<double> const chosen = street.chosen(limits, directional(travel));
        ASSERT_GT(chosen.count, 0);
        for (int i = 0; i < street.width * street.height; ++i) {
            auto const tile = std::size_t(i);
            if (!(street.nearest[tile] <= street.farthest[tile])) continue;
            ViewVolume<double> const& view = street.view;
            V3 const point = point_at(view, Street::side_of(i % street.width, street.width, view.left, view.right),
                                      Street::side_of(i / street.width, street.height, view.bottom, view.top),
                                      street.farthest[tile]);
            EXPECT_GE(laws::server_of(chosen, limits, point, 1e-9), 0);
        }
    }
}

TEST(ChooseMaps, SaysWhatItHasChosen) {
    Street const street;
    ChosenMaps<double> const chosen = street.chosen();
    int samples = 0;
    for (auto const& made : chosen) {
        EXPECT_GT(std::string(describe(made.shape)).size(), 20u);
        EXPECT_LT(made.part.lo.z, made.part.hi.z);
        samples += made.samples;
    }
    EXPECT_GT(samples, 100);
    EXPECT_LE(samples, max_search_samples);
    for (MapShape const shape : {MapShape::rectangle, MapShape::warp, MapShape::lopsided})
        EXPECT_GT(std::string(describe(shape)).size(), 20u);
    EXPECT_STREQ(describe(static_cast<MapShape>(99)), "no map");
}

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
    row("a pose with NaN", Fault::not_finite, false, [](Row& r) { r.view.pose.position.x = no_number; });
    row("a range turned over", Fault::empty_range, false, [](Row& r) { r.view.z_far = 0.01; });
    row("sides crossed", Fault::bad_frustum, false, [](Row& r) { r.view.left = 2.0; });
    row("axes askew", Fault::bad_pose, false, [](Row& r) { r.view.pose.up = r.view.pose.right; });
    row("no light", Fault::zero_light, false, [](Row& r) { r.light = directional(V3(0)); });
    row("a light of NaN", Fault::not_finite, false, [](Row& r) { r.light = directional(V3(no_number)); });
    row("a spot", Fault::clamped_option, false, [](Row& r) { r.light = spot(V3(0, 9, 0), V3(0, -1, 0), 0.5, 30.0); });
    row("no pixels", Fault::clamped_option, false, [](Row& r) { r.limits.eye_pixels = V2(0, 9); });
    row("no rows of pixels", Fault::clamped_option, false, [](Row& r) { r.limits.eye_pixels = V2(9, 0); });
    row("pixels of NaN", Fault::clamped_option, false, [](Row& r) { r.limits.eye_pixels = V2(no_number, 9); });
    row("a map of four texels", Fault::map_too_small, false, [](Row& r) { r.limits.map_size = 4; });
    row("a margin of NaN", Fault::not_finite, false, [](Row& r) { r.limits.margin_texels = no_number; });
    row("no maps", Fault::count_clamped, true, [](Row& r) { r.limits.maps = 0; });
    row("nine maps", Fault::count_clamped, true, [](Row& r) { r.limits.maps = 9; });
    row("an infinite far", Fault::far_clamped, true, [](Row& r) { r.view.z_far = endless; });
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
    for (double const depth : {no_number, endless, -endless, -5.0, 0.0}) {
        Street spoilt = street;
        // Sky, to begin with.
        std::size_t sky = 0;
        while (spoilt.nearest[sky] <= spoilt.farthest[sky]) ++sky;
        spoilt.nearest[sky] = depth;
        spoilt.farthest[sky] = depth;
        spoilt.samples.push_back({V3(no_number), V3(0, 1, 0)});
        spoilt.samples.push_back({V3(0, 0, -5), V3(endless)});
        auto const watched = test::watched([&] { return spoilt.chosen(); });
        EXPECT_TRUE(watched.calm());
        EXPECT_TRUE(laws::same(watched.result, clean)) << depth;
    }
    Street boxes = street;
    boxes.boxes.push_back({V3(no_number), V3(1)});
    boxes.boxes.push_back({V3(1), V3(0)});
    EXPECT_TRUE(laws::same(boxes.chosen_from_boxes(), street.chosen_from_boxes()));
}

TEST(ChooseMaps, OfMoreSamplesThanASearchHoldsItLooksAtSomeFromEverywhere) {
    Street const few, many(street_view(), 40, 25, 1);
    ChosenMaps<double> const chosen = many.chosen();
    int looked_at = 0;
    for (auto const& made : chosen) looked_at += made.samples;
    EXPECT_GT(many.samples.size(), std::size_t(10 * max_search_samples));
    EXPECT_LE(looked_at, max_search_samples);
    EXPECT_GT(looked_at, max_search_samples / 2);
    EXPECT_LT(mean_footprint(few, maps_of(chosen), 1024), 1.25 * mean_footprint(few, maps_of(few.chosen()), 1024));
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
    for (Depths const depths : {Depths{no_number, 9.0}, Depths{9.0, endless}, Depths{9.0, 8.0}, Depths{-9.0, -8.0},
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

// Four maps for sixteen like tiles: where one comes to serve none, the others serve all.
TEST(ChooseMaps, EverySampleCountsInAMapThatIsThere) {
    ViewVolume<double> const flat =
        orthographic_view(pose_looking(V3(0, 10, 0), V3(0, -1, 0), V3(0, 0, -1)), -20.0, 20.0, -20.0, 20.0, 0.0, 50.0);
    MapSearch<double> static work;
    std::vector<double> const depth(16, 10.0);
    SurfacePoint<double> const* const none = nullptr;
    ChosenMaps<double> const ground =
        choose_maps(flat, morning, town, none, 0, {depth.data(), depth.data(), 4, 4}, MapLimits<double>{}, work);
    ASSERT_GT(ground.count, 0);
    EXPECT_TRUE(laws::are_maps_of(ground, morning, gl_clip));
    int samples = 0;
    for (ChosenMap<double> const& chosen : ground) samples += chosen.samples;
    EXPECT_EQ(samples, 16);
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

TEST(BoxSamples, ARayEndsInTheBoxesThatItMeets) {
    Street const street;
    LightSampler<double> const sampler = light_sampler(street.view, morning, V2(1920, 1080), V2(20, 12));
    std::vector<LightSample<double>> guesses(max_search_samples);
    int const count = guesses_in_boxes(sampler, morning, street.boxes.data(), int(street.boxes.size()), guesses.data(),
                                       int(guesses.size()));
    ASSERT_GT(count, 100);
    double weight = 0.0;
    for (int i = 0; i < count; ++i) {
        LightSample<double> const& guess = guesses[std::size_t(i)];
        V3 const point = point_at(street.view, guess.seen.x, guess.seen.y, guess.seen.z);
        bool inside = false;
        for (auto box : street.boxes) {
            box.lo -= 1e-9, box.hi += 1e-9;
            inside = inside || contains(box, point);
        }
        EXPECT_TRUE(inside);
        weight += guess.weight;
    }
    EXPECT_LE(weight, guess_rays_x * guess_rays_y * 1.0001);
    EXPECT_GT(weight, 50.0);
    EXPECT_EQ(guesses_in_boxes(sampler, morning, street.boxes.data(), int(street.boxes.size()), guesses.data(), 7), 7);
}
