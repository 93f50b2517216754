// SPDX-License-Identifier: MIT
#include "tests/laws/scroll.hpp"

#include <gtest/gtest.h>

#include <utility>

using namespace shadowmath;

namespace {

using V3 = glm::dvec3;

LightBasis<double> const axes = light_basis(V3(0.3, -0.9, 0.2) / std::sqrt(0.94));

TexelGrid<double> window_at(double x, double y, int size = 16) {
    return grid_window(axes, axes.x * x + axes.y * y, 0.5, size);
}

}  // namespace

TEST(Scroll, OfAWindowThatStoodStillIsNothing) {
    Scroll const scroll = scroll_between(window_at(0, 0), window_at(0.2, -0.2));
    EXPECT_TRUE(scroll.kept);
    EXPECT_EQ(scroll.fresh.count, 0);
}

TEST(Scroll, IsAStripOnTheSideThatTheWindowMovesTo) {
    Scroll const right = scroll_between(window_at(0, 0), window_at(1.5, 0));
    EXPECT_EQ(right.x, 3);
    ASSERT_EQ(right.fresh.count, 1);
    EXPECT_EQ(right.fresh.at[0].x, 13);
    EXPECT_EQ(right.fresh.at[0].width, 3);
    EXPECT_EQ(right.fresh.at[0].height, 16);
    Scroll const corner = scroll_between(window_at(0, 0), window_at(-1, -2));
    EXPECT_EQ(corner.fresh.count, 2);
    EXPECT_TRUE(laws::covers_once(window_at(0, 0), window_at(-1, -2), corner));
}

TEST(Scroll, KeepsNothingOfAnotherGridOrAPlaceTooFar) {
    TexelGrid<double> const here = window_at(0, 0);
    TexelGrid<double> other = here;
    other.texel_metres = 0.25;
    TexelGrid<double> const turned = grid_window(light_basis(V3(0, -1, 0)), V3(0.0), 0.5, 16);
    for (TexelGrid<double> const& after : {other, turned, window_at(8, 0), window_at(0, -1000), window_at(0, 0, 8)}) {
        Scroll const scroll = scroll_between(here, after);
        EXPECT_FALSE(scroll.kept);
        EXPECT_TRUE(laws::covers_once(here, after, scroll));
    }
    EXPECT_FALSE(scroll_between(TexelGrid<double>{}, here).kept);
    EXPECT_EQ(scroll_between(here, TexelGrid<double>{}).fresh.count, 0);
}

TEST(Wrapped, AddressesEveryTexelOfTheGridInTheMap) {
    EXPECT_EQ(wrapped(std::int64_t(-1), 16), 15);
    EXPECT_EQ(wrapped(std::int64_t(-17), 16), 15);
    EXPECT_EQ(wrapped(std::int64_t(33), 16), 1);
    EXPECT_EQ(wrapped(std::int64_t(5), 0), 0);
    for (double const x : {-40.0, -3.5, 0.0, 7.0})
        for (TexelRect const& rect : {TexelRect{0, 0, 16, 16}, TexelRect{13, 0, 3, 16}, TexelRect{0, 12, 16, 4},
                                      TexelRect{5, 5, 1, 1}, TexelRect{0, 0, 0, 4}})
            EXPECT_TRUE(laws::wraps_once(window_at(x, 2.0), rect));
}

TEST(Unchanged, SeesASingleBit) {
    ShadowMap<double> map;
    map.visible = true;
    ShadowMap<double> moved = map;
    EXPECT_TRUE(unchanged(map, moved));
    moved.clip_from_world[3][0] = std::nextafter(moved.clip_from_world[3][0], 9.0);
    EXPECT_FALSE(unchanged(map, moved));
    moved = map;
    moved.visible = false;
    EXPECT_FALSE(unchanged(map, moved));
}

TEST(Unchanged, SeesAnotherConvention) {
    ShadowMap<double> map;
    map.visible = true;
    for (ClipSpace const clip : {reversed(map.clip), vulkan_clip}) {
        ShadowMap<double> other = map;
        other.clip = clip;
        EXPECT_FALSE(unchanged(map, other));
    }
}

TEST(Scroll, KeepsNothingWhereTheLightTurnedByABit) {
    TexelGrid<double> const before = window_at(0.0, 0.0);
    for (V3 LightBasis<double>::*axis : {&LightBasis<double>::x, &LightBasis<double>::y, &LightBasis<double>::depth}) {
        TexelGrid<double> after = before;
        (after.basis.*axis).z = std::nextafter((after.basis.*axis).z, 9.0);
        EXPECT_FALSE(scroll_between(before, after).kept);
        EXPECT_EQ(scroll_between(before, after).fresh.count, 1);
    }
}

TEST(Wrapped, LeavesOutARectangleThatIsLargerThanTheMap) {
    TexelGrid<double> const grid = window_at(3.0, 2.0);
    EXPECT_EQ(wrapped(grid, TexelRect{0, 0, 17, 1}).count, 0);
    EXPECT_EQ(wrapped(grid, TexelRect{0, 0, 1, 17}).count, 0);
}

TEST(TexelRects, HoldNoMoreThanTheyHaveRoomFor) {
    TexelRects<2> rects;
    for (int i = 0; i < 3; ++i) rects.add({i, 0, 1, 1});
    rects.add({0, 0, 0, 5});
    EXPECT_EQ(rects.count, 2);
    EXPECT_EQ(rects.at[1].x, 1);
}

TEST(Scroll, ByItsWholeSizeKeepsNothing) {
    TexelGrid<double> const before = window_at(0.0, 0.0);
    for (auto const& [x, y] : {std::pair(8.0, 0.0), std::pair(-8.0, 0.0), std::pair(0.0, 8.0), std::pair(0.0, -8.0)}) {
        Scroll const scroll = scroll_between(before, window_at(x, y));
        EXPECT_FALSE(scroll.kept);
        ASSERT_EQ(scroll.fresh.count, 1);
        EXPECT_EQ(scroll.fresh.at[0].width * scroll.fresh.at[0].height, 256);
    }
}
