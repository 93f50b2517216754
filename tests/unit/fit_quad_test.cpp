// SPDX-License-Identifier: MIT
#include "tests/laws/quad_map.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/fit_quad.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

using namespace shadowmath;

namespace {

using V2 = glm::dvec2;
using V3 = glm::dvec3;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

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

// A grid of 2 * half_x by 2 * half_y metres about the middle, turned; every metre is worth the same.
std::vector<LightSample<double>> even_rectangle(V2 middle, double half_x, double half_y, double angle) {
    std::vector<LightSample<double>> samples;
    V2 const a(std::cos(angle), std::sin(angle)), b(-a.y, a.x);
    for (int y = -4; y <= 4; ++y)
        for (int x = -4; x <= 4; ++x) {
            LightSample<double> sample;
            sample.place = middle + a * (half_x * x / 4) + b * (half_y * y / 4);
            sample.gain_x = V2(500, 0);
            sample.gain_y = V2(0, 500);
            sample.usable = true;
            samples.push_back(sample);
        }
    return samples;
}

std::vector<std::uint16_t> list_of(std::size_t count) {
    std::vector<std::uint16_t> list;
    while (list.size() < count) list.push_back(static_cast<std::uint16_t>(list.size()));
    return list;
}

Supports<double> supports_of(std::vector<LightSample<double>> const& samples) {
    auto const list = list_of(samples.size());
    Supports<double> supports = no_supports(frame_of(samples.data(), list.data(), int(list.size())));
    for (auto const& sample : samples) add(supports, sample);
    return supports;
}

Quad<double> box(V2 lo, V2 hi) {
    return quad_between(QuadSides<double>{V3(1, 0, -lo.x), V3(-1, 0, hi.x), V3(0, 1, -lo.y), V3(0, -1, hi.y)});
}

bool are_same(QuadFit<double> const& a, QuadFit<double> const& b) {
    return a.quad.x == b.quad.x && a.quad.y == b.quad.y && a.quad.w == b.quad.w && a.direction == b.direction &&
           a.price == b.price && a.quad.visible == b.quad.visible;
}

}  // namespace

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
    EXPECT_LT(price_of(1e6), 30.2) << "lost is lost";
    EXPECT_LT(price_of(1e6) - price_of(150.0), 0.7) << "and no more than that";
}

TEST(FitQuad, PricesAtTheEndsOfTheScaleAreThoseWrittenDown) {
    EXPECT_DOUBLE_EQ(price_of(0.0), 0.0);
    EXPECT_DOUBLE_EQ(price_of(1.4), 0.14);
    EXPECT_DOUBLE_EQ(price_of(31.4), 0.14 + 30.0 / std::sqrt(2.0)) << "30 pixels more: most of what is lost";
}

// 4 m by 2 m in 1000 texels, at 500 eye pixels a metre: texels of 2 by 1 pixels.
TEST(FitQuad, ATexelOfABoxIsAsLongAsItsLongerSide) {
    LightSample<double> sample;
    for (double const angle : {0.0, 0.4, 2.0}) {
        sample.gain_x = V2(std::cos(angle), std::sin(angle)) * 500.0;
        sample.gain_y = V2(-std::sin(angle), std::cos(angle)) * 500.0;
        EXPECT_NEAR(major_at(box({-2, -1}, {2, 1}), 1000.0, sample), 2.0, 1e-12);
    }
    sample.gain_x *= 1e-9, sample.gain_y *= 1e-9;
    EXPECT_NEAR(major_at(box({-2, -1}, {2, 1}), 1000.0, sample), 2e-9, 1e-21) << "far below a pixel too";
    sample.gain_x = V2(0), sample.gain_y *= 1e9;
    EXPECT_NEAR(major_at(box({-2, -1}, {2, 1}), 1000.0, sample), 1.0, 1e-12) << "seen edge-on along x";
}

TEST(FitQuad, ATexelThatIsAsWideAsItIsLongHasThatLength) {
    LightSample<double> sample;
    sample.gain_x = V2(0.5, 0);
    sample.gain_y = V2(0, 0.5);
    EXPECT_NEAR(major_at(box({-1, -1}, {1, 1}), 1.0, sample), 1.0, 1e-12) << "two metres at half a pixel each";
}

TEST(FitQuad, TheFrameReachesToTheEndsOfTheCells) {
    LightSample<double> const sample = sample_at({3, 4}, {0.5, 0.25});
    std::uint16_t const list[] = {0, 0, 0};
    SampleFrame<double> const frame = frame_of(&sample, list, 3);
    EXPECT_NEAR(glm::length(frame.a - V2(2, 0)), 0.0, 1e-12);
    EXPECT_NEAR(glm::length(frame.b - V2(0, 4)), 0.0, 1e-12);
}

TEST(FitQuad, TheMajorAxisIsTheLongestImageOfAnyTexelLength) {
    Quad<double> const quad =
        quad_between(QuadSides<double>{V3(1, 0.2, 3), V3(-1, 0.1, 4.9), V3(0.1, 1, 2), V3(-0.2, -1, 4.2)});
    ASSERT_TRUE(quad.visible);
    LightSample<double> sample = sample_at({0.7, 1.1});
    sample.gain_x = V2(300, 120);
    sample.gain_y = V2(-80, 150);
    QuadGain<double> const map = gain_at(quad, 512.0, sample.place);
    glm::dmat2 const pixels_per_texel =
        glm::dmat2(sample.gain_x, sample.gain_y) * glm::inverse(glm::dmat2(map.x, map.y));
    double longest = 0.0;
    for (int i = 0; i < 20000; ++i) {
        double const angle = 3.14159265358979 * i / 20000;
        longest = std::max(longest, glm::length(pixels_per_texel * V2(std::cos(angle), std::sin(angle))));
    }
    EXPECT_NEAR(major_at(quad, 512.0, sample), longest, 1e-7 * longest);
}

TEST(FitQuad, AMapWithoutExtentOrASampleOfNoNumberCountsAsLost) {
    LightSample<double> const sample = sample_at({0, 0});
    EXPECT_EQ(major_at(Quad<double>{}, 1020.0, sample), footprint_limit<double>);
    Quad<double> const quad = box({-2, -1}, {2, 1});
    for (int member = 0; member < 3; ++member) {
        LightSample<double> bad = sample;
        (member == 0 ? bad.place : member == 1 ? bad.gain_x : bad.gain_y).x = no_number;
        EXPECT_EQ(major_at(quad, 1020.0, bad), footprint_limit<double>) << member;
    }
}

TEST(FitQuad, TheFrameHasTheSamplesAxesAndOneUnitToTheirEnds) {
    V2 const middle(40, -7), a(std::cos(0.5), std::sin(0.5)), b(-a.y, a.x);
    auto const samples = even_rectangle(middle, 6.0, 1.5, 0.5);
    auto const list = list_of(samples.size());
    SampleFrame<double> const frame = frame_of(samples.data(), list.data(), int(list.size()));
    EXPECT_NEAR(glm::length(frame.middle - middle), 0.0, 1e-12);
    EXPECT_NEAR(std::abs(glm::dot(frame.a, a)), 1.0 / 6.0, 1e-12);
    EXPECT_NEAR(std::abs(glm::dot(frame.b, b)), 1.0 / 1.5, 1e-12);
    EXPECT_NEAR(glm::dot(frame.a, b), 0.0, 1e-12);
    EXPECT_NEAR(glm::dot(frame.b, a), 0.0, 1e-12);
}

TEST(FitQuad, TheFrameOfNoneOrOfOnePlaceIsFinite) {
    SampleFrame<double> const none = frame_of<double>(nullptr, nullptr, 0);
    EXPECT_EQ(none.a, V2(1, 0));
    EXPECT_EQ(none.b, V2(0, 1));
    LightSample<double> const sample = sample_at({3, 4});
    std::uint16_t const list[] = {0, 0, 0};
    SampleFrame<double> const one = frame_of(&sample, list, 3);
    EXPECT_EQ(one.middle, V2(3, 4));
    EXPECT_TRUE(all_finite(one.a) && all_finite(one.b));
    EXPECT_GT(glm::length(one.a), 0.0);
}

TEST(FitQuad, TheFrameOfALineIsTenThousandTimesAsLongAsWide) {
    auto const samples = even_rectangle(V2(3, 4), 5.0, 0.0, 0.0);
    auto const list = list_of(samples.size());
    SampleFrame<double> const frame = frame_of(samples.data(), list.data(), int(list.size()));
    EXPECT_NEAR(glm::length(frame.a), 1.0 / 5.0, 1e-12);
    EXPECT_NEAR(glm::length(frame.b), 1e4 / 5.0, 1e-9);
}

TEST(FitQuad, DirectionsRunFromOneAxisOfTheFrameToTheOther) {
    SampleFrame<double> const frame{V2(0), V2(0.5, 0), V2(0.1, 2)};
    Supports<double> const supports = no_supports(frame);
    EXPECT_NEAR(glm::length(supports.direction[0] - frame.a), 0.0, 1e-15);
    EXPECT_NEAR(glm::length(supports.direction[quad_directions / 4] - frame.b), 0.0, 1e-15);
}

TEST(FitQuad, SupportsAreTheFarthestPlacesInAnyOrder) {
    Cloud const cloud;
    Supports<double> backward = no_supports(cloud.supports.frame), corners = backward;
    for (std::size_t i = cloud.samples.size(); i-- > 0;) add(backward, cloud.samples[i]);
    for (auto const& sample : cloud.samples)
        for (double const a : {-1.0, 1.0})
            for (double const b : {-1.0, 1.0}) add(corners, sample.place + a * sample.reach_x + b * sample.reach_y);
    EXPECT_EQ(backward.reach, cloud.supports.reach) << "not by a bit";
    for (unsigned i = 0; i < unsigned(quad_directions); ++i)
        EXPECT_NEAR(corners.reach[i], cloud.supports.reach[i], 1e-13) << "a cell is its four corners";
}

TEST(FitQuad, APlaceThatIsNoNumberMovesNoSide) {
    Cloud const cloud;
    Supports<double> with = cloud.supports;
    add(with, V2(no_number, 0));
    add(with, V2(1, no_number));
    EXPECT_EQ(with.reach, cloud.supports.reach);
    Supports<double> alone = no_supports(SampleFrame<double>{});
    add(alone, V2(no_number));
    EXPECT_FALSE(quad_at(alone, {32, 0, 48, 16}).visible);
    EXPECT_FALSE(fit_quad(alone, cloud.samples.data(), cloud.list.data(), int(cloud.list.size()), 1020.0).quad.visible);
}

// Nothing is gained by a warp or a shear where a metre is worth the same all over.
TEST(FitQuad, OfAnEvenRectangleIsTheRectangleAtItsAngle) {
    for (double const angle : {0.0, 0.3, 1.2})
        for (double const half_y : {1.0, 2.5}) {
            V2 const middle(100, -30), a(std::cos(angle), std::sin(angle)), b(-a.y, a.x);
            auto const samples = even_rectangle(middle, 3.0, half_y, angle);
            auto const list = list_of(samples.size());
            QuadFit<double> const fit =
                fit_quad(supports_of(samples), samples.data(), list.data(), int(list.size()), 1000.0);
            ASSERT_TRUE(fit.quad.visible);
            EXPECT_NEAR(area(fit.quad), 12.0 * half_y, 12.0 * half_y * 2.1e-4);
            EXPECT_NEAR(fit.quad.w_least, 1.0, 1e-9);
            for (V2 const& corner : fit.quad.corner) {
                EXPECT_NEAR(std::abs(glm::dot(corner - middle, a)), 3.0, 3.0 * 1.1e-4);
                EXPECT_NEAR(std::abs(glm::dot(corner - middle, b)), half_y, half_y * 1.1e-4);
            }
            double const texel_pixels = std::max(3.0, half_y) * 2.0 / 1000.0 * 500.0;
            EXPECT_NEAR(fit.price, double(samples.size()) * price_of(texel_pixels), 1e-3 * fit.price);
        }
}

TEST(FitQuad, OfNoSamplesButPlacesIsTheSmallestAroundThem) {
    Cloud const cloud;
    QuadFit<double> const fit = fit_quad(cloud.supports, cloud.samples.data(), cloud.list.data(), 0, 1020.0);
    ASSERT_TRUE(fit.quad.visible);
    EXPECT_DOUBLE_EQ(fit.price, area(fit.quad));
    for (auto const& sample : cloud.samples) EXPECT_TRUE(is_in(fit.quad, sample.place));
    for (int r = 0; r < 16; ++r) {
        Quad<double> const rectangle = quad_at(cloud.supports, {r + 32, r, r + 48, r + 16});
        EXPECT_TRUE(!rectangle.visible || fit.price <= area(rectangle)) << r;
    }
    EXPECT_LE(area(fit.quad), area(cloud.fit().quad));
}

TEST(FitQuad, AStrideLeavesSamplesOutOfThePriceNeverOutOfTheMap) {
    Cloud const cloud;
    for (int const stride : {2, 7, 144, 1000}) {
        QuadFit<double> const fit =
            fit_quad(cloud.supports, cloud.samples.data(), cloud.list.data(), int(cloud.list.size()), 1020.0, stride);
        ASSERT_TRUE(fit.quad.visible) << stride;
        for (auto const& sample : cloud.samples) EXPECT_TRUE(is_in(fit.quad, sample.place)) << stride;
    }
    double const half =
        fit_quad(cloud.supports, cloud.samples.data(), cloud.list.data(), int(cloud.list.size()), 1020.0, 2).price;
    EXPECT_NEAR(half / cloud.fit().price, 1.0, 0.1) << "every other sample counts twice";
}

TEST(FitQuad, SamplesWithoutAWeightAreHeldAndCostNothing) {
    Cloud cloud;
    double const all = cloud.fit().price;
    for (double const weight : {0.0, -1.0, no_number}) {
        Cloud light = cloud;
        for (std::size_t i = 1; i < light.samples.size(); i += 2) light.samples[i].weight = weight;
        QuadFit<double> const fit = light.fit();
        ASSERT_TRUE(fit.quad.visible);
        EXPECT_LT(fit.price, 0.7 * all);
        for (auto const& sample : light.samples) EXPECT_TRUE(is_in(fit.quad, sample.place));
    }
}

TEST(FitQuad, OfALineAndOfOnePlaceHoldsThem) {
    for (V2 const step : {V2(1, 0), V2(0.6, 0.8), V2(0)}) {
        std::vector<LightSample<double>> samples;
        for (int i = 0; i < 9; ++i) samples.push_back(sample_at(V2(50, 20) + step * double(i)));
        auto const list = list_of(samples.size());
        QuadFit<double> const fit =
            fit_quad(supports_of(samples), samples.data(), list.data(), int(list.size()), 1020.0);
        ASSERT_TRUE(fit.quad.visible);
        for (auto const& sample : samples) EXPECT_TRUE(is_in(fit.quad, sample.place));
    }
}

TEST(FitQuad, TheSameSamplesGiveTheSameMapWithoutTheHeap) {
    Cloud const cloud;
    auto const once = test::watched([&] { return cloud.fit(); });
    EXPECT_TRUE(once.calm_in_range());
    EXPECT_TRUE(are_same(once.result, cloud.fit()));
}
