// SPDX-License-Identifier: MIT
#include "tests/laws/sample_bounds.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;

template <class T>
class SampleBoundsOf : public ::testing::Test {};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(SampleBoundsOf, Scalars);

namespace {

// From 2 m above the origin along -z, a right angle wide and high; the sun is overhead: light x = x, y = -z, depth =
// -y.
template <class T>
ViewVolume<T> looking_ahead() {
    ViewVolume<T> view;
    view.pose.position = Vec3<T>(0, 2, 0);
    view.z_near = T(1);
    view.z_far = T(100);
    return view;
}

}  // namespace

TYPED_TEST(SampleBoundsOf, APixelAndADepthAreAPoint) {
    using T = TypeParam;
    auto const rays = sample_rays(looking_ahead<T>(), Light<T>{}, 2, 4);
    EXPECT_TRUE(rays.usable);
    EXPECT_EQ(rays.eye, Vec3<T>(0, 0, -2));
    // Pixel centres at -1/2 and 1/2 in x, at -3/4 to 3/4 in y.
    EXPECT_EQ(from_eye(rays, 0, 0, T(8)), Vec3<T>(-4, 8, 6));
    EXPECT_EQ(from_eye(rays, 1, 3, T(8)), Vec3<T>(4, 8, -6));
}

TYPED_TEST(SampleBoundsOf, AnOrthographicViewDoesNotSpread) {
    using T = TypeParam;
    ViewVolume<T> view = looking_ahead<T>();
    view.kind = ViewKind::orthographic;
    auto const rays = sample_rays(view, Light<T>{}, 2, 4);
    EXPECT_EQ(from_eye(rays, 0, 0, T(8)), Vec3<T>(T(-0.5), 8, T(0.75)));
}

TYPED_TEST(SampleBoundsOf, SamplesAtAPlaneCountForBothNeighbours) {
    using T = TypeParam;
    T const planes[] = {T(10)};
    auto const rays = sample_rays(looking_ahead<T>(), Light<T>{}, 2, 4);
    auto const boxes_with = [&](T depth, T blend) {
        auto bounds = no_bounds(explicit_splits(T(1), T(100), planes, 2), blend);
        add(bounds, rays, 0, 0, depth);
        return (is_empty(bounds.box[0]) ? 0 : 1) + (is_empty(bounds.box[1]) ? 0 : 2);
    };
    EXPECT_EQ(boxes_with(T(9), T(0)), 1);
    EXPECT_EQ(boxes_with(T(9.999), T(0)), 3);
    EXPECT_EQ(boxes_with(T(10), T(0)), 3);
    EXPECT_EQ(boxes_with(T(11), T(0)), 2);
    EXPECT_EQ(boxes_with(T(9), T(0.5)), 3);  // in the blend band
    EXPECT_EQ(boxes_with(T(5), T(0.5)), 1);
}

TYPED_TEST(SampleBoundsOf, WhatIsNotSeenIsLeftOut) {
    using T = TypeParam;
    auto const rays = sample_rays(looking_ahead<T>(), Light<T>{}, 2, 4);
    auto bounds = no_bounds(uniform_splits(T(1), T(100), 3));
    for (T const depth :
         {T(0.999), T(100), T(-5), std::numeric_limits<T>::infinity(), std::numeric_limits<T>::quiet_NaN()})
        add(bounds, rays, 1, 1, depth);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(is_empty(bounds.box[i]));
    auto none = no_bounds(Splits<T>{});
    add(none, rays, 1, 1, T(5));
    EXPECT_EQ(none.count, 0);
}

TYPED_TEST(SampleBoundsOf, OfATileThatIsNoneNothingIsTakenIn) {
    using T = TypeParam;
    auto const rays = sample_rays(looking_ahead<T>(), Light<T>{}, 4, 4);
    T const nan = std::numeric_limits<T>::quiet_NaN(), infinite = std::numeric_limits<T>::infinity();
    auto bounds = no_bounds(logarithmic_splits(T(1), T(100), 2));
    add_tile(bounds, rays, 1, 1, T(5), T(4));
    add_tile(bounds, rays, 1, 1, nan, T(4));
    add_tile(bounds, rays, 1, 1, T(4), infinite);
    add_tile(bounds, rays, 1, 1, T(200), T(300));
    for (int i = 0; i < bounds.count; ++i) EXPECT_TRUE(is_empty(bounds.box[i]));
    add_tile(bounds, rays, 1, 1, T(2), T(3));
    EXPECT_FALSE(is_empty(bounds.box[0]));
    EXPECT_TRUE(is_empty(bounds.box[1]));
}

TYPED_TEST(SampleBoundsOf, ViewsAndLightsWithFaultsGiveNoRays) {
    using T = TypeParam;
    ViewVolume<T> view = looking_ahead<T>();
    EXPECT_FALSE(sample_rays(view, directional(Vec3<T>(0)), 2, 2).usable);
    EXPECT_TRUE(sample_rays(view, directional(Vec3<T>(0)), 2, 2).faults.has(Fault::zero_light));
    EXPECT_TRUE(sample_rays(view, spot(Vec3<T>(0), Vec3<T>(1), T(1), T(9)), 2, 2).faults.has(Fault::clamped_option));
    EXPECT_FALSE(sample_rays(view, Light<T>{}, 0, 2).usable);
    EXPECT_TRUE(sample_rays(view, Light<T>{}, 1, 1).usable) << "a picture of one pixel";
    EXPECT_FALSE(sample_rays(view, Light<T>{}, 2, 0).usable);
    view.pose.position.x = T(1e20);
    EXPECT_TRUE(sample_rays(view, Light<T>{}, 2, 2).faults.has(Fault::precision_lost));
    view.pose.position.x = std::numeric_limits<T>::quiet_NaN();
    EXPECT_TRUE(sample_rays(view, Light<T>{}, 2, 2).faults.has(Fault::not_finite));
}

TYPED_TEST(SampleBoundsOf, AsManySplitsAsThereCanBeAddUp) {
    using T = TypeParam;
    auto const rays = sample_rays(looking_ahead<T>(), Light<T>{}, 2, 4);
    auto near_ones = no_bounds(uniform_splits(T(1), T(100), max_splits)), far_ones = near_ones;
    add(near_ones, rays, 1, 1, T(2));
    add(far_ones, rays, 1, 1, T(99));
    add(near_ones, far_ones);
    EXPECT_FALSE(is_empty(near_ones.box[0]));
    EXPECT_FALSE(is_empty(near_ones.box[max_splits - 1]));
    EXPECT_TRUE(is_empty(near_ones.box[5]));
}

TYPED_TEST(SampleBoundsOf, ASampleAtTheNearEndIsTakenIn) {
    using T = TypeParam;
    auto const rays = sample_rays(looking_ahead<T>(), Light<T>{}, 2, 4);
    auto bounds = no_bounds(uniform_splits(T(1), T(100), 2));
    add(bounds, rays, 0, 0, T(1));
    EXPECT_TRUE(contains(bounds.box[0], from_eye(rays, 0, 0, T(1))));
    EXPECT_TRUE(is_empty(bounds.box[1]));
}

TYPED_TEST(SampleBoundsOf, OfATileItsWholeCellIsTakenInAndNoMore) {
    using T = TypeParam;
    // The cell from -1/2 to 0 in x and in y.
    auto const rays = sample_rays(looking_ahead<T>(), Light<T>{}, 4, 4);
    auto const box_of = [&](T nearest, T farthest) {
        auto bounds = no_bounds(uniform_splits(T(1), T(100), 1));
        add_tile(bounds, rays, 1, 1, nearest, farthest);
        return bounds.box[0];
    };
    EXPECT_EQ(box_of(T(2), T(3)).lo, Vec3<T>(T(-1.5), 2, 0));
    EXPECT_EQ(box_of(T(2), T(3)).hi, Vec3<T>(0, 3, T(1.5)));
    EXPECT_EQ(box_of(T(4), T(4)).lo, Vec3<T>(-2, 4, 0)) << "a tile of one depth";
    EXPECT_EQ(box_of(T(4), T(4)).hi, Vec3<T>(0, 4, 2));
}

TYPED_TEST(SampleBoundsOf, BoxesBeyondTheCountStayAsTheyAre) {
    using T = TypeParam;
    auto const rays = sample_rays(looking_ahead<T>(), Light<T>{}, 2, 4);
    T const planes[] = {T(10), T(20)};
    auto const three = no_bounds(explicit_splits(T(1), T(100), planes, 3));
    auto all = three, two = three;
    two.count = 2;
    add(all, rays, 0, 0, T(19.999));
    add(two, rays, 0, 0, T(19.999));
    EXPECT_FALSE(is_empty(all.box[2])) << "served by the third too";
    EXPECT_FALSE(is_empty(two.box[1]));
    EXPECT_TRUE(is_empty(two.box[2]));
    add_tile(two, rays, 0, 0, T(5), T(50));
    EXPECT_TRUE(is_empty(two.box[2]));
    add(two, all);
    EXPECT_TRUE(is_empty(two.box[2]));
}
