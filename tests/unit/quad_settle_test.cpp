// SPDX-License-Identifier: MIT
#include <shadowmath/quad_settle.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

using namespace shadowmath;

namespace {

using V2 = glm::dvec2;
using V3 = glm::dvec3;

constexpr double texels = 1020.0;

Quad<double> box(V2 lo, V2 hi) {
    V2 const middle = (lo + hi) * 0.5;
    lo -= middle;
    hi -= middle;
    return moved(quad_between<double>({V3(1, 0, -lo.x), V3(-1, 0, hi.x), V3(0, 1, -lo.y), V3(0, -1, hi.y)}), middle);
}

// Twenty by ten squares, a sample in the middle of each, and nine pieces: more than are looked at before the end. Those
// to the left of `fine_to` are seen from nearby. The first map holds what lies left of `cut`, the second one the rest.
struct Field {
    std::unique_ptr<MapSearch<double>> work = std::make_unique<MapSearch<double>>();
    std::vector<std::array<V3, 4>> pieces;
    detail::QuadStack<double> stack;

    Field(double fine_to, double cut) {
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 20; ++x) {
                V2 const lo(x, y), middle = lo + 0.5;
                LightSample<double> sample;
                sample.place = middle;
                sample.seen = V3(middle, 1.0);
                double const pixels = middle.x < fine_to ? 1000.0 : 50.0;
                sample.gain_x = V2(pixels, 0);
                sample.gain_y = V2(0, pixels);
                sample.usable = true;
                work->sample[unsigned(work->count++)] = sample;
                for (int part = 0; part < 9; ++part) {
                    V2 const a = lo + V2(part % 3, part / 3) / 3.0, b = a + 1.0 / 3.0;
                    pieces.push_back({V3(a, 0), V3(b.x, a.y, 0), V3(a.x, b.y, 0), V3(b, 0)});
                }
            }
        stack.count = 2;
        stack.part[0].hi.x = cut;
        stack.part[1].lo.x = cut;
        stack.quad[0] = box(V2(-0.01, -0.01), V2(cut + 0.01, 10.01));
        stack.quad[1] = box(V2(cut - 0.01, -0.01), V2(20.01, 10.01));
    }

    [[nodiscard]] auto cover() const {
        return [this](ViewPart<double> const& part, auto const& visit) {
            for (auto const& piece : pieces)
                if (is_in(part, piece[0] * 0.5 + piece[3] * 0.5)) visit(piece.data(), 4);
        };
    }
    [[nodiscard]] detail::QuadStack<double> settled() {
        double before = price(stack);
        return detail::settled(*work, stack, texels, cover(), before);
    }
    [[nodiscard]] double price(detail::QuadStack<double> const& of) const { return price_in(of, *work, texels); }
};

}  // namespace

TEST(QuadSettle, EveryPieceIsInOneOfTheMapsWhole) {
    for (double const fine_to : {3.0, 8.0, 14.0})
        for (double const cut : {4.0, 9.0, 16.0}) {
            Field field(fine_to, cut);
            auto const settled = field.settled();
            for (auto const& piece : field.pieces)
                EXPECT_GE(settled.holder(piece.data(), 4), 0) << fine_to << ", " << cut << ": " << piece[0].x;
        }
}

TEST(QuadSettle, NeverCostsMore) {
    for (double const fine_to : {3.0, 8.0, 14.0})
        for (double const cut : {4.0, 9.0, 16.0}) {
            Field field(fine_to, cut);
            EXPECT_LE(field.price(field.settled()), field.price(field.stack)) << fine_to << ", " << cut;
        }
}

// The first map reaches beyond what is seen from nearby, and gives it up; or not as far, and takes it in.
TEST(QuadSettle, WhatLiesOnTheWrongSideOfACutChangesHands) {
    for (double const cut : {6.0, 12.0}) {
        Field field(8.0, cut);
        auto const settled = field.settled();
        EXPECT_LT(field.price(settled), 0.85 * field.price(field.stack)) << cut;
        Field right(8.0, 8.0);
        EXPECT_LT(field.price(settled), 1.1 * field.price(right.stack)) << cut;
    }
}

TEST(QuadSettle, OfOneMapIsThatMap) {
    Field field(8.0, 8.0);
    field.stack.quad[0] = field.stack.quad[1];
    field.stack.count = 1;
    auto const settled = field.settled();
    EXPECT_EQ(settled.count, 1);
    EXPECT_EQ(settled.quad[0].x, field.stack.quad[0].x);
}

// Of a piece of more points than are kept its outline is.
TEST(QuadSettle, APieceOfManyPointsIsHeldWhole) {
    Field field(8.0, 12.0);
    std::array<V3, 9> many{};
    for (int i = 0; i < 9; ++i) many[unsigned(i)] = V3(11.9 - 0.2 * i, i, 0);
    auto const cover = [&](ViewPart<double> const& part, auto const& visit) {
        field.cover()(part, visit);
        if (is_in(part, V3(11.9, 5, 1))) visit(many.data(), 9);
    };
    double price = field.price(field.stack);
    auto const settled = detail::settled(*field.work, field.stack, texels, cover, price);
    EXPECT_GE(settled.holder(many.data(), 9), 0);
    EXPECT_LT(field.price(settled), field.price(field.stack));
    EXPECT_EQ(field.price(settled), price);
}

TEST(QuadSettle, AnOutlineTouchesItsPointsInEightDirections) {
    std::array<V3, 12> points{};
    for (unsigned i = 0; i < 12; ++i) points[i] = V3(3.0 + 2.0 * std::cos(0.7 * i), -1.0 + std::sin(1.9 * i), 5.0);
    SettlingPiece<double> piece;
    piece.count = 8;
    detail::outline(piece, points.data(), 12);
    for (int k = 0; k < 8; ++k) {
        V2 const way(std::cos(0.78539816339744831 * k), std::sin(0.78539816339744831 * k));
        double of_points = -1e9, of_outline = -1e9;
        for (V3 const& p : points) of_points = std::fmax(of_points, glm::dot(way, V2(p)));
        for (V2 const& p : piece.point) of_outline = std::fmax(of_outline, glm::dot(way, p));
        EXPECT_NEAR(of_outline, of_points, 1e-12) << k;
    }
}
