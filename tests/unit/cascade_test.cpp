// SPDX-License-Identifier: MIT
#include <shadowmath/cascade.hpp>

#include <gtest/gtest.h>

#include <utility>

using namespace shadowmath;

TEST(Cascade, OfNoneNoneIsVisited) {
    Cascades<float> const none;
    for ([[maybe_unused]] Cascade<float> const& cascade : none) FAIL() << "there is none";
    EXPECT_FALSE(none.faults.any());
}

TEST(Cascade, OfSeveralEachIsVisitedOnceTheNearestFirst) {
    Cascades<double> three;
    three.count = 3;
    for (int i = 0; i < max_splits; ++i) three.at[i].range.end = 10.0 * (i + 1);
    double end = 0;
    for (Cascade<double> const& cascade : three) EXPECT_EQ(cascade.range.end, std::exchange(end, end + 10) + 10);
    EXPECT_EQ(end, 30);
}

TEST(Cascade, ShowsNothingUntilItIsFitted) {
    Cascade<float> const cascade;
    EXPECT_FALSE(cascade.map.visible);
    EXPECT_EQ(cascade.texel_metres, 0);
    EXPECT_EQ(cascade.depth_metres, 0);
}

// Wider than a quarter of the map, or than 64 texels, there is more margin than map.
TEST(Cascade, KernelsAreKeptToAQuarterOfTheMapAndSayIfTheyWereNot) {
    struct {
        int map_size, asked, kept;
    } const cases[] = {{2048, 0, 0}, {2048, 1, 1}, {2048, 64, 64}, {2048, 65, 64}, {2048, -1, 0},
                       {64, 16, 16}, {64, 17, 16}, {256, 64, 64},  {252, 63, 63},  {252, 64, 63},
                       {3, 1, 0},    {0, 1, 0},    {-2048, 1, 0},  {0, 0, 0}};
    for (auto const& at : cases) {
        CascadeOptions<float> options;
        options.map_size = at.map_size;
        options.filter_radius = at.asked;
        Faults faults;
        EXPECT_EQ(detail::kernel_radius(options, faults), at.kept) << at.map_size << " texels, " << at.asked;
        EXPECT_EQ(faults.has(Fault::clamped_option), at.kept != at.asked) << at.map_size << " texels, " << at.asked;
    }
}
