// SPDX-License-Identifier: MIT
#include "tests/laws/sdsm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace shadowmath;

template <class T>
class Sdsm : public ::testing::Test {};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(Sdsm, Scalars);

namespace {

// From the origin along -z, a right angle wide and high.
template <class T>
ViewVolume<T> looking_ahead() {
    ViewVolume<T> view;
    view.z_near = T(0.1);
    view.z_far = T(1000);
    return view;
}

// A picture of 4 x 4 pixels, all at one depth: centres at -3/4 to 3/4 of it.
template <class T>
SampleBounds<T> wall_at(SampleRays<T> const& rays, T depth) {
    SampleDepths<T> depths = no_depths(T(0.1), T(1000));
    add(depths, depth);
    SampleBounds<T> bounds = no_bounds(sample_splits(depths, 4, SampleSplits::adaptive));
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) add(bounds, rays, x, y, depth);
    return bounds;
}

template <class T>
Aabb<T> brick() {
    return {Vec3<T>(-50, -50, -50), Vec3<T>(50, 50, 50)};
}

}  // namespace

TYPED_TEST(Sdsm, AWallFillsTheMapOfASunBehindTheEye) {
    using T = TypeParam;
    Light<T> const light = directional(Vec3<T>(0, 0, -1));
    auto const rays = sample_rays(looking_ahead<T>(), light, 4, 4);
    SampleFitOptions<T> options;
    options.map_size = 100;
    options.margin_texels = T(10);
    auto const cascades = fit_samples(rays, wall_at(rays, T(8)), brick<T>(), options);
    ASSERT_EQ(cascades.count, 1);
    ASSERT_TRUE(cascades.at[0].map.visible);
    // 12 m in 80 texels, from the brick's face at z = 50 to the wall at z = -8; each end 2^-18 of 8 m farther out.
    double const rounding = 256 * double(std::numeric_limits<T>::epsilon()), slack = 0x1p-15;
    EXPECT_NEAR(double(cascades.at[0].texel_metres), 0.15, 2 * slack / 80 + rounding);
    EXPECT_NEAR(double(cascades.at[0].depth_metres), 58, slack + 58 * rounding);
    EXPECT_TRUE(laws::is_map_of(cascades.at[0].map.clip_from_world, light, options.clip));
    options.pancake = true;
    EXPECT_LT(fit_samples(rays, wall_at(rays, T(8)), brick<T>(), options).at[0].depth_metres, T(1e-3));
}

TYPED_TEST(Sdsm, SeveralTimesTheTexelsOfTheWholeSlice) {
    using T = TypeParam;
    Light<T> const light = directional(Vec3<T>(T(0.3), -1, T(0.2)));
    auto const rays = sample_rays(looking_ahead<T>(), light, 4, 4);
    SampleFitOptions<T> options;
    auto const cascades = fit_samples(rays, wall_at(rays, T(8)), brick<T>(), options);
    CascadeOptions<T> whole;
    whole.count = 1;
    whole.fit = CascadeFit::tight;
    auto const tight = fit_cascades(looking_ahead<T>(), light, brick<T>(), brick<T>(), whole);
    EXPECT_GT(tight.at[0].texel_metres, T(50) * cascades.at[0].texel_metres);
}

TYPED_TEST(Sdsm, AnEmptyScreenNeedsNoMap) {
    using T = TypeParam;
    auto const rays = sample_rays(looking_ahead<T>(), Light<T>{}, 4, 4);
    auto const none = fit_samples(rays, no_bounds(Splits<T>{}), brick<T>(), SampleFitOptions<T>{});
    EXPECT_EQ(none.count, 0);
    EXPECT_FALSE(none.faults.any());
    // A split that no sample fell into.
    auto const unseen = fit_samples(rays, no_bounds(uniform_splits(T(1), T(10), 2)), brick<T>(), SampleFitOptions<T>{});
    ASSERT_EQ(unseen.count, 2);
    EXPECT_FALSE(unseen.at[0].map.visible || unseen.at[1].map.visible);
    EXPECT_TRUE(laws::harmless(unseen.at[0].map));
    EXPECT_FALSE(unseen.faults.any());
}

TYPED_TEST(Sdsm, NothingAboveTheSamplesNeedsNoMap) {
    using T = TypeParam;
    Light<T> const light = directional(Vec3<T>(0, 0, -1));
    auto const rays = sample_rays(looking_ahead<T>(), light, 4, 4);
    Aabb<T> const behind{Vec3<T>(-50, -50, -50), Vec3<T>(50, 50, -20)};
    auto const cascades = fit_samples(rays, wall_at(rays, T(8)), behind, SampleFitOptions<T>{});
    ASSERT_EQ(cascades.count, 1);
    EXPECT_FALSE(cascades.at[0].map.visible);
    EXPECT_FALSE(cascades.faults.any());
    EXPECT_FALSE(fit_samples(rays, wall_at(rays, T(8)), Aabb<T>{}, SampleFitOptions<T>{}).at[0].map.visible);
}

TYPED_TEST(Sdsm, CastersWithoutEndKeepAFiniteDepth) {
    using T = TypeParam;
    auto const rays = sample_rays(looking_ahead<T>(), directional(Vec3<T>(T(0.5), -1, T(-0.25))), 4, 4);
    T const huge = std::numeric_limits<T>::max();
    Aabb<T> const endless{Vec3<T>(-huge), Vec3<T>(huge)};
    auto const cascades = fit_samples(rays, wall_at(rays, T(8)), endless, SampleFitOptions<T>{});
    ASSERT_TRUE(cascades.at[0].map.visible);
    EXPECT_TRUE(laws::harmless(cascades.at[0].map));
    EXPECT_GT(cascades.at[0].depth_metres, T(1e5));
    EXPECT_LT(cascades.at[0].depth_metres, T(1e8));
}

TYPED_TEST(Sdsm, StillTexelsHaveOneOfEightSizesAnOctave) {
    using T = TypeParam;
    auto const rays = sample_rays(looking_ahead<T>(), directional(Vec3<T>(0, 0, -1)), 4, 4);
    SampleFitOptions<T> options;
    options.still = true;
    T last = T(0);
    int sizes = 0;
    for (int percent = 100; percent < 200; ++percent) {
        auto const cascades = fit_samples(rays, wall_at(rays, T(8) * T(percent) / T(100)), brick<T>(), options);
        T const texel = cascades.at[0].texel_metres;
        EXPECT_GE(texel, last);
        sizes += texel > last;
        last = texel;
        // Never an eighth more than a map that is not still.
        options.still = false;
        auto const tight = fit_samples(rays, wall_at(rays, T(8) * T(percent) / T(100)), brick<T>(), options);
        options.still = true;
        EXPECT_LE(texel, tight.at[0].texel_metres * T(1.13));
        EXPECT_GE(texel, tight.at[0].texel_metres);
    }
    EXPECT_EQ(sizes, 8);
}

TYPED_TEST(Sdsm, FarFromTheOriginStillMapsSayThatPrecisionIsLost) {
    using T = TypeParam;
    ViewVolume<T> view = looking_ahead<T>();
    view.pose.position = Vec3<T>(T(1) / std::numeric_limits<T>::epsilon(), 0, 0);
    auto const rays = sample_rays(view, directional(Vec3<T>(0, 0, -1)), 4, 4);
    SampleFitOptions<T> options;
    options.still = true;
    Aabb<T> const wide{Vec3<T>(T(-1e17)), Vec3<T>(T(1e17))};
    EXPECT_TRUE(fit_samples(rays, wall_at(rays, T(8)), wide, options).faults.has(Fault::precision_lost));
}

TYPED_TEST(Sdsm, BadInputsAreFaults) {
    using T = TypeParam;
    T const nan = std::numeric_limits<T>::quiet_NaN();
    auto const rays = sample_rays(looking_ahead<T>(), Light<T>{}, 4, 4);
    auto const bounds = wall_at(rays, T(8));
    SampleFitOptions<T> options;
    EXPECT_TRUE(fit_samples(rays, bounds, Aabb<T>{Vec3<T>(nan), Vec3<T>(1)}, options).faults.has(Fault::not_finite));
    options.margin_texels = nan;
    EXPECT_EQ(fit_samples(rays, bounds, brick<T>(), options).count, 0);
    options.margin_texels = T(2);
    options.map_size = 6;
    EXPECT_TRUE(fit_samples(rays, bounds, brick<T>(), options).faults.has(Fault::map_too_small));
    options.map_size = 64;
    auto const sunless = sample_rays(looking_ahead<T>(), directional(Vec3<T>(0)), 4, 4);
    EXPECT_EQ(fit_samples(sunless, bounds, brick<T>(), options).count, 0);
    EXPECT_TRUE(fit_samples(sunless, bounds, brick<T>(), options).faults.has(Fault::zero_light));
}

TYPED_TEST(Sdsm, SamplesBeyondTheFarthestDistanceSayThatPrecisionIsLost) {
    using T = TypeParam;
    ViewVolume<T> view = looking_ahead<T>();
    view.pose.position = Vec3<T>(0, 0, T(-0.9e18L));
    view.z_far = T(0.9e18L);
    auto const rays = sample_rays(view, directional(Vec3<T>(0, T(-1), T(-1))), 4, 4);
    ASSERT_TRUE(rays.usable);
    SampleDepths<T> depths = no_depths(view.z_near, view.z_far);
    add(depths, T(0.8e18L));
    SampleBounds<T> bounds = no_bounds(sample_splits(depths, 1, SampleSplits::even));
    add(bounds, rays, 1, 1, T(0.8e18L));
    auto const cascades = fit_samples(rays, bounds, brick<T>(), SampleFitOptions<T>{});
    EXPECT_TRUE(cascades.faults.has(Fault::precision_lost));
    for (auto const& cascade : cascades) EXPECT_FALSE(cascade.map.visible);
}

// 12 m in 15 texels and one for the place of the grid, up to the next of eight sizes an octave.
TYPED_TEST(Sdsm, AStillMapWithoutAMarginHasTheLeastTexelThatHoldsItsSamples) {
    using T = TypeParam;
    Light<T> const light = directional(Vec3<T>(0, 0, -1));
    auto const rays = sample_rays(looking_ahead<T>(), light, 4, 4);
    SampleFitOptions<T> options;
    options.map_size = 16;
    options.margin_texels = T(0);
    options.still = true;
    EXPECT_EQ(fit_samples(rays, wall_at(rays, T(8)), brick<T>(), options).at[0].texel_metres, T(0.8125));
}

TYPED_TEST(Sdsm, ATexelIsAsLongAsItsLongerSide) {
    using T = TypeParam;
    for (T const width : {T(0.5), T(2)}) {
        ViewVolume<T> view = looking_ahead<T>();
        view.left *= width;
        view.right *= width;
        auto const rays = sample_rays(view, directional(Vec3<T>(0, 0, -1)), 4, 4);
        SampleFitOptions<T> options;
        options.map_size = 100;
        options.margin_texels = T(10);
        auto const cascades = fit_samples(rays, wall_at(rays, T(8)), brick<T>(), options);
        EXPECT_NEAR(double(cascades.at[0].texel_metres), 0.15 * std::max(1.0, double(width)), 1e-5);
    }
}

// What a ray meets first, in long double, at each corner of the sides.
TYPED_TEST(Sdsm, LightEntersABoxNoSoonerThanItIsSaidTo) {
    using T = TypeParam;
    if (sizeof(T) == sizeof(long double)) return;
    Aabb<T> const box{Vec3<T>(T(-3.1), T(0.7), T(-5.3)), Vec3<T>(T(4.7), T(9.1), T(2.9))};
    int tight = 0;
    for (int i = 0; i < 2000; ++i) {
        T const turn = T(i) * T(0.37), rise = T(0.2) + T(i % 17) * T(0.07);
        LightBasis<T> const basis = light_basis(directional(Vec3<T>(std::cos(turn), -rise, std::sin(turn))).direction);
        Vec2<T> const lo(T(i % 5) - T(2.3), T(i % 7) - T(3.1)), hi = lo + T(1e-3) * T(i % 11);
        long double first = 1e9L;
        for (T const x : {lo.x, hi.x})
            for (T const y : {lo.y, hi.y}) {
                long double enters = -1e9L;
                for (int k = 0; k < 3; ++k) {
                    long double const along = basis.depth[k];
                    long double const across =
                        static_cast<long double>(basis.x[k]) * x + static_cast<long double>(basis.y[k]) * y;
                    if (std::abs(along) > 1e-4L)
                        enters = std::max(enters, ((along > 0 ? box.lo[k] : box.hi[k]) - across) / along);
                }
                first = std::min(first, enters);
            }
        long double const said = light_entry(basis, lo, hi, box);
        EXPECT_LE(said, first) << i;
        tight += first - said < 1e-2L;
    }
    EXPECT_GT(tight, 1000) << "and not much later";
}

TEST(EighthOfOctaveUp, RoundsUpToFourBits) {
    EXPECT_EQ(eighth_of_octave_up(1.0), 1.0);
    EXPECT_EQ(eighth_of_octave_up(1.01), 1.125);
    EXPECT_EQ(eighth_of_octave_up(1.125f), 1.125f);
    EXPECT_EQ(eighth_of_octave_up(1.9), 2.0);
    EXPECT_EQ(eighth_of_octave_up(0.3f), 0.3125f);
}
