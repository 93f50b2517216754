// SPDX-License-Identifier: MIT
#include "tests/laws/stillness.hpp"

#include <shadowmath/fit_sphere.hpp>
#include <shadowmath/texel_grid.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace shadowmath;

namespace {

template <class T>
ShadowMap<T> map_at(T x_texels, T y_texels, ClipSpace clip) {
    ShadowMap<T> map;
    map.clip = clip;
    map.visible = true;
    // 100 texels of a metre; texel (0, 0) begins at the world's origin when nothing is moved.
    map.clip_from_world = clip_from_canonical<T>(clip);
    map.clip_from_world[0] *= T(1) / T(50);
    map.clip_from_world[1] *= T(1) / T(50);
    Mat4<T> shift(T(1));
    shift[3] = Vec4<T>(x_texels, y_texels, T(0), T(1));
    map.clip_from_world = map.clip_from_world * shift;
    return map;
}

}  // namespace

template <class T>
class StillnessOf : public ::testing::Test {};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(StillnessOf, Scalars);

TYPED_TEST(StillnessOf, WholeTexelsLeaveNothingOverAndPartsWhatTheyAre) {
    using T = TypeParam;
    Vec3<T> const point(T(3), T(4), T(0.5));
    for (ClipSpace const clip : {gl_clip, vulkan_clip, reversed(gl_clip)}) {
        auto const shift = [&](T x, T y) {
            return texel_shift(map_at(T(0), T(0), clip), map_at(x, y, clip), 100, point);
        };
        T const tolerance = T(256) * std::numeric_limits<T>::epsilon();
        EXPECT_LE(shimmer_texels(shift(T(7), T(-12))), tolerance);
        EXPECT_NEAR(double(shift(T(7), T(-12)).texels.x), 7.0, double(tolerance));
        EXPECT_NEAR(double(shift(T(7.25), T(0)).off_grid.x), 0.25, double(tolerance));
        EXPECT_NEAR(double(shimmer_texels(shift(T(0), T(2.375)))), 0.375, double(tolerance));
        EXPECT_NEAR(double(shimmer_texels(shift(T(0.1), T(0.75)))), 0.25, double(tolerance));
        EXPECT_TRUE(laws::is_texel_shift(shift(T(0.5), T(-0.5))));
    }
}

TYPED_TEST(StillnessOf, WindowsOfOneGridLeaveNothingOverWhereverTheySlide) {
    using T = TypeParam;
    LightBasis<T> const basis = light_basis(directional(Vec3<T>(T(0.3), T(-1), T(0.45))).direction);
    auto const made = [&](Vec3<T> const& center) {
        ShadowMap<T> map;
        map.clip_from_world =
            clip_from_world(texel_grid(basis, Sphere<T>{center, T(8)}, 512, T(2)), T(-20), T(20), map.clip);
        map.visible = true;
        return map;
    };
    ShadowMap<T> const before = made(Vec3<T>(T(0)));
    for (T const step : {T(0.01), T(0.7), T(-3.3)})
        EXPECT_LE(shimmer_texels(
                      texel_shift(before, made(Vec3<T>(step, -step, T(2) * step)), 512, Vec3<T>(T(1), T(2), T(-3)))),
                  T(1) / 64)
            << double(step);
}

TYPED_TEST(StillnessOf, WhatAMapDoesNotHoldHasNoShift) {
    using T = TypeParam;
    ShadowMap<T> const good = map_at(T(0), T(0), ClipSpace{});
    ShadowMap<T> behind = good;
    behind.clip_from_world[3][3] = T(-1);
    Vec3<T> const point(T(3), T(4), T(0.5));
    EXPECT_TRUE(texel_shift(good, good, 100, point).ok);
    EXPECT_FALSE(texel_shift(good, behind, 100, point).ok);
    EXPECT_FALSE(texel_shift(behind, good, 100, point).ok);
    EXPECT_FALSE(texel_shift(good, good, 0, point).ok);
    EXPECT_FALSE(texel_shift(good, good, 100, Vec3<T>(std::numeric_limits<T>::quiet_NaN())).ok);
    EXPECT_EQ(shimmer_texels(TexelShift<T>{}), T(0));
}

TEST(Stillness, OfAMapOfOneTexelIsMeasuredTooAndOfNoneNot) {
    auto const before = map_at(0.0, 0.0, gl_clip), after = map_at(25.0, 0.0, gl_clip);
    TexelShift<double> const one = texel_shift(before, after, 1, Vec3<double>(0.0));
    EXPECT_TRUE(one.ok);
    EXPECT_NEAR(one.texels.x, 0.25, 1e-12);
    EXPECT_FALSE(texel_shift(before, after, 0, Vec3<double>(0.0)).ok);
}

TEST(Stillness, IsNotMeasuredBehindEitherMap) {
    auto const map = map_at(0.0, 0.0, gl_clip);
    auto behind = map;
    behind.clip_from_world[3][3] = -1.0;
    EXPECT_FALSE(texel_shift(map, behind, 100, Vec3<double>(0.0)).ok);
    EXPECT_FALSE(texel_shift(behind, map, 100, Vec3<double>(0.0)).ok);
}
