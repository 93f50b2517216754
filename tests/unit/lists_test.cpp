// SPDX-License-Identifier: MIT
//
// Nodes sorted into lists, beside lists that are made one by one.
#include <shadowmath/irregular/lists.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

using namespace shadowmath;

namespace {

using Bounds = std::array<float, 5>;

struct Dice {
    std::mt19937 bits{20021201};

    int in(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(bits); }
    float in(float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(bits); }
};

// A grid, and nodes put into it as TileKernel does.
struct Listing {
    std::vector<float> scalars;
    std::vector<std::uint32_t> words;
    IrregularBuffer<float> buffer;
    detail::Parts<float> parts;
    std::vector<Bounds> bounds;
    std::vector<int> tiles;

    Listing(int map_size, int capacity) {
        StorageSize const size = storage_for(128, 128, map_size, capacity);
        scalars.assign(size.scalars, -77.0f);
        words.assign(size.words, 0xabadcafeu);
        buffer.rect = {0, 0, 128, 128};
        buffer.map_size = map_size;
        buffer.tiles_across = 32;
        buffer.tile_count = 32 * 32;
        while (buffer.level_count == 0 || level_size(map_size, buffer.level_count - 1) > 1) ++buffer.level_count;
        parts = detail::lay_out(buffer, {scalars.data(), words.data(), size});
    }
    void add(int tile, Bounds const& of) {
        float array[5];
        std::copy(of.begin(), of.end(), array);
        detail::add_part(buffer, parts, tile, array);
        bounds.push_back(of);
        tiles.push_back(tile);
    }
};

// Where a node goes, the slow way: no shifts, a division of the plane for each list.
struct Node {
    int level = 0;
    std::array<int, 4> finest{};  // places in 32nds of a texel
};

int finest_place(float coordinate, int map_size) {
    if (!(coordinate > 0.0f)) return 0;
    return static_cast<int>(std::fmin(std::floor(double(coordinate) * 32.0), 32.0 * map_size - 1.0));
}

Node node_of(Bounds const& b, int map_size, int levels) {
    Node node;
    double const extent = std::fmax(double(b[1] - b[0]), double(b[3] - b[2]));
    while (node.level + 1 < levels && extent > std::pow(4.0, node.level)) ++node.level;
    for (unsigned i = 0; i < 4; ++i) node.finest[i] = finest_place(b[i], map_size);
    return node;
}

// Whether two closed ranges of places meet.
bool meet(int a0, int a1, int b0, int b1) {
    return a0 <= b1 && b0 <= a1;
}

bool touches(Node const& node, int x, int y, int side) {
    return meet(node.finest[0], node.finest[1], x * side, x * side + side - 1) &&
           meet(node.finest[2], node.finest[3], y * side, y * side + side - 1);
}

}  // namespace

TEST(Lists, APlaceIsA32ndOfATexelAndWhatLiesBesideTheMapBelongsToItsBorder) {
    Dice dice;
    constexpr float endless = std::numeric_limits<float>::infinity();
    for (int i = 0; i < 300; ++i) {
        int const map_size = dice.in(1, 300);
        float const b[4] = {dice.in(-9.0f, 300.0f), dice.in(-9.0f, 300.0f), dice.in(-9.0f, 300.0f),
                            dice.in(-9.0f, 300.0f)};
        auto const places = detail::places_of(b, map_size);
        EXPECT_EQ(places.x0, finest_place(b[0], map_size));
        EXPECT_EQ(places.x1, finest_place(b[1], map_size));
        EXPECT_EQ(places.y0, finest_place(b[2], map_size));
        EXPECT_EQ(places.y1, finest_place(b[3], map_size));
    }
    float const odd[4] = {std::numeric_limits<float>::quiet_NaN(), endless, -endless, 3.0f};
    auto const places = detail::places_of(odd, 3);
    EXPECT_EQ(places.x0, 0);
    EXPECT_EQ(places.x1, 95);
    EXPECT_EQ(places.y0, 0);
    EXPECT_EQ(places.y1, 95);
}

TEST(Lists, APlaceBeginsAtItsLowerEnd) {
    for (int place = 0; place < 96; ++place) {
        float const edge = static_cast<float>(place) / 32.0f;
        EXPECT_EQ(detail::place_of(edge, 95.0f), place);
        EXPECT_EQ(detail::place_of(std::nextafter(edge, 9.0f), 95.0f), place);
    }
}

TEST(Lists, TexelsAndDivisionsAreThoseThatThePlacesTouch) {
    Dice dice;
    for (int i = 0; i < 300; ++i) {
        int const x0 = dice.in(0, 400), y0 = dice.in(0, 400);
        detail::PlaceRange const places{x0, x0 + dice.in(0, 90), y0, y0 + dice.in(0, 90)};
        for (int level = 0; level < 3; ++level) {
            int const side = 32 << 2 * level;
            auto const texels = detail::texels_of(places, level);
            EXPECT_EQ(texels.x0, places.x0 / side);
            EXPECT_EQ(texels.x1, places.x1 / side);
            EXPECT_EQ(texels.y0, places.y0 / side);
            EXPECT_EQ(texels.y1, places.y1 / side);
        }
        auto const texels = detail::texels_of(places, 0);
        for (int y = texels.y0; y <= texels.y1; ++y)
            for (int x = texels.x0; x <= texels.x1; ++x)
                for (int k = 0; k <= most_divisions; ++k) {
                    auto const in = detail::divisions_of(places, x, y, k);
                    int const side = 32 >> k;
                    for (int d = 0; d < 1 << k; ++d) {
                        int const left = 32 * x + d * side, top = 32 * y + d * side;
                        EXPECT_EQ(in.x0 <= d && d <= in.x1, meet(places.x0, places.x1, left, left + side - 1));
                        EXPECT_EQ(in.y0 <= d && d <= in.y1, meet(places.y0, places.y1, top, top + side - 1));
                    }
                }
    }
}

// Crowds of small nodes about a few places, so that texels are divided, and some of all sizes.
TEST(Lists, HoldEveryNodeThatTouchesThemInTheOrderOfThePicture) {
    Dice dice;
    for (int const map_size : {1, 2, 5, 16, 17, 65}) {
        int const count = 4000;
        Listing listing(map_size, count);
        auto& buffer = listing.buffer;
        for (int i = 0; i < count; ++i) {
            bool const crowd = i % 4 != 0;
            float const size = crowd ? 0.02f : std::pow(2.0f, dice.in(-6.0f, 8.0f));
            float const x = crowd ? float(i % 2) * 0.9f * float(map_size) + dice.in(0.0f, 0.9f)
                                  : dice.in(-1.0f, float(map_size) + 1.0f);
            float const y = crowd ? 0.3f + dice.in(0.0f, 0.4f) : dice.in(-1.0f, float(map_size) + 1.0f);
            listing.add(i / 4,
                        {x, x + size * dice.in(0.1f, 1.0f), y, y + size * dice.in(0.1f, 1.0f), dice.in(0.0f, 1.0f)});
        }
        bool const fits = detail::sort_parts(buffer, listing.parts);

        std::vector<Node> nodes;
        for (auto const& b : listing.bounds) nodes.push_back(node_of(b, map_size, buffer.level_count));
        std::vector<std::vector<std::size_t>> lists;
        std::uint32_t levels = 0;
        std::vector<float> depth(std::size_t(map_size * map_size), std::numeric_limits<float>::lowest());
        for (int y = 0; y < map_size; ++y)
            for (int x = 0; x < map_size; ++x) {
                auto const texel = std::size_t(y * map_size + x);
                std::vector<std::size_t> here;
                std::uint32_t bits = 0;
                for (std::size_t i = 0; i < nodes.size(); ++i) {
                    if (!touches(nodes[i], x, y, 32)) continue;
                    bits |= 1u << nodes[i].level;
                    depth[texel] = std::fmax(depth[texel], listing.bounds[i][4]);
                    if (nodes[i].level == 0) here.push_back(i);
                }
                levels |= bits;
                EXPECT_EQ(buffer.texel_levels[texel], bits);
                EXPECT_EQ(buffer.texel_depth[texel], depth[texel]);
                int k = 0;
                for (std::size_t most = 64; k < 5 && here.size() >= most; most *= 4) ++k;
                EXPECT_EQ(buffer.texel_division[texel], std::uint32_t(k));
                EXPECT_EQ(buffer.texel_lists[texel], std::uint32_t(lists.size()));
                std::size_t const wide = lists.size();
                lists.resize(wide + 1 + (std::size_t(1) << 2 * k));
                int const side = 32 >> k;
                for (std::size_t const i : here) {
                    std::vector<std::size_t> in;
                    int columns = 0, rows = 0;
                    for (int d = 0; d < 1 << k; ++d) {
                        int const left = 32 * x + d * side, top = 32 * y + d * side;
                        columns += meet(nodes[i].finest[0], nodes[i].finest[1], left, left + side - 1);
                        rows += meet(nodes[i].finest[2], nodes[i].finest[3], top, top + side - 1);
                        for (int e = 0; e < 1 << k; ++e)
                            if (touches(nodes[i], (32 * x >> (5 - k)) + e, (32 * y >> (5 - k)) + d, side))
                                in.push_back(wide + 1 + std::size_t((d << k) + e));
                    }
                    if (columns > 2 || rows > 2) in = {wide};
                    for (std::size_t const list : in) lists[list].push_back(i);
                }
            }
        for (int level = 1; level < buffer.level_count; ++level) {
            int const side = level_size(map_size, level);
            EXPECT_EQ(buffer.level_first[level], std::uint32_t(lists.size()));
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) {
                    lists.emplace_back();
                    for (std::size_t i = 0; i < nodes.size(); ++i)
                        if (nodes[i].level == level && touches(nodes[i], x, y, 32 << 2 * level))
                            lists.back().push_back(i);
                }
        }
        EXPECT_EQ(buffer.levels_used, levels);
        ASSERT_EQ(buffer.list_count, std::uint32_t(lists.size()));
        ListCounts counted;
        for (auto const& list : lists) {
            counted.nodes += std::uint32_t(list.size());
            counted.lists += list.empty() ? 0u : 1u;
            counted.longest = std::max(counted.longest, std::uint32_t(list.size()));
        }
        EXPECT_EQ(buffer.counts.parts, std::uint32_t(count));
        EXPECT_EQ(buffer.counts.nodes, counted.nodes);
        EXPECT_EQ(buffer.counts.lists, counted.lists);
        EXPECT_EQ(buffer.counts.longest, counted.longest);
        ASSERT_TRUE(fits) << counted.nodes << " nodes of " << count << " parts";
        for (std::size_t list = 0, node = 0; list < lists.size(); ++list) {
            EXPECT_EQ(buffer.first[list], std::uint32_t(node));
            for (std::size_t const i : lists[list]) {
                EXPECT_EQ(buffer.tile[node], std::uint32_t(listing.tiles[i]));
                for (std::size_t c = 0; c < 5; ++c) EXPECT_EQ(buffer.bounds[5 * node + c], listing.bounds[i][c]);
                ++node;
            }
            EXPECT_EQ(buffer.first[list + 1], std::uint32_t(node));
        }
        for (int y = 0; y < map_size; ++y)
            for (int x = 0; x < map_size; ++x) {
                float deepest = std::numeric_limits<float>::lowest();
                for (int j = y; j <= y + 1 && j < map_size; ++j)
                    for (int i = x; i <= x + 1 && i < map_size; ++i)
                        deepest = std::fmax(deepest, depth[std::size_t(j * map_size + i)]);
                EXPECT_EQ(buffer.block_depth[y * map_size + x], deepest);
            }
    }
}

TEST(Lists, ANodeAsLargeAsATexelOfALevelBelongsToIt) {
    Listing listing(64, 50);
    for (float const size : {1.0f, 4.0f, 16.0f, 64.0f, 1000.0f}) {
        listing.add(1, {3.0f, 3.0f + size, 2.0f, 2.5f, 0.5f});
        listing.add(1, {3.0f, 3.5f, 2.0f, 2.0f + size, 0.5f});
    }
    ASSERT_TRUE(detail::sort_parts(listing.buffer, listing.parts));
    EXPECT_EQ(listing.buffer.levels_used, 0xfu);
    for (int level = 0; level < 4; ++level)
        for (int i = 0; i < 2; ++i)
            EXPECT_EQ(listing.parts.place[3 * (2 * level + i)] >> 28, std::uint32_t(level)) << "of part " << i;
}

TEST(Lists, WhatThereIsNoRoomForIsCountedAndLeavesNoTrace) {
    Listing listing(16, 10);
    ASSERT_EQ(listing.parts.capacity, 10u);
    for (int i = 0; i < 10; ++i) listing.add(i, {0.1f, 0.2f, 0.1f, 0.2f, 0.1f});
    auto const before = listing.words;
    auto const numbers = listing.scalars;
    for (int i = 0; i < 3; ++i) listing.add(i, {5.0f, 12.0f, 5.0f, 12.0f, 0.9f});
    EXPECT_EQ(listing.buffer.counts.parts, 13u);
    EXPECT_EQ(listing.words, before);
    EXPECT_EQ(listing.scalars, numbers);
    EXPECT_EQ(listing.buffer.levels_used, 1u);
}

TEST(Lists, ATexelIsDividedForEveryFourNodesAndIntoNoMoreThan32By32) {
    struct Row {
        std::uint32_t nodes, k;
    };
    for (Row const& row : {Row{0, 0}, Row{63, 0}, Row{64, 1}, Row{255, 1}, Row{256, 2}, Row{1023, 2}, Row{1024, 3},
                           Row{4096, 4}, Row{16384, 5}, Row{65536, 5}, Row{1u << 20, 5}}) {
        Listing listing(2, 1);
        listing.buffer.texel_division[1] = row.nodes;
        std::uint32_t const lists = detail::divide_texels(listing.buffer);
        EXPECT_EQ(listing.buffer.texel_division[0], 0u);
        EXPECT_EQ(listing.buffer.texel_division[1], row.k) << row.nodes;
        EXPECT_EQ(listing.buffer.texel_lists[2], 2u + 1u + (1u << 2 * row.k));
        EXPECT_EQ(lists, 6u + 1u + (1u << 2 * row.k) + 1u) << "three texels, that one, and one of the coarser level";
    }
}

// Sixty-four about a corner of four texels, which so are divided; the last one reaches into nine divisions.
TEST(Lists, HaveRoomForFourNodesOfEachPartAndForNoMore) {
    for (bool const more : {false, true}) {
        Listing listing(16, 64);
        for (int i = 0; i < 64; ++i) {
            float const begin = more && i == 63 ? 3.4f : 3.9f;
            listing.add(i, {begin, 4.1f, begin, 4.1f, 0.1f});
        }
        bool const fits = detail::sort_parts(listing.buffer, listing.parts);
        EXPECT_EQ(listing.buffer.counts.nodes, more ? 4u * 63u + 9u : 4u * 64u);
        EXPECT_EQ(fits, !more);
    }
}
