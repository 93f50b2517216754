// SPDX-License-Identifier: MIT
#include "tests/support/tolerance.hpp"

#include <shadowmath/points.hpp>

#include <gtest/gtest.h>

#include <vector>

using namespace shadowmath;

namespace {

template <class T>
void expect_products() {
    Mat4<T> const matrix(T(0.5), T(-1), T(2), T(0.125), T(3), T(0.75), T(-0.5), T(1), T(-2), T(4), T(0.25), T(-3), T(8),
                         T(-16), T(32), T(5));
    std::vector<Vec3<T>> points;
    for (int i = 0; i < 37; ++i) points.push_back({T(i) * T(0.3), T(7 - i) * T(0.7), T(i * i) * T(0.01)});
    std::vector<Vec4<T>> clip(points.size() + 1, Vec4<T>(T(99)));
    clip_points(matrix, points.data(), static_cast<int>(points.size()), clip.data());
    for (std::size_t i = 0; i < points.size(); ++i) {
        Vec4<T> const wanted = matrix * Vec4<T>(points[i], T(1));
        // Seven roundings either way, of terms below 100.
        for (int r = 0; r < 4; ++r)
            EXPECT_NEAR(double(clip[i][r]), double(wanted[r]), double(test::tolerance(T(100), 7)));
    }
    EXPECT_EQ(clip.back(), Vec4<T>(T(99)));
    clip_points(matrix, points.data(), 0, clip.data());
}

}  // namespace

TEST(ClipPoints, AreTheProductsOfTheMatrixAndEachPoint) {
    expect_products<float>();
    expect_products<double>();
}
