// SPDX-License-Identifier: MIT
#include <shadowmath/by_footprint.hpp>
#include <shadowmath/cascades.hpp>
#include <shadowmath/plane_set.hpp>

#include "tests/laws/by_footprint.hpp"
#include "tests/laws/shadow_map.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <vector>

using namespace shadowmath;

namespace {

using V2 = glm::dvec2;
using V3 = glm::dvec3;
using Points = std::vector<SurfacePoint<double>>;

Light<double> const slanting = directional(V3(0.5, -1, -0.7));
ViewVolume<double> const view =
    perspective_view(pose_looking(V3(0, 6, 0), V3(0.1, -0.15, -1), V3(0, 1, 0)), 1.0, 1.6, 0.1, 200.0);
V3 const up(0, 1, 0), ahead(0, 0, 1);

// A floor up to a wall 40 m ahead; of every five points `of_five` on the wall.
Points floor_and_wall(int of_five) {
    Points points;
    for (int i = 0; i < 400; ++i) {
        double const across = (i % 20) / 20.0 - 0.5, along = (i / 20) / 20.0;
        if (i % 5 < of_five)
            points.push_back({V3(across * 40, along * 15, -40), ahead});
        else
            points.push_back({V3(across * 30, 0, -4 - along * 34), up});
    }
    return points;
}

int count_of(Points const& points) {
    return static_cast<int>(points.size());
}

bool is_floor(ShadowPlane<double> const& plane) {
    return std::abs(glm::dot(plane.normal, up)) > 0.999 && std::abs(plane.offset) < 1e-9;
}

bool is_wall(ShadowPlane<double> const& plane) {
    return std::abs(glm::dot(plane.normal, ahead)) > 0.999 && std::abs(plane.offset - 40.0) < 1e-9;
}

}  // namespace

TEST(ChoosePlanes, FindsFloorAndWallTheLargerOneFirst) {
    // The wall's map serves what lies before the wall too.
    for (int const of_five : {1, 3}) {
        Points const points = floor_and_wall(of_five);
        auto const planes = choose_planes(view, slanting, points.data(), count_of(points));
        ASSERT_EQ(planes.count, 2) << of_five;
        EXPECT_TRUE(of_five == 1 ? is_floor(planes.at[0]) : is_wall(planes.at[0])) << of_five;
        EXPECT_TRUE(of_five == 1 ? is_wall(planes.at[1]) : is_floor(planes.at[1])) << of_five;
        EXPECT_GE(planes.share[0], planes.share[1]);
        EXPECT_NEAR(planes.share[0] + planes.share[1], 1.0, 1e-12);
    }
}

TEST(ChoosePlanes, LeaveOutAPlaneThatIsNotWorthAMap) {
    Points points = floor_and_wall(0);
    for (std::size_t i = 0; i < points.size(); i += 11)
        points[i] = {V3(double(i % 20) - 10, 1.0 + 0.01 * double(i), -40), ahead};
    PlaneSetOptions<double> options;
    EXPECT_EQ(choose_planes(view, slanting, points.data(), count_of(points), options).count, 1);
    options.least_share = 0.05;
    EXPECT_EQ(choose_planes(view, slanting, points.data(), count_of(points), options).count, 2);
    options.most = 1;
    EXPECT_EQ(choose_planes(view, slanting, points.data(), count_of(points), options).count, 1);
    options.most = 0;
    EXPECT_EQ(choose_planes(view, slanting, points.data(), count_of(points), options).count, 0);
}

TEST(ChoosePlanes, KeepTheLastPlanesWhileOthersAreLittleBetter) {
    Points const points = floor_and_wall(1);
    PlaneSet<double> last;
    last.count = 1;
    last.at[0] = {up, -1e-3};  // a millimetre high: as good as the floor itself
    auto const kept = choose_planes(view, slanting, points.data(), count_of(points), {}, &last);
    ASSERT_EQ(kept.count, 2);
    EXPECT_EQ(kept.at[0].offset, -1e-3);
    last.at[0] = {up, -5.0};  // just below the eye: no good to anyone
    EXPECT_TRUE(is_floor(choose_planes(view, slanting, points.data(), count_of(points), {}, &last).at[0]));
}

TEST(ChoosePlanes, HaveNothingToChooseWithoutPointsOrLight) {
    Points points = floor_and_wall(2);
    EXPECT_EQ(choose_planes<double>(view, slanting, nullptr, 0).count, 0);
    EXPECT_EQ(choose_planes(view, directional(V3(0.0)), points.data(), count_of(points)).count, 0);
    // From below and behind, no sample is lit.
    EXPECT_EQ(choose_planes(view, directional(V3(0, 1, 1)), points.data(), count_of(points)).count, 0);
    for (double PlaneSetOptions<double>::*option :
         {&PlaneSetOptions<double>::good_pixels, &PlaneSetOptions<double>::least_share,
          &PlaneSetOptions<double>::hysteresis}) {
        PlaneSetOptions<double> options;
        options.*option = std::numeric_limits<double>::quiet_NaN();
        EXPECT_EQ(choose_planes(view, slanting, points.data(), count_of(points), options).count, 0);
    }
}

TEST(ChoosePlanes, NeitherAllocateNorRaiseAFlag) {
    Points const points = floor_and_wall(2);
    EXPECT_TRUE(test::watched([&] { return choose_planes(view, slanting, points.data(), count_of(points)); }).calm());
}

// The whole way: a map on each plane, a cascade behind them, the finest at each point.
TEST(ByFootprint, OfMapsOnFloorAndWallIsFinerThanEitherAndThanTheCascadeBehindThem) {
    Points const points = floor_and_wall(2);
    Aabb<double> const world{V3(-60, 0, -41), V3(60, 15, 5)}, casters{V3(-60, 0, -41), V3(60, 30, 20)};
    auto const planes = choose_planes(view, slanting, points.data(), count_of(points));
    int const size = 1024;
    std::vector<ShadowMap<double>> maps;
    for (int i = 0; i < planes.count; ++i) {
        VdsmOptions<double> options;
        options.map_size = size;
        maps.push_back(view_dependent_map(view, slanting, planes.at[std::size_t(i)], casters, world, options, gl_clip));
        EXPECT_TRUE(laws::is_map_of(maps.back().clip_from_world, slanting, gl_clip));
    }
    CascadeOptions<double> options;
    options.count = 1;
    options.map_size = size;
    options.fit = CascadeFit::rectangle;
    maps.push_back(fit_cascades(view, slanting, casters, world, options).at[0].map);
    Mat4<double> const eye = clip_from_world(view, ClipSpace{});
    V2 const picture(1600, 1000);
    auto const mean = [&](int first, int count) {
        double sum = 0.0;
        for (auto const& p : points) {
            auto const at = by_footprint(maps.data() + first, count, size, 2.0, eye, picture, p.point, p.normal);
            EXPECT_TRUE(laws::is_finest(at, maps.data() + first, count, size, 2.0, eye, picture, p.point, p.normal));
            sum += at.first < 0 ? 100.0
                                : footprint(eye, picture, maps[std::size_t(first + at.first)].clip_from_world,
                                            double(size), p.point, p.normal)
                                      .major;
        }
        return sum / double(points.size());
    };
    double const together = mean(0, 3);
    for (int alone = 0; alone < 2; ++alone) EXPECT_LT(together, 0.85 * mean(alone, 1)) << alone;
    EXPECT_LT(together, 0.3 * mean(2, 1)) << "the cascade";
    std::array<int, 3> used{};
    for (auto const& p : points) {
        int const map = by_footprint(maps.data(), 3, size, 2.0, eye, picture, p.point, p.normal).first;
        if (map >= 0) ++used[std::size_t(map)];
    }
    EXPECT_GT(used[0], 100);
    EXPECT_GT(used[1], 100);
}

TEST(ByFootprint, MixesHalfAndHalfWhereTwoMapsAreAlikeAndNotBeyondTheBand) {
    auto const map_of = [](double half) {
        ShadowMap<double> map;
        map.visible = true;
        map.clip = gl_zero_to_one_clip;
        map.clip_from_world = clip_from_world(
            LightBox<double>{light_basis(slanting.direction), V2(-half), V2(half), -100.0, 100.0}, map.clip);
        return map;
    };
    Mat4<double> const eye = clip_from_world(view, ClipSpace{});
    auto const at = [&](double a, double b, double band) {
        std::array const maps{map_of(a), map_of(b)};
        return by_footprint(maps.data(), 2, 1024, 2.0, eye, V2(1600, 1000), V3(0, 0, -10), up, band);
    };
    LookUp<double> const equal = at(30, 30, 0.25), near_it = at(33, 30, 0.25), beyond = at(60, 30, 0.25);
    EXPECT_EQ(equal.first, 0);
    EXPECT_EQ(equal.second, 1);
    EXPECT_EQ(equal.blend, 0.5);
    EXPECT_EQ(near_it.first, 1);
    EXPECT_EQ(near_it.second, 0);
    EXPECT_NEAR(near_it.blend, 0.5 * (1 - 0.1 / 0.25), 1e-12);
    EXPECT_EQ(beyond.first, 1);
    EXPECT_EQ(beyond.second, -1);
    EXPECT_EQ(beyond.blend, 0.0);
    EXPECT_EQ(at(33, 30, 0.0).second, -1);
    EXPECT_EQ(at(33, 30, std::numeric_limits<double>::quiet_NaN()).second, -1);
    EXPECT_EQ(at(5, 6, 0.25).first, -1) << "neither holds the point";
    std::array const alike{map_of(30), map_of(30)};
    LookUp<double> const of_few_pixels =
        by_footprint(alike.data(), 2, 1024, 2.0, eye, V2(16, 10), V3(0, 0, -10), up, 0.25);
    EXPECT_EQ(of_few_pixels.second, 1) << "texels far smaller than a pixel";
    LookUp<double> const unmixed = by_footprint(alike.data(), 2, 1024, 2.0, eye, V2(1600, 1000), V3(0, 0, -10), up);
    EXPECT_EQ(unmixed.first, 0);
    EXPECT_EQ(unmixed.second, -1) << "unless a band is asked for";
    EXPECT_EQ(by_footprint<double>(nullptr, 0, 1024, 2.0, eye, V2(1600, 1000), V3(0, 0, -10), up).first, -1);
}

TEST(ByFootprint, OfTexelsWithoutLengthNothingIsMixedNorDivided) {
    auto const made = test::watched([] { return look_up_in(FinestMaps<double>{3, 1, 0.0, 0.0}, 0.25); });
    EXPECT_TRUE(made.calm());
    EXPECT_EQ(made.result.first, 3);
    EXPECT_EQ(made.result.second, -1);
}

TEST(PlaneSet, LooksAtAsManyPointsAsItHolds) {
    Points points;
    while (count_of(points) < max_samples) points.push_back(floor_and_wall(0)[points.size()]);
    auto const planes = choose_planes(view, slanting, points.data(), max_samples);
    EXPECT_EQ(planes.count, 1);
    EXPECT_TRUE(is_floor(planes.at[0]));
    EXPECT_EQ(choose_planes(view, slanting, points.data(), 0).count, 0);
}

namespace {

int served_by(ShadowPlane<double> const& plane, Points const& points, double good_pixels = 2.0) {
    Samples<double> samples;
    for (auto const& point : points)
        if (samples.count < max_samples) samples.at[std::size_t(samples.count++)] = point;
    return detail::well_served(plane, clip_from_world(view, ClipSpace{}), slanting, samples, good_pixels);
}

double major_on(ShadowPlane<double> const& plane, SurfacePoint<double> const& p) {
    Mat4<double> const eye = clip_from_world(view, ClipSpace{});
    return footprint(eye, V2(1000), eye * plane_projection(plane, homogeneous(slanting)), 1000.0, p.point, p.normal)
        .major;
}

ShadowPlane<double> const floor_plane{up, 0.0}, wall_plane{ahead, 40.0};

}  // namespace

TEST(PlaneSet, APlaneThatTheLightRunsAlongServesNothing) {
    ShadowPlane<double> const along_light =
        plane_through(V3(0, 0, -20), glm::normalize(glm::cross(slanting.direction, up)));
    EXPECT_EQ(served_by(along_light, floor_and_wall(2)), 0);
    PlaneSet<double> last;
    last.count = 1;
    last.at[0] = along_light;
    Points const points = floor_and_wall(1);
    EXPECT_TRUE(is_floor(choose_planes(view, slanting, points.data(), count_of(points), {}, &last).at[0]));
}

TEST(PlaneSet, APlaneServesNoPointBehindTheEyeNorOneWhoseLightMeetsItThere) {
    EXPECT_EQ(served_by(floor_plane, {{V3(1, 0, 20), up}}), 0);
    // Just ahead and above the eye: the light goes on downward and back.
    Light<double> const backward = directional(V3(0, -1, 1));
    Samples<double> samples, left;
    samples.at[0] = {V3(0, 8, -6), up};
    samples.count = 1;
    Mat4<double> const eye = clip_from_world(view, ClipSpace{});
    EXPECT_EQ(detail::well_served(floor_plane, eye, backward, samples, 2.0, &left), 0);
    EXPECT_EQ(left.count, 1);
}

TEST(PlaneSet, AsManyPixelsAsAreGoodAreGood) {
    SurfacePoint<double> const point{V3(3, 0, -20), up};
    double const major = major_on(floor_plane, point);
    EXPECT_EQ(served_by(floor_plane, {point}, major), 1);
    EXPECT_EQ(served_by(floor_plane, {point}, std::nextafter(major, 0.0)), 0);
}

TEST(PlaneSet, LooksAtEverySampleOfAsManyAsItHolds) {
    Points points;
    for (int i = 0; i < max_samples; ++i)
        points.push_back(i % 2 == 0 ? floor_and_wall(0)[std::size_t(i % 400)]
                                    : floor_and_wall(5)[std::size_t(i % 400)]);
    EXPECT_EQ(choose_planes(view, slanting, points.data(), max_samples).count, 2);
}

TEST(PlaneSet, WhatLiesBehindTheEyeTakesNoShare) {
    Points points = floor_and_wall(0);
    std::size_t const seen = points.size();
    for (std::size_t i = 0; i < seen; ++i) points.push_back({V3(points[i].point.x, 0, 10 + double(i % 7)), up});
    auto const planes = choose_planes(view, slanting, points.data(), count_of(points));
    ASSERT_EQ(planes.count, 1);
    EXPECT_EQ(planes.share[0], 1.0);
}

// Of two planes that serve as many the first sample's is taken; one of the last frame stays while the other serves no
// more than 1 + hysteresis times as many.
TEST(PlaneSet, OfEqualsTheFirstAndOfNearlyEqualsTheLastFramesIsTaken) {
    auto const first_of = [](int on_floor, int on_wall, double hysteresis, ShadowPlane<double> const* last) {
        Points points;
        for (int i = 0; i < on_floor; ++i) points.push_back({V3(i - 2.0, 0, -12 - i), up});
        for (int i = 0; i < on_wall; ++i) points.push_back({V3(i - 2.0, 9.0 + i, -40), ahead});
        PlaneSetOptions<double> options;
        options.good_pixels = 1.05;
        options.hysteresis = hysteresis;
        PlaneSet<double> previous;
        previous.count = last != nullptr ? 1 : 0;
        if (last != nullptr) previous.at[0] = *last;
        for (ShadowPlane<double> const& plane : {floor_plane, wall_plane})
            EXPECT_EQ(served_by(plane, points, options.good_pixels), is_floor(plane) ? on_floor : on_wall);
        auto const planes = choose_planes(view, slanting, points.data(), count_of(points), options, &previous);
        return is_floor(planes.at[0]) ? 'f' : is_wall(planes.at[0]) ? 'w' : '?';
    };
    EXPECT_EQ(first_of(4, 4, 0.1, nullptr), 'f');
    EXPECT_EQ(first_of(4, 6, 0.1, &floor_plane), 'w');
    EXPECT_EQ(first_of(4, 6, 0.5, &floor_plane), 'f');  // just so many
    EXPECT_EQ(first_of(4, 6, 0.4, &floor_plane), 'w');
    EXPECT_EQ(first_of(4, 8, 1.0, &floor_plane), 'f');
    EXPECT_EQ(first_of(4, 9, 7.0, &floor_plane), 'w') << "twice as many are never too few";
    EXPECT_EQ(first_of(6, 6, -3.0, &wall_plane), 'w');
}

TEST(PlaneSet, AShareThatIsJustEnoughIsEnough) {
    Points const points = floor_and_wall(0);
    PlaneSetOptions<double> options;
    options.least_share = 1.0;
    EXPECT_EQ(choose_planes(view, slanting, points.data(), count_of(points), options).count, 1);
}
