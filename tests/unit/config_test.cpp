// SPDX-License-Identifier: MIT
#include <shadowmath/config.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace shadowmath;

TEST(Config, NowherePutsEveryPointBesideTheMapInEveryConvention) {
    for (Vec4<float> const& point :
         {Vec4<float>(0, 0, 0, 1), Vec4<float>(1, -2, 3, 1), Vec4<float>(1e30f, 1e30f, -1e30f, 1),
          Vec4<float>(std::numeric_limits<float>::max(), 0, 0, 1)})
        EXPECT_EQ(nowhere<float>() * point, Vec4<float>(2, 2, 2, 1));
}

TEST(Config, RowsAreReadAsTheyWereWritten) {
    Vec4<double> const x(1, 2, 3, 4), y(5, 6, 7, 8), z(9, 10, 11, 12), w(13, 14, 15, 16);
    Mat4<double> const matrix = from_rows(x, y, z, w);
    EXPECT_EQ(row(matrix, 0), x);
    EXPECT_EQ(row(matrix, 1), y);
    EXPECT_EQ(row(matrix, 2), z);
    EXPECT_EQ(row(matrix, 3), w);
    EXPECT_EQ(matrix * Vec4<double>(0, 0, 1, 0), Vec4<double>(3, 7, 11, 15));
}
