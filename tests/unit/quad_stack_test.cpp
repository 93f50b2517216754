// SPDX-License-Identifier: MIT
#include <shadowmath/quad_stack.hpp>

#include <gtest/gtest.h>

#include <array>
#include <utility>

using namespace shadowmath;

namespace {

using V2 = glm::dvec2;
using V3 = glm::dvec3;

constexpr double texels = 1020.0;

// A metre of the light's plane is so many pixels of the picture.
LightSample<double> sample_at(V2 place, double pixels_a_metre) {
    LightSample<double> sample;
    sample.place = place;
    sample.seen = V3(place.x, 0.0, place.y);
    sample.gain_x = V2(pixels_a_metre, 0);
    sample.gain_y = V2(0, pixels_a_metre);
    sample.usable = true;
    return sample;
}

struct Bound {
    void operator()(ViewPart<double> const&, int count, Supports<double>& supports) const noexcept {
        for (int i = 0; i < count; ++i) add(supports, work->sample[work->list[unsigned(i)]]);
    }
    MapSearch<double>* work;
};

// Ten by ten samples a metre apart, the nearer half of them seen from nearby; two parts, cut at `at`.
struct Field {
    MapSearch<double> work;
    Bound bound{&work};
    detail::PartSearch<double, Bound> search{work, bound, texels, max_search_samples};
    detail::PartTree<double> tree;

    Field() {
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 10; ++x)
                work.sample[unsigned(work.count++)] = sample_at(V2(x, y), y < 5 ? 2000.0 : 100.0);
    }
    Field(Field const&) = delete;
    Field& operator=(Field const&) = delete;

    void cut_at(double at) {
        auto const halves = detail::cut(ViewPart<double>{}, detail::depth_axis, at);
        tree.node[0].axis = detail::depth_axis;
        tree.node[0].at = at;
        tree.node[0].child = 1;
        tree.node[1].part = halves.a;
        tree.node[2].part = halves.b;
        for (unsigned n : {1u, 2u}) tree.node[n].fit = search.fit(tree.node[n].part);
        tree.count = 3;
        tree.leaves = 2;
    }
    // What may be seen in a part are its samples' places.
    [[nodiscard]] auto cover() {
        return [this](ViewPart<double> const& part, auto const& visit) {
            for (int i = 0; i < work.count; ++i) {
                LightSample<double> const& sample = work.sample[unsigned(i)];
                V3 const point(sample.place, 0.0);
                if (is_in(part, sample.seen)) visit(&point, 1);
            }
        };
    }
};

}  // namespace

TEST(QuadStack, EveryPieceIsHeldAndTheFinestMapComesFirst) {
    Field field;
    field.cut_at(2.5);
    auto const stack = detail::stacked(field.search, field.tree, field.cover());
    ASSERT_EQ(stack.count, 2);
    EXPECT_LT(area(stack.quad[0]), area(stack.quad[1]));
    for (int i = 0; i < field.work.count; ++i)
        EXPECT_EQ(stack.holder(field.work.sample[unsigned(i)]), field.work.sample[unsigned(i)].seen.z < 2.5 ? 0 : 1);
}

// The root and a leaf are cut, along every axis that there is; what is cut is no part.
TEST(QuadStack, TheLeavesAndTheyAloneAreItsPartsSmallestFirst) {
    for (int const axis : {0, detail::depth_axis}) {
        Field field;
        field.cut_at(6.5);
        auto const halves = detail::cut(field.tree.node[1].part, axis, axis == 0 ? 3.5 : 1.5);
        field.tree.node[1].axis = axis;
        field.tree.node[1].child = 3;
        field.tree.node[3].part = halves.a;
        field.tree.node[4].part = halves.b;
        // The larger of the two stands first in the tree.
        if (axis == 0) std::swap(field.tree.node[3], field.tree.node[4]);
        for (unsigned n : {3u, 4u}) field.tree.node[n].fit = field.search.fit(field.tree.node[n].part);
        field.tree.count = 5;
        field.tree.leaves = 3;
        auto const stack = detail::stacked(field.search, field.tree, field.cover());
        ASSERT_EQ(stack.count, 3) << axis;
        EXPECT_EQ(stack.held_count, 0) << axis;
        EXPECT_LE(area(stack.quad[0]), area(stack.quad[1])) << axis;
        EXPECT_LE(area(stack.quad[1]), area(stack.quad[2])) << axis;
    }
}

TEST(QuadStack, WhatServesNoPieceIsLeftOutAndTheOthersStayInOrder) {
    Field field;
    field.cut_at(2.5);
    auto stack = detail::stacked(field.search, field.tree, field.cover());
    ASSERT_EQ(stack.count, 2);
    // The finer one once more behind itself: what it holds, the first holds already.
    stack.quad[2] = stack.quad[1];
    stack.part[2] = stack.part[1];
    stack.quad[1] = stack.quad[0];
    stack.part[1] = stack.part[0];
    stack.count = 3;
    auto const before = stack;
    auto depth = detail::depths_served(stack, field.cover());
    EXPECT_GT(depth[1].lo, depth[1].hi);
    detail::leave_out_idle(stack, depth);
    ASSERT_EQ(stack.count, 2);
    EXPECT_EQ(stack.held_count, 1);
    EXPECT_EQ(stack.part[1].lo, before.part[2].lo);
    EXPECT_EQ(stack.held[0].hi, before.part[1].hi);
    EXPECT_EQ(area(stack.quad[0]), area(before.quad[0]));
    EXPECT_EQ(area(stack.quad[1]), area(before.quad[2]));
    for (unsigned k : {0u, 1u}) EXPECT_EQ(depth[k].lo, 0.0) << k;
}

TEST(QuadStack, AsksForThePiecesOfEachPartOnceAndForNothingBehindThem) {
    Field field;
    field.cut_at(2.5);
    auto stack = detail::stacked(field.search, field.tree, field.cover());
    stack.held_count = 1;
    std::array<V3, 2> const points{V3(4, 1, 5), V3(4, 1, 99)};
    int asked = 0;
    auto const depth = detail::depths_served(stack, [&](ViewPart<double> const&, auto const& visit) {
        ++asked;
        visit(points.data(), 1);
    });
    EXPECT_EQ(asked, 3);
    EXPECT_EQ(depth[0].lo, 5.0);
    EXPECT_EQ(depth[0].hi, 5.0);
}

// A piece stands for all that may be seen in it: it is served by a map that holds it whole.
TEST(QuadStack, APieceIsHeldOnlyWhole) {
    Field field;
    field.cut_at(4.5);
    auto const stack = detail::stacked(field.search, field.tree, field.cover());
    std::array<V3, 2> const across{V3(4, 4, 0), V3(4, 8, 0)}, within{V3(4, 1, 0), V3(4, 3, 0)};
    int const first = stack.holder(within.data(), 2);
    ASSERT_GE(first, 0);
    EXPECT_EQ(stack.holder(across.data(), 2), -1);
    EXPECT_EQ(stack.holder(across.data(), 1), first);
}

TEST(QuadStack, APartThatAnEarlierMapHoldsGetsNone) {
    Field field;
    field.cut_at(4.5);
    // The second part is the first one's middle, seen twice.
    field.tree.node[2].part = field.tree.node[1].part;
    field.tree.node[2].part.lo.x = 2.0;
    field.tree.node[2].part.hi.x = 7.0;
    std::swap(field.tree.node[1].fit, field.tree.node[2].fit);
    field.tree.node[1].fit = field.search.fit(field.tree.node[1].part);
    field.tree.node[2].fit = field.tree.node[1].fit;
    auto const stack = detail::stacked(field.search, field.tree, field.cover());
    EXPECT_EQ(stack.count, 1);
    EXPECT_EQ(stack.held_count, 1);
}

TEST(QuadStack, WhatAnEarlierMapHoldsHasNoSayInALaterOne) {
    auto const later_map = [](double pixels_a_metre) {
        Field field;
        field.cut_at(4.5);
        // They overlap: two rows of the nearer part are in the farther one too.
        field.tree.node[2].part.lo[detail::depth_axis] = 2.5;
        auto& work = field.work;
        for (int i = 0; i < work.count; ++i)
            if (work.sample[unsigned(i)].seen.z > 2.5 && work.sample[unsigned(i)].seen.z < 4.5)
                work.sample[unsigned(i)] = sample_at(work.sample[unsigned(i)].place, pixels_a_metre);
        auto const stack = detail::stacked(field.search, field.tree, field.cover());
        EXPECT_EQ(stack.count, 2);
        for (int i = 0; i < work.count; ++i)
            EXPECT_EQ(stack.holder(work.sample[unsigned(i)]), work.sample[unsigned(i)].seen.z < 4.5 ? 0 : 1);
        return stack.quad[1];
    };
    auto const some = later_map(2000.0), other = later_map(0.1);
    EXPECT_EQ(some.x, other.x);
    EXPECT_EQ(some.y, other.y);
    EXPECT_EQ(some.w, other.w);
}

TEST(QuadStack, ThePriceIsThatOfTheFirstMapThatHoldsAndOfALostShadowElsewhere) {
    Field field;
    field.cut_at(4.5);
    auto const stack = detail::stacked(field.search, field.tree, field.cover());
    double expected = 0.0;
    for (int i = 0; i < field.work.count; ++i) {
        auto const& sample = field.work.sample[unsigned(i)];
        int const k = stack.holder(sample);
        ASSERT_GE(k, 0);
        expected += price_of(major_at(stack.quad[unsigned(k)], texels, sample));
    }
    EXPECT_NEAR(detail::price_in(stack, field.work, texels), expected, 1e-9 * expected);
    LightSample<double>& lost = field.work.sample[0];
    expected +=
        price_of(footprint_limit<double>) - price_of(major_at(stack.quad[unsigned(stack.holder(lost))], texels, lost));
    lost.place = V2(1e4);
    EXPECT_NEAR(detail::price_in(stack, field.work, texels), expected, 1e-9 * expected);
}
