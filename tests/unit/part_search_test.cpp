// SPDX-License-Identifier: MIT
#include "tests/support/watched.hpp"

#include <shadowmath/part_search.hpp>

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
using Part = ViewPart<double>;
using Tree = detail::PartTree<double>;

constexpr double texels = 1020.0;

// Seen by an eye at the origin of the light's plane that looks along its y.
LightSample<double> sample_at(double side_x, double side_y, double depth) {
    LightSample<double> sample;
    sample.seen = V3(side_x, side_y, depth);
    sample.place = V2(side_x * depth, depth);
    sample.gain_x = V2(1000.0 / depth, 0);
    sample.gain_y = V2(0, 1000.0 / depth);
    sample.usable = true;
    return sample;
}

// What a map must hold are the samples themselves.
struct Samples {
    void operator()(Part const&, int count, Supports<double>& supports) const noexcept {
        for (int i = 0; i < count; ++i) add(supports, work->sample[work->list[static_cast<unsigned>(i)]]);
    }
    MapSearch<double>* work;
};

struct Search {
    MapSearch<double> work;
    Samples bound{&work};
    detail::PartSearch<double, Samples> parts{work, bound, texels, max_search_samples};

    Search() = default;
    Search(Search const&) = delete;
    Search& operator=(Search const&) = delete;

    void take(LightSample<double> const& sample) {
        ASSERT_LT(work.count, max_search_samples);
        work.sample[static_cast<unsigned>(work.count++)] = sample;
    }
    [[nodiscard]] Tree grown(int leaves, bool by_depth_alone = false) {
        return detail::grown(parts, leaves, by_depth_alone);
    }
};

// A street from 2 m to 100 m, as wide as the view.
struct Street : Search {
    Street() {
        for (int k = 0; k < 16; ++k)
            for (int i = 0; i < 10; ++i) take(sample_at(0.2 * i - 0.9, -1.7 / depth(k), depth(k)));
    }
    static double depth(int k) { return 2.0 * std::pow(50.0, k / 15.0); }
};

// The same at depths that no eighth of the way meets.
struct CrowdedStreet : Search {
    CrowdedStreet() {
        for (int k = 0; k < 60; ++k)
            for (int i = 0; i < 6; ++i) {
                double const depth = 2.0 * std::pow(50.0, std::pow(k / 59.0, 1.7));
                take(sample_at(0.36 * i - 0.9, -1.7 / depth, depth));
            }
    }
};

// Two fronts equally far, with a gap between.
struct Fronts : Search {
    Fronts() {
        for (int k = 0; k < 6; ++k)
            for (int i = 0; i < 6; ++i)
                for (double const side : {-3.0, 3.0}) take(sample_at(side + 0.02 * i, 0.1 * k, 20.0 + 0.1 * k));
    }
};

// Two a metre long and eight apart along one axis, told apart by nothing else: a hundred metres away, or in the middle.
struct Clumps : Search {
    double gap;

    explicit Clumps(int axis) : gap(axis == detail::depth_axis ? 105.0 : 0.0) {
        for (double const first : {gap - 5.0, gap + 4.0})
            for (int k = 0; k <= 10; ++k)
                for (int i = 0; i < 3; ++i) {
                    LightSample<double> sample = sample_at(0.0, 0.0, 10.0);
                    sample.seen[axis] = first + 0.1 * k;
                    sample.place = V2(0.1 * i, sample.seen[axis]);
                    take(sample);
                }
    }
};

std::vector<int> leaves_of(Tree const& tree) {
    std::vector<int> leaves;
    for (int n = 0; n < tree.count; ++n)
        if (tree.node[static_cast<unsigned>(n)].axis < 0) leaves.push_back(n);
    return leaves;
}

// Each sample is in one leaf, and in that leaf's map; the price is the leaves' own.
void expect_sound(Search const& search, Tree const& tree) {
    auto const leaves = leaves_of(tree);
    ASSERT_EQ(int(leaves.size()), tree.leaves);
    EXPECT_EQ(tree.count, 2 * tree.leaves - 1);
    double price = 0.0;
    for (int const n : leaves) price += tree.node[static_cast<unsigned>(n)].fit.price;
    EXPECT_NEAR(tree.price, price, 1e-9 * price);
    for (int i = 0; i < search.work.count; ++i) {
        auto const& sample = search.work.sample[static_cast<unsigned>(i)];
        int holders = 0;
        for (int const n : leaves) {
            auto const& node = tree.node[static_cast<unsigned>(n)];
            if (!is_in(node.part, sample.seen)) continue;
            ++holders;
            EXPECT_TRUE(node.fit.quad.visible && is_in(node.fit.quad, sample.place)) << i;
        }
        EXPECT_EQ(holders, 1) << i;
    }
}

bool are_same(Tree const& a, Tree const& b) {
    if (a.count != b.count || a.leaves != b.leaves || a.price != b.price) return false;
    for (unsigned n = 0; n < static_cast<unsigned>(a.count); ++n) {
        auto const &p = a.node[n], &q = b.node[n];
        if (p.axis != q.axis || p.at != q.at || p.fit.price != q.fit.price || p.fit.direction != q.fit.direction)
            return false;
    }
    return true;
}

}  // namespace

TEST(PartSearch, ACutLosesNoSampleAndGivesNoneTwice) {
    for (int axis = 0; axis < 3; ++axis)
        for (double const at : {-1.0, 0.0, 2.5}) {
            detail::PartPair<double> const halves = detail::cut(Part{}, axis, at);
            for (double const value : {-7.0, std::nextafter(at, -9.0), at, std::nextafter(at, 9.0), 7.0}) {
                V3 seen(0.5);
                seen[axis] = value;
                EXPECT_EQ(is_in(halves.a, seen), value < at);
                EXPECT_EQ(is_in(halves.b, seen), value >= at);
            }
        }
    EXPECT_FALSE(is_in(Part{}, V3(0, std::numeric_limits<double>::quiet_NaN(), 1))) << "no number is in no part";
}

TEST(PartSearch, PlacesBetweenTheEndsAreEvenAcrossAndInRatiosOfDepth) {
    Search search;
    search.take(sample_at(-1, 0.5, 2));
    search.take(sample_at(3, 0.75, 32));
    search.take(sample_at(0, 0.5, 3));
    EXPECT_NEAR(detail::between_ends(search.work, Part{}, 0, 0.25), 0.0, 1e-15);
    EXPECT_NEAR(detail::between_ends(search.work, Part{}, 1, 0.5), 0.625, 1e-15);
    EXPECT_NEAR(detail::between_ends(search.work, Part{}, 2, 0.25), 4.0, 1e-14);
    EXPECT_NEAR(detail::between_ends(search.work, Part{}, 2, 1.0), 32.0, 1e-13);
    Part const nearer = detail::cut(Part{}, 2, 4.0).a;
    EXPECT_NEAR(detail::between_ends(search.work, nearer, 2, 0.5), std::sqrt(6.0), 1e-14) << "of the part's own";
    EXPECT_EQ(detail::between_ends(search.work, detail::cut(Part{}, 2, 3.0).a, 2, 0.5), 2.0) << "one sample";
}

TEST(PartSearch, AFitIsPricedByTheSamplesOfItsPartAlone) {
    Street street;
    auto const halves = detail::cut(Part{}, 2, Street::depth(8));
    for (Part const& part : {halves.a, halves.b}) {
        QuadFit<double> const fit = street.parts.fit(part);
        double price = 0.0;
        for (int i = 0; i < street.work.count; ++i) {
            auto const& sample = street.work.sample[static_cast<unsigned>(i)];
            if (is_in(part, sample.seen)) price += price_of(major_at(fit.quad, texels, sample));
        }
        EXPECT_NEAR(fit.price, price, 1e-9 * price);
    }
    EXPECT_EQ(street.parts.gather(halves.a) + street.parts.gather(halves.b), street.work.count);
}

TEST(PartSearch, OfFewerPricedSamplesAllAreHeld) {
    Street street;
    street.parts.most_priced = 9;
    QuadFit<double> const fit = street.parts.fit(Part{});
    ASSERT_TRUE(fit.quad.visible);
    for (int i = 0; i < street.work.count; ++i)
        EXPECT_TRUE(is_in(fit.quad, street.work.sample[static_cast<unsigned>(i)].place));
}

TEST(PartSearch, AsManySamplesAsMayBePricedAreAllPriced) {
    Street every, as_many;
    as_many.parts.most_priced = as_many.work.count;
    EXPECT_EQ(as_many.parts.fit(Part{}).price, every.parts.fit(Part{}).price);
}

TEST(PartSearch, EveryCutMakesThePriceLess) {
    Street street;
    double last = std::numeric_limits<double>::max();
    for (int most = 1; most <= max_chosen_maps; ++most) {
        Tree const tree = street.grown(most);
        EXPECT_EQ(tree.leaves, most) << "a street is worth every map";
        expect_sound(street, tree);
        EXPECT_LT(tree.price, last);
        last = tree.price;
    }
    EXPECT_LT(last, 0.5 * street.grown(1).price);
}

TEST(PartSearch, OnePartIsTheFitOfAll) {
    Street street;
    Tree const tree = street.grown(1);
    EXPECT_EQ(tree.count, 1);
    EXPECT_EQ(tree.node[0].axis, -1);
    EXPECT_EQ(tree.price, street.parts.fit(Part{}).price);
}

TEST(PartSearch, TheFirstCutIsTheBestOfAllThatAreTried) {
    Street street;
    double const all = street.parts.fit(Part{}).price;
    auto const best = detail::best_cut(street.parts, Part{}, all, 0);
    ASSERT_GE(best.axis, 0);
    EXPECT_EQ(best.saved, all - best.a.price - best.b.price);
    for (int axis = 0; axis < 3; ++axis)
        for (int k = 1; k < 8; ++k) {
            auto const halves = detail::cut(Part{}, axis, detail::between_ends(street.work, Part{}, axis, k / 8.0));
            double const price = street.parts.fit(halves.a).price + street.parts.fit(halves.b).price;
            EXPECT_GE(price, all - best.saved - 1e-9 * all) << axis << ' ' << k;
        }
}

TEST(PartSearch, SevenCutsAreTriedAlongEachAxis) {
    Street street;
    (void)street.grown(2, true);
    EXPECT_EQ(street.parts.tried, 1 + 2 * 7);
    street.parts.tried = 0;
    (void)street.grown(2);
    EXPECT_EQ(street.parts.tried, 1 + 2 * 3 * 7);
}

TEST(PartSearch, ByDepthAloneNothingElseIsCut) {
    Street street;
    Fronts fronts;
    for (Search* const search : {static_cast<Search*>(&street), static_cast<Search*>(&fronts)}) {
        Tree const tree = search->grown(max_chosen_maps, true);
        expect_sound(*search, tree);
        for (int n = 0; n < tree.count; ++n) {
            int const axis = tree.node[static_cast<unsigned>(n)].axis;
            EXPECT_TRUE(axis < 0 || axis == detail::depth_axis);
        }
    }
}

TEST(PartSearch, TwoFrontsWithAGapAreCutInTheGap) {
    Fronts fronts;
    Tree const tree = fronts.grown(2);
    ASSERT_EQ(tree.leaves, 2);
    EXPECT_EQ(tree.node[0].axis, 0);
    EXPECT_GT(tree.node[0].at, -2.9);
    EXPECT_LE(tree.node[0].at, 3.0);
    EXPECT_LT(tree.price, 0.5 * fronts.grown(2, true).price) << "than by depth";
}

TEST(PartSearch, NoCutIsMadeThatSavesNothing) {
    Search one;
    for (int i = 0; i < 5; ++i) one.take(sample_at(0.1, -0.2, 12.0));
    Tree const tree = one.grown(max_chosen_maps);
    EXPECT_EQ(tree.leaves, 1);
    expect_sound(one, tree);
}

TEST(PartSearch, SettlingNeverCostsAndLeavesThePartsSound) {
    Street street;
    CrowdedStreet crowded;
    Fronts fronts;
    for (Search* const search :
         {static_cast<Search*>(&street), static_cast<Search*>(&crowded), static_cast<Search*>(&fronts)})
        for (bool const by_depth_alone : {true, false})
            for (int most = 1; most <= max_chosen_maps; ++most) {
                Tree tree = search->grown(most, by_depth_alone);
                double const before = tree.price;
                detail::settle(search->parts, tree);
                EXPECT_LE(tree.price, before * (1 + 1e-12));
                expect_sound(*search, tree);
            }
}

TEST(PartSearch, SettlingFindsCutsBetweenThosePlacesThatWereTried) {
    CrowdedStreet street;
    for (bool const by_depth_alone : {true, false})
        for (int const most : {2, 3}) {
            Tree tree = street.grown(most, by_depth_alone);
            double const before = tree.price;
            detail::settle(street.parts, tree);
            EXPECT_LT(tree.price, 0.997 * before) << by_depth_alone << ' ' << most;
        }
}

TEST(PartSearch, ASettledCutIsNoWorseThanItsNeighbours) {
    CrowdedStreet street;
    Tree tree = street.grown(2, true);
    detail::settle(street.parts, tree);
    for (double const way : {-0.03, -0.015, 0.015, 0.03}) {
        Tree moved = tree;
        moved.node[0].at *= std::pow(50.0, way);
        detail::refit(street.parts, moved);
        EXPECT_GE(moved.price, tree.price) << way;
    }
}

TEST(PartSearch, ATreeWhoseCutsHaveNotMovedIsTheSameAnew) {
    Street street;
    Fronts fronts;
    for (Search* const search : {static_cast<Search*>(&street), static_cast<Search*>(&fronts)}) {
        Tree const tree = search->grown(max_chosen_maps);
        Tree anew = tree;
        detail::refit(search->parts, anew);
        expect_sound(*search, anew);
        EXPECT_NEAR(anew.price, tree.price, 1e-9 * tree.price);
    }
}

TEST(PartSearch, ACutBesideAGapSettlesInTheGap) {
    for (int axis = 0; axis < 3; ++axis)
        for (double const beside : {-4.55, 4.55}) {
            Clumps clumps(axis);
            Tree tree;
            tree.count = 3;
            tree.leaves = 2;
            tree.node[0].axis = axis;
            tree.node[0].at = clumps.gap + beside;
            tree.node[0].child = 1;
            detail::refit(clumps.parts, tree);
            double const before = tree.price;
            detail::settle(clumps.parts, tree);
            EXPECT_LT(tree.price, 0.5 * before) << axis << ' ' << beside;
            EXPECT_GT(tree.node[0].at, clumps.gap - 4.0) << axis << ' ' << beside;
            EXPECT_LE(tree.node[0].at, clumps.gap + 4.0) << axis << ' ' << beside;
            expect_sound(clumps, tree);
        }
}

TEST(PartSearch, OfNoSamplesThereIsOnePartWithoutAMap) {
    Search nothing;
    Tree tree = nothing.grown(max_chosen_maps);
    detail::settle(nothing.parts, tree);
    EXPECT_EQ(tree.leaves, 1);
    EXPECT_EQ(tree.price, 0.0);
    EXPECT_FALSE(tree.node[0].fit.quad.visible);
}

TEST(PartSearch, SamplesOfNoNumbersMoveNoCutAndCostNothing) {
    Street clean, street;
    for (int member = 0; member < 3; ++member) {
        LightSample<double> bad = sample_at(0, 0, 500.0);
        bad.seen[member] = std::numeric_limits<double>::quiet_NaN();
        street.take(bad);
    }
    Tree a = clean.grown(max_chosen_maps), b = street.grown(max_chosen_maps);
    detail::settle(clean.parts, a);
    detail::settle(street.parts, b);
    EXPECT_TRUE(are_same(a, b));
}

TEST(PartSearch, AsManySamplesAsThereIsRoomForAreSearched) {
    Search search;
    for (int i = 0; i < max_search_samples; ++i)
        search.take(sample_at(0.03 * (i % 32) - 0.5, -0.3, 2.0 + 1.5 * (i / 32)));
    search.parts.most_priced = 64;
    EXPECT_EQ(search.parts.gather(Part{}), max_search_samples);
    EXPECT_EQ(search.work.list.back(), max_search_samples - 1);
    Tree const tree = search.grown(2);
    auto const leaves = leaves_of(tree);
    ASSERT_EQ(leaves.size(), 2u);
    int held = 0;
    for (int const n : leaves) held += search.parts.gather(tree.node[static_cast<unsigned>(n)].part);
    EXPECT_EQ(held, max_search_samples);
}

TEST(PartSearch, TheSameSamplesGiveTheSamePartsInBoundedStepsWithoutTheHeap) {
    auto const search = [](Street& street) {
        Tree tree = street.grown(max_chosen_maps);
        detail::settle(street.parts, tree);
        return tree;
    };
    Street once, again;
    auto const seen = test::watched([&] { return search(once); });
    EXPECT_TRUE(seen.calm_in_range());
    EXPECT_TRUE(are_same(seen.result, search(again)));
    EXPECT_EQ(once.parts.tried, again.parts.tried);
    EXPECT_LE(once.parts.tried, 1 + 7 * 21 * 2 + 3 * 6 * 3 * 4);
}
