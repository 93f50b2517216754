// SPDX-License-Identifier: MIT
#include "tests/laws/moments.hpp"

#include <shadowmath/msm.hpp>
#include <shadowmath/vsm.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace shadowmath;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// A lit floor at 0.8 behind an occluder at 0.3 that covers `share` of the kernel.
laws::Kernel edge(double share) {
    return {{0.3, 0.8}, {share, 1 - share}};
}

}  // namespace

TEST(Moments, LessBleedingTakesFaintLightAway) {
    EXPECT_EQ(less_bleeding(0.2, 0.25), 0.0);
    EXPECT_DOUBLE_EQ(less_bleeding(0.625, 0.25), 0.5);
    EXPECT_EQ(less_bleeding(1.0, 0.25), 1.0);
    EXPECT_EQ(less_bleeding(0.4, 0.0), 0.4);
    EXPECT_EQ(less_bleeding(not_a_number, 0.1), 1.0);
    EXPECT_EQ(less_bleeding(0.5, 7.0), 0.0);
}

TEST(Moments, OfReceiversBeforeEverythingAreLit) {
    Vec4<double> const msm = edge(0.5).mean<double>(msm_moments<double>);
    Vec2<double> const vsm = edge(0.5).mean<double>(vsm_moments<double>);
    EXPECT_EQ(vsm_visibility(vsm, 0.3, 0.0), 1.0);
    EXPECT_NEAR(msm_visibility(msm, 0.2999, 1e-12), 1.0, 1e-9);
    EXPECT_EQ(msm_visibility(msm, -5.0, 1e-6), msm_visibility(msm, 0.0, 1e-6)) << "as depth clamp stores it";
}

TEST(Moments, OfBadNumbersAreLit) {
    EvsmExponents<double> const exponents;
    for (double bad : {not_a_number, infinity, -infinity}) {
        EXPECT_EQ(vsm_visibility(Vec2<double>(bad, 0.5), 0.5, 0.0), 1.0);
        EXPECT_EQ(vsm_visibility(Vec2<double>(0.2, 0.05), bad, 0.0), 1.0);
        EXPECT_EQ(evsm_visibility(Vec4<double>(bad), 0.5, exponents, 0.0), 1.0);
        EXPECT_EQ(msm_visibility(Vec4<double>(0, 0.3, 0, bad), 0.5, 1e-6), 1.0);
        EXPECT_EQ(msm_visibility(Vec4<double>(0, 0.3, 0, 0.3), bad, 1e-6), 1.0);
        EXPECT_EQ(vsm_moments(bad), Vec2<double>(1.0));
        EXPECT_EQ(msm_moments(bad), Vec4<double>(1.0));
    }
}

TEST(Moments, MeanIsThatOfTheBoxAndOutsideIsWhatIsAskedFor) {
    auto const columns = [](int x, int y) {
        EXPECT_TRUE(x >= 0 && y >= 0 && x < 16 && y < 16);
        return Vec2<double>(x < 8 ? 0.25 : 1.0);
    };
    auto const at = [&](double x, double y) {
        return mean_moments(Vec2<double>(x, y), 16, 1, Vec2<double>(2.0), columns).x;
    };
    EXPECT_DOUBLE_EQ(at(8.0, 8.0), 0.625);
    EXPECT_DOUBLE_EQ(at(7.5, 8.0), 0.4375);
    EXPECT_DOUBLE_EQ(at(4.0, 8.0), 0.25);
    EXPECT_DOUBLE_EQ(at(4.0, 0.0), 0.25 * 0.5 + 2.0 * 0.5);
    EXPECT_DOUBLE_EQ(at(-0.5, 8.0), 0.25 * 0.25 + 2.0 * 0.75);
    EXPECT_DOUBLE_EQ(at(16.5, 8.0), 1.0 * 0.25 + 2.0 * 0.75);
    EXPECT_EQ(at(1e30, 0.0), 2.0);
    for (double const out : {-1e30, 1e30}) {
        EXPECT_EQ(at(out, 8.0), 2.0);
        EXPECT_EQ(at(8.0, out), 2.0);
    }
    EXPECT_EQ(at(not_a_number, 0.0), 2.0);
}

TEST(Moments, MeanOfABadMapOrPlaceIsThatOfTheOutside) {
    auto const inside = [](int x, int y) {
        EXPECT_TRUE(x >= 0 && y >= 0 && x < 16 && y < 16) << x << ' ' << y;
        return 5.0;
    };
    Vec2<double> const middle(8.0, 8.0);
    EXPECT_EQ(mean_moments(middle, 16, 1, 1.0, inside), 5.0);
    for (int const size : {0, -4, largest_map_size + 1}) EXPECT_EQ(mean_moments(middle, size, 1, 1.0, inside), 1.0);
    EXPECT_EQ(mean_moments(Vec2<double>(std::numeric_limits<double>::quiet_NaN(), 8.0), 16, 1, 1.0, inside), 1.0);
    EXPECT_EQ(mean_moments(middle, 16, -3, 1.0, inside), 5.0) << "a negative radius is 0";
    EXPECT_NEAR(mean_moments(middle, 16, 1000000, 1.0, inside),
                mean_moments(middle, 16, largest_filter_radius, 1.0, inside), 1e-12);
    for (Vec2<double> const& corner : {Vec2<double>(0, 0), Vec2<double>(16, 0), Vec2<double>(0, 16)})
        EXPECT_NEAR(mean_moments(corner, 16, 2, 1.0, inside), 2.0, 1e-12) << "a quarter of the box is in the map";
    for (Vec2<double> const& beside :
         {Vec2<double>(-2.1, 8), Vec2<double>(18.1, 8), Vec2<double>(8, -2.1), Vec2<double>(8, 18.1)})
        EXPECT_EQ(mean_moments(beside, 16, 1, 1.0, inside), 1.0);
}

TEST(Moments, OfATexelAreThoseOfItsColumnAndItsRow) {
    auto const places = [](int x, int y) { return Vec2<double>(x, y); };
    auto const at = [&](double x, double y, int size) {
        return mean_moments(Vec2<double>(x, y), size, 0, Vec2<double>(-1.0), places);
    };
    EXPECT_EQ(at(3.4, 5.6, 16), Vec2<double>(3, 5));
    EXPECT_EQ(at(0.5, 0.5, 1), Vec2<double>(0, 0)) << "the smallest map";
    EXPECT_EQ(at(7.5, 9.5, largest_map_size), Vec2<double>(7, 9)) << "and the largest";
    EXPECT_EQ(at(7.5, 9.5, largest_map_size + 1), Vec2<double>(-1.0));
}

TEST(Moments, LessBleedingOfWhatIsNoNumberIsLit) {
    for (double const bad : {not_a_number, infinity}) {
        EXPECT_EQ(less_bleeding(bad, 0.2), 1.0);
        EXPECT_EQ(less_bleeding(0.1, bad), 1.0);
    }
}
