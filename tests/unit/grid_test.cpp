// SPDX-License-Identifier: MIT
#include "tests/support/traced.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

using Lanes = BestLanes<float>;
using V = Vec3<float>;

struct Listing : ::testing::Test {
    ViewVolume<float> eye =
        perspective_view<float>(pose_looking(V(0, 4, 4), V(0, -1, -1), V(0, 1, 0)), 0.8f, 1.5f, 0.1f, 100.0f);
    PlanePicture<float> floor = picture_of_plane(eye, 48, 32, V(0, 0, 0), V(0, 1, 0));
    Light<float> sun = directional(V(0.3f, -1.0f, 0.2f));
    std::vector<float> scalars;
    std::vector<std::uint32_t> words;

    Receivers<float> receivers() const {
        Receivers<float> seen;
        seen.depth = floor.depth.data();
        seen.normal = floor.normals.data();
        return seen;
    }
    IrregularBuffer<float> list(ShadowMap<float> const& grid, int map_size, StorageSize size, Light<float> const& light,
                                PixelRect rect = {}) {
        // What lies beyond must stay as it is.
        scalars.assign(size.scalars + 64, -77.0f);
        words.assign(size.words + 64, 0xabadcafeu);
        return list_receivers<float, Lanes>(floor.frame, receivers(), light, grid, map_size,
                                            {scalars.data(), words.data(), size}, rect);
    }
    void expect_nothing_written_past(StorageSize size) const {
        for (std::size_t i = size.scalars; i < scalars.size(); ++i) EXPECT_EQ(scalars[i], -77.0f);
        for (std::size_t i = size.words; i < words.size(); ++i) EXPECT_EQ(words[i], 0xabadcafeu);
    }
};

}  // namespace

TEST_F(Listing, HoldsATileInEveryTexelThatItsFootprintTouches) {
    for (int const map_size : {1, 3, 16, 100}) {
        ShadowMap<float> const grid = sun_map(sun, V(0, 0, 0), 8.0f);
        StorageSize const size = storage_for(48, 32, map_size);
        IrregularBuffer<float> const buffer = list(grid, map_size, size, sun);
        ASSERT_FALSE(buffer.faults.any()) << describe(buffer.faults);
        expect_nothing_written_past(size);
        EXPECT_EQ(buffer.counts.tiles, 96u);
        // Any point of any pixel: one of the lists that a triangle there would walk has a node that holds it.
        Mat4<float> const texture = texture_from_world(grid);
        for (int pixel = 0; pixel < 48 * 32; pixel += 7)
            for (float const u : {0.0f, 1.0f}) {
                int const column = pixel % 48, row = pixel / 48;
                MicroQuad<float> const quad =
                    micro_quad(floor.frame, column, row, floor.depth[static_cast<std::size_t>(pixel)], floor.normal);
                Vec4<float> const at =
                    texture * Vec4<float>(point_on(floor.frame, quad, column, row, u, 1.0f - u), 1.0f);
                float const x = at.x * static_cast<float>(map_size), y = at.y * static_cast<float>(map_size);
                float const bounds[4] = {x, x, y, y};
                detail::PlaceRange const places = detail::places_of(bounds, map_size);
                auto const tile = static_cast<std::uint32_t>(row / 4 * 12 + column / 4);
                bool found = false;
                auto const look = [&](std::uint32_t first, std::uint32_t last) {
                    for (std::uint32_t node = buffer.first[first]; node < buffer.first[last + 1]; ++node) {
                        float const* const of_node = buffer.bounds + 5 * std::size_t{node};
                        found = found || (buffer.tile[node] == tile && of_node[0] <= x && x <= of_node[1] &&
                                          of_node[2] <= y && y <= of_node[3] && at.z <= of_node[4]);
                    }
                };
                for (int level = 0; level < buffer.level_count; ++level) {
                    detail::PlaceRange const texel = detail::texels_of(places, level);
                    auto const index = static_cast<std::uint32_t>(texel.y0 * level_size(map_size, level) + texel.x0);
                    if (level > 0) {
                        look(buffer.level_first[level] + index, buffer.level_first[level] + index);
                        continue;
                    }
                    auto const k = static_cast<int>(buffer.texel_division[index]);
                    detail::PlaceRange const in = detail::divisions_of(places, texel.x0, texel.y0, k);
                    std::uint32_t const lists = buffer.texel_lists[index];
                    look(lists, lists);
                    std::uint32_t const division = lists + 1 + static_cast<std::uint32_t>((in.y0 << k) + in.x0);
                    look(division, division);
                }
                EXPECT_TRUE(found) << pixel << " in a grid of " << map_size;
            }
    }
}

TEST_F(Listing, IsTheSameEveryTime) {
    ShadowMap<float> const grid = sun_map(sun, V(0, 0, 0), 8.0f);
    StorageSize const size = storage_for(48, 32, 16);
    ListCounts const counts = list(grid, 16, size, sun).counts;
    auto const scalars_before = scalars;
    auto const words_before = words;
    EXPECT_EQ(list(grid, 16, size, sun).counts.nodes, counts.nodes);
    EXPECT_EQ(scalars, scalars_before);
    EXPECT_EQ(words, words_before);
    EXPECT_GE(counts.nodes, counts.parts);
    EXPECT_LE(counts.longest, counts.nodes);
}

TEST_F(Listing, SaysHowMuchStorageItNeedsAndWritesNothingPastTheEnd) {
    ShadowMap<float> const grid = sun_map(sun, V(0, 0, 0), 8.0f);
    StorageSize const enough = storage_for(48, 32, 16);
    for (StorageSize const size : {StorageSize{}, StorageSize{enough.scalars, 100}, StorageSize{100, enough.words},
                                   storage_for(48, 32, 16, 1), storage_for(48, 32, 16, 20)}) {
        IrregularBuffer<float> buffer = list(grid, 16, size, sun);
        EXPECT_TRUE(buffer.faults.has(Fault::storage_too_small));
        expect_nothing_written_past(size);
        V const roof[3] = {V(-50, 1, -50), V(50, 1, -50), V(0, 1, 50)};
        Casters<float> casters;
        casters.position = &roof[0].x;
        casters.vertex_count = 3;
        casters.triangle_count = 1;
        trace(buffer, casters);
        expect_nothing_written_past(size);
        std::vector<std::uint32_t> masks(48 * 32, 1u);
        write_masks(buffer, masks.data());
        EXPECT_EQ(std::accumulate(masks.begin(), masks.end(), 0u), 0u) << "everything lit";
        if (buffer.counts.parts == 0) continue;
        StorageSize const asked_for = storage_for(48, 32, 16, static_cast<int>(buffer.counts.parts));
        EXPECT_FALSE(list(grid, 16, asked_for, sun).faults.any());
    }
}

TEST_F(Listing, TakesNoMapOfAnotherLightAndNoBrokenOne) {
    ShadowMap<float> const grid = sun_map(sun, V(0, 0, 0), 8.0f);
    StorageSize const size = storage_for(48, 32, 16);
    EXPECT_TRUE(list(grid, 16, size, directional(V(0.31f, -1.0f, 0.2f))).faults.has(Fault::bad_projection));
    ShadowMap<float> broken = grid;
    broken.clip_from_world[1][2] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(list(broken, 16, size, sun).faults.has(Fault::bad_projection));
    EXPECT_TRUE(list(ShadowMap<float>{}, 16, size, sun).faults.has(Fault::bad_projection));
    EXPECT_TRUE(list(grid, 16, size, directional(V(0))).faults.has(Fault::zero_light));
    EXPECT_TRUE(list(grid, 0, size, sun).faults.has(Fault::map_too_small));
    EXPECT_TRUE(list(grid, largest_grid + 1, size, sun).faults.has(Fault::map_too_small));
    EXPECT_TRUE(list(grid, 16, size, sun, {40, 0, 9, 1}).faults.has(Fault::bad_region));
    EXPECT_TRUE(list(grid, 16, size, sun, {-1, 0, 4, 4}).faults.has(Fault::bad_region));
}

// The products of such directions are so small that a rounding is large beside them.
TEST_F(Listing, TakesTheMapOfASunAHairOffAnAxis) {
    StorageSize const size = storage_for(48, 32, 16);
    for (float const hair : {0.0f, 1e-30f, 1e-25f, 1e-12f, 1e-6f})
        for (int axis = 0; axis < 6; ++axis) {
            V along = V(0.3f, -0.7f, 0.9f) * hair;
            along[axis / 2] = axis % 2 == 0 ? 1.0f : -1.0f;
            Light<float> const noon = directional(along);
            EXPECT_FALSE(list(sun_map(noon, V(0, 0, 0), 8.0f), 16, size, noon).faults.any()) << hair << ", " << axis;
        }
}
