// SPDX-License-Identifier: MIT
#include <shadowmath/irregular/buffer.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

using namespace shadowmath;

namespace {

struct Picture {
    int width, height, map_size, capacity;
};

constexpr Picture pictures[] = {{1, 1, 1, 1},   {4, 4, 1, 3},    {5, 3, 2, 7},      {16, 16, 4, 16},    {17, 15, 5, 20},
                                {64, 3, 16, 9}, {3, 64, 17, 50}, {40, 40, 64, 300}, {129, 65, 100, 999}};

int tiles_of(Picture const& picture) {
    return (picture.width + 3) / 4 * ((picture.height + 3) / 4);
}

// Arrays that begin `skipped` numbers after a line of the caches, and what is laid out in them.
template <class T>
struct LaidOut {
    std::vector<T> scalars;
    std::vector<std::uint32_t> words;
    Storage<T> storage;
    IrregularBuffer<T> buffer;
    detail::Parts<T> parts;

    LaidOut(Picture const& picture, StorageSize size, std::size_t skipped)
        : scalars(size.scalars + 100, T(-77)), words(size.words + 100, 0xabadcafeu) {
        storage = {at_line(scalars.data()) + skipped, at_line(words.data()) + skipped, size};
        buffer.rect = {0, 0, picture.width, picture.height};
        buffer.map_size = picture.map_size;
        buffer.tile_count = tiles_of(picture);
        parts = detail::lay_out(buffer, storage);
    }
    template <class Number>
    static Number* at_line(Number* from) {
        while (reinterpret_cast<std::uintptr_t>(from) % cache_line != 0) ++from;
        return from;
    }
    // Numbers from the beginning of the storage to the end of an array.
    template <class Number>
    [[nodiscard]] std::size_t end(Number const* array, std::size_t count) const {
        if constexpr (std::is_same_v<Number, T>)
            return std::size_t(array - storage.scalars) + count;
        else
            return std::size_t(array - storage.words) + count;
    }
};

}  // namespace

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

// Whether the caller's arrays begin at a line of the caches, or as far beside one as can be.
template <class T>
void expect_room_for_what_was_asked_for() {
    for (Picture const& picture : pictures)
        for (std::size_t const skipped : {std::size_t(0), std::size_t(1), std::size_t(7)}) {
            StorageSize const size = storage_for(picture.width, picture.height, picture.map_size, picture.capacity);
            LaidOut<T> const laid(picture, size, skipped);
            auto const& [capacity, tiles] = std::pair(std::size_t(picture.capacity), std::size_t(tiles_of(picture)));
            EXPECT_EQ(laid.parts.capacity, capacity < 16 * tiles ? capacity : 16 * tiles);
            auto const texels = std::size_t(picture.map_size * picture.map_size), nodes = 4 * capacity;
            auto const& b = laid.buffer;
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(b.surface) % cache_line, 0u);
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(b.state) % cache_line, 0u);
            EXPECT_EQ(b.bounds, b.surface + 64 * tiles);
            EXPECT_EQ(b.texel_depth, b.bounds + 5 * nodes);
            EXPECT_EQ(b.block_depth, b.texel_depth + texels);
            EXPECT_EQ(laid.parts.bounds, b.block_depth + texels);
            constexpr std::size_t line = cache_line / sizeof(T);
            std::size_t const left_out = (line - skipped % line) % line;
            EXPECT_EQ(std::size_t(b.surface - laid.storage.scalars), left_out);
            EXPECT_EQ(laid.end(laid.parts.bounds, 5 * capacity) + line_slack - left_out, size.scalars);

            EXPECT_EQ(b.caster, b.state + 48 * tiles);
            EXPECT_EQ(b.caster_list, b.caster + 16 * tiles);
            EXPECT_EQ(b.caster_order, b.caster_list + 16 * tiles);
            EXPECT_EQ(b.caster_room, 16 * tiles);
            EXPECT_EQ(b.tile, b.caster_order + 16 * tiles);
            EXPECT_EQ(b.texel_levels, b.tile + nodes);
            EXPECT_EQ(b.texel_lists, b.texel_levels + texels);
            EXPECT_EQ(b.texel_division, b.texel_lists + texels);
            EXPECT_EQ(b.first, b.texel_division + texels);
            // Every texel has a list and a division, every four nodes one more, and every texel of a coarser level one.
            std::size_t lists = 2 * texels + capacity + 2;
            for (int side = picture.map_size; side > 1;) {
                side = (side + 3) / 4;
                lists += std::size_t(side * side);
            }
            std::size_t const words_left_out = (16 - skipped) % 16;
            EXPECT_GE(std::size_t(b.caster_end - b.first), lists);
            EXPECT_LE(laid.end(b.caster_end, lists), size.words);
            EXPECT_EQ(std::size_t(b.state - laid.storage.words), words_left_out);
            EXPECT_EQ(laid.end(b.first, 2 * lists) + line_slack - words_left_out, size.words);
        }
}

TEST(StorageFor, HasRoomForWhatWasAskedForAndNoPartMore) {
    expect_room_for_what_was_asked_for<float>();
    expect_room_for_what_was_asked_for<double>();
}

TEST(StorageFor, TakesThreeTimesAsManyPartsAsTilesWhereNoneAreAskedFor) {
    for (Picture const& picture : pictures) {
        StorageSize const size = storage_for(picture.width, picture.height, picture.map_size);
        StorageSize const three = storage_for(picture.width, picture.height, picture.map_size, 3 * tiles_of(picture));
        EXPECT_EQ(size.scalars, three.scalars);
        EXPECT_EQ(size.words, three.words);
    }
}

TEST(LayOut, TakesNothingThatIsTooShort) {
    for (Picture const& picture : pictures) {
        StorageSize const least = storage_for(picture.width, picture.height, picture.map_size, 1);
        auto const capacity = [&](StorageSize const& size) { return LaidOut<float>(picture, size, 1).parts.capacity; };
        EXPECT_EQ(capacity(least), 1u);
        EXPECT_EQ(capacity({least.scalars - 1, least.words}), 0u);
        EXPECT_EQ(capacity({least.scalars, least.words - 1}), 0u);
        EXPECT_EQ(capacity({least.scalars - 1, least.words + 999}), 0u);
        EXPECT_EQ(capacity({least.scalars + 999, least.words - 1}), 0u);
        EXPECT_EQ(capacity({least.scalars + 24, least.words + 999}), 1u) << "a part is 25 numbers";
        EXPECT_EQ(capacity({least.scalars + 999, least.words + 5}), 1u) << "and six words";
        LaidOut<float> laid(picture, storage_for(picture.width, picture.height, picture.map_size), 0);
        Storage<float> no_scalars = laid.storage, no_words = laid.storage;
        no_scalars.scalars = nullptr;
        no_words.words = nullptr;
        EXPECT_EQ(detail::lay_out(laid.buffer, no_scalars).capacity, 0u);
        EXPECT_EQ(detail::lay_out(laid.buffer, no_words).capacity, 0u);
    }
}

TEST(LayOut, HasNoMorePartsThanPixels) {
    Picture const picture{9, 5, 4, 0};
    EXPECT_EQ(LaidOut<float>(picture, storage_for(9, 5, 4, 500), 0).parts.capacity, 16u * 6u);
}

TEST(LayOut, ClearsWhatTexelsHaveAndNothingElse) {
    for (Picture const& picture : pictures) {
        LaidOut<float> const laid(picture, storage_for(picture.width, picture.height, picture.map_size), 3);
        auto const texels = std::size_t(picture.map_size * picture.map_size);
        auto const& b = laid.buffer;
        for (std::size_t i = 0; i < texels; ++i) {
            EXPECT_EQ(b.texel_levels[i], 0u);
            EXPECT_EQ(b.texel_division[i], 0u);
            EXPECT_EQ(b.texel_depth[i], std::numeric_limits<float>::lowest());
            EXPECT_EQ(b.block_depth[i], -77.0f);
            EXPECT_EQ(b.texel_lists[i], 0xabadcafeu);
        }
        EXPECT_EQ(b.bounds[0], -77.0f);
        EXPECT_EQ(b.first[0], 0xabadcafeu);
        EXPECT_EQ(laid.parts.place, b.caster);
    }
}

TEST(LevelSize, IsAQuarterOfTheFinerOnesRoundedUp) {
    for (int map_size = 1; map_size <= 300; ++map_size)
        for (int level = 0, side = map_size; level < most_levels; ++level, side = (side + 3) / 4)
            EXPECT_EQ(level_size(map_size, level), side);
}
