// SPDX-License-Identifier: MIT
#include "tests/laws/pcss.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/light_box.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace shadowmath;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr int size = 512;

// A sun overhead of radius 0.1 over a map of 8 m by 8 m by 10 m: a metre is 64 texels and a tenth of depth.
struct Overhead {
    Light<double> sun = directional(Vec3<double>(0, -1, 0));
    ShadowMap<double> map;
    MapPenumbra<double> penumbra;

    explicit Overhead(ClipSpace clip = gl_zero_to_one_clip, double radius = 0.1) {
        LightBox<double> box;
        box.basis = light_basis(sun.direction);
        box.lo = Vec2<double>(-4.0);
        box.hi = Vec2<double>(4.0);
        box.depth_lo = -9.0;
        box.depth_hi = 1.0;
        map.clip = clip;
        map.clip_from_world = clip_from_world(box, clip);
        map.visible = true;
        penumbra = penumbra_for(map, sun, radius);
    }

    // Left of texel `edge` an occluder `height` metres over the floor, elsewhere the floor.
    [[nodiscard]] SoftShadow<double> past_edge(double x, double height, PcssOptions<double> const& options) const {
        bool const far_is_zero = map.clip.depth == DepthOrder::one_to_zero;
        auto const stored = [&](int i, int) {
            double const depth = i < size / 2 ? 0.9 - height / 10 : 0.9;
            return far_is_zero ? 1 - depth : depth;
        };
        MapBias<double> bias;
        bias.constant = 1e-6;
        return soft_visibility(map, size, Vec3<double>(x, 0, 0), Vec3<double>(0, 1, 0), bias, penumbra, options,
                               stored);
    }
};

PcssOptions<double> const many{256, 256, {1, 0}};

}  // namespace

TEST(Pcss, OfAStraightEdgeIsTheShareOfTheDiskBesideIt) {
    for (ClipSpace clip : {gl_zero_to_one_clip, reversed(gl_zero_to_one_clip), gl_clip, vulkan_clip}) {
        Overhead const scene(clip);
        double const radius_metres = 0.1 * 5.0;  // 32 texels
        for (double x = -1.5; x <= 1.5; x += 0.125) {
            SoftShadow<double> const shadow = scene.past_edge(x * radius_metres, 5.0, many);
            // Texels are a 32nd of the radius, half of one moves the share by 1 percent; 256 taps tell 1 percent apart.
            EXPECT_NEAR(shadow.visibility, laws::share_of_disk(x), 0.02) << x;
            EXPECT_NEAR(shadow.gap, shadow.blocked ? 5.0 : 0.0, 1e-4);
        }
    }
}

TEST(Pcss, WidensInProportionToGapAndLight) {
    // Where a quarter of the light is seen: 0.4040 of the penumbra's radius before the edge.
    auto const quarter = [](Overhead const& scene, double height) {
        double lo = -3, hi = 0;
        for (int i = 0; i < 30; ++i)
            (scene.past_edge((lo + hi) / 2, height, many).visibility < 0.25 ? lo : hi) = (lo + hi) / 2;
        return lo;
    };
    double const once = quarter(Overhead(), 4.0);
    EXPECT_NEAR(once, -0.4040 * 0.4, 0.01);
    EXPECT_NEAR(quarter(Overhead(), 8.0), 2 * once, 0.02);
    EXPECT_NEAR(quarter(Overhead(gl_clip, 0.2), 4.0), 2 * once, 0.02);
}

TEST(Pcss, OfALightWithoutSizeFadesOverOneTexel) {
    Overhead const scene(gl_zero_to_one_clip, 0.0);
    double const texel = 1.0 / 64;
    EXPECT_EQ(scene.past_edge(-0.51 * texel, 5.0, {}).visibility, 0.0);
    EXPECT_EQ(scene.past_edge(0.51 * texel, 5.0, {}).visibility, 1.0);
    EXPECT_NEAR(scene.past_edge(-0.25 * texel, 5.0, {}).visibility, 0.25, 1e-9);
    EXPECT_NEAR(scene.past_edge(0.25 * texel, 5.0, {}).visibility, 0.75, 1e-9);
}

TEST(Pcss, IsSharpInContactWhateverTheLight) {
    Overhead const scene(gl_zero_to_one_clip, 0.1);
    double const texel = 1.0 / 64;
    EXPECT_EQ(scene.past_edge(-texel, 0.01, {}).visibility, 0.0);
    EXPECT_EQ(scene.past_edge(texel, 0.01, {}).visibility, 1.0);
}

TEST(Pcss, CountsNoOccluderOutsideOfItsOwnCone) {
    // 1 m high, its penumbra ends 0.1 m from the edge; the search for occluders of up to 9 m reaches 0.9 m.
    Overhead const scene;
    EXPECT_FALSE(scene.past_edge(0.11, 1.0, many).blocked);
    EXPECT_TRUE(scene.past_edge(0.08, 1.0, many).blocked);
    EXPECT_FALSE(scene.past_edge(0.3, 1.0, many).blocked);
}

TEST(Pcss, LooksNoFartherThanTold) {
    Overhead scene;
    scene.penumbra.largest_gap = 2.0;
    EXPECT_DOUBLE_EQ(scene.past_edge(-1.0, 5.0, {}).gap, 2.0);
}

TEST(Pcss, OutsideTheMapIsLitAndNeverAskedFor) {
    Overhead const scene;
    auto const never = [](int x, int y) {
        EXPECT_TRUE(x >= 0 && y >= 0 && x < size && y < size);
        return 0.5;
    };
    auto const at = [&](double x) {
        return soft_visibility(scene.map, size, Vec3<double>(x, 0, 0), Vec3<double>(0, 1, 0), MapBias<double>{},
                               scene.penumbra, PcssOptions<double>{}, never);
    };
    for (double x : {-40.0, 40.0, 1e30, not_a_number}) EXPECT_EQ(at(x).visibility, 1.0);
    EXPECT_NEAR(at(4.0).visibility, 0.5, 0.05);
    EXPECT_EQ(at(0.0).visibility, 0.0);
    auto const all_lit = [](int, int) { return 1.0; };
    EXPECT_FALSE(soft_visibility(scene.map, size, Vec3<double>(4.0, 0, 0), Vec3<double>(0, 1, 0), MapBias<double>{},
                                 scene.penumbra, PcssOptions<double>{}, all_lit)
                     .blocked);
}

TEST(Pcss, TurnsItsTapsAsToldAndNotAtAllWhereThatIsNoDirection) {
    Overhead const scene;
    double const not_turned = scene.past_edge(0.1, 5.0, {8, 8, {1, 0}}).visibility;
    EXPECT_NE(scene.past_edge(0.1, 5.0, {8, 8, {0.6, 0.8}}).visibility, not_turned);
    for (double const odd : {0.0, 7.0, not_a_number})
        EXPECT_EQ(scene.past_edge(0.1, 5.0, {8, 8, {odd, 0}}).visibility, not_turned) << odd;
}

TEST(Pcss, BadNumbersAreLit) {
    Overhead const scene;
    auto const black = [](int, int) { return 0.0; };
    Receiver<double> const good{Vec2<double>(256.0), 0.5, {}};
    auto const seen = [&](Receiver<double> const& receiver, double w, MapPenumbra<double> const& penumbra, int side) {
        return soft_filtered(receiver, w, penumbra, side, scene.map.clip, PcssOptions<double>{}, black).visibility;
    };
    EXPECT_EQ(seen(good, 1.0, scene.penumbra, size), 0.0);
    EXPECT_EQ(seen(good, 1.0, scene.penumbra, 0), 1.0);
    EXPECT_EQ(seen(good, 1.0, scene.penumbra, largest_map_size + 1), 1.0);
    EXPECT_EQ(seen(good, 0.0, scene.penumbra, size), 1.0);
    EXPECT_EQ(seen(good, not_a_number, scene.penumbra, size), 1.0);
    EXPECT_EQ(seen({good.texel, not_a_number, {}}, 1.0, scene.penumbra, size), 1.0);
    EXPECT_EQ(seen({good.texel, 0.5, {0, not_a_number}}, 1.0, scene.penumbra, size), 1.0);
    MapPenumbra<double> bad = scene.penumbra;
    bad.rim_x.w = not_a_number;
    EXPECT_EQ(seen(good, 1.0, bad, size), 1.0);
    PcssOptions<double> odd{-5, 1 << 30, {not_a_number, 7}};
    EXPECT_EQ(soft_filtered(good, 1.0, scene.penumbra, size, scene.map.clip, odd, black).visibility, 0.0);
    auto const nothing = [](int, int) { return not_a_number; };
    EXPECT_EQ(soft_filtered(good, 1.0, scene.penumbra, size, scene.map.clip, odd, nothing).visibility, 1.0);
}

TEST(Pcss, AnyNumberWithoutAnEndIsLitAlone) {
    Overhead const scene;
    double const inf = std::numeric_limits<double>::infinity();
    auto const black = [](int, int) { return 0.0; };
    Receiver<double> const good{Vec2<double>(256.0), 0.5, {}};
    auto const seen = [&](Receiver<double> const& receiver, MapPenumbra<double> const& penumbra) {
        return soft_filtered(receiver, 1.0, penumbra, size, scene.map.clip, PcssOptions<double>{}, black);
    };
    EXPECT_EQ(seen(good, scene.penumbra).visibility, 0.0);
    for (DepthSlope<double> const& slope : {DepthSlope<double>{inf, 0}, DepthSlope<double>{0, inf}})
        EXPECT_FALSE(seen({good.texel, 0.5, slope}, scene.penumbra).blocked);
    EXPECT_FALSE(seen({good.texel, inf, {}}, scene.penumbra).blocked);
    for (int member = 0; member < 5; ++member) {
        MapPenumbra<double> bad = scene.penumbra;
        (member == 0   ? bad.rim_x.x
         : member == 1 ? bad.rim_y.y
         : member == 2 ? bad.depth_of_gap
                       : bad.largest_gap) = inf;
        if (member == 4) bad.largest_gap = not_a_number;
        EXPECT_EQ(seen(good, bad).visibility, 1.0) << member;
        EXPECT_FALSE(seen(good, bad).blocked) << member;
    }
    MapPenumbra<double> none = scene.penumbra;
    none.depth_of_gap = 0.0;
    auto const run = test::watched([&] { return seen(good, none); });
    EXPECT_FALSE(run.result.blocked);
    EXPECT_TRUE(run.calm_in_range());
    auto const behind = test::watched(
        [&] { return soft_filtered(good, 0.0, scene.penumbra, size, scene.map.clip, PcssOptions<double>{}, black); });
    EXPECT_FALSE(behind.result.blocked);
    EXPECT_TRUE(behind.calm_in_range());
}

TEST(Pcss, KnowsTheSmallestMapAndTheLargest) {
    Overhead const scene;
    auto const black = [](int, int) { return 0.0; };
    for (int const side : {1, largest_map_size}) {
        Receiver<double> const middle{Vec2<double>(side * 0.5), 0.5, {}};
        EXPECT_TRUE(
            soft_filtered(middle, 1.0, scene.penumbra, side, scene.map.clip, PcssOptions<double>{}, black).blocked);
    }
}

TEST(Pcss, ATexelIsInTheMapFromTheFirstToTheLast) {
    auto const none = [](int, int) { return 1.0; };
    detail::TapMap<double, decltype(none)> const map{none, 8, false};
    for (int const inside : {0, 7}) EXPECT_TRUE(map.holds(inside, inside));
    for (int const outside : {-1, 8}) {
        EXPECT_FALSE(map.holds(outside, 4));
        EXPECT_FALSE(map.holds(4, outside));
    }
    Vec2<double> texel;
    for (double const inside : {-0.99, 8.99}) {
        EXPECT_TRUE(detail::texel_of(Vec4<double>(inside / 8, 0.5, 0, 1), 8, texel)) << inside;
        EXPECT_TRUE(detail::texel_of(Vec4<double>(0.5, inside / 8, 0, 1), 8, texel)) << inside;
    }
    for (double const outside : {-1.01, 9.01}) {
        EXPECT_FALSE(detail::texel_of(Vec4<double>(outside / 8, 0.5, 0, 1), 8, texel)) << outside;
        EXPECT_FALSE(detail::texel_of(Vec4<double>(0.5, outside / 8, 0, 1), 8, texel)) << outside;
    }
}

// From beside the map what is in it counts, and what is not counts for nothing.
TEST(Pcss, AReceiverBesideTheMapSeesTheOccludersInItAlone) {
    Overhead const scene;
    Receiver<double> const beside{Vec2<double>(-6.0, 256.0), 0.9, {}};
    auto const seen = [&](double stored) {
        return soft_filtered(beside, 1.0, scene.penumbra, size, scene.map.clip, many,
                             [stored](int, int) { return stored; });
    };
    EXPECT_FALSE(seen(1.0).blocked);
    ASSERT_TRUE(seen(0.4).blocked);
    EXPECT_NEAR(seen(0.4).gap, 5.0, 1e-9);
}

TEST(Pcss, WhatIsBlockedNowhereInItsDiskIsLit) {
    Overhead const scene;
    int found = 0;
    for (double x = 0.2; x < 0.5; x += 1e-3) {
        SoftShadow<double> const shadow = scene.past_edge(x, 5.0, {256, 4, {1, 0}});
        EXPECT_GE(shadow.visibility, 0.5) << x;
        found += shadow.blocked && shadow.visibility == 1.0 ? 1 : 0;
    }
    EXPECT_GT(found, 0) << "the search finds what the few taps of the filter miss";
}

TEST(Pcss, DirectionsAreAtTheGoldenAngleAndStayUnit) {
    Vec2<float> direction(1.0f, 0.0f);
    for (int i = 0; i < largest_tap_count; ++i, direction = next_direction(direction)) {
        double const angle = 2.39996322972865332 * i;
        // Each step rounds three times.
        EXPECT_NEAR(direction.x, std::cos(angle), 2e-7 * (i + 1));
        EXPECT_NEAR(direction.y, std::sin(angle), 2e-7 * (i + 1));
    }
}
