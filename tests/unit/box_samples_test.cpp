// SPDX-License-Identifier: MIT
#include "tests/support/street.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/box_samples.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

using namespace shadowmath;

namespace {

using V2 = glm::dvec2;
using V3 = glm::dvec3;
using Boxes = std::vector<Aabb<double>>;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr int rays = guess_rays_x * guess_rays_y;

// From the origin along -z, as wide as it is deep on each side.
ViewVolume<double> some_view() {
    return perspective_view(Pose<double>{}, 1.57079632679489662, 1.0, 1.0, 101.0);
}

Light<double> const morning = directional(V3(0.5, -1, -0.2));

// Across the whole view.
Aabb<double> wall(double nearest, double farthest) {
    return {V3(-500, -500, -farthest), V3(500, 500, -nearest)};
}

LightSampler<double> sampler_of(ViewVolume<double> const& view) {
    return light_sampler(view, morning, V2(1920, 1080), V2(guess_rays_x, guess_rays_y));
}

std::vector<LightSample<double>> guesses(Boxes const& boxes, int capacity = 8 * rays,
                                         ViewVolume<double> const& view = some_view()) {
    std::vector<LightSample<double>> samples(static_cast<std::size_t>(capacity));
    int const count =
        guesses_in_boxes(sampler_of(view), morning, boxes.data(), int(boxes.size()), samples.data(), capacity);
    EXPECT_LE(count, capacity);
    samples.resize(static_cast<std::size_t>(count));
    return samples;
}

bool are_same(std::vector<LightSample<double>> const& a, std::vector<LightSample<double>> const& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](auto const& p, auto const& q) {
        return p.place == q.place && p.depth == q.depth && p.seen == q.seen && p.weight == q.weight &&
               p.gain_x == q.gain_x && p.gain_y == q.gain_y;
    });
}

double weight_of(std::vector<LightSample<double>> const& samples) {
    double sum = 0.0;
    for (auto const& sample : samples) sum += sample.weight;
    return sum;
}

// Those of the samples at this eye depth.
double weight_at(std::vector<LightSample<double>> const& samples, double depth) {
    double sum = 0.0;
    for (auto const& sample : samples)
        if (std::abs(sample.seen.z - depth) < 1e-9) sum += sample.weight;
    return sum;
}

}  // namespace

TEST(BoxSamples, ARayIsInABoxFromItsNearerToItsFartherFace) {
    ViewVolume<double> const view = some_view();
    auto const expect_span = [&](double x, double y, Aabb<double> const& box, double first, double last) {
        DepthSpan<double> const span = depths_in_box(view, x, y, box);
        EXPECT_NEAR(span.first, first, 1e-12);
        EXPECT_NEAR(span.last, last, 1e-12);
    };
    Aabb<double> const cube{V3(-2, -2, -10), V3(2, 2, -6)};
    expect_span(0, 0, cube, 6, 10);
    expect_span(0.25, 0, cube, 6, 8);
    expect_span(0, -0.25, cube, 6, 8);
    expect_span(0.5, 0.5, {V3(3, 3, -50), V3(4, 4, -1)}, 6, 8);
    expect_span(0, 0, wall(0.5, 5), 1, 5);
    expect_span(0, 0, wall(90, 1000), 90, 101);
    expect_span(0.3, 0.3, wall(7, 7), 7, 7);
}

TEST(BoxSamples, ARayThatMissesABoxHasNoSpan) {
    ViewVolume<double> const view = some_view();
    Aabb<double> const cube{V3(-2, -2, -10), V3(2, 2, -6)};
    auto const misses = [&](double x, double y, Aabb<double> const& box) {
        DepthSpan<double> const span = depths_in_box(view, x, y, box);
        return span.last < span.first;
    };
    EXPECT_TRUE(misses(0.5, 0, cube)) << "beside it";
    EXPECT_TRUE(misses(0, -0.5, cube)) << "below it";
    EXPECT_TRUE(misses(0, 0, wall(-10, -2))) << "behind the eye";
    EXPECT_TRUE(misses(0, 0, wall(200, 300))) << "beyond far";
    EXPECT_TRUE(misses(0, 0, {V3(3, -2, -10), V3(5, 2, -6)})) << "along its side";
    EXPECT_TRUE(misses(0, 0, Aabb<double>{})) << "empty";
}

TEST(BoxSamples, ARayAlongAnAxisIsInABoxThatHoldsItOnTheOthers) {
    auto const span = [](V3 lo, V3 hi) { return depths_in_box(some_view(), 0.0, 0.0, Aabb<double>{lo, hi}); };
    EXPECT_LT(span(V3(-1, -1, -9), V3(1, 1, -5)).first, span(V3(-1, -1, -9), V3(1, 1, -5)).last);
    for (double const side : {-1.0, 1.0}) {
        auto const x = span(V3(3 * side - 1, -1, -9), V3(3 * side + 1, 1, -5));
        auto const y = span(V3(-1, 3 * side - 1, -9), V3(1, 3 * side + 1, -5));
        EXPECT_GT(x.first, x.last);
        EXPECT_GT(y.first, y.last);
    }
}

TEST(BoxSamples, EveryGuessIsInABoxAndInTheView) {
    Boxes const boxes{{V3(-8, -3, -40), V3(-2, 6, -12)}, {V3(1, -4, -90), V3(30, -2, -5)}, wall(80, 400)};
    ViewVolume<double> view = some_view();
    view.pose = pose_looking(V3(2, 1, 4), V3(0.1, -0.1, -1), V3(0.1, 1, 0));
    LightSampler<double> const sampler = sampler_of(view);
    auto const samples = guesses(boxes, 8 * rays, view);
    EXPECT_GT(samples.size(), std::size_t(rays));
    for (auto const& sample : samples) {
        EXPECT_TRUE(sample.usable);
        V3 const point = view.pose.position + sampler.basis.x * sample.place.x + sampler.basis.y * sample.place.y +
                         sampler.basis.depth * sample.depth;
        bool held = false;
        for (Aabb<double> box : boxes) {
            box.lo -= 1e-9;
            box.hi += 1e-9;
            held = held || contains(box, point);
        }
        EXPECT_TRUE(held);
        EXPECT_TRUE(std::abs(sample.seen.x) < view.right && std::abs(sample.seen.y) < view.top);
        EXPECT_TRUE(sample.seen.z > view.z_near && sample.seen.z < view.z_far);
    }
}

TEST(BoxSamples, ARayEndsInTheBoxesThatItMeets) {
    test::Street const street;
    LightSampler<double> const sampler = light_sampler(street.view, test::street_morning, V2(1920, 1080), V2(20, 12));
    std::vector<LightSample<double>> guesses(max_search_samples);
    int const count = guesses_in_boxes(sampler, test::street_morning, street.boxes.data(), int(street.boxes.size()),
                                       guesses.data(), int(guesses.size()));
    ASSERT_GT(count, 100);
    double weight = 0.0;
    for (int i = 0; i < count; ++i) {
        LightSample<double> const& guess = guesses[std::size_t(i)];
        V3 const point = point_at(street.view, guess.seen.x, guess.seen.y, guess.seen.z);
        bool inside = false;
        for (auto box : street.boxes) {
            box.lo -= 1e-9, box.hi += 1e-9;
            inside = inside || contains(box, point);
        }
        EXPECT_TRUE(inside);
        weight += guess.weight;
    }
    EXPECT_LE(weight, guess_rays_x * guess_rays_y * 1.0001);
    EXPECT_GT(weight, 50.0);
    EXPECT_EQ(guesses_in_boxes(sampler, test::street_morning, street.boxes.data(), int(street.boxes.size()),
                               guesses.data(), 7),
              7);
}

TEST(BoxSamples, ARayWeighsOneHoweverManyBoxesItMeets) {
    for (int count = 1; count <= 6; ++count) {
        Boxes boxes;
        for (int i = 0; i < count; ++i) boxes.push_back(wall(10.0 * (i + 1), 10.0 * (i + 1) + 4.0));
        auto const samples = guesses(boxes);
        EXPECT_EQ(int(samples.size()), 2 * std::min(count, 4) * rays);
        EXPECT_NEAR(weight_of(samples), rays, 1e-9) << count;
    }
}

TEST(BoxSamples, ARayEndsInEachBoxWithEvenOddsAndInTheLastForCertain) {
    auto const samples = guesses({wall(10, 14), wall(20, 24), wall(30, 34)});
    double const share[] = {0.5, 0.25, 0.25};
    for (int i = 0; i < 3; ++i)
        for (double const part : {1.0, 3.0})
            EXPECT_NEAR(weight_at(samples, 10.0 * (i + 1) + part), 0.5 * share[i] * rays, 1e-9) << i << ' ' << part;
}

TEST(BoxSamples, TheFourNearestBoxesCountInWhateverOrderTheyCome) {
    Boxes boxes;
    for (int const i : {3, 6, 1, 5, 2, 4}) boxes.push_back(wall(10.0 * i, 10.0 * i + 4.0));
    auto const samples = guesses(boxes);
    for (auto const& sample : samples) EXPECT_LT(sample.seen.z, 44.0);
    std::sort(boxes.begin(), boxes.end(), [](auto const& a, auto const& b) { return a.hi.z > b.hi.z; });
    EXPECT_TRUE(are_same(samples, guesses(boxes))) << "not by a bit";
}

TEST(BoxSamples, OfTheBoxAroundTheEyeOnlyTheRoomIsSeen) {
    Aabb<double> const room = wall(-20, 60), hall = wall(-30, 41);
    auto const alone = guesses({room, hall});
    EXPECT_EQ(int(alone.size()), 2 * rays);
    EXPECT_NEAR(weight_at(alone, 1 + 59 * 0.5), 0.5 * rays, 1e-9) << "in the one that ends last";
    EXPECT_NEAR(weight_at(alone, 1 + 59 * 0.9), 0.5 * rays, 1e-9);
    EXPECT_TRUE(are_same(guesses({room, wall(10, 14)}), guesses({wall(10, 14)}))) << "where nothing stands in it";
}

TEST(BoxSamples, BoxesThatAreEmptyOrNoNumbersAreNone) {
    Boxes const good{wall(10, 14), wall(20, 24)};
    auto const samples = guesses(good);
    Aabb<double> turned_over = wall(5, 6), no_box = wall(5, 6), without_end = wall(5, 6);
    std::swap(turned_over.lo.x, turned_over.hi.x);
    no_box.lo.y = no_number;
    without_end.hi.x = std::numeric_limits<double>::infinity();
    for (Aabb<double> const& bad : {Aabb<double>{}, turned_over, no_box, without_end}) {
        EXPECT_TRUE(guesses({bad}).empty());
        EXPECT_TRUE(are_same(guesses({bad, good[0], bad, good[1]}), samples));
    }
    EXPECT_TRUE(guesses({}).empty());
    EXPECT_EQ(guesses_in_boxes<double>(sampler_of(some_view()), morning, nullptr, 0, nullptr, 0), 0);
}

TEST(BoxSamples, NoMoreIsWrittenThanThereIsRoomFor) {
    Boxes const boxes{wall(10, 14), wall(20, 24)};
    auto const all = guesses(boxes);
    for (int const capacity : {0, 1, 7, 4 * rays - 1}) {
        LightSample<double> untouched;
        untouched.weight = -7.0;
        std::vector<LightSample<double>> into(all.size(), untouched);
        EXPECT_EQ(guesses_in_boxes(sampler_of(some_view()), morning, boxes.data(), 2, into.data(), capacity), capacity);
        for (std::size_t i = std::size_t(capacity); i < into.size(); ++i) EXPECT_EQ(into[i].weight, -7.0) << i;
        into.resize(std::size_t(capacity));
        EXPECT_TRUE(are_same(into, {all.begin(), all.begin() + capacity}));
    }
}

TEST(BoxSamples, OfAViewWithFaultsThereAreNone) {
    ViewVolume<double> crossed = some_view(), nowhere_at_all = some_view();
    std::swap(crossed.left, crossed.right);
    nowhere_at_all.pose.position.x = no_number;
    EXPECT_TRUE(guesses({wall(10, 14)}, 8 * rays, crossed).empty());
    EXPECT_TRUE(guesses({wall(10, 14)}, 8 * rays, nowhere_at_all).empty());
}

TEST(BoxSamples, AreTheSameEachTimeWithoutTheHeap) {
    Boxes const boxes{{V3(-8, -3, -40), V3(-2, 6, -12)}, wall(-4, 90), wall(95, 400)};
    LightSampler<double> const sampler = sampler_of(some_view());
    std::vector<LightSample<double>> into(8 * std::size_t(rays));
    auto const count = test::watched([&] {
        return guesses_in_boxes(sampler, morning, boxes.data(), int(boxes.size()), into.data(), int(into.size()));
    });
    EXPECT_TRUE(count.calm_in_range());
    into.resize(std::size_t(count.result));
    EXPECT_TRUE(are_same(into, guesses(boxes)));
}

TEST(BoxSamples, WithoutWeightsAreAsManyAsTheRayIsLikelyToEndThere) {
    // Of each ray's ends half are in the first wall, a quarter in the second, and all that are left in the last.
    Boxes const boxes{wall(10, 14), wall(20, 24), wall(30, 34)};
    Samples<double> const samples = samples_in_boxes(some_view(), morning, boxes.data(), 3);
    ASSERT_EQ(samples.count, max_samples);
    std::array<int, 3> in{};
    for (int i = 0; i < samples.count; ++i) {
        auto const& sample = samples.at[std::size_t(i)];
        for (std::size_t b = 0; b < 3; ++b) in[b] += contains(boxes[b], sample.point) ? 1 : 0;
        EXPECT_EQ(sample.normal, neutral_normal(some_view(), morning, sample.point));
    }
    EXPECT_EQ(in[0], max_samples / 2);
    EXPECT_EQ(in[1], max_samples / 4);
    EXPECT_EQ(in[2], max_samples / 4);
    // The only box of a ray has them all.
    Samples<double> const alone = samples_in_boxes(some_view(), morning, boxes.data(), 1);
    EXPECT_EQ(alone.count, max_samples);
    for (int i = 0; i < alone.count; ++i) EXPECT_TRUE(contains(boxes[0], alone.at[std::size_t(i)].point));
}

TEST(BoxSamples, WithoutWeightsAreNoneOfBadInput) {
    Boxes const boxes{wall(10, 14)};
    ViewVolume<double> crossed = some_view(), endless = some_view();
    std::swap(crossed.left, crossed.right);
    endless.z_far = std::numeric_limits<double>::infinity();
    EXPECT_EQ(samples_in_boxes(crossed, morning, boxes.data(), 1).count, 0);
    EXPECT_EQ(samples_in_boxes(endless, morning, boxes.data(), 1).count, 0);
    EXPECT_EQ(samples_in_boxes(some_view(), directional(V3(0)), boxes.data(), 1).count, 0);
    EXPECT_EQ(samples_in_boxes<double>(some_view(), morning, nullptr, 0).count, 0);
    Aabb<double> no_box = wall(5, 6);
    no_box.lo.y = no_number;
    EXPECT_EQ(samples_in_boxes(some_view(), morning, &no_box, 1).count, 0);
}
