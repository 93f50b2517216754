// SPDX-License-Identifier: MIT
//
// What a tile is listed and left out by: the nodes of its pixels, and a byte for each of their bounds.
#include "tests/support/tile_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class Lanes>
struct TileNodes : TilePicture<Lanes> {};
using Kinds = ::testing::Types<PlainLanes<float>, PlainLanes<double>, BestLanes<float>>;
TYPED_TEST_SUITE(TileNodes, Kinds);

}  // namespace

// (lo x, -hi x, lo y, -hi y, -depth) in steps of a 255th of the tile's range, from one to two steps less than they are.
TYPED_TEST(TileNodes, KeepsTheKeysOfItsPixelsInAByteEach) {
    using T = typename TypeParam::Scalar;
    int several = 0;
    for (TileForm const& form : tile_forms) {
        this->take(form);
        for (int tile = 0; tile < this->buffer.tile_count; ++tile) {
            typename TestFixture::Kernel::Seen seen;
            this->kernel().see(tile, 2 + tile % 5 * 4, 1 + tile / 5 * 4, seen);
            if (seen.alive == 0) continue;
            std::array<T, 16> keys[5] = {this->numbers(seen.lo_x), this->numbers(seen.hi_x), this->numbers(seen.lo_y),
                                         this->numbers(seen.hi_y), this->numbers(seen.depth)};
            for (std::size_t i : {1u, 3u, 4u})
                for (T& key : keys[i]) key = -key;
            T const* const kept = this->buffer.surface + tile * tile_scalars;
            auto const* const bytes = reinterpret_cast<unsigned char const*>(this->buffer.state + tile * tile_words);
            for (std::size_t i = 0; i < 5; ++i) {
                T least = std::numeric_limits<T>::max(), most = std::numeric_limits<T>::lowest();
                for (std::size_t k = 0; k < 16; ++k)
                    if ((seen.alive >> k & 1u) != 0)
                        least = std::min(least, keys[i][k]), most = std::max(most, keys[i][k]);
                T const base = kept[key_base_at + i], step = kept[key_step_at + i];
                EXPECT_EQ(base, least);
                if (most == least) {
                    EXPECT_EQ(step, T(0));
                    continue;
                }
                ++several;
                EXPECT_NEAR(double(step), double((most - least) / 255), double(most - least) * 1e-6);
                for (std::size_t k = 0; k < 16; ++k) {
                    if ((seen.alive >> k & 1u) == 0) {
                        EXPECT_EQ(bytes[16 * i + k], 0);
                        continue;
                    }
                    double const steps = double((keys[i][k] - base) / step), slack = 1e-3;
                    double const wanted = std::fmax(0.0, steps - 1.0);
                    EXPECT_LE(bytes[16 * i + k], wanted + slack);
                    EXPECT_GT(bytes[16 * i + k], wanted - 1.0 - slack);
                }
            }
        }
    }
    EXPECT_GT(several, 100);
}

// Made up: sixteen pixels of these bounds, alike in y and depth.
TYPED_TEST(TileNodes, KeysOfNoRangeToSpeakOfAreAsTheLeast) {
    using T = typename TypeParam::Scalar;
    struct Row {
        double first, rest;
        bool ranged;
    };
    for (Row const& row : {Row{5, 5, false}, Row{5, 5.0001, false}, Row{5, 5.001, true}, Row{0, 1e-31, false},
                           Row{0, 1e-29, true}, Row{-1e15, 1e15, true}, Row{-1e31, 1e31, false}, Row{0, 1e29, true},
                           Row{16384, 16384.9, false}, Row{-16384, -16385.5, true}}) {
        this->take(tile_forms[0]);
        typename TestFixture::Kernel::Seen seen;
        T lanes[lane_count];
        for (int k = 0; k < lane_count; ++k) lanes[k] = T(k % 5 == 0 ? row.first : row.rest);
        seen.lo_x = seen.hi_x = seen.depth = TypeParam::load(lanes);
        seen.lo_y = seen.hi_y = TypeParam::all(T(3));
        seen.alive = 0xffffu;
        this->kernel().keep_bounds(0, seen);
        T const* const kept = this->buffer.surface;
        EXPECT_EQ(kept[key_step_at] > T(0), row.ranged) << row.first << ' ' << row.rest;
        EXPECT_EQ(kept[key_step_at + 1] > T(0), row.ranged) << row.first << ' ' << row.rest;
        EXPECT_EQ(kept[key_step_at + 2], T(0));
        EXPECT_EQ(kept[key_base_at], T(std::min(row.first, row.rest)));
        EXPECT_EQ(kept[key_base_at + 1], -T(std::max(row.first, row.rest)));
        auto const* const bytes = reinterpret_cast<unsigned char const*>(this->buffer.state);
        for (int k = 0; k < lane_count; ++k) {
            bool const upper = row.ranged && lanes[k] > T(std::min(row.first, row.rest));
            EXPECT_NEAR(bytes[k], upper ? 254 : 0, row.ranged ? 1 : 0);
        }
    }
}

// A tile whose pixels lie far apart for their size is listed in quarters, and those by single pixels.
TYPED_TEST(TileNodes, IsListedInPartsThatLieTogether) {
    using T = typename TypeParam::Scalar;
    // What sixteen pixels of half a texel each are listed as: where the right half lies this far off, and the last
    // pixel of the first quarter.
    struct Row {
        double half, one;
        std::uint32_t alive, nodes;
    };
    // A quarter is two by two pixels: 0, 1, 4, 5. Together they reach over eight times a pixel, or four times.
    for (Row const& row :
         {Row{0, 0, 0xffff, 1}, Row{3.4, 0, 0xffff, 1}, Row{3.6, 0, 0xffff, 4}, Row{3.6, 1.4, 0xffff, 4},
          Row{3.6, 1.6, 0xffff, 7}, Row{3.6, 1.6, 0xffee, 5}, Row{3.6, 0, 0xff33, 3}, Row{3.6, 1.6, 0x0000, 0}}) {
        for (bool const upward : {false, true}) {
            this->take(tile_forms[0]);
            typename TestFixture::Kernel::Seen seen;
            T lo[lane_count], hi[lane_count], far_end[lane_count];
            for (int k = 0; k < lane_count; ++k) {
                lo[k] = T(5 + (k % 4 >= 2 ? row.half : 0) + (k == 5 ? row.one : 0));
                hi[k] = lo[k] + T(0.5);
                far_end[k] = T(k);
            }
            auto const all = [](double value) { return TypeParam::all(T(value)); };
            (upward ? seen.lo_y : seen.lo_x) = TypeParam::load(lo);
            (upward ? seen.hi_y : seen.hi_x) = TypeParam::load(hi);
            (upward ? seen.lo_x : seen.lo_y) = all(7);
            (upward ? seen.hi_x : seen.hi_y) = all(7.25);
            seen.depth = TypeParam::load(far_end);
            seen.alive = row.alive;
            this->kernel().insert(this->parts, 3, seen, row.alive, tile_side);
            auto const& b = this->buffer;
            EXPECT_EQ(b.counts.parts, row.nodes) << row.half << ' ' << row.one;
            if (row.nodes == 0) continue;
            // Every pixel lies in a node, and each node ends at one.
            T least = T(1e9), most = T(-1e9), deepest = T(-1e9);
            for (int k = 0; k < lane_count; ++k) {
                if ((row.alive >> k & 1u) == 0) continue;
                least = std::min(least, lo[k]), most = std::max(most, hi[k]), deepest = std::max(deepest, far_end[k]);
                bool held = false;
                for (std::uint32_t n = 0; n < row.nodes; ++n) {
                    T const* const node = this->parts.bounds + 5 * n;
                    EXPECT_EQ(this->parts.place[3 * n] & 0x0fffffffu, 3u);
                    EXPECT_EQ(node[upward ? 0 : 2], T(7));
                    EXPECT_EQ(node[upward ? 1 : 3], T(7.25));
                    T const from = node[upward ? 2 : 0], to = node[upward ? 3 : 1];
                    EXPECT_LE(to - from, row.nodes > 1 ? T(2.0001) : T(4.0001));
                    held = held || (from <= lo[k] && hi[k] <= to && far_end[k] <= node[4]);
                }
                EXPECT_TRUE(held) << k;
            }
            EXPECT_EQ(upward ? b.least_y : b.least_x, least);
            EXPECT_EQ(upward ? b.most_y : b.most_x, most);
            EXPECT_EQ(upward ? b.least_x : b.least_y, T(7));
            EXPECT_EQ(upward ? b.most_x : b.most_y, T(7.25));
            EXPECT_EQ(b.most_depth, deepest);
        }
    }
}

// Nothing smaller than a texel is worth a node more, however small its pixels are.
TYPED_TEST(TileNodes, IsOneNodeWithinATexel) {
    using T = typename TypeParam::Scalar;
    for (double const extent : {0.9, 1.1}) {
        this->take(tile_forms[0]);
        typename TestFixture::Kernel::Seen seen;
        T lo[lane_count];
        for (int k = 0; k < lane_count; ++k) lo[k] = T(k % 4 >= 2 ? extent : 0);
        seen.lo_x = seen.hi_x = TypeParam::load(lo);
        seen.lo_y = seen.hi_y = seen.depth = TypeParam::all(T(1));
        this->kernel().insert(this->parts, 3, seen, 0xffffu, tile_side);
        EXPECT_EQ(this->buffer.counts.parts, extent < 1.0 ? 1u : 4u);
    }
}
