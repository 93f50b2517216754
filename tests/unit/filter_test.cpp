// SPDX-License-Identifier: MIT
#include "tests/laws/filter.hpp"

#include <shadowmath/fit_crop.hpp>
#include <shadowmath/light_box.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace shadowmath;

namespace {

constexpr ClipSpace plain = gl_zero_to_one_clip;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// Columns left of `edge` hold an occluder at 0.25.
auto occluder_left_of(int edge) {
    return [edge](int x, int) { return x < edge ? 0.25 : 1.0; };
}

double shadow_edge(double x, FilterOptions options, double depth = 0.5) {
    return filtered(Receiver<double>{Vec2<double>(x, 8.0), depth, {}}, 16, plain, options, occluder_left_of(8));
}

}  // namespace

TEST(Filter, OfRadiusOneFadesOverTwoTexels) {
    EXPECT_EQ(shadow_edge(6.9, {1, true}), 0.0);
    EXPECT_DOUBLE_EQ(shadow_edge(7.5, {1, true}), 0.25);
    EXPECT_DOUBLE_EQ(shadow_edge(8.0, {1, true}), 0.5);
    EXPECT_DOUBLE_EQ(shadow_edge(8.5, {1, true}), 0.75);
    EXPECT_EQ(shadow_edge(9.1, {1, true}), 1.0);
}

TEST(Filter, OfRadiusZeroIsHard) {
    EXPECT_EQ(shadow_edge(7.99, {0, true}), 0.0);
    EXPECT_EQ(shadow_edge(8.01, {0, true}), 1.0);
}

TEST(Filter, EqualDepthIsLit) {
    EXPECT_EQ(shadow_edge(4.5, {1, true}, 0.25), 1.0);
    EXPECT_EQ(shadow_edge(4.5, {1, true}, 0.2500001), 0.0);
}

TEST(Filter, ReceiversBeyondTheFarEndAreLitByTheClearedMapAndShadowedByOccluders) {
    EXPECT_EQ(shadow_edge(12.5, {1, true}, 1.5), 1.0);
    EXPECT_EQ(shadow_edge(4.5, {1, true}, 1.5), 0.0);
    EXPECT_EQ(shadow_edge(4.5, {1, true}, -3.0), 1.0);
}

TEST(Filter, OutsideTheMapIsLitAndNeverAskedFor) {
    auto const never = [](int x, int y) {
        EXPECT_TRUE(x >= 0 && y >= 0 && x < 16 && y < 16);
        return 0.0;
    };
    auto const share = [&never](double x) {
        return filtered(Receiver<double>{Vec2<double>(x, 8.0), 0.5, {}}, 16, plain, {2, true}, never);
    };
    for (double x : {-2.0, 18.0, 40.0, 1e30, -1e30, not_a_number}) EXPECT_EQ(share(x), 1.0);
    EXPECT_DOUBLE_EQ(share(0.0), 0.5);
    EXPECT_DOUBLE_EQ(share(17.0), 0.75);
    EXPECT_DOUBLE_EQ(share(2.0), 0.0);
}

TEST(Filter, BadNumbersAndSizesAreLit) {
    auto const black = [](int, int) { return 0.0; };
    Receiver<double> const good{Vec2<double>(8.0, 8.0), 0.5, {}};
    EXPECT_EQ(filtered(good, 16, plain, {1, true}, black), 0.0);
    EXPECT_EQ(filtered(good, 0, plain, {1, true}, black), 1.0);
    EXPECT_EQ(filtered(good, -7, plain, {1, true}, black), 1.0);
    EXPECT_EQ(filtered(good, std::numeric_limits<int>::max(), plain, {1, true}, black), 1.0);
    EXPECT_EQ(filtered(Receiver<double>{good.texel, not_a_number, {}}, 16, plain, {1, true}, black), 1.0);
    EXPECT_EQ(filtered(Receiver<double>{good.texel, 0.5, {not_a_number, 0}}, 16, plain, {1, true}, black), 1.0);
    EXPECT_EQ(filtered(good, 16, plain, {1, true}, [](int, int) { return not_a_number; }), 1.0);
    EXPECT_EQ(filtered(good, 16, plain, {-3, true}, black), 0.0) << "a negative radius is 0";
    EXPECT_TRUE(laws::is_share(filtered(good, 16, plain, {1000000000, true}, black)));
}

TEST(Filter, OfANumberWithoutAnEndIsLitEachAlone) {
    double const inf = std::numeric_limits<double>::infinity();
    auto const of = [](Vec2<double> at, double depth, DepthSlope<double> slope) {
        return filtered(Receiver<double>{at, depth, slope}, 16, plain, {1, true}, [](int, int) { return 0.25; });
    };
    Vec2<double> const middle(8.0);
    EXPECT_EQ(of(middle, 0.5, {}), 0.0);
    EXPECT_EQ(of(middle, inf, {}), 1.0);
    EXPECT_EQ(of(middle, 0.5, {inf, 0.0}), 1.0);
    EXPECT_EQ(of(middle, 0.5, {0.0, inf}), 1.0);
    EXPECT_EQ(of(Vec2<double>(inf, 8.0), 0.5, {}), 1.0);
}

TEST(Filter, TakesTheLargestMap) {
    Receiver<double> const receiver{Vec2<double>(8.0), 0.5, {}};
    auto const near_by = [](int, int) { return 0.25; };
    EXPECT_EQ(filtered(receiver, largest_map_size, plain, {1, true}, near_by), 0.0);
    EXPECT_EQ(filtered(receiver, largest_map_size + 1, plain, {1, true}, near_by), 1.0);
}

// A plane that rises along both axes is lit a hair before itself, and dark a hair behind.
TEST(Filter, TapsFollowThePlaneAlongBothAxes) {
    DepthSlope<double> const slope{0.01, 0.02};
    auto const plane = [&](int x, int y) { return 0.5 + slope.x * (x + 0.5 - 8.3) + slope.y * (y + 0.5 - 7.8); };
    for (double const off : {-1e-9, 1e-9})
        EXPECT_EQ(filtered(Receiver<double>{Vec2<double>(8.3, 7.8), 0.5 + off, slope}, 16, plain, {2, true}, plane),
                  off < 0 ? 1.0 : 0.0);
}

TEST(Filter, TapsFollowThePlaneAndNotThePoint) {
    // Depth rises by 0.01 a texel along x; the map holds exactly that plane.
    Receiver<double> const receiver{Vec2<double>(8.25, 8.75), 0.4 + 0.01 * 8.25 - 1e-12, {0.01, 0.0}};
    auto const plane = [](int x, int) { return 0.4 + 0.01 * (x + 0.5); };
    EXPECT_EQ(filtered(receiver, 16, plain, {2, true}, plane), 1.0);
    EXPECT_LT(filtered(receiver, 16, plain, {2, false}, plane), 0.6);
}

TEST(Filter, WithoutThePlaneOfTheTapsComparesThePointsOwnDepth) {
    Receiver<double> const receiver{Vec2<double>(8.25, 8.75), 0.5, {0.01, 0.02}};
    EXPECT_EQ(filtered(receiver, 16, plain, {2, false}, [](int, int) { return 0.5; }), 1.0);
    EXPECT_EQ(filtered(receiver, 16, plain, {2, false}, [](int, int) { return 0.4999; }), 0.0);
}

TEST(Visibility, ASurfaceThatFacesTheLampWantsNoBiasOfItsSlopeWhereverItLies) {
    Light<double> const lamp = spot(Vec3<double>(0, 10, 0), Vec3<double>(0, -1, 0), 0.7, 20.0);
    ShadowMap<double> map;
    map.clip_from_world = spot_clip_from_world(lamp, 1.0, plain);
    map.clip = plain;
    map.visible = true;
    MapBias<double> bias;
    bias.slope_texels = 1.0;
    for (Vec3<double> const& point : {Vec3<double>(5, 0, 0), Vec3<double>(0, 0, 5), Vec3<double>(-3, 1, 4)}) {
        Vec3<double> const facing = glm::normalize(lamp.position - point);
        double const depth = projected(texture_from_world(map), point).at.z;
        EXPECT_NEAR(detail::seen_by(map, 1024, point, facing, bias, true).receiver.depth, depth, 1e-12);
        EXPECT_LT(detail::seen_by(map, 1024, point, facing, bias, false).receiver.depth, depth - 1e-6);
    }
}

TEST(Visibility, IsOneWhereAMapDoesNotHoldThePoint) {
    LightBox<double> box;
    ShadowMap<double> map;
    map.clip_from_world = clip_from_world(box, plain);
    map.clip = plain;
    map.visible = true;
    auto const black = [](int, int) { return 0.0; };
    Vec3<double> const inside(0, -0.5, 0), up(0, 1, 0);
    EXPECT_EQ(visibility(map, 16, inside, up, {}, {}, black), 0.0);
    EXPECT_LT(visibility(map, 1, inside, up, {}, {}, black), 1.0) << "a map of one texel is a map";
    EXPECT_EQ(visibility(map, 0, inside, up, {}, {}, black), 1.0);
    EXPECT_EQ(visibility(map, 16, Vec3<double>(3, -0.5, 0), up, {}, {}, black), 1.0);
    map.w_min = 1.0;  // w is 1 everywhere
    EXPECT_EQ(visibility(map, 16, inside, up, {}, {}, black), 1.0);
    map.w_min = 0;
    map.visible = false;
    EXPECT_EQ(visibility(map, 16, inside, up, {}, {}, black), 1.0);
}

TEST(Visibility, BiasIsInFavourOfLightInBothDepthOrders) {
    LightBox<double> box;
    MapBias<double> bias;
    for (ClipSpace clip : {plain, reversed(plain), gl_clip}) {
        ShadowMap<double> map;
        map.clip_from_world = clip_from_world(box, clip);
        map.clip = clip;
        map.visible = true;
        bool const far_is_zero = clip.depth == DepthOrder::one_to_zero;
        auto const occluder = [=](int, int) { return far_is_zero ? 0.51 : 0.49; };
        Vec3<double> const point(0, -0.5, 0), up(0, 1, 0);  // at depth 0.5
        bias.constant = 0.009;
        EXPECT_EQ(visibility(map, 16, point, up, bias, {}, occluder), 0.0);
        bias.constant = 0.011;
        EXPECT_EQ(visibility(map, 16, point, up, bias, {}, occluder), 1.0);
    }
}

TEST(Filter, OfASlopeThatIsNoNumberIsLit) {
    auto const black = [](int, int) { return 0.0; };
    for (DepthSlope<double> const& slope :
         {DepthSlope<double>{not_a_number, 0.0}, DepthSlope<double>{0.0, not_a_number}})
        EXPECT_EQ(filtered(Receiver<double>{Vec2<double>(8.0), 0.5, slope}, 16, plain, {1, true}, black), 1.0);
}
