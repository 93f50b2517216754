// SPDX-License-Identifier: MIT
#include "tests/laws/fit_box.hpp"
#include "tests/laws/shadow_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace shadowmath;

template <class T>
class FitBox : public ::testing::Test {};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(FitBox, Scalars);

namespace {

template <class T>
std::array<Vec3<T>, 8> brick(Vec3<T> const& lo, Vec3<T> const& hi) {
    return corners(Aabb<T>{lo, hi});
}

}  // namespace

TYPED_TEST(FitBox, OfABrickUnderAnOverheadSunIsTheBrick) {
    using T = TypeParam;
    // Light along -y: x = x, y = -z, depth = -y.
    LightBox<T> const box = fit_box(LightBasis<T>{}, brick(Vec3<T>(1, 2, 3), Vec3<T>(5, 10, 5)), 100, T(0));
    double const rounding = 64 * double(std::numeric_limits<T>::epsilon());
    EXPECT_NEAR(double(box.lo.x), 1, rounding);
    EXPECT_NEAR(double(box.hi.x), 5, rounding);
    EXPECT_NEAR(double(box.lo.y), -5, rounding);
    EXPECT_NEAR(double(box.hi.y), -3, rounding);
    EXPECT_NEAR(double(box.depth_lo), -10, rounding);
    EXPECT_NEAR(double(box.depth_hi), -2, rounding);
}

TYPED_TEST(FitBox, TheMarginIsThatManyTexelsOfTheMapItself) {
    using T = TypeParam;
    // 4 m in 80 of 100 texels: 5 cm each, 10 of them left and right.
    LightBox<T> const box = fit_box(LightBasis<T>{}, brick(Vec3<T>(1, 2, 3), Vec3<T>(5, 10, 5)), 100, T(10));
    EXPECT_NEAR(double(texel_metres(box, 100).x), 0.05, 1e-6);
    EXPECT_NEAR(double(texel_metres(box, 100).y), 0.025, 1e-6);
    EXPECT_NEAR(double(box.lo.x), 0.5, 1e-5);
    EXPECT_NEAR(double(box.hi.y), -2.75, 1e-5);
}

TYPED_TEST(FitBox, HoldsEveryCornerInEveryConvention) {
    using T = TypeParam;
    Light<T> const light = directional(Vec3<T>(T(0.3), T(-1), T(0.45)));
    auto const body = brick(Vec3<T>(-3, 0, 20), Vec3<T>(5, 10, 31));
    LightBox<T> const box = fit_box(light_basis(light.direction), body, 512, T(3));
    for (ClipSpace const clip : {gl_clip, gl_zero_to_one_clip, vulkan_clip, d3d_clip, reversed(gl_zero_to_one_clip)}) {
        Mat4<T> const matrix = clip_from_world(box, clip);
        EXPECT_TRUE(laws::is_map_of(matrix, light, clip));
        // 3 of 256 texels to a side, less the rounding of coordinates of 40 m in a box of 15 m.
        T const margin = T(3) / T(256) - T(64) * std::numeric_limits<T>::epsilon();
        for (Vec3<T> const& corner : body) {
            // Depth has no margin: its slack is asked for apart.
            Vec3<T> const inward =
                corner + (Vec3<T>(1, 5, T(25.5)) - corner) * (T(16) * std::numeric_limits<T>::epsilon());
            EXPECT_TRUE(laws::holds(matrix, clip, inward, margin));
        }
    }
}

TYPED_TEST(FitBox, FlatBodiesGetATexelOfTheirLargestExtent) {
    using T = TypeParam;
    auto const plane = fit_box(LightBasis<T>{}, brick(Vec3<T>(0, 0, 0), Vec3<T>(10, 0, 10)), 100, T(0));
    EXPECT_TRUE(laws::is_a_box(plane));
    EXPECT_LT(plane.depth_hi - plane.depth_lo, T(1e-4));
    auto const wall = fit_box(LightBasis<T>{}, brick(Vec3<T>(2, 0, 0), Vec3<T>(2, 10, 5)), 100, T(0));
    EXPECT_TRUE(laws::is_a_box(wall));
    EXPECT_NEAR(double(wall.hi.x - wall.lo.x), 0.1, 1e-4);
    for (T const at : {T(0), T(1000)}) {
        auto const body = brick(Vec3<T>(at), Vec3<T>(at));
        auto const point = fit_box(LightBasis<T>{}, body, 100, T(2));
        EXPECT_TRUE(laws::is_a_box(point));
        EXPECT_TRUE(laws::holds_corners_and_margin(point, body, 100, T(2)));
    }
}

TYPED_TEST(FitBox, StaysABoxWhateverIsGiven) {
    using T = TypeParam;
    T const nan = std::numeric_limits<T>::quiet_NaN(), huge = std::numeric_limits<T>::max();
    auto const body = brick(Vec3<T>(0), Vec3<T>(10));
    for (T const bad : {nan, huge, -std::numeric_limits<T>::infinity()}) {
        EXPECT_TRUE(laws::is_a_box(fit_box(LightBasis<T>{}, brick(Vec3<T>(0), Vec3<T>(bad)), 100, T(2))));
        EXPECT_TRUE(laws::is_a_box(fit_box(LightBasis<T>{Vec3<T>(bad), {}, {}}, body, 100, T(2))));
        EXPECT_TRUE(laws::is_a_box(fit_box(LightBasis<T>{}, body, 100, bad)));
    }
    LightBox<T> const nothing;
    for (int corner = 0; corner < 8; ++corner)
        for (int axis = 0; axis < 3; ++axis) {
            auto one_bad = body;
            one_bad[static_cast<std::size_t>(corner)][axis] = nan;
            LightBox<T> const box = fit_box(LightBasis<T>{}, one_bad, 100, T(2));
            EXPECT_TRUE(box.lo == nothing.lo && box.hi == nothing.hi) << corner << ' ' << axis;
        }
    for (int const size : {-1, 0, 1, 2, 70000})
        EXPECT_TRUE(laws::is_a_box(fit_box(LightBasis<T>{}, body, size, T(2)))) << size;
    EXPECT_TRUE(laws::is_a_box(fit_box(LightBasis<T>{}, brick(Vec3<T>(T(-1e18L)), Vec3<T>(T(1e18L))), 100, T(2))));
}

TYPED_TEST(FitBox, BoundsBeyondReachHaveTheBoxOfNothing) {
    using T = TypeParam;
    T const farthest = detail::farthest_metres<T>;
    LightBox<T> const nothing;
    for (T const at : {T(2.5) * farthest, T(-2.5) * farthest, std::numeric_limits<T>::quiet_NaN()}) {
        Aabb<T> body{Vec3<T>(T(-1)), Vec3<T>(T(1))};
        (at < T(0) ? body.lo : body.hi).y = at;
        LightBox<T> const box = box_around(LightBasis<T>{}, body, 100, T(2));
        EXPECT_TRUE(box.lo == nothing.lo && box.hi == nothing.hi && box.depth_lo == nothing.depth_lo);
    }
    EXPECT_EQ(box_around(LightBasis<T>{}, Aabb<T>{}, 100, T(2)).hi, nothing.hi);
    LightBasis<T> bent;
    bent.y *= T(2);
    EXPECT_EQ(box_around(bent, Aabb<T>{Vec3<T>(T(-9)), Vec3<T>(T(9))}, 100, T(2)).hi, nothing.hi);
}

TEST(Margin, NamesWhatIsWrongWithIt) {
    EXPECT_FALSE(faults_of_margin(3, 0.0).any());
    EXPECT_FALSE(faults_of_margin(7, 2.0).any());
    EXPECT_EQ(faults_of_margin(6, 2.0), Faults(Fault::map_too_small));
    EXPECT_EQ(faults_of_margin(0, 0.0), Faults(Fault::map_too_small));
    EXPECT_EQ(faults_of_margin(9, -1.0), Faults(Fault::clamped_option));
    EXPECT_EQ(faults_of_margin(9, std::numeric_limits<double>::quiet_NaN()), Faults(Fault::not_finite));
    EXPECT_EQ(usable_texels(100, 10.0), 80.0);
    EXPECT_EQ(usable_texels(100, -10.0), 100.0);
    EXPECT_EQ(usable_texels(100, 1e300), 1.0);
    EXPECT_EQ(usable_texels(-5, 0.0), 1.0);
    EXPECT_EQ(usable_texels(10, 4.75), 1.0) << "half a texel is one";
    EXPECT_EQ(faults_of_margin(3, 0.5), Faults(Fault::map_too_small));
    EXPECT_FALSE(faults_of_margin(4, 0.5).any());
}

// Not but for a rounding: with no margin at all each corner is inside, a kilometre out and told in long double.
TEST(FitBox, WithoutAMarginHoldsItsCornersToTheLastBit) {
    using Wide = long double;
    for (int i = 0; i < 200; ++i) {
        float const turn = static_cast<float>(i) * 0.031f;
        auto const basis = light_basis(directional(Vec3<float>(std::cos(turn), -0.4f, std::sin(turn))).direction);
        Vec3<float> const centre(1000.0f + turn, 35.0f, -700.0f * turn);
        auto const body = corners(Aabb<float>{centre - 7.3f, centre + 7.3f});
        LightBox<float> const box = fit_box(basis, body, 1024, 0.0f);
        for (Vec3<float> const& corner : body) {
            Wide const x = glm::dot(Vec3<Wide>(box.basis.x), Vec3<Wide>(corner));
            Wide const y = glm::dot(Vec3<Wide>(box.basis.y), Vec3<Wide>(corner));
            EXPECT_TRUE(x >= Wide(box.lo.x) && x <= Wide(box.hi.x) && y >= Wide(box.lo.y) && y <= Wide(box.hi.y)) << i;
        }
    }
}
