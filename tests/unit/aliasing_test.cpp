// SPDX-License-Identifier: MIT
#include "tests/laws/aliasing.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <tuple>

using namespace shadowmath;
using namespace shadowmath::closed_form;

namespace {

void expect_near_relative(double value, double wanted, double relative = 1e-12) {
    EXPECT_NEAR(value, wanted, relative * std::abs(wanted));
}

}  // namespace

TEST(Aliasing, HasThePublishedWorstCasesForARangeOfAThousand) {
    expect_near_relative(uniform_along(1.0, 1.0, 1000.0), 999);
    expect_near_relative(warped_worst(1.0, 1000.0, best_centre(1.0, 1000.0)),
                         std::sqrt(1000.0) - 1 / std::sqrt(1000.0));
    expect_near_relative(logarithmic_along(1.0, 1000.0), 6.907755278982137);
    EXPECT_NEAR(split_uniform_worst(1.0, 1000.0, 4), 4.623, 5e-4);
    EXPECT_NEAR(split_warped_worst(1.0, 1000.0, 4), 1.950, 5e-4);
    EXPECT_NEAR(split_warped_worst(2.0, 2000.0, 4), 1.950, 5e-4);
    EXPECT_NEAR(split_logarithmic_worst(1.0, 1000.0, 4), 1.727, 5e-4);
}

TEST(Aliasing, IsTheStepOfTheMapOverTheDepth) {
    long double const n = 0.7L, f = 90.0L, d = f - n;
    // A step of 3e-6 of the depth leaves its square, 1e-11.
    auto const is_one = [](long double ratio) { return std::abs(ratio - 1) <= 1e-10L; };
    for (long double z : {0.8L, 2.0L, 17.0L, 85.0L}) {
        auto const uniform = [=](long double at) { return (at - n) / d; };
        auto const logarithmic = [=](long double at) { return std::log(at / n) / std::log(f / n); };
        EXPECT_TRUE(is_one(uniform_along(z, n, f) / laws::measured_along(uniform, z, 3e-6L * z)));
        EXPECT_TRUE(is_one(logarithmic_along(n, f) / laws::measured_along(logarithmic, z, 3e-6L * z)));
        for (long double a : {0.7L, 3.0L, 40.0L}) {
            auto const warped = [=](long double at) { return (a + d) * (at - n) / (d * (at - n + a)); };
            EXPECT_TRUE(is_one(warped_along(z, n, f, a) / laws::measured_along(warped, z, 3e-6L * z)));
        }
    }
}

TEST(Aliasing, BothEndsOfTheBestWarpAreAlikeAndNoOtherCentreIsBetter) {
    double const n = 0.5, f = 300, best = best_centre(n, f);
    expect_near_relative(warped_along(n, n, f, best), warped_along(f, n, f, best));
    for (double factor : {0.1, 0.5, 0.9, 0.99, 1.01, 1.1, 2.0, 10.0})
        EXPECT_GT(warped_worst(n, f, best * factor), warped_worst(n, f, best));
    double const least = 4 * (std::sqrt(f) - std::sqrt(n)) / (std::sqrt(f) + std::sqrt(n));
    expect_near_relative(warped_along(std::sqrt(n * f), n, f, best), least);
}

TEST(Aliasing, AWarpFromTheEyeIsPerfectAcrossAndFromFarAwayIsNone) {
    expect_near_relative(warped_across(7.0, 1.0, 100.0, 1.0), 1.0);
    expect_near_relative(warped_across(7.0, 1.0, 100.0, 1e12), uniform_across(7.0, 1.0, 100.0), 1e-9);
    expect_near_relative(warped_along(7.0, 1.0, 100.0, 1e12), uniform_along(7.0, 1.0, 100.0), 1e-9);
    expect_near_relative(warped_across(1.0, 1.0, 100.0, best_centre(1.0, 100.0)), 10.0);
}

TEST(Aliasing, IsThatOfTheFormulaeInNumbers) {
    // 1600 pixels over a width of 0.8 at a metre, in 1000 texels: two pixels a texel.
    EXPECT_DOUBLE_EQ(closed_form::pixels_per_texel(1600.0, 0.4, 1000.0), 2.0);
    // Three maps over a ratio of a thousand: each ends at ten times its beginning.
    EXPECT_NEAR(closed_form::split_uniform_worst(0.5, 500.0, 3), 9.0, 1e-12);
    // (2 / 4) (0.25 / 0.5) (6 / 2)^3.
    EXPECT_DOUBLE_EQ(closed_form::plane_map_area(2.0, 4.0, 0.5, 0.25, 2.0, 6.0), 6.75);
}

TEST(Aliasing, OutsideItsRangeIsZero) {
    double const nan = std::numeric_limits<double>::quiet_NaN(), endless = std::numeric_limits<double>::infinity();
    EXPECT_EQ(uniform_along(1.0, 0.0, 10.0), 0.0);
    EXPECT_EQ(uniform_along(-1.0, 1.0, 10.0), 0.0);
    EXPECT_EQ(uniform_across(5.0, 10.0, 10.0), 0.0) << "a range of no length is none";
    EXPECT_EQ(best_centre(10.0, 10.0), 0.0);
    EXPECT_EQ(uniform_across(0.0, 1.0, 10.0), 0.0);
    EXPECT_EQ(warped_across(1.0, 1.0, 10.0, nan), 0.0);
    EXPECT_EQ(warped_across(-1.0, 1.0, 10.0, 1.0), 0.0);
    EXPECT_EQ(logarithmic_along(10.0, 1.0), 0.0);
    EXPECT_EQ(logarithmic_along(1.0, endless), 0.0);
    EXPECT_EQ(warped_along(1.0, 1.0, 10.0, nan), 0.0);
    EXPECT_EQ(best_centre(nan, 10.0), 0.0);
    EXPECT_EQ(split_uniform_worst(1.0, 10.0, 0), 0.0);
    EXPECT_EQ(split_warped_worst(1.0, 10.0, 0), 0.0);
    EXPECT_EQ(split_logarithmic_worst(1.0, 10.0, 0), 0.0);
    EXPECT_EQ(pixels_per_texel(0.0, 1.0, 1000.0), 0.0);
    EXPECT_EQ(pixels_per_texel(1000.0, 1.0, nan), 0.0);
    EXPECT_EQ(pixels_per_texel(1000.0, 0.0, 1000.0), 0.0);
    EXPECT_EQ(plane_map_area(1.0, 0.0, 1.0, 1.0, 1.0, 1.0), 0.0);
    EXPECT_EQ(plane_map_area(1.0, 1.0, 0.0, 1.0, 1.0, 1.0), 0.0);
    EXPECT_EQ(plane_map_area(1.0, 1.0, 1.0, 1.0, 0.0, 1.0), 0.0);
    EXPECT_EQ(plane_map_area(1.0, 1.0, 1.0, 1.0, nan, 1.0), 0.0);
    EXPECT_EQ(plane_map_area(1.0, 1e-300, 1.0, 1.0, 1.0, 1e10), 0.0) << "no number";
    EXPECT_EQ(plane_map_area(1.0, -1.0, 1.0, 1.0, 1.0, 2.0), 8.0) << "an area has no sign";
}

// One bad argument at a time, at every place.
TEST(Aliasing, IsZeroWhicheverArgumentIsBad) {
    auto const zero_unless_all_good = [](auto const& form, auto... good) {
        constexpr std::size_t count = sizeof...(good);
        for (double const bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
            for (std::size_t at = 0; at < count; ++at) {
                std::array<double, count> arguments{good...};
                arguments[at] = bad;
                EXPECT_EQ(std::apply(form, arguments), 0.0) << at << " is " << bad;
            }
        EXPECT_GT(form(good...), 0.0);
    };
    zero_unless_all_good([](double a, double b, double c) { return pixels_per_texel(a, b, c); }, 1000.0, 1.0, 512.0);
    zero_unless_all_good([](double z, double a, double b) { return uniform_along(z, a, b); }, 2.0, 1.0, 9.0);
    zero_unless_all_good([](double z, double a, double b) { return uniform_across(z, a, b); }, 2.0, 1.0, 9.0);
    zero_unless_all_good([](double a, double b) { return logarithmic_along(a, b); }, 1.0, 9.0);
    zero_unless_all_good([](double z, double a, double b, double c) { return warped_along(z, a, b, c); }, 2.0, 1.0, 9.0,
                         3.0);
    zero_unless_all_good([](double z, double a, double b, double c) { return warped_across(z, a, b, c); }, 2.0, 1.0,
                         9.0, 3.0);
    zero_unless_all_good([](double a, double b) { return best_centre(a, b); }, 1.0, 9.0);
    zero_unless_all_good([](double a, double b) { return split_uniform_worst(a, b, 4); }, 1.0, 9.0);
    zero_unless_all_good([](double a, double b) { return split_warped_worst(a, b, 4); }, 1.0, 9.0);
    zero_unless_all_good([](double a, double b) { return split_logarithmic_worst(a, b, 4); }, 1.0, 9.0);
}
