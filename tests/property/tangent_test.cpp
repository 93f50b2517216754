// SPDX-License-Identifier: MIT
#include "tests/laws/tangent.hpp"
#include "tests/support/any_map.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class TangentProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(TangentProperty, Scalars);

TYPED_TEST(TangentProperty, TangentsSpanThePlaneOfAnyDirectionAndLength) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Vec3<T> const normal = *direction<T>();
        T const length = *log_uniform<T>(T(1e-30), T(1e30));
        RC_ASSERT(laws::span_the_plane(tangents(normal * length), normal, T(16) * std::numeric_limits<T>::epsilon()));
    }));
}

TYPED_TEST(TangentProperty, AnythingAtAllProjectsToSomethingFinite) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ShadowMap<T> const map = *nasty_map<T>();
        Vec3<T> const point = *nasty_vec3<T>();
        Vec3<T> const near_point = *point_within<T>(T(100));
        T const w_min = *nasty<T>();
        RC_ASSERT(laws::is_finite(projected(map.clip_from_world, point)));
        RC_ASSERT(laws::is_finite(projected(map.clip_from_world, near_point, w_min)));
    }));
}

TYPED_TEST(TangentProperty, QuotientsStayWithinTheirLimit) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        T const a = *nasty<T>();
        T const b = *nasty<T>();
        T const limit = *log_uniform<T>(T(1e-6), T(1e6));
        T const quotient = bounded_quotient(a, b, limit);
        RC_ASSERT(all_finite(&quotient, 1));
        RC_ASSERT(std::abs(quotient) <= limit);
    }));
}

// In double, against differences in long double: 2e-7 of the distance for a step leaves 1e-13 of the derivative.
TEST(TangentProperty, GainsAreTheDerivativeOfThePlaceInAnyMap) {
    EXPECT_TRUE(rc::check([] {
        auto const any = *any_map<double>();
        auto const point = *point_in(any.map);
        auto const along = *direction<double>();
        Mat4<double> const& matrix = any.map.clip_from_world;
        Projected<double> const at = projected(matrix, point);
        RC_ASSERT(at.in_front);
        // Metres in which the place changes by about itself.
        double const reach = at.w / glm::length(Vec4<double>(row(matrix, 3)));
        auto const measured = laws::measured_gain(matrix, point, along, 2e-7L * static_cast<long double>(reach));
        auto const exact = Vec3<long double>(gain_along(matrix, at, along));
        long double const scale = glm::length(measured) + 1 / static_cast<long double>(reach);
        RC_ASSERT(glm::length(exact - measured) <= 1e-9L * scale);
        RC_ASSERT(watched([&] { return gain_along(matrix, projected(matrix, point), along); }).calm_in_range());
    }));
}
