// SPDX-License-Identifier: MIT
#include "tests/laws/fit_sphere.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;

template <class T>
class FitSphere : public ::testing::Test {
public:
    static ViewVolume<T> view(T z_near, T z_far, T fov_y_radians = T(1), T aspect = T(1.5)) {
        return perspective_view(pose_looking(Vec3<T>(1, 2, 3), Vec3<T>(1, -2, 0.5), Vec3<T>(0, 1, 0)), fov_y_radians,
                                aspect, z_near, z_far);
    }
    static bool close(T value, long double wanted) {
        return std::abs(static_cast<long double>(value) - wanted) <=
               32 * static_cast<long double>(std::numeric_limits<T>::epsilon()) * wanted;
    }
};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(FitSphere, Scalars);

TYPED_TEST(FitSphere, OfALongSliceIsCentredOnTheFarFace) {
    using T = TypeParam;
    // k^2 = 0.25 + 0.25 = 1/2 >= (f - n) / (f + n) = 1/3: centre (0, 0, 20), R = k f.
    ViewVolume<T> slice;
    slice.left = slice.bottom = T(-0.5);
    slice.right = slice.top = T(0.5);
    slice.z_near = T(10);
    slice.z_far = T(20);
    Sphere<T> const sphere = bounding_sphere(slice);
    EXPECT_EQ(sphere.center, Vec3<T>(0, 0, -20));
    EXPECT_TRUE(this->close(sphere.radius, 20 * std::sqrt(0.5L)));
    EXPECT_EQ(laws::corners_on_sphere(slice), 4);
}

TYPED_TEST(FitSphere, OfANarrowSliceTouchesAllEightCorners) {
    using T = TypeParam;
    // k^2 = 1/8 < 99 / 101: c = 1/2 * 101 * 9/8 = 56.8125, R^2 = (99^2 + 2 * 10001 / 8 + 101^2 / 64) / 4.
    ViewVolume<T> slice;
    slice.left = slice.bottom = T(-0.25);
    slice.right = slice.top = T(0.25);
    slice.z_near = T(1);
    slice.z_far = T(100);
    Sphere<T> const sphere = bounding_sphere(slice);
    EXPECT_TRUE(this->close(-sphere.center.z, 56.8125L));
    EXPECT_TRUE(this->close(sphere.radius, 0.5L * std::sqrt(9801 + 2500.25L + 10201 / 64.0L)));
    EXPECT_EQ(laws::corners_on_sphere(slice), 8);
}

TYPED_TEST(FitSphere, OfAnOrthographicViewIsHalfItsDiagonal) {
    using T = TypeParam;
    ViewVolume<T> const slice = orthographic_view(Pose<T>{}, T(1), T(4), T(-2), T(2), T(3), T(15));
    Sphere<T> const sphere = bounding_sphere(slice);
    EXPECT_EQ(sphere.center, Vec3<T>(2.5, 0, -9));
    EXPECT_TRUE(this->close(sphere.radius, 6.5L));
}

TYPED_TEST(FitSphere, FormulaAndSearchAgreeOnSymmetricViews) {
    using T = TypeParam;
    for (T const fov : {T(0.01), T(0.3), T(1), T(2), T(3)})
        for (T const ratio : {T(1.01), T(2), T(1000)}) {
            ViewVolume<T> slice = this->view(T(1), ratio, fov);
            Sphere<T> const formula = bounding_sphere(slice);
            // One ulp off centre takes the general way.
            slice.right = std::nextafter(slice.right, T(100));
            Sphere<T> const search = bounding_sphere(slice);
            // Coordinates of size 1 are rounded, radii are as small as the sine.
            double const rounding = double(256 * std::numeric_limits<T>::epsilon() / std::sin(fov / 2));
            EXPECT_NEAR(double(search.radius / formula.radius), 1.0, rounding) << double(fov) << " " << double(ratio);
        }
}

TYPED_TEST(FitSphere, IsExactWhereTheTwoCasesOfTheFormulaMeet) {
    using T = TypeParam;
    // k^2 = 1/2, n / f = 1/3.
    ViewVolume<T> slice = this->view(T(10), T(30));
    for (T const side : {T(0.5), std::nextafter(T(0.5), T(1)), std::nextafter(T(0.5), T(0))}) {
        slice.left = slice.bottom = -side;
        slice.right = slice.top = side;
        EXPECT_TRUE(laws::holds_every_corner(slice));
        EXPECT_TRUE(laws::no_other_centre_needs_less(slice));
        EXPECT_TRUE(this->close(bounding_sphere(slice).radius, 30 * std::sqrt(0.5L)));
    }
}

TYPED_TEST(FitSphere, HoldsViewsFarOffCentre) {
    using T = TypeParam;
    for (T const shift : {T(0.01), T(0.5), T(3), T(-40)}) {
        ViewVolume<T> slice = this->view(T(1), T(50));
        slice.left += shift;
        slice.right += shift;
        slice.top -= shift / T(3);
        slice.bottom -= shift / T(3);
        EXPECT_TRUE(laws::holds_every_corner(slice)) << double(shift);
        EXPECT_TRUE(laws::no_other_centre_needs_less(slice)) << double(shift);
    }
}

TYPED_TEST(FitSphere, ScalesFromMicrometresToLightYears) {
    using T = TypeParam;
    for (T const scale : {T(1e-30), T(1e-6), T(1e6), T(1e16)}) {
        ViewVolume<T> slice = this->view(T(1), T(10));
        slice.pose.position = Vec3<T>(T(0));
        T const radius = bounding_sphere(slice).radius;
        slice.z_near *= scale;
        slice.z_far *= scale;
        EXPECT_NEAR(double(bounding_sphere(slice).radius / (radius * scale)), 1.0, 1e-6) << double(scale);
        EXPECT_TRUE(laws::holds_every_corner(slice)) << double(scale);
    }
}

// In view space, where a corner is what its side says: relative to a depth of a kilometre the ball is a metre.
TYPED_TEST(FitSphere, OfAThinSliceFarAwayHoldsItsCornersWhateverItsCentreRoundedTo) {
    using T = TypeParam;
    using Wide = long double;
    for (int i = 0; i < 300; ++i) {
        ViewVolume<T> slice = this->view(T(999) + T(i) / T(400), T(1000), T(0.0005) + T(i) * T(7e-6));
        if (i % 2 == 1) slice.top *= T(1.25);
        auto const ball = detail::ball_in_view(slice);
        for (unsigned corner = 0; corner < 8; ++corner) {
            Wide const depth = (corner & 4u) != 0 ? slice.z_far : slice.z_near;
            Vec3<Wide> const at(Wide((corner & 1u) != 0 ? slice.right : slice.left) * depth,
                                Wide((corner & 2u) != 0 ? slice.top : slice.bottom) * depth, depth);
            EXPECT_LE(glm::length(at - Vec3<Wide>(ball.center) * Wide(ball.unit)), Wide(ball.radius_metres)) << i;
        }
    }
}

TYPED_TEST(FitSphere, OfASliceThatEndsAtTheFarthestDistanceHasARadius) {
    using T = TypeParam;
    ViewVolume<T> slice;
    slice.left = slice.bottom = T(-1);
    slice.right = slice.top = T(1);
    slice.z_near = T(1);
    slice.z_far = detail::farthest_metres<T>;
    EXPECT_GT(bounding_sphere(slice).radius, T(0));
    slice.top = T(1.01);
    EXPECT_EQ(bounding_sphere(slice).radius, T(0)) << "its corners do not";
}

TYPED_TEST(FitSphere, OfABadSliceHasNoRadius) {
    using T = TypeParam;
    T const nan = std::numeric_limits<T>::quiet_NaN(), infinity = std::numeric_limits<T>::infinity();
    T const huge = std::numeric_limits<T>::max();
    auto const radius = [this](auto const& spoil) {
        ViewVolume<T> slice = this->view(T(1), T(10));
        spoil(slice);
        EXPECT_TRUE(laws::is_finite_or_nothing(slice));
        return bounding_sphere(slice).radius;
    };
    EXPECT_GT(radius([](auto&) {}), T(0));
    EXPECT_EQ(radius([=](auto& s) { s.z_near = nan; }), T(0));
    EXPECT_EQ(radius([=](auto& s) { s.z_far = infinity; }), T(0));
    EXPECT_EQ(radius([=](auto& s) { s.z_far = huge; }), T(0));
    EXPECT_EQ(radius([=](auto& s) { s.z_far = s.z_near; }), T(0));
    EXPECT_EQ(radius([=](auto& s) { s.z_near = T(-1); }), T(0));
    EXPECT_EQ(radius([=](auto& s) { s.right = huge; }), T(0));
    EXPECT_EQ(radius([=](auto& s) { s.left = s.right; }), T(0));
    EXPECT_EQ(radius([=](auto& s) { s.pose.position.y = huge; }), T(0));
    EXPECT_EQ(radius([=](auto& s) { s.pose.position.y = -infinity; }), T(0));
    EXPECT_EQ(radius([=](auto& s) { s.pose.up *= T(1.1); }), T(0));
    EXPECT_GT(radius([=](auto& s) { s.z_near = T(0); }), T(0));
}

// From the origin along the axes no coordinate of a corner is rounded but once.
TEST(BoundingSphere, HoldsItsCornersToTheBitHoweverWideTheView) {
    for (float side = 0.01f; side < 1e8f; side *= 1.37f)
        for (float const other : {0.3f, side, -0.3f, -side}) {
            ViewVolume<float> view;
            view.left = -side, view.right = side * 0.7f, view.bottom = -std::abs(other), view.top = std::abs(other);
            if (other < 0) std::swap(view.left, view.bottom), std::swap(view.right, view.top);
            view.z_near = 0.37f, view.z_far = 5.3f;
            Sphere<float> const ball = bounding_sphere(view);
            ASSERT_GT(ball.radius, 0.0f);
            for (Vec3<float> const& corner : corners(view)) {
                long double const distance = glm::length(Vec3<long double>(corner) - Vec3<long double>(ball.center));
                EXPECT_LE(distance, static_cast<long double>(ball.radius)) << side;
            }
        }
}

// All of the view lies to the right of its axis and above: the ball stands on one near corner and one far one.
TEST(BoundingSphere, OfAViewBesideItsAxisStandsOnTwoCorners) {
    ViewVolume<double> view;
    view.left = view.bottom = 0.2, view.right = 0.6, view.top = 0.5;
    view.z_near = 1, view.z_far = 100;
    glm::dvec3 const near_corner(0.2, 0.2, 1), far_corner(60, 50, 100);
    double const radius = glm::length(far_corner - near_corner) / 2;
    EXPECT_NEAR(bounding_sphere(view).radius, radius, 1e-13 * radius);
}
