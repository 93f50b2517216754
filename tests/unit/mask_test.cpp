// SPDX-License-Identifier: MIT
#include "tests/laws/mask.hpp"

#include <gtest/gtest.h>

#include <bitset>
#include <set>

using namespace shadowmath;

namespace {

using Best = BestLanes<float>;

PixelLine<float> line(double angle, double r) {
    double const x = std::cos(angle), y = std::sin(angle);
    return {static_cast<float>(-(x + y) / 2 - r), static_cast<float>(x), static_cast<float>(y)};
}

}  // namespace

TEST(PixelSamples, AreTheHaltonPointsFromTheFirstOn) {
    EXPECT_EQ(pixel_samples<double>.u[0], 0.5);
    EXPECT_EQ(pixel_samples<double>.u[1], 0.25);
    EXPECT_EQ(pixel_samples<double>.u[2], 0.75);
    EXPECT_EQ(pixel_samples<double>.v[0], 1.0 / 3.0);
    EXPECT_DOUBLE_EQ(pixel_samples<double>.v[1], 2.0 / 3.0);
    EXPECT_DOUBLE_EQ(pixel_samples<double>.v[2], 1.0 / 9.0);
    EXPECT_DOUBLE_EQ(radical_inverse<double>(2, 6), 0.375);
    std::set<std::pair<double, double>> places;
    for (int i = 0; i < samples_per_pixel; ++i) {
        double const u = pixel_samples<double>.u[i], v = pixel_samples<double>.v[i];
        EXPECT_TRUE(u > 0.0 && u < 1.0 && v > 0.0 && v < 1.0);
        places.insert({u, v});
    }
    EXPECT_EQ(places.size(), 32u);
}

TEST(HalfPlaneMask, HoldsTheSamplesOnTheInnerSideInOrder) {
    std::uint32_t const right = half_plane_mask<PlainLanes<double>>(PixelLine<double>{-0.5, 1.0, 0.0});
    for (int i = 0; i < samples_per_pixel; ++i)
        EXPECT_EQ((right >> i & 1u) != 0, pixel_samples<double>.u[i] >= 0.5) << i;
    EXPECT_EQ(half_plane_mask<Best>(PixelLine<float>{0.0f, 0.0f, 0.0f}), every_sample);
    EXPECT_EQ(half_plane_mask<Best>(PixelLine<float>{-1e-30f, 0.0f, 0.0f}), 0u);
}

TEST(HalfPlaneMask, AndItsNegativeHoldEverySampleAndShareOnlyThoseOnTheLine) {
    for (int a = 0; a < 64; ++a)
        for (int j = -12; j <= 12; ++j) {
            PixelLine<float> const one = line(a * 0.0981747704, j / 16.0), other{-one.c, -one.x, -one.y};
            for (auto const mask : {half_plane_mask<Best, float>, half_plane_mask<PlainLanes<float>, float>}) {
                EXPECT_EQ(mask(one) | mask(other), every_sample);
                std::uint32_t const shared = mask(one) & mask(other);
                for (int i = 0; i < samples_per_pixel; ++i)
                    EXPECT_TRUE((shared >> i & 1u) == 0 || laws::distance_to(one, i) <= 1e-6);
            }
        }
}

TEST(HalfPlanesMask, HoldsWhatAllFourHold) {
    for (int a = 0; a < 64; ++a) {
        PixelLine<float> lines[4];
        for (int i = 0; i < 4; ++i) lines[i] = line(a * 0.0981747704 + 1.4 * i, -0.3 + 0.01 * a * (i - 1));
        std::uint32_t all = every_sample;
        for (PixelLine<float> const& one : lines) all &= half_plane_mask<Best>(one);
        EXPECT_EQ(half_planes_mask<Best>(lines), all) << a;
        EXPECT_EQ(half_planes_mask<PlainLanes<float>>(lines), all) << a;
    }
}

TEST(HalfPlaneTable, DiffersFromTheExactMaskOnlyNearTheLine) {
    HalfPlaneTable const table = half_plane_table();
    int differing = 0;
    for (int a = 0; a < 360; ++a)
        for (int j = -80; j <= 80; ++j)
            for (double const length : {1e-3, 1.0, 1e4}) {
                PixelLine<float> at = line(a * 0.01745329 + 0.001, j * 0.01);
                at = {at.c * static_cast<float>(length), at.x * static_cast<float>(length),
                      at.y * static_cast<float>(length)};
                std::uint32_t const looked_up = half_plane_mask(table, at), exact = half_plane_mask<Best>(at);
                ASSERT_TRUE(laws::differ_only_near(at, looked_up, exact, table_displacement)) << a << " " << j;
                differing += looked_up != exact ? 1 : 0;
            }
    EXPECT_GT(differing, 1000) << "a table of 1024 words cannot be exact";
    PixelLine<float> const wrong = line(0.3, 0.2);
    EXPECT_FALSE(laws::differ_only_near(wrong, half_plane_mask(table, wrong) ^ 1u, half_plane_mask<Best>(wrong), 1e-3))
        << "the law sees nothing";
}

TEST(HalfPlaneTable, KnowsWhatHasNoBorderInThePixel) {
    HalfPlaneTable const table = half_plane_table();
    EXPECT_EQ(half_plane_mask(table, PixelLine<double>{1.0, 0.0, 0.0}), every_sample);
    EXPECT_EQ(half_plane_mask(table, PixelLine<double>{0.0, 0.0, 0.0}), every_sample);
    EXPECT_EQ(half_plane_mask(table, PixelLine<double>{-1.0, 0.0, 0.0}), 0u);
    EXPECT_EQ(half_plane_mask(table, PixelLine<double>{5.0, 1.0, 1.0}), every_sample);
    EXPECT_EQ(half_plane_mask(table, PixelLine<double>{-5.0, 1.0, 1.0}), 0u);
    EXPECT_EQ(sizeof table, 4096u);
}

// Half a step of radius: that of the angle is nothing here.
TEST(HalfPlaneTable, AlongItsOwnAnglesALineMovesByHalfAStepOfRadius) {
    HalfPlaneTable const table = half_plane_table();
    double const half_step = 0.70710678118654752 / 64.0;
    PixelSamples<double> const& at = pixel_samples<double>;
    for (int k = 0; k < table_steps; ++k)
        for (int i = -70; i <= 70; ++i) {
            double const angle = (k + 0.5) * 6.283185307179586 / table_steps, r = 0.01 * i + 0.0013;
            double const x = std::cos(angle), y = std::sin(angle);
            std::uint32_t const mask = half_plane_mask(table, PixelLine<double>{-r - 0.5 * (x + y), x, y});
            for (int s = 0; s < samples_per_pixel; ++s) {
                double const inside = x * (at.u[s] - 0.5) + y * (at.v[s] - 0.5) - r;
                if (std::abs(inside) < half_step + 1e-6) continue;
                EXPECT_EQ((mask >> s & 1u) != 0, inside > 0.0) << k << ' ' << r << ' ' << s;
            }
        }
}
