// SPDX-License-Identifier: MIT
#include <shadowmath/schedule.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;

TEST(MapsDue, AreTheRuler) {
    std::uint32_t const expected[] = {0b1001, 0b0011, 0b0101, 0b0011, 0b1001, 0b0011, 0b0101, 0b0011, 0b1001};
    for (std::uint64_t frame = 0; frame < 9; ++frame) EXPECT_EQ(maps_due(frame, 4), expected[frame]) << frame;
}

TEST(MapsDue, AreAtMostTwoAndEachExactlyOnceInItsTurn) {
    for (int count = 1; count <= 16; ++count)
        for (std::uint64_t start : {std::uint64_t(0), std::uint64_t(12345), ~std::uint64_t(0) - 70000})
            for (int map = 0; map < count; ++map) {
                int drawn = 0;
                for (int i = 0; i < frames_between(map, count); ++i) {
                    std::uint32_t const due = maps_due(start + std::uint64_t(i), count);
                    drawn += (due >> map & 1u) != 0;
                    ASSERT_LE(__builtin_popcount(due), 2);
                    ASSERT_EQ(due >> count, 0u);
                }
                ASSERT_EQ(drawn, 1) << count << ' ' << map << ' ' << start;
            }
}

TEST(MapsDue, IncludeWhatHasChangedAndNothingBeyondTheCount) {
    EXPECT_EQ(maps_due(1, 4, 0b1100), 0b1111u);
    EXPECT_EQ(maps_due(1, 2, ~0u), 0b11u);
    EXPECT_EQ(maps_due(0, 0), 0u);
    EXPECT_EQ(maps_due(0, -3), 0u);
    EXPECT_EQ(maps_due(0, 1), 1u);
    EXPECT_NE(maps_due(0, 32), 0u);
}

TEST(MapsDue, OfThirtyTwoMapsAreAmongThem) {
    EXPECT_EQ(maps_due(0, 32) & 1u, 1u);
    EXPECT_EQ(maps_due(0, 32, ~0u), ~0u);
    EXPECT_EQ(maps_due(0, 31, ~0u), 0x7fffffffu);
    EXPECT_EQ(maps_due(0, 0, ~0u), 0u);
    EXPECT_EQ(maps_due(0, -1, ~0u), 0u);
}

TEST(FramesBetween, AreOneForTheFirstMapAndForOneAlone) {
    EXPECT_EQ(frames_between(0, 4), 1);
    EXPECT_EQ(frames_between(-1, 4), 1);
    EXPECT_EQ(frames_between(3, 1), 1);
    EXPECT_EQ(frames_between(3, 0), 1);
    EXPECT_EQ(frames_between(1, 2), 1);
    EXPECT_EQ(frames_between(2, 9), 4);
    EXPECT_EQ(frames_between(40, 99), 1 << 30) << "no longer than an int can count";
}
