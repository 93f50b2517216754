// SPDX-License-Identifier: MIT
#include <shadowmath/irregular/buffer.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;

TEST(StorageFor, IsNothingForNoPictureAndGrowsWithEverything) {
    EXPECT_EQ(storage_for(0, 10, 16).scalars, 0u);
    EXPECT_EQ(storage_for(10, 10, 0).words, 0u);
    EXPECT_EQ(storage_for(10, 0, 16).words, 0u);
    EXPECT_EQ(storage_for(10, 10, largest_grid + 1).scalars, 0u);
    EXPECT_GT(storage_for(10, 10, largest_grid).scalars, 0u);
    StorageSize const least = storage_for(64, 64, 16);
    for (StorageSize const more :
         {storage_for(128, 64, 16), storage_for(64, 128, 16), storage_for(64, 64, 64), storage_for(64, 64, 16, 4096)}) {
        EXPECT_GT(more.scalars, least.scalars);
        EXPECT_GT(more.words, least.words);
    }
    // What buffer.hpp says: bytes a pixel and a texel, however many triangles there are.
    auto const bytes = [](int width, int height, int map_size) {
        StorageSize const size = storage_for(width, height, map_size);
        return 4.0 * static_cast<double>(size.scalars + size.words);
    };
    EXPECT_LE((bytes(1280, 720, 96) - bytes(4, 4, 96)) / (1280.0 * 720.0), 64.0);
    EXPECT_LE((bytes(4, 4, 256) - bytes(4, 4, 96)) / (256.0 * 256.0 - 96.0 * 96.0), 37.0);
    EXPECT_LE(bytes(1, 1, 1), 1 << 11);
}
