// SPDX-License-Identifier: MIT
#include "tests/laws/quad_map.hpp"
#include "tests/laws/shadow_map.hpp"

#include <shadowmath/bias.hpp>
#include <shadowmath/fit_quad.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

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

LightSample<double> sample_at(V2 place, V2 reach = V2(0)) {
    LightSample<double> sample;
    sample.place = place;
    sample.gain_x = V2(40.0 / (8.0 + place.y), 0.0);
    sample.gain_y = V2(0.0, 40.0 / (8.0 + place.y));
    sample.reach_x = V2(reach.x, 0.0);
    sample.reach_y = V2(0.0, reach.y);
    sample.usable = true;
    return sample;
}

struct Cloud {
    std::vector<LightSample<double>> samples;
    std::vector<std::uint16_t> list;
    Supports<double> supports;

    Cloud() {
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 12; ++x) {
                // A wedge that opens toward +y, leaning to the right.
                double const depth = y * 1.5, half = 2.0 + 0.6 * depth;
                samples.push_back(sample_at({0.3 * depth + half * (x / 5.5 - 1.0), depth}, {0.05, 0.1}));
                list.push_back(static_cast<std::uint16_t>(list.size()));
            }
        supports = no_supports(frame_of(samples.data(), list.data(), int(list.size())));
        for (auto const& sample : samples) add(supports, sample);
    }
    [[nodiscard]] QuadFit<double> fit() const {
        return fit_quad(supports, samples.data(), list.data(), int(list.size()), 1020.0);
    }
    [[nodiscard]] double price(Quad<double> const& quad) const {
        double sum = 0.0;
        for (auto const& sample : samples) sum += price_of(major_at(quad, 1020.0, sample));
        return sum;
    }
};

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

TEST(FitQuad, HoldsEverySampleWithItsWholeCell) {
    Cloud const cloud;
    QuadFit<double> const fit = cloud.fit();
    ASSERT_TRUE(fit.quad.visible);
    EXPECT_TRUE(laws::fills_the_square(fit.quad));
    for (auto const& sample : cloud.samples)
        for (double const a : {-1.0, 1.0})
            for (double const b : {-1.0, 1.0})
                EXPECT_TRUE(is_in(fit.quad, sample.place + a * sample.reach_x + b * sample.reach_y));
}

TEST(FitQuad, CostsNoMoreThanTheBestRectangleAndThanAnySideTurnedAlone) {
    Cloud const cloud;
    QuadFit<double> const fit = cloud.fit();
    EXPECT_NEAR(fit.price, cloud.price(fit.quad), 1e-9 * fit.price);
    auto const price_at = [&](std::array<int, 4> direction) {
        Quad<double> const quad = quad_at(cloud.supports, direction);
        return quad.visible ? cloud.price(quad) : std::numeric_limits<double>::max();
    };
    double least = std::numeric_limits<double>::max();
    for (int r = 0; r < 16; ++r) least = std::min(least, price_at({r + 32, r, r + 48, r + 16}));
    EXPECT_LT(fit.price, 0.9 * least) << "a wedge that opens away from the eye is worth a warp";
    for (unsigned k = 0; k < 4; ++k)
        for (int const turn : {-1, 1}) {
            std::array<int, 4> moved = fit.direction;
            moved[k] += turn;
            EXPECT_GE(price_at(moved), fit.price * 0.999);
        }
}

TEST(FitQuad, OfNothingIsNothing) {
    Supports<double> const none = no_supports(SampleFrame<double>{});
    EXPECT_FALSE(fit_quad(none, static_cast<LightSample<double> const*>(nullptr), nullptr, 0, 1020.0).quad.visible);
}

TEST(FitQuad, PricesATexelByThePixelsThatComeOutWrong) {
    double last = -1.0;
    for (double major = 0.01; major < 1e6; major *= 1.1) {
        double const price = price_of(major);
        EXPECT_GT(price, last);
        last = price;
    }
    EXPECT_LT(price_of(1e6), 61.0) << "lost is lost";
}
