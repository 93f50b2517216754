// SPDX-License-Identifier: MIT
#include <shadowmath/plane_choice.hpp>

#include "tests/laws/shadow_map.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace shadowmath;

namespace {

using V2 = glm::dvec2;
using V3 = glm::dvec3;
using Points = std::vector<SurfacePoint<double>>;

Light<double> const slanting = directional(V3(0.4, -1, 0.2));
V3 const up(0, 1, 0);

ViewVolume<double> view_over_ground() {
    return perspective_view(pose_looking(V3(0, 6, 0), V3(0.1, -0.3, -1), up), 1.0, 1.6, 0.1, 200.0);
}

// Points of the plane through `origin` with this normal, on a grid ahead of the eye.
Points points_on(V3 const& origin, V3 const& normal) {
    Points points;
    for (int x = -6; x <= 6; ++x)
        for (int z = 2; z < 15; ++z) {
            V3 p(x * z * 0.3, 0, -3.0 * z);
            p.y = origin.y - (normal.x * (p.x - origin.x) + normal.z * (p.z - origin.z)) / normal.y;
            points.push_back({p, normal});
        }
    return points;
}

int count_of(Points const& points) {
    return static_cast<int>(points.size());
}

}  // namespace

TEST(LeastSquaresPlane, FindsAPlaneExactly) {
    for (V3 const& n : {V3(0, 1, 0), V3(0.1, 1, 0.05), V3(-0.2, 1, 0.1)}) {
        Points const points = points_on(V3(0, 0.5, -20), glm::normalize(n));
        auto const plane = least_squares_plane(view_over_ground(), points.data(), count_of(points));
        EXPECT_NEAR(glm::dot(plane.normal, glm::normalize(n)), 1.0, 1e-12);
        EXPECT_NEAR(glm::dot(plane.normal, V3(0, 0.5, -20)) + plane.offset, 0.0, 1e-9);
    }
}

TEST(LeastSquaresPlane, OfALineOrAPointIsNone) {
    for (V3 const& way : {V3(0.0), V3(1, 0, -2)}) {
        Points points;
        for (int i = 0; i < 9; ++i) points.push_back({V3(0, 0, -10) + way * double(i), up});
        EXPECT_EQ(least_squares_plane(view_over_ground(), points.data(), count_of(points)).normal, V3(0.0));
    }
    EXPECT_EQ(least_squares_plane<double>(view_over_ground(), nullptr, 0).normal, V3(0.0));
}

TEST(MedianPlane, HasHalfOfThePointsOnEitherSideWhateverTheOutliers) {
    Points points;
    for (int i = 0; i < 101; ++i) points.push_back({V3(i, i < 60 ? 0.01 * i : 1000.0, 0), up});
    EXPECT_NEAR(-median_plane(V3(0, 2, 0), points.data(), 101).offset, 0.5, 1e-12);
    Points const many(5000, SurfacePoint<double>{V3(1, 7, 2), up});
    EXPECT_NEAR(-median_plane(up, many.data(), 5000).offset, 7.0, 1e-12);
    EXPECT_EQ(median_plane<double>(up, nullptr, 0).offset, 0.0);
}

// Ten points a few metres ahead, a hundred far away and 3 m higher: these take a fifteenth of the pixels of the near
// ones.
TEST(MedianPlane, WithWeightsIsNotOutvotedByWhatIsFar) {
    ViewVolume<double> const view = view_over_ground();
    Points points;
    for (int i = 0; i < 110; ++i) {
        double const depth = i < 10 ? 8.0 : 100.0;
        V3 p = view.pose.position + view.pose.forward * depth;
        p.y = i < 10 ? 0.01 * i : 3.0;
        points.push_back({p, up});
    }
    EXPECT_NEAR(-median_plane(up, points.data(), 110).offset, 3.0, 1e-12);
    EXPECT_NEAR(-weighted_median_plane(view, V3(0, 2, 0), points.data(), 110).offset, 0.05, 0.011);
    for (auto& p : points) p.point -= view.pose.forward * 500.0;
    EXPECT_EQ(weighted_median_plane(view, up, points.data(), 110).offset, 0.0) << "all behind the eye";
    EXPECT_EQ(weighted_median_plane<double>(view, up, nullptr, 0).offset, 0.0);
}

TEST(PlaneDistortion, IsNothingOnThePlaneItself) {
    Points const points = points_on(V3(0, 0.5, -20), up);
    EXPECT_NEAR(plane_distortion({up, -0.5}, view_over_ground(), slanting, points.data(), count_of(points)), 0.0,
                1e-12);
    EXPECT_GT(plane_distortion({up, 1.0}, view_over_ground(), slanting, points.data(), count_of(points)), 1e-3);
    double const most = std::numeric_limits<double>::max();
    EXPECT_EQ(plane_distortion({V3(0.0), 0.0}, view_over_ground(), slanting, points.data(), count_of(points)), most);
    EXPECT_EQ(plane_distortion<double>({up, 0.0}, view_over_ground(), slanting, nullptr, 0), most);
}

// Two parallel floors, a third of the points on the upper one: no plane serves both alike.
TEST(ChoosePlane, HasNoMoreDistortionThanMedianSquaresOrMean) {
    Points points = points_on(V3(0, 0, -20), up);
    for (std::size_t i = 0; i < points.size(); i += 3) points[i].point.y = 1.5;
    ViewVolume<double> const view = view_over_ground();
    int const count = count_of(points);
    auto const choice = choose_plane(view, slanting, points.data(), count, up);
    ASSERT_TRUE(choice.visible);
    EXPECT_FALSE(choice.kept);
    auto const of = [&](ShadowPlane<double> const& plane) {
        return plane_distortion(plane, view, slanting, points.data(), count);
    };
    EXPECT_EQ(choice.distortion, of(choice.plane));
    EXPECT_LE(choice.distortion, of(median_plane(up, points.data(), count)));
    EXPECT_LE(choice.distortion, of(weighted_median_plane(view, up, points.data(), count)));
    EXPECT_LE(choice.distortion, of(least_squares_plane(view, points.data(), count)));
    for (double height = 0.0; height <= 1.5; height += 0.05)
        EXPECT_LE(choice.distortion, of({choice.plane.normal, -height}) * 1.001) << height;
}

TEST(ChoosePlane, FollowsASlopeAndMakesAMapOfIt) {
    V3 const normal = glm::normalize(V3(-0.2, 1, 0.15));
    Points const points = points_on(V3(0, 0, -20), normal);
    ViewVolume<double> const view = view_over_ground();
    auto const choice = choose_plane(view, slanting, points.data(), count_of(points), up);
    EXPECT_NEAR(glm::dot(choice.plane.normal, normal), 1.0, 1e-9);
    EXPECT_NEAR(choice.distortion, 0.0, 1e-9);
    Aabb<double> const world{V3(-100, -30, -100), V3(100, 30, 10)};
    auto const map = view_dependent_map(view, slanting, choice.plane, world, world, VdsmOptions<double>{}, gl_clip);
    EXPECT_TRUE(map.visible);
    EXPECT_TRUE(laws::is_map_of(map.clip_from_world, slanting, gl_clip));
}

TEST(ChoosePlane, KeepsTheLastPlaneUntilAnotherIsBetterByATenth) {
    Points points = points_on(V3(0, 0, -20), up);
    for (std::size_t i = 0; i < points.size(); i += 3) points[i].point.y = 1.5;
    ViewVolume<double> const view = view_over_ground();
    int const count = count_of(points);
    auto const best = choose_plane(view, slanting, points.data(), count, up);
    bool was_kept = true;
    for (double off = 0.0; off < 2.0; off += 0.02) {
        ShadowPlane<double> const previous{best.plane.normal, best.plane.offset - off};
        auto const next = choose_plane(view, slanting, points.data(), count, up, &previous);
        double const distortion = plane_distortion(previous, view, slanting, points.data(), count);
        EXPECT_EQ(next.kept, !(best.distortion < 0.9 * distortion)) << off;
        EXPECT_TRUE(was_kept || !next.kept);
        was_kept = next.kept;
    }
    EXPECT_FALSE(was_kept);
}

TEST(ChoosePlane, HasNothingToChooseWithoutPointsOrLight) {
    EXPECT_FALSE(choose_plane<double>(view_over_ground(), slanting, nullptr, 0, up).visible);
    Points const points = points_on(V3(0, 0, -20), up);
    EXPECT_FALSE(choose_plane(view_over_ground(), directional(V3(0.0)), points.data(), count_of(points), up).visible);
    // The light lies in the only plane there is.
    EXPECT_FALSE(
        choose_plane(view_over_ground(), directional(V3(1, 0, 0)), points.data(), count_of(points), up).visible);
}

TEST(ChoosePlane, NeitherAllocatesNorRaisesAFlag) {
    Points const points = points_on(V3(0, 0, -20), up);
    EXPECT_TRUE(test::watched([&] {
                    return choose_plane(view_over_ground(), slanting, points.data(), count_of(points), up);
                }).calm_in_range());
}

TEST(StillGood, TurnsFalseAsTheCameraComesDown) {
    ViewVolume<double> const view = view_over_ground();
    Aabb<double> const world{V3(-100, 0, -150), V3(100, 0, 10)}, casters{V3(-100, 0, -150), V3(100, 9, 10)};
    VdsmOptions<double> options;
    options.map_size = 2048;
    auto const map = view_dependent_map(view, slanting, {up, 0.0}, casters, world, options, gl_clip);
    auto const worth = [&](ViewVolume<double> const& eye) {
        Samples<double> const samples = samples_in(eye, slanting, world);
        return worth_of(map, 2048, eye, V2(1600, 1000), samples.at.data(), samples.count);
    };
    Worth<double> const drawn = worth(view);
    EXPECT_EQ(drawn.unserved, 0);
    EXPECT_TRUE(still_good(drawn, worth(view)));
    bool was_good = true;
    int good = 0;
    for (int step = 1; step <= 20; ++step) {
        ViewVolume<double> moved = view;
        moved.pose.position.y -= 0.25 * step;
        bool const is_good = still_good(drawn, worth(moved), 1.5);
        EXPECT_TRUE(was_good || !is_good)
            << step << " " << worth(moved).worst << " of " << drawn.worst << " unserved " << worth(moved).unserved;
        was_good = is_good;
        good += is_good;
    }
    EXPECT_GT(good, 0);
    EXPECT_LT(good, 20);
}

TEST(MedianPlane, LooksAtEveryPointOfAsManyAsItHolds) {
    Points points;
    for (int i = 0; i < max_samples; ++i) points.push_back({V3(0, i % 2 == 0 ? 0 : 5, -10), up});
    EXPECT_EQ(median_plane(up, points.data(), count_of(points)).offset, -5.0);
}

TEST(PlaneDistortion, IsAMeanOverThePoints) {
    Points once = points_on(V3(0, 0.5, -20), up), twice = once;
    twice.insert(twice.end(), once.begin(), once.end());
    ShadowPlane<double> const plane{up, -0.2};
    auto const of = [&](Points const& points) {
        return plane_distortion(plane, view_over_ground(), slanting, points.data(), count_of(points));
    };
    EXPECT_GT(of(once), 0.0);
    EXPECT_NEAR(of(twice), of(once), 1e-12 * of(once));
}

TEST(PlaneDistortion, IsTheLargestNumberWhereNothingIsServed) {
    // Walls that the light runs along: their footprint is the limit in any map.
    V3 const along_light = glm::normalize(V3(1, 0.4, 0));
    Points points{{V3(0, 1, -10), along_light}, {V3(1, 2, -20), along_light}};
    EXPECT_NEAR(glm::dot(along_light, slanting.direction), 0.0, 1e-15);
    EXPECT_EQ(plane_distortion(ShadowPlane<double>{up, 0.0}, view_over_ground(), slanting, points.data(), 2),
              std::numeric_limits<double>::max());
}

TEST(PlaneDistortion, CountsPointsOfThePlaneItselfWhateverTheirFootprintsRoundTo) {
    for (SurfacePoint<double> const& point : points_on(V3(0, 0.5, -20), up)) {
        ShadowPlane<double> const plane{up, -0.5};
        EXPECT_NEAR(plane_distortion(plane, view_over_ground(), slanting, &point, 1), 0.0, 1e-9);
    }
}
