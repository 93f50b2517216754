// SPDX-License-Identifier: MIT
#include "tests/support/traced.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

TEST_F(Listing, TakesTheMapOfALampFarAwayAndNotThatOfASunNearby) {
    StorageSize const size = storage_for(48, 32, 16);
    ShadowMap<float> map;
    map.clip = gl_zero_to_one_clip;
    for (int i = 0; i < 200; ++i) {
        float const turn = 0.7f * float(i), height = std::sin(0.37f * float(i));
        V const along(std::cos(turn), height, std::sin(turn));
        Light<float> const lamp = spot(along * (1.0f + 10.0f * float(i)), -along, 0.7f, 5000.0f);
        map.clip_from_world = clip_from_world(
            perspective_view<float>(pose_looking(lamp.position, V(0.3f, -1, 0.2f), V(0, 1, 0)), 1.0f, 1.0f, 0.5f, 9e3f),
            map.clip);
        EXPECT_FALSE(list(map, 16, size, lamp).faults.has(Fault::bad_projection)) << i;
    }
    // However large the map is, and so however small the numbers in it are.
    for (float const half : {8.0f, 500.0f, 8000.0f, 1e5f})
        EXPECT_TRUE(list(sun_map(sun, V(0), half), 16, size, directional(V(0.3f, -1.0f, 0.201f)))
                        .faults.has(Fault::bad_projection))
            << half;
}

TEST_F(Listing, TakesNoMapOfNumbersThatEndInNone) {
    StorageSize const size = storage_for(48, 32, 16);
    ShadowMap<float> grid = sun_map(sun, V(0, 0, 0), 8.0f);
    grid.w_min = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(list(grid, 16, size, sun).faults.has(Fault::bad_projection));
    grid = sun_map(sun, V(0, 0, 0), 1e-20f);
    floor.frame.eye = V(1e30f, 1e30f, 0);
    EXPECT_TRUE(list(grid, 16, size, sun).faults.has(Fault::bad_projection)) << "as seen from so far away";
}

// Sixteen roundings of the sum of its terms' sizes; of x and y that which has more, and as many of w, times the place.
TEST_F(Listing, SaysWhatRoundingMayAddToAPlaceInTheGrid) {
    for (bool const wide : {false, true}) {
        ShadowMap<float> grid = sun_map(sun, V(0, 0, 0), 8.0f);
        // Wider, or higher; and with a w that is not 1.
        for (int c = 0; c < 4; ++c) grid.clip_from_world[c][wide ? 0 : 1] *= 3.0f;
        grid.clip_from_world[3][3] = 1.5f;
        auto const buffer = list(grid, 10, storage_for(48, 32, 10), sun);
        ASSERT_FALSE(buffer.faults.any());
        double steep[4], here[4];
        for (int i = 0; i < 4; ++i) {
            glm::dvec4 const row(buffer.row[i]);
            steep[i] = std::abs(row.x) + std::abs(row.y) + std::abs(row.z);
            here[i] = std::abs(row.w);
        }
        double const eps = 16.0 * 0x1p-23;
        EXPECT_NEAR(buffer.texel_error, eps * (std::max(steep[0], steep[1]) + 10.0 * steep[3]), 1e-5 * eps);
        EXPECT_NEAR(buffer.texel_error_here, eps * (std::max(here[0], here[1]) + 10.0 * here[3]), 1e-5 * eps);
        EXPECT_NEAR(buffer.depth_error, eps * (steep[2] + steep[3]), 1e-5 * eps);
        EXPECT_NEAR(buffer.depth_error_here, eps * (here[2] + here[3]), 1e-5 * eps);
    }
    Light<float> const lamp = spot(V(0.5f, 3, 0.25f), V(0, -1, 0), 1.2f, 20.0f);
    ShadowMap<float> map;
    map.clip = gl_zero_to_one_clip;
    map.clip_from_world = clip_from_world(
        perspective_view<float>(pose_looking(lamp.position, V(0.2f, -1, 0.1f), V(0, 0, 1)), 2.0f, 1.0f, 0.1f, 30.0f),
        map.clip);
    auto const buffer = list(map, 10, storage_for(48, 32, 10), lamp);
    ASSERT_FALSE(buffer.faults.any());
    double steep[4];
    for (int i = 0; i < 4; ++i) {
        glm::dvec4 const row(buffer.row[i]);
        steep[i] = std::abs(row.x) + std::abs(row.y) + std::abs(row.z);
    }
    EXPECT_NEAR(buffer.texel_error, 16.0 * 0x1p-23 * (std::max(steep[0], steep[1]) + 10.0 * steep[3]), 1e-10);
    EXPECT_NEAR(buffer.depth_error, 16.0 * 0x1p-23 * (steep[2] + steep[3]), 1e-10);
}

TEST_F(Listing, SaysHowFarAnythingInThePictureMayBe) {
    for (bool const flat : {false, true}) {
        auto const pose = pose_looking(V(1, 4, -3), V(0.1f, -1, -1), V(0, 1, 0));
        eye = flat ? orthographic_view<float>(pose, -1, 9, -2, 4, 0.1f, 100)
                   : perspective_view<float>(pose, 0.8f, 1.5f, 0.1f, 100.0f);
        floor = picture_of_plane(eye, 48, 32, V(0, 0, 0), V(0, 1, 0));
        auto const buffer = list(sun_map(sun, V(0, 0, 0), 8.0f), 16, storage_for(48, 32, 16), sun);
        ASSERT_FALSE(buffer.faults.any());
        auto const& f = floor.frame;
        double const across = glm::length(glm::dvec3(f.across)), upward = glm::length(glm::dvec3(f.upward));
        double const ray = 48.0 * across + 32.0 * upward + glm::length(glm::dvec3(f.inward));
        double const eye_place = 2.0 * (1 + 4 + 3);
        double const aside = across * std::abs(double(f.origin.x)) + upward * std::abs(double(f.origin.y));
        EXPECT_NEAR(buffer.contact_ray, flat ? 1.0 : ray, 1e-5);
        EXPECT_NEAR(buffer.contact_reach, flat ? eye_place + ray + aside : eye_place, 1e-4);
    }
}

TEST_F(Listing, APartOfThePictureGoesOnToItsEndWhereItHasNoSize) {
    ShadowMap<float> const grid = sun_map(sun, V(0, 0, 0), 8.0f);
    StorageSize const size = storage_for(48, 32, 16);
    struct Row {
        PixelRect asked_for, wanted;
    };
    for (Row const& row : {Row{{5, 7, 0, 0}, {5, 7, 43, 25}}, Row{{47, 31, 1, 1}, {47, 31, 1, 1}},
                           Row{{3, 4, 1, 0}, {3, 4, 1, 28}}, Row{{3, 4, 0, 1}, {3, 4, 45, 1}}}) {
        auto const buffer = list(grid, 16, size, sun, row.asked_for);
        EXPECT_FALSE(buffer.faults.any());
        EXPECT_EQ(buffer.rect.x, row.wanted.x);
        EXPECT_EQ(buffer.rect.y, row.wanted.y);
        EXPECT_EQ(buffer.rect.width, row.wanted.width);
        EXPECT_EQ(buffer.rect.height, row.wanted.height);
    }
    for (PixelRect const& none : {PixelRect{48, 0, 0, 4}, PixelRect{0, 32, 4, 0}, PixelRect{0, 30, 4, 3},
                                  PixelRect{46, 0, 3, 4}, PixelRect{0, -1, 4, 4}})
        EXPECT_TRUE(list(grid, 16, size, sun, none).faults.has(Fault::bad_region)) << none.x << ' ' << none.y;
}

TEST_F(Listing, TakesTheLargestGridAndNothingAfterAFault) {
    ShadowMap<float> const grid = sun_map(sun, V(0, 0, 0), 8.0f);
    StorageSize const size = storage_for(48, 32, 16);
    EXPECT_FALSE(list(grid, largest_grid, size, sun).faults.has(Fault::map_too_small));
    auto const without_light = list(grid, 16, size, directional(V(0)));
    EXPECT_FALSE(without_light.faults.has(Fault::bad_projection)) << "of no light a map is not judged";
    EXPECT_EQ(without_light.tile_count, 0);
    floor.frame.faults = Fault::bad_pose;
    EXPECT_EQ(list(grid, 16, size, sun).tile_count, 0);
}

// Four metres below a lamp that looks down; beside it w is less, if less of the floor is in the map.
TEST_F(Listing, LeavesOutWhatIsNearerThanTheMapsLeastW) {
    Light<float> const lamp = spot(V(0, 4, 0), V(0, -1, 0), 1.2f, 20.0f);
    ShadowMap<float> map;
    map.clip = gl_zero_to_one_clip;
    V const down = glm::normalize(V(0, -1, 0.5f));
    map.clip_from_world = clip_from_world(
        perspective_view<float>(pose_looking(lamp.position, down, V(0, 0, 1)), 2.0f, 1.0f, 0.1f, 30.0f), map.clip);
    StorageSize const size = storage_for(48, 32, 16);
    int last = 48 * 32 + 1;
    for (float const w_min : {-1.0f, 0.0f, 0.5f, 3.5f, 4.2f}) {
        // And of a matrix a fifth as large w is a fifth.
        map.w_min = w_min;
        ShadowMap<float> fifth = map;
        fifth.clip_from_world *= 0.2f;
        fifth.w_min = 0.2f * w_min;
        EXPECT_NEAR(list(fifth, 16, size, lamp).most_w, 0.2f * list(map, 16, size, lamp).most_w, 1e-5);
        EXPECT_NEAR(list(fifth, 16, size, lamp).least_w, 0.2f * list(map, 16, size, lamp).least_w, 1e-5);
        auto const buffer = list(map, 16, size, lamp);
        ASSERT_FALSE(buffer.faults.any());
        int alive = 0, above = 0, near_w_min = 0;
        float least_w = 1e9f, most_w = -1e9f;
        for (int pixel = 0; pixel < 48 * 32; ++pixel) {
            int const column = pixel % 48, row = pixel / 48;
            auto const quad = micro_quad(floor.frame, column, row, floor.depth[std::size_t(pixel)], floor.normal);
            float least = 1e9f, most = -1e9f;
            for (float const u : {0.0f, 1.0f})
                for (float const v : {0.0f, 1.0f}) {
                    float const w = glm::dot(down, point_on(floor.frame, quad, column, row, u, v) - lamp.position);
                    least = std::min(least, w), most = std::max(most, w);
                }
            above += least > std::max(w_min, 0.0f);
            near_w_min += std::abs(least - std::max(w_min, 0.0f)) < 1e-4f;
            if (least > std::max(w_min, 0.0f)) least_w = std::min(least_w, least), most_w = std::max(most_w, most);
        }
        for (int tile = 0; tile < buffer.tile_count; ++tile)
            for (std::uint32_t bits = buffer.state[tile * tile_words + alive_at]; bits != 0; bits &= bits - 1) ++alive;
        EXPECT_NEAR(alive, above, near_w_min) << w_min;
        EXPECT_LE(alive, last);
        EXPECT_NEAR(buffer.least_w, least_w, 1e-4);
        EXPECT_NEAR(buffer.most_w, most_w, 1e-4);
        last = alive;
    }
    EXPECT_GT(last, 50);
    EXPECT_LT(last, 1500);
}

TEST_F(Listing, KnowsTheWOfASunToTheLastBit) {
    for (float const w : {1.0f, 2.0f, 0.75f}) {
        ShadowMap<float> grid = sun_map(sun, V(0, 0, 0), 8.0f);
        grid.clip_from_world *= w;
        auto const buffer = list(grid, 16, storage_for(48, 32, 16), sun);
        ASSERT_FALSE(buffer.faults.any());
        EXPECT_NEAR(buffer.least_w, w, w == 1.0f ? 0.0f : 1e-5f);
        EXPECT_NEAR(buffer.most_w, w, w == 1.0f ? 0.0f : 1e-5f);
    }
    // Of a lamp w may be 1 where the eye is, and is not elsewhere.
    Light<float> const lamp = spot(V(0, 8, 4), V(0, -1, 0), 1.2f, 20.0f);
    ShadowMap<float> map;
    map.clip = gl_zero_to_one_clip;
    map.clip_from_world = clip_from_world(
        perspective_view<float>(pose_looking(lamp.position, V(0, -1, 0), V(0, 0, 1)), 2.0f, 1.0f, 0.5f, 30.0f),
        map.clip);
    map.clip_from_world *= 0.25f;
    auto const buffer = list(map, 16, storage_for(48, 32, 16), lamp);
    ASSERT_FALSE(buffer.faults.any());
    ASSERT_EQ(buffer.row[3].w, 1.0f);
    EXPECT_NEAR(buffer.least_w, 2.0f, 1e-4f);
}

TEST_F(Listing, WhatFacesAwayIsDarkInAllSamples) {
    Light<float> const from_below = directional(V(0.3f, 1.0f, 0.2f));
    auto const buffer = list(sun_map(from_below, V(0, 0, 0), 8.0f), 16, storage_for(48, 32, 16), from_below);
    ASSERT_FALSE(buffer.faults.any());
    EXPECT_EQ(buffer.counts.tiles, 0u);
    std::vector<std::uint32_t> masks(48 * 32, 1u);
    write_masks(buffer, masks.data());
    for (std::uint32_t const mask : masks) EXPECT_EQ(mask, every_sample);
}
