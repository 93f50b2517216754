// SPDX-License-Identifier: MIT
//
// Planes through points, beside the slow and plain way to each; and which points count.
#include "tests/support/watched.hpp"

#include <shadowmath/plane_choice.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

using namespace shadowmath;

namespace {

using V2 = glm::dvec2;
using V3 = glm::dvec3;
using Points = std::vector<SurfacePoint<double>>;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double endless = std::numeric_limits<double>::infinity();

V3 const up(0, 1, 0);
Light<double> const slanting = directional(V3(0.4, -1, 0.2));

struct Dice {
    std::mt19937 bits{20021201};

    double in(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(bits); }
    V3 vector() { return {in(-1, 1), in(-1, 1), in(-1, 1)}; }
};

ViewVolume<double> view_from(V3 const& eye) {
    return perspective_view(pose_looking(eye, V3(0.1, -0.3, -1), up), 1.0, 1.6, 0.1, 200.0);
}

int count_of(Points const& points) {
    return static_cast<int>(points.size());
}

// Before the eye of view_from(at), from `first` metres on, thrown up by as much as `height`.
Points some_points(Dice& dice, int count, V3 const& at, double first, double height) {
    Points points;
    while (count_of(points) < count) {
        V3 const p = at + V3(dice.in(-1, 1), 0.1, -1.5) * (first + dice.in(0, 20)) + up * dice.in(0, height);
        if (eye_depth(view_from(at), p) > first) points.push_back({p, glm::normalize(up + 0.3 * dice.vector())});
    }
    return points;
}

// What no plane may be made of, to the eye of view_from(at).
Points bad_points(V3 const& at) {
    ViewVolume<double> const view = view_from(at);
    V3 const ahead = view.pose.forward;
    return {{at - ahead * 3.0, up},
            {at - ahead * 1e5, up},
            {at + view.pose.right * 4.0, up},
            {at, up},
            {at + ahead * 3e9, up},
            {V3(no_number, at.y, at.z - 5), up},
            {V3(at.x, endless, at.z - 5), up},
            {at + V3(-endless), up},
            {V3(at.x, at.y, -endless), up}};
}

// Sum of the squares of the distances, each over that of its depth.
double squares(ShadowPlane<double> const& plane, ViewVolume<double> const& view, Points const& points) {
    double sum = 0.0;
    for (auto const& p : points)
        sum += std::pow((glm::dot(plane.normal, p.point) + plane.offset) / eye_depth(view, p.point), 2.0);
    return sum;
}

// The height at which the weights, sorted by height, come to a half of all.
double slow_median(std::vector<std::pair<double, double>> height_and_weight) {
    std::sort(height_and_weight.begin(), height_and_weight.end());
    double total = 0.0, below = 0.0;
    for (auto const& [height, weight] : height_and_weight) total += weight;
    for (auto const& [height, weight] : height_and_weight) {
        below += weight;
        if (2.0 * below >= total) return height;
    }
    return no_number;
}

}  // namespace

TEST(LeastEigenvector, IsTheAxisAlongWhichAMatrixIsLeastAtAnyScale) {
    Dice dice;
    for (int i = 0; i < 300; ++i) {
        V3 const x = glm::normalize(dice.vector()), y = glm::normalize(glm::cross(x, dice.vector()));
        V3 const z = glm::cross(x, y);
        double const scale = std::pow(10.0, dice.in(-6, 6)), least = dice.in(-1, 1);
        double const along[3] = {least, least + dice.in(0.2, 3), least + dice.in(0.2, 3)};
        V3 square(0), mixed(0);
        V3 const axes[3] = {x, y, z};
        for (int k = 0; k < 3; ++k) {
            V3 const& a = axes[k];
            square += a * a * along[k] * scale;
            mixed += V3(a.x * a.y, a.y * a.z, a.z * a.x) * along[k] * scale;
        }
        EXPECT_NEAR(std::abs(glm::dot(detail::least_eigenvector(square, mixed), x)), 1.0, 1e-9);
    }
}

TEST(LeastEigenvector, OfAMatrixAlikeAllWaysIsNoneAndRaisesNoFlag) {
    for (double const same : {0.0, 2.0}) {
        auto const none = test::watched([&] { return detail::least_eigenvector(V3(same), V3(0)); });
        EXPECT_TRUE(none.calm_in_range());
        EXPECT_EQ(none.result, V3(0));
    }
}

// In its normal and its offset: turned or moved a little it is farther from the points.
TEST(LeastSquaresPlane, HasTheLeastSquaresOverDepth) {
    Dice dice;
    for (int i = 0; i < 100; ++i) {
        V3 const eye = dice.vector() * 50.0;
        ViewVolume<double> const view = view_from(eye);
        Points const points = some_points(dice, 20, eye, 0.3, 2.0);
        auto const plane = least_squares_plane(view, points.data(), count_of(points));
        double const least = squares(plane, view, points);
        EXPECT_NEAR(glm::length(plane.normal), 1.0, 1e-12);
        EXPECT_GE(glm::dot(plane.normal, eye) + plane.offset, 0.0) << "its normal is on the side of the eye";
        for (int k = 0; k < 20; ++k) {
            V3 const normal = glm::normalize(plane.normal + 0.01 * dice.vector());
            // About the middle of the weighted points, and beside it.
            V3 middle(0);
            double total = 0.0;
            for (auto const& p : points) {
                double const weight = std::pow(eye_depth(view, p.point), -2.0);
                middle += p.point * weight, total += weight;
            }
            double const offset = -glm::dot(normal, middle / total);
            EXPECT_GE(squares({normal, offset}, view, points), least * (1.0 - 1e-9));
            EXPECT_GE(squares({plane.normal, plane.offset + dice.in(-0.1, 0.1)}, view, points), least * (1.0 - 1e-9));
        }
    }
}

TEST(LeastSquaresPlane, OfNoPointsIsNoneThroughTheOrigin) {
    V3 const eye(3, 6, 0);
    Points const bad = bad_points(eye);
    for (int const count : {0, count_of(bad)}) {
        auto const plane = least_squares_plane(view_from(eye), bad.data(), count);
        EXPECT_EQ(plane.normal, V3(0));
        EXPECT_EQ(plane.offset, 0.0);
    }
}

TEST(PlaneChoice, PointsBehindTheEyeBesideItFarAwayOrNoNumbersCountForNothing) {
    Dice dice;
    V3 const eye(3, 6, 0);
    ViewVolume<double> const view = view_from(eye);
    for (int i = 0; i < 20; ++i) {
        Points const good = some_points(dice, 15, eye, 0.1, 2.0);
        auto const squares_of = [&](Points const& p) { return least_squares_plane(view, p.data(), count_of(p)); };
        auto const median_of = [&](Points const& p) { return weighted_median_plane(view, up, p.data(), count_of(p)); };
        for (auto const& bad : bad_points(eye)) {
            Points both = good;
            both.insert(both.begin() + 7, bad);
            EXPECT_EQ(squares_of(both).normal, squares_of(good).normal);
            EXPECT_EQ(squares_of(both).offset, squares_of(good).offset);
            EXPECT_EQ(median_of(both).offset, median_of(good).offset);
        }
        Points behind = good;
        behind.push_back(bad_points(eye)[0]);
        ShadowPlane<double> const plane{up, -5.0};
        EXPECT_EQ(plane_distortion(plane, view, slanting, behind.data(), count_of(behind)),
                  plane_distortion(plane, view, slanting, good.data(), count_of(good)));
    }
}

TEST(MedianPlane, IsAtTheMedianOfTheHeightsOfPointsInAnyOrder) {
    Dice dice;
    V3 const eye(3, 6, 0);
    ViewVolume<double> const view = view_from(eye);
    for (int i = 0; i < 100; ++i) {
        Points const points = some_points(dice, 2 * (i % 40) + 1, eye, 0.3, 9.0);
        V3 const normal = glm::normalize(dice.vector());
        std::vector<std::pair<double, double>> alike, weighted;
        for (auto const& p : points) {
            double const height = glm::dot(normal, p.point);
            alike.emplace_back(height, 1.0);
            weighted.emplace_back(height, 1.0 / std::pow(eye_depth(view, p.point), 2.0));
        }
        EXPECT_NEAR(-median_plane(normal, points.data(), count_of(points)).offset, slow_median(alike), 1e-12);
        EXPECT_NEAR(-weighted_median_plane(view, normal, points.data(), count_of(points)).offset, slow_median(weighted),
                    1e-12);
    }
}

TEST(MedianPlane, WithWeightsLooksAtEveryPointOfAsManyAsItHolds) {
    V3 const eye(0, 6, 0);
    Points points;
    for (int i = 0; i < max_samples; ++i)
        points.push_back({eye + V3(0, i % 2 == 0 ? -5 : 0, i % 2 == 0 ? -90 : -9), up});
    EXPECT_EQ(weighted_median_plane(view_from(eye), up, points.data(), max_samples).offset, -6.0);
}

// The light runs along a wall of no width in any map.
TEST(PlaneDistortion, IsFiniteWithAPointThatNoMapServes) {
    V3 const eye(0, 6, 0), along_light = glm::normalize(V3(1, 0.4, 0));
    Dice dice;
    Points points = some_points(dice, 9, eye, 2.0, 2.0);
    ShadowPlane<double> const plane{up, -5.0};
    auto const distortion = [&] {
        return plane_distortion(plane, view_from(eye), slanting, points.data(), count_of(points));
    };
    double const served = distortion();
    points.push_back({eye + V3(0, 0, -10), along_light});
    double const most = std::log(footprint_limit<double>);
    EXPECT_GT(distortion(), 0.9 * served + 0.1 * most * most - 1e-9);
    EXPECT_LE(distortion(), 0.9 * served + 0.2 * most * most + 1e-9);
}

// Of no plane parallel to it, between the points, to a hundredth of their height.
TEST(ChoosePlane, NoParallelPlaneBetweenThePointsHasLessDistortion) {
    Dice dice;
    for (int i = 0; i < 20; ++i) {
        // Most of it high up or low down: medians are not the best.
        V3 const eye(3, 6, 0);
        ViewVolume<double> const view = view_from(eye);
        Points points = some_points(dice, 40, eye, 4.0, 0.0);
        for (auto& p : points) p.point.y = 3.0 * std::pow(dice.in(0, 1), i % 2 == 0 ? 3.0 : 0.3);
        auto const choice = choose_plane(view, slanting, points.data(), count_of(points), up);
        ASSERT_TRUE(choice.visible);
        double lo = endless, hi = -endless;
        for (auto const& p : points) {
            lo = std::fmin(lo, glm::dot(choice.plane.normal, p.point));
            hi = std::fmax(hi, glm::dot(choice.plane.normal, p.point));
        }
        // The least of a curve that is smooth near it: half a step beside it is as good, but for little.
        for (int k = 0; k <= 100; ++k) {
            ShadowPlane<double> const other{choice.plane.normal, -(lo + (hi - lo) * k / 100.0)};
            EXPECT_LE(choice.distortion,
                      plane_distortion(other, view, slanting, points.data(), count_of(points)) * 1.001)
                << i << ' ' << k;
        }
    }
}

TEST(ChoosePlane, MovesWithTheWorld) {
    Dice dice;
    V3 const eye(3, 6, 0);
    for (double const off : {-64.0, 64.0}) {
        Points points = some_points(dice, 40, eye, 2.0, 3.0);
        auto const choice = choose_plane(view_from(eye), slanting, points.data(), count_of(points), up);
        for (auto& p : points) p.point.y += off;
        auto const moved = choose_plane(view_from(eye + up * off), slanting, points.data(), count_of(points), up);
        EXPECT_NEAR(moved.distortion, choice.distortion, 1e-6 * choice.distortion);
        EXPECT_NEAR(moved.plane.offset, choice.plane.offset - choice.plane.normal.y * off, 1e-6);
    }
}

TEST(ChoosePlane, ReadsNoMorePointsThanThereAre) {
    Dice dice;
    V3 const eye(3, 6, 0);
    Points points = some_points(dice, 40, eye, 2.0, 3.0);
    auto const choice = choose_plane(view_from(eye), slanting, points.data(), 40, up);
    points.push_back({V3(0, 5000, -5), up});
    auto const again = choose_plane(view_from(eye), slanting, points.data(), 40, up);
    EXPECT_EQ(again.plane.normal, choice.plane.normal);
    EXPECT_EQ(again.plane.offset, choice.plane.offset);
}

TEST(ChoosePlane, KeepsAPlaneThatIsAsGoodAndSaysThatItIsVisible) {
    Dice dice;
    V3 const eye(3, 6, 0);
    ViewVolume<double> const view = view_from(eye);
    Points const points = some_points(dice, 40, eye, 2.0, 3.0);
    auto const best = choose_plane(view, slanting, points.data(), 40, up);
    ShadowPlane<double> worse = best.plane;
    worse.offset -= 0.2;
    // Hysteresis that is no number is none.
    for (double const hysteresis : {0.0, no_number}) {
        auto const kept = choose_plane(view, slanting, points.data(), 40, up, &best.plane, hysteresis);
        EXPECT_TRUE(kept.kept);
        EXPECT_TRUE(kept.visible);
        EXPECT_EQ(kept.distortion, best.distortion);
        EXPECT_FALSE(choose_plane(view, slanting, points.data(), 40, up, &worse, hysteresis).kept);
    }
    EXPECT_FALSE(choose_plane<double>(view, slanting, nullptr, 0, up, &best.plane).visible) << "it serves nothing";
}
