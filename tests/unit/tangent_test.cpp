// SPDX-License-Identifier: MIT
#include "tests/laws/tangent.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;

TEST(Projected, BehindTheEyeThereIsNoPlace) {
    Mat4<double> eye(1.0);
    eye[2][3] = -1.0;  // w = 1 - z
    EXPECT_TRUE(projected(eye, Vec3<double>(0, 0, 0.5)).in_front);
    EXPECT_FALSE(projected(eye, Vec3<double>(0, 0, 1)).in_front);
    EXPECT_FALSE(projected(eye, Vec3<double>(0, 0, 2)).in_front);
    EXPECT_FALSE(projected(eye, Vec3<double>(0, 0, 0.5), 0.5).in_front) << "w equal to w_min is outside";
    EXPECT_TRUE(laws::is_finite(projected(eye, Vec3<double>(0, 0, 1))));
}

TEST(Projected, ANegativeLeastWDoesNotLetPointsBehindIn) {
    Mat4<double> eye(1.0);
    eye[2][3] = -1.0;
    EXPECT_FALSE(projected(eye, Vec3<double>(0, 0, 2), -5.0).in_front);
}

TEST(GainAlong, OfAPerspectiveIsItsDerivative) {
    // x / (1 - z) at (1, 0, -1): along x 1/2, along z x / (1 - z)^2 = 1/4.
    Mat4<double> eye(1.0);
    eye[2][3] = -1.0;
    Projected<double> const at = projected(eye, Vec3<double>(1, 0, -1));
    EXPECT_EQ(gain_along(eye, at, Vec3<double>(1, 0, 0)).x, 0.5);
    EXPECT_EQ(gain_along(eye, at, Vec3<double>(0, 0, 1)).x, 0.25);
}

TEST(Tangents, AreTwoOfAnyNormal) {
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                Vec3<double> const normal(x, y, z);
                Tangents<double> const plane = tangents(normal);
                ASSERT_EQ(plane.ok, normal != Vec3<double>(0));
                if (!plane.ok) continue;
                EXPECT_NEAR(glm::dot(plane.s, normal), 0, 1e-15);
                EXPECT_NEAR(glm::length(glm::cross(plane.s, plane.t)), 1, 1e-14);
            }
}

TEST(Tangents, OfNoNormalAreNone) {
    EXPECT_FALSE(tangents(Vec3<float>(0.0f)).ok);
    EXPECT_FALSE(tangents(Vec3<float>(std::numeric_limits<float>::quiet_NaN(), 0.0f, 1.0f)).ok);
}

TEST(BoundedQuotient, IsTheLimitOverZeroAndZeroOverItself) {
    EXPECT_EQ(bounded_quotient(3.0, 2.0, 10.0), 1.5);
    EXPECT_EQ(bounded_quotient(-3.0, 0.0, 10.0), -10.0);
    EXPECT_EQ(bounded_quotient(0.5, 0.0, 10.0), 10.0);
    EXPECT_EQ(bounded_quotient(3.0, -0.1, 10.0), -10.0);
    EXPECT_EQ(bounded_quotient(0.0, 0.0, 10.0), 0.0);
}
