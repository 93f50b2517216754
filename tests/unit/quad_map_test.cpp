// SPDX-License-Identifier: MIT
#include "tests/laws/quad_map.hpp"
#include "tests/laws/shadow_map.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/bias.hpp>
#include <shadowmath/quad_map.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

using namespace shadowmath;

namespace {

using V2 = glm::dvec2;
using V3 = glm::dvec3;

QuadSides<double> box_sides(V2 lo, V2 hi) {
    return {V3(1, 0, -lo.x), V3(-1, 0, hi.x), V3(0, 1, -lo.y), V3(0, -1, hi.y)};
}

// Through the point, with this inward normal.
V3 side(V2 point, V2 inward) {
    return {inward.x, inward.y, -glm::dot(inward, point)};
}

QuadSides<double> lopsided() {
    return {side({-3, 0}, {1, 0.2}), side({5, 1}, {-1, 0.1}), side({0, -2}, {0.1, 1}), side({1, 4}, {-0.2, -1})};
}

}  // namespace

TEST(QuadMap, ItsFourSidesAreThoseOfTheMap) {
    for (auto const& sides : {box_sides({-2, 1}, {3, 7}), lopsided()}) {
        Quad<double> const quad = quad_between(sides);
        ASSERT_TRUE(quad.visible);
        EXPECT_TRUE(laws::fills_the_square(quad));
    }
}

TEST(QuadMap, OfABoxIsTheBox) {
    Quad<double> const quad = quad_between(box_sides({-2, 1}, {3, 7}));
    ASSERT_TRUE(quad.visible);
    EXPECT_DOUBLE_EQ(quad.w_least, 1.0);
    EXPECT_DOUBLE_EQ(area(quad), 30.0);
    for (V2 const p : {V2(-2, 1), V2(0.5, 4), V2(2.75, 6)}) {
        V3 const h(p, 1);
        EXPECT_NEAR(glm::dot(quad.x, h) / glm::dot(quad.w, h), (p.x - 0.5) / 2.5, 1e-14);
        EXPECT_NEAR(glm::dot(quad.y, h) / glm::dot(quad.w, h), (p.y - 4.0) / 3.0, 1e-14);
        EXPECT_TRUE(is_in(quad, p));
    }
    EXPECT_FALSE(is_in(quad, V2(3.01, 2)));
    EXPECT_FALSE(is_in(quad, V2(0, 0.99)));
}

TEST(QuadMap, LengthsOfItsSidesNeverMatter) {
    QuadSides<double> const sides = lopsided();
    Quad<double> const quad = quad_between(sides);
    Quad<double> const scaled =
        quad_between(QuadSides<double>{sides[0] * 8.0, sides[1], sides[2] * 0.5, sides[3] * 2.0});
    ASSERT_TRUE(scaled.visible);
    EXPECT_NEAR(glm::length(quad.x - scaled.x) + glm::length(quad.y - scaled.y) + glm::length(quad.w - scaled.w), 0.0,
                1e-14);
}

TEST(QuadMap, RefusesWhatIsNoQuadrilateral) {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    QuadSides<double> const box = box_sides({-1, -1}, {1, 1});
    EXPECT_FALSE(quad_between(box_sides({1, -1}, {-1, 1})).visible) << "crossed";
    EXPECT_FALSE(quad_between(QuadSides<double>{box[0], box[0], box[2], box[3]}).visible) << "one side twice";
    EXPECT_FALSE(quad_between(QuadSides<double>{V3(0), box[1], box[2], box[3]}).visible) << "no side";
    EXPECT_FALSE(quad_between(QuadSides<double>{V3(nan), box[1], box[2], box[3]}).visible) << "no number";
    QuadSides<double> const wedge{side({-1, 0}, {1, 0.8}), side({1, 0}, {-1, 0.8}), box[2], side({0, 30}, {0, -1})};
    EXPECT_FALSE(quad_between(wedge).visible) << "a warp beyond its limit";
    EXPECT_TRUE(quad_between(wedge, 1e3).visible);
    QuadSides<double> const leaning{side({-1, 0}, {1, -1.5}), side({1, 0}, {-1, 1.5}), box[2], box[3]};
    EXPECT_FALSE(quad_between(leaning).visible) << "a shear beyond its limit";
    EXPECT_TRUE(quad_between(leaning, 8.0, 2.0).visible);
}

TEST(QuadMap, TexelsAreGainedAsByDifferences) {
    Quad<double> const quad = quad_between(lopsided());
    auto const texel = [&](V2 p) {
        V3 const h(p, 1);
        return V2(glm::dot(quad.x, h), glm::dot(quad.y, h)) / glm::dot(quad.w, h) * 512.0;
    };
    V2 const p(1.0, 0.5);
    QuadGain<double> const gain = gain_at(quad, 1024.0, p);
    constexpr double h = 1e-6;
    EXPECT_NEAR(glm::length((texel(p + V2(h, 0)) - texel(p - V2(h, 0))) / (2 * h) - gain.x), 0.0, 1e-5);
    EXPECT_NEAR(glm::length((texel(p + V2(0, h)) - texel(p - V2(0, h))) / (2 * h) - gain.y), 0.0, 1e-5);
}

TEST(QuadMap, OfNoQuadrilateralServesNothing) {
    ShadowMap<double> const map = quad_map(Quad<double>{}, light_basis(V3(0, -1, 0)), V3(0.0), 0.0, 1.0,
                                           Aabb<double>{V3(-1.0), V3(1.0)}, 512, 2.0, gl_clip);
    EXPECT_FALSE(map.visible);
    EXPECT_FALSE(map.faults.any());
    EXPECT_EQ(map.clip_from_world, nowhere<double>());
}

TEST(QuadMap, IsAMapOfItsLightInEveryConvention) {
    Light<double> const light = directional(V3(0.3, -0.8, 0.5));
    LightBasis<double> const basis = light_basis(light.direction);
    Aabb<double> const world{V3(-500), V3(500)};
    Quad<double> const quad = quad_between(lopsided());
    V3 const origin(20, 3, -70);
    for (ClipSpace const clip : {gl_clip, gl_zero_to_one_clip, vulkan_clip, d3d_clip, reversed(vulkan_clip)}) {
        ShadowMap<double> const map = quad_map(quad, basis, origin, -2.0, 9.0, world, 1024, 2.0, clip);
        ASSERT_TRUE(map.visible);
        EXPECT_TRUE(laws::is_map_of(map.clip_from_world, light, clip, 512));
        for (V2 const& corner : quad.corner)
            for (double const depth : {-2.0, 9.0, -300.0}) {
                V3 const point = origin + basis.x * corner.x + basis.y * corner.y + basis.depth * depth;
                EXPECT_TRUE(laws::holds(map.clip_from_world, clip, point, 4.0 / 1024.0 - 1e-9)) << depth;
            }
    }
}

// A sheared map's texels are longer than their sides are apart. Where a plane's slope was cut to what the sides alone
// would give, it shadowed itself in stripes.
TEST(QuadMap, APlaneInAShearedMapKeepsItsSlope) {
    Light<double> const light = directional(V3(0, -1, 0));
    QuadSides<double> const leaning{side({-1, 0}, {1, -3}), side({1, 0}, {-1, 3}), V3(0, 1, 1), V3(0, -1, 1)};
    Quad<double> const quad = quad_between(leaning, 8.0, 10.0);
    ASSERT_TRUE(quad.visible);
    ShadowMap<double> const map = quad_map(quad, light_basis(light.direction), V3(0), -1.0, 1.0,
                                           Aabb<double>{V3(-5), V3(5)}, 1024, 2.0, gl_zero_to_one_clip);
    MapBias<double> const bias = bias_for(map, light, 1024, BiasOptions<double>{});
    V3 const steep(std::sin(1.45), std::cos(1.45), 0.0);  // a tangent of 8, of the 20 that slopes are believed to
    DepthSlope<double> const believed = slope(map, 1024, V3(0), steep, bias.slope_limit);
    DepthSlope<double> const whole = slope(map, 1024, V3(0), steep, 1.0);
    EXPECT_EQ(believed.x, whole.x);
    EXPECT_EQ(believed.y, whole.y);
}

TEST(QuadGain, AtItsHorizonIsNoneAndRaisesNoFlag) {
    Quad<double> quad;
    quad.x = V3(1, 0, 0);
    quad.y = V3(0, 1, 0);
    quad.w = V3(0, 1, 0);
    auto const there = test::watched([&] { return gain_at(quad, 1000.0, V2(0.5, 0.0)); });
    EXPECT_EQ(there.raised, 0);
    EXPECT_EQ(there.result.x, V2(0.0));
    EXPECT_EQ(there.result.y, V2(0.0));
    EXPECT_EQ(gain_at(quad, 1000.0, V2(0.5, 1.0)).x, V2(500.0, 0.0));
}

TEST(QuadMap, MayBeAsSmallAsItLikes) {
    for (double const size : {1e-4, 1e-2, 1e3}) {
        Quad<double> const quad = quad_between(box_sides(V2(-size), V2(2 * size)));
        ASSERT_TRUE(quad.visible) << size;
        EXPECT_NEAR(quad.w_least, 1.0, 1e-12);
        EXPECT_NEAR(area(quad) / (9 * size * size), 1.0, 1e-12);
    }
}

TEST(QuadMap, IsNoneWhereOneSideIsTurnedAround) {
    for (std::size_t k = 0; k < 4; ++k) {
        QuadSides<double> sides = lopsided();
        sides[k] = -sides[k];
        EXPECT_FALSE(quad_between(sides).visible) << k;
    }
}

// Texels at a corner have the angle at which its two sides meet: the sharpest of the four decides, wherever it is.
TEST(QuadMap, IsRefusedByItsSharpestCornerWhicheverThatIs) {
    for (V2 const& mirror : {V2(1, 1), V2(-1, 1), V2(1, -1), V2(-1, -1)}) {
        QuadSides<double> sides{side({-3, 0}, {1, 0.1}), side({5, 1}, {-1, 0.3}), side({0, -2}, {0.1, 1}),
                                side({1, 4}, {0.4, -1})};
        for (V3& s : sides) s = V3(s.x * mirror.x, s.y * mirror.y, s.z);
        if (mirror.x < 0) std::swap(sides[0], sides[1]);
        if (mirror.y < 0) std::swap(sides[2], sides[3]);
        double worst = 1.0;
        for (std::size_t i = 0; i < 4; ++i) {
            V2 const a = glm::normalize(V2(sides[i & 1u])), b = glm::normalize(V2(sides[2 + (i >> 1)]));
            worst = std::max(worst, 1.0 / std::abs(a.x * b.y - a.y * b.x));
        }
        EXPECT_TRUE(quad_between(sides, 4.0, worst * 1.0001).visible);
        EXPECT_FALSE(quad_between(sides, 4.0, worst * 0.9999).visible);
    }
}
