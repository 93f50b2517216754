// SPDX-License-Identifier: MIT
#include <shadowmath/quad_settle.hpp>

#include <gtest/gtest.h>

#include <algorithm>
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

// The first map lies around two groups, what is seen from nearby and a strip beside the second map, and around the gap
// between them, of which settling looks at no piece before the end, or (`turn`) at no other piece of the first map.
struct Gap {
    std::unique_ptr<MapSearch<double>> work = std::make_unique<MapSearch<double>>();
    std::vector<std::array<V3, 4>> first, second;  // pieces of the two parts
    detail::QuadStack<double> stack;

    Gap() {
        constexpr double row = 0.05, width = 0.125;
        std::vector<V2> groups, gap;
        for (int y = 0; y < 20; ++y) {
            for (double const x : {0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 11.0, 11.5}) groups.emplace_back(x, y * row);
            for (int x = 0; x < 8; ++x) second.push_back(piece({12.0 + x * width, y * row}, {width, row}));
        }
        for (double x = 10.75; x >= 3.0; x -= width)
            for (int y = 4; y < 16; ++y) gap.emplace_back(x, y * row);
        // One in three is looked at.
        for (std::size_t i = 0; i < gap.size(); ++i) {
            if (i % 2 == 0) first.push_back(piece(groups[i / 2 % groups.size()], {0.5, row}));
            first.push_back(piece(gap[i], {2.0 * width, row}));
        }
        for (V2 const& at : groups) sample(at + V2(0.25, 0.5 * row), at.x < 3.0 ? 500.0 : 50.0);
        for (auto const& of_second : second) sample(V2(of_second[0] + of_second[3]) * 0.5, 100.0);
        stack.count = 2;
        stack.part[0].hi.x = 12.0;
        stack.part[1].lo.x = 12.0;
        stack.quad[0] = box(V2(-0.01, -0.01), V2(12.01, 1.01));
        stack.quad[1] = box(V2(11.99, -0.01), V2(13.01, 1.01));
    }

    static std::array<V3, 4> piece(V2 const& at, V2 const& size) {
        return {V3(at, 0), V3(at.x + size.x, at.y, 0), V3(at.x, at.y + size.y, 0), V3(at + size, 0)};
    }
    void sample(V2 const& place, double pixels) {
        LightSample<double> one;
        one.place = place;
        one.seen = V3(place, 1.0);
        one.gain_x = V2(pixels, 0);
        one.gain_y = V2(0, pixels);
        one.usable = true;
        work->sample[unsigned(work->count++)] = one;
    }
    [[nodiscard]] double price() const { return price_in(stack, *work, texels); }
    void settle(unsigned turn) {
        auto const cover = [this, turn](ViewPart<double> const& part, auto const& visit) {
            auto const& all = part.hi.x == 12.0 ? first : second;
            for (std::size_t i = 0; i < all.size(); ++i) visit(all[(i + turn) % all.size()].data(), 4);
        };
        double before = price();
        stack = detail::settled(*work, stack, texels, cover, before);
    }
};

// Four strips beside each other, each with a map and its samples; as many pieces as are asked for.
struct Strips {
    std::unique_ptr<MapSearch<double>> work = std::make_unique<MapSearch<double>>();
    std::array<std::vector<std::array<V3, 4>>, 4> pieces;
    detail::QuadStack<double> stack;

    explicit Strips(std::array<int, 4> const& count, int samples = 400) {
        for (int i = 0; i < samples; ++i) {
            LightSample<double> sample;
            sample.place = V2(0.04 * (i % 100) + 0.02, (i / 100 + 0.5) * 400.0 / samples);
            sample.seen = V3(sample.place, 1.0);
            sample.gain_x = V2(sample.place.x < 1.5 ? 400.0 : 50.0, 0);
            sample.gain_y = V2(0, sample.gain_x.x);
            sample.usable = true;
            work->sample[unsigned(work->count++)] = sample;
        }
        stack.count = 4;
        for (unsigned k = 0; k < 4; ++k) {
            stack.part[k].lo.x = k;
            stack.part[k].hi.x = k + 1.0;
            stack.quad[k] = box(V2(k - 0.01, -0.01), V2(k + 1.01, 4.01));
            for (int i = 0; i < count[k]; ++i) {
                V2 const lo(k + (i % 10) * 0.1, 4.0 * (i / 10) / (count[k] / 10 + 1.0)), hi = lo + V2(0.1, 0.001);
                pieces[k].push_back({V3(lo, 0), V3(hi.x, lo.y, 0), V3(lo.x, hi.y, 0), V3(hi, 0)});
            }
        }
    }
    [[nodiscard]] auto cover() const {
        return [this](ViewPart<double> const& part, auto const& visit) {
            for (auto const& piece : pieces[unsigned(part.lo.x)]) visit(piece.data(), 4);
        };
    }
    [[nodiscard]] detail::QuadStack<double> settled() {
        double before = price_in(stack, *work, texels);
        return detail::settled(*work, stack, texels, cover(), before);
    }
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

// Of fields where every move helps. That nothing is lost where moves only seem to help is the next test.
TEST(QuadSettle, NeverCostsMore) {
    for (double const fine_to : {3.0, 8.0, 14.0})
        for (double const cut : {4.0, 9.0, 16.0}) {
            Field field(fine_to, cut);
            EXPECT_LE(field.price(field.settled()), field.price(field.stack)) << fine_to << ", " << cut;
        }
}

// Once settled, the first map could be a quarter as long if the gap were not there. Settling that sees no piece of it
// makes it so, must take the gap in at the end, and then has lost more than it gained: it goes back.
TEST(QuadSettle, IsUndoneWhereWhatWasNotLookedAtCostsMoreThanTheMovesSaved) {
    Gap gap;
    double const apart = gap.price();
    gap.settle(1);
    auto const quads = gap.stack.quad;
    double const together = gap.price();
    EXPECT_LT(together, 0.1 * apart);
    gap.settle(0);
    EXPECT_LE(gap.price(), together);
    for (unsigned k = 0; k < 2; ++k) EXPECT_EQ(gap.stack.quad[k].corner, quads[k].corner) << k;
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

TEST(QuadSettle, ASideIsMovedOutToThePointsBeyondItAndNoFarther) {
    std::array<V2, 4> const corner{V2(-2, -1), V2(3, -2), V2(-1, 4), V2(4, 2)};
    // The last one is not counted.
    std::array<V3, 4> const points{V3(-3, 2, 9), V3(1, 1, 9), V3(4, -1, 9), V3(90, 90, 9)};
    auto sided = detail::sides_of(corner);
    auto const before = sided;
    detail::grow(sided, points.data(), 3);
    for (unsigned k = 0; k < 4; ++k) {
        double least = 0.0;
        for (unsigned i = 0; i < 3; ++i)
            least = std::fmin(least, glm::dot(before.side[k], V3(V2(points[i]) - before.middle, 1.0)));
        EXPECT_EQ(V2(sided.side[k]), V2(before.side[k]));
        EXPECT_NEAR(sided.side[k].z, least < 0.0 ? (before.side[k].z - least) * 1.0001 : before.side[k].z, 1e-12) << k;
    }
    auto const grown = detail::quad_of(sided);
    for (unsigned i = 0; i < 3; ++i) EXPECT_TRUE(is_in(grown, V2(points[i]))) << i;
}

TEST(QuadSettle, InNoRoundsNothingMoves) {
    Field field(8.0, 12.0);
    detail::take_pieces(*field.work, field.stack, field.cover());
    detail::Settling<double> settling(*field.work, field.stack, texels);
    settling.run(0);
    for (unsigned k = 0; k < 2; ++k) EXPECT_EQ(settling.stack().quad[k].corner, field.stack.quad[k].corner) << k;
}

TEST(QuadSettle, OnlyTheRatioOfWeightsCounts) {
    Field field(3.0, 9.0);
    auto const settled = field.settled();
    for (auto& sample : field.work->sample) sample.weight *= 0x1p-40;
    auto const of_light = field.settled();
    for (unsigned k = 0; k < 2; ++k) EXPECT_EQ(of_light.quad[k].corner, settled.quad[k].corner) << k;
}

// Beyond the pieces, where the second map alone reaches.
TEST(QuadSettle, ASampleThatNoPieceHoldsStaysInAMap) {
    Field field(8.0, 6.0);
    auto const beyond = [](auto const& piece) { return piece[0].x >= 19.0; };
    field.pieces.erase(std::remove_if(field.pieces.begin(), field.pieces.end(), beyond), field.pieces.end());
    auto const settled = field.settled();
    EXPECT_LT(field.price(settled), 0.85 * field.price(field.stack));
    for (int i = 0; i < field.work->count; ++i) EXPECT_GE(settled.holder(field.work->sample[unsigned(i)]), 0) << i;
}

TEST(QuadSettle, APieceIsItsPointsAsTheyAreUpToEight) {
    Field field(8.0, 10.0);
    for (int count = 1; count <= 8; ++count) {
        std::array<V3, 8> points{};
        for (int i = 0; i < count; ++i) points[unsigned(i)] = V3(1.0 + 0.1 * i * i, 2.0 + 0.3 * i, 7.0);
        detail::take_pieces(*field.work, field.stack, [&](ViewPart<double> const& part, auto const& visit) {
            if (part.hi.x == 10.0) visit(points.data(), count);
        });
        auto const& piece = field.work->piece[quad_directions];
        ASSERT_EQ(piece.count, count);
        for (int i = 0; i < count; ++i) EXPECT_EQ(piece.point[unsigned(i)], V2(points[unsigned(i)])) << i;
    }
}

TEST(QuadSettle, AllPiecesAreLookedAtAsLongAsThereIsRoom) {
    constexpr int rims = 4 * quad_directions, room = max_settling_pieces - rims;
    for (std::array<int, 4> const& count : {std::array{200, 200, 200, 168}, std::array{1, 0, 5, 3}}) {
        Strips strips(count);
        detail::take_pieces(*strips.work, strips.stack, strips.cover());
        EXPECT_EQ(strips.work->piece_count, rims + count[0] + count[1] + count[2] + count[3]);
    }
    Strips one_more({200, 200, 200, 169});
    detail::take_pieces(*one_more.work, one_more.stack, one_more.cover());
    EXPECT_EQ(one_more.work->piece_count, rims + 100 + 100 + 100 + 85) << "every other one";
    // Odd parts round up; the room ends before the last piece.
    Strips full({385, 385, 383, 383});
    detail::take_pieces(*full.work, full.stack, full.cover());
    EXPECT_EQ(full.work->piece_count, rims + room);
    Strips none_in_the_last({512, 512, 512, 0});
    detail::take_pieces(*none_in_the_last.work, none_in_the_last.stack, none_in_the_last.cover());
    EXPECT_EQ(none_in_the_last.work->piece_count, rims + room);
    // As much as that rounding up makes of it, before the last part's rim is taken.
    Strips odd({511, 511, 513, 0});
    detail::take_pieces(*odd.work, odd.stack, odd.cover());
    EXPECT_EQ(odd.work->piece_count, rims + room);
}

TEST(QuadSettle, AsManyMapsSamplesAndPiecesAsThereIsRoomForAreSettled) {
    Strips strips({385, 385, 383, 383}, max_search_samples);
    double const before = price_in(strips.stack, *strips.work, texels);
    auto const settled = strips.settled();
    EXPECT_LT(price_in(settled, *strips.work, texels), 0.9 * before);
    for (auto const& strip : strips.pieces)
        for (auto const& piece : strip) EXPECT_GE(settled.holder(piece.data(), 4), 0);
}

// The first map lies around what is seen from nearby and a strip beside the second map, and gives that strip away. Two
// of three pieces of the first part are in the gap between: they are not looked at before the end.
TEST(QuadSettle, WhatWasNotLookedAtIsTakenInByTheMapWhoseAreaGrowsLeast) {
    Gap gap;
    gap.first.clear();
    gap.second.clear();
    gap.work->count = 0;
    for (int i = 0; i < 500; ++i) {
        double const x = 0.5 * (i % 17), y = 0.05 * (i / 17 % 20);
        gap.first.push_back(Gap::piece({x < 8.0 ? x : 11.5, y}, {0.5, 0.05}));
        gap.first.push_back(Gap::piece({8.0 + 0.1 * (i % 9), 0.2 + 0.05 * (i % 12)}, {0.1, 0.05}));
        gap.first.push_back(gap.first.back());
        gap.second.push_back(Gap::piece({12.0 + 0.125 * (i % 8), 0.05 * (i / 8 % 20)}, {0.125, 0.05}));
        gap.sample(V2(gap.first[unsigned(3 * i)][0]) + V2(0.25, 0.025), 500.0);
        gap.sample(V2(gap.second.back()[0]) + 0.02, 1000.0);
    }
    for (int i = 0; i < 150; ++i) gap.second.push_back(gap.second[unsigned(i)]);
    double const before = gap.price();
    gap.settle(0);
    EXPECT_LT(gap.price(), 0.75 * before);
    for (auto const& piece : gap.first)
        EXPECT_EQ(gap.stack.holder(piece.data(), 4), piece[0].x < 11.0 ? 0 : 1) << piece[0].x;
    for (auto const& piece : gap.second) EXPECT_EQ(gap.stack.holder(piece.data(), 4), 1) << piece[0].x;
    for (V2 const& corner : gap.stack.quad[1].corner) EXPECT_GT(corner.x, 11.0);
}
