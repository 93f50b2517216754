// SPDX-License-Identifier: MIT
//
// Which triangles of a mesh are looked at, a block at a time, and in which order: that of the lists that they begin in.
#include "tests/support/traced.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

using V = Vec3<float>;
using Lanes = BestLanes<float>;

struct TraceOrder : ::testing::Test {
    static constexpr int width = 37, height = 22;

    std::mt19937 bits{20021201};
    ViewVolume<float> eye =
        perspective_view<float>(pose_looking(V(0, 4, 4), V(0, -1, -1), V(0, 1, 0)), 0.8f, 1.6f, 0.1f, 100.0f);
    PlanePicture<float> floor = picture_of_plane(eye, width, height, V(0, 0, 0), V(0, 1, 0));
    Light<float> sun = directional(V(0.3f, -1.0f, 0.2f));
    std::vector<float> scalars;
    std::vector<std::uint32_t> words;

    int in(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(bits); }
    float in(float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(bits); }

    IrregularBuffer<float> listed(int map_size, float w = 1.0f) {
        StorageSize const size = storage_for(width, height, map_size);
        scalars.assign(size.scalars, -77.0f);
        words.assign(size.words, 0xabadcafeu);
        Receivers<float> receivers;
        receivers.depth = floor.depth.data();
        receivers.normal = floor.normals.data();
        ShadowMap<float> grid = sun_map(sun, V(0, 0, 0), 8.0f);
        grid.clip_from_world *= w;
        auto const buffer =
            list_receivers(floor.frame, receivers, sun, grid, map_size, {scalars.data(), words.data(), size});
        EXPECT_FALSE(buffer.faults.any()) << describe(buffer.faults);
        return buffer;
    }
    std::vector<Triangle<float>> mesh(std::size_t count, float size) {
        std::vector<Triangle<float>> made;
        for (std::size_t i = 0; i < count; ++i) {
            V const at(in(-3.0f, 3.0f), in(0.5f, 2.0f), in(-3.0f, 2.0f));
            auto const beside = [&] { return at + V(in(-size, size), in(-size, size), in(-size, size)); };
            made.push_back({at, beside(), beside()});
        }
        return made;
    }
    static Casters<float> casters_of(std::vector<Triangle<float>> const& mesh) {
        Casters<float> casters;
        casters.position = &mesh[0][0].x;
        casters.stride = static_cast<int>(sizeof(V) / sizeof(float));
        casters.vertex_count = static_cast<std::uint32_t>(3 * mesh.size());
        casters.triangle_count = static_cast<std::uint32_t>(mesh.size());
        return casters;
    }
    static std::vector<std::uint32_t> masks_of(IrregularBuffer<float> const& buffer) {
        std::vector<std::uint32_t> masks(width * height);
        write_masks(buffer, masks.data());
        return masks;
    }
    // One at a time.
    std::vector<std::uint32_t> slowly(std::vector<std::vector<Triangle<float>>> const& meshes, int map_size) {
        auto buffer = listed(map_size);
        for (auto const& mesh : meshes)
            for (Triangle<float> const& one : mesh) trace(buffer, casters_of({one}));
        return masks_of(buffer);
    }
};

// The narrowest list that is no narrower than the triangle, of those that hold where it begins.
std::uint32_t slow_list(IrregularBuffer<float> const& buffer, detail::PlaceRange const& places) {
    int const extent = std::max(places.x1 - places.x0, places.y1 - places.y0);
    int level = 0;
    for (int side = 32; side < extent && level + 1 < buffer.level_count; side *= 4) ++level;
    if (level > 0) {
        int const side = 32 << 2 * level, across = (buffer.map_size - 1) / (side / 32) + 1;
        return buffer.level_first[level] + std::uint32_t(places.y0 / side * across + places.x0 / side);
    }
    int const texel = places.y0 / 32 * buffer.map_size + places.x0 / 32;
    int const divisions = 1 << buffer.texel_division[texel], side = 32 / divisions;
    if (extent > side) return buffer.texel_lists[texel];
    return buffer.texel_lists[texel] + 1u + std::uint32_t(places.y0 % 32 / side * divisions + places.x0 % 32 / side);
}

}  // namespace

TEST_F(TraceOrder, ATriangleBeginsInTheNarrowestListThatIsNoNarrowerThanIt) {
    for (int const map_size : {1, 3, 16, 64, 70}) {
        auto const texels = std::size_t(map_size * map_size);
        std::vector<std::uint32_t> division(texels), lists(texels);
        IrregularBuffer<float> buffer;
        buffer.map_size = map_size;
        buffer.texel_division = division.data();
        buffer.texel_lists = lists.data();
        std::uint32_t count = 0;
        for (std::size_t i = 0; i < texels; ++i) {
            division[i] = std::uint32_t(in(0, 5));
            lists[i] = count;
            count += 1u + (1u << 2 * division[i]);
        }
        for (int side = 0; side != 1;) {
            side = level_size(map_size, buffer.level_count);
            buffer.level_first[buffer.level_count++] = count;
            count += std::uint32_t(side * side);
        }
        Casters<float> const none;
        PixelFrame<double> const frame;
        detail::TraceKernel<Lanes> const kernel{buffer, {buffer, none, frame, {}, 1.0f}, {buffer, frame}};
        int const last = 32 * map_size - 1;
        for (int i = 0; i < 3000; ++i) {
            int const x = in(0, last), y = in(0, last);
            // As often as not just as wide as a list.
            int const wide = i % 2 == 0 ? 1 << in(0, 11) : in(0, last), high = i % 3 == 0 ? 1 << in(0, 11) : in(0, 3);
            detail::PlaceRange const places{x, std::min(x + wide, last), y, std::min(y + high, last)};
            int const extent = std::max(places.x1 - places.x0, places.y1 - places.y0);
            EXPECT_EQ(kernel.list_of(places, extent), slow_list(buffer, places)) << map_size << ' ' << extent;
        }
    }
}

TEST_F(TraceOrder, KeepsWhatMayTouchANodeWithTheListThatItBeginsIn) {
    for (int const map_size : {1, 5, 64})
        for (float const size : {0.05f, 0.5f, 6.0f}) {
            auto buffer = listed(map_size);
            auto const triangles = mesh(300, size);
            Casters<float> const casters = casters_of(triangles);
            PixelFrame<double> const frame = frame_in<double>(buffer.frame);
            detail::CasterKernel<Lanes> const loader{buffer, casters, frame, pixel_light(frame, buffer.source), 0.999f};
            detail::TraceKernel<Lanes> const kernel{buffer, loader, {buffer, frame}};
            std::fill(buffer.caster_end, buffer.caster_end + buffer.list_count + 1, 0u);
            detail::CasterBatch<Lanes> batch{}, one{};
            std::uint32_t kept = 0;
            EXPECT_EQ(kernel.keep(20, 250, batch, kept), 250u);
            std::uint32_t wanted = 0;
            std::vector<std::uint32_t> ends(buffer.list_count + 1);
            for (std::uint32_t triangle = 20; triangle < 270; ++triangle) {
                loader.load(triangle, 1, nullptr, one);
                if ((one.sound & 1u) == 0) continue;
                float const bounds[4] = {one.bounds[0][0], one.bounds[1][0], one.bounds[2][0], one.bounds[3][0]};
                auto const places = detail::places_of(bounds, map_size);
                bool const in_block = std::max(places.x1 - places.x0, places.y1 - places.y0) <= 32;
                int const texel = places.y0 / 32 * map_size + places.x0 / 32;
                if (in_block && buffer.block_depth[texel] < one.depth[0]) continue;
                ASSERT_LT(wanted, kept);
                EXPECT_EQ(buffer.caster[wanted], triangle);
                EXPECT_EQ(buffer.caster_list[wanted], slow_list(buffer, places));
                ++ends[slow_list(buffer, places) + 1];
                ++wanted;
            }
            EXPECT_EQ(kept, wanted);
            EXPECT_TRUE(std::equal(ends.begin(), ends.end(), buffer.caster_end));
            kernel.sort(kept);
            for (std::uint32_t i = 0, list = 0; i < kept; ++i) {
                while (i >= buffer.caster_end[list]) ++list;
                auto const at = std::find(buffer.caster, buffer.caster + kept, buffer.caster_order[i]) - buffer.caster;
                ASSERT_LT(at, std::ptrdiff_t(kept));
                EXPECT_EQ(buffer.caster_list[at], list);
            }
        }
}

// Some of a mesh, after all of another: whatever order the other one left behind.
TEST_F(TraceOrder, ARangeOfTrianglesIsThatRangeAndNoMore) {
    auto const before = mesh(1200, 0.1f), triangles = mesh(3000, 0.05f);
    struct Row {
        std::uint32_t first, count, end;
    };
    for (Row const& row : {Row{0, 20, 20}, Row{7, 33, 40}, Row{0, 1500, 1500}, Row{2990, 0, 3000},
                           Row{2000, 5000, 3000}, Row{100, 1024, 1124}, Row{3000, 0, 3000}}) {
        auto buffer = listed(16);
        trace(buffer, casters_of(before));
        trace(buffer, casters_of(triangles), row.first, row.count);
        std::vector<Triangle<float>> const range(triangles.begin() + row.first, triangles.begin() + row.end);
        EXPECT_EQ(masks_of(buffer), slowly({before, range}, 16)) << row.first;
    }
}

TEST_F(TraceOrder, VerticesBeyondTheLastTriangleAreNone) {
    auto const triangles = mesh(40, 2.0f);
    Casters<float> casters = casters_of(triangles);
    casters.triangle_count = 12;
    auto buffer = listed(16);
    trace(buffer, casters, 5);
    EXPECT_EQ(masks_of(buffer), slowly({{triangles.begin() + 5, triangles.begin() + 12}}, 16));
}

TEST_F(TraceOrder, TheSizeOfTheMatrixDoesNotMatter) {
    auto const triangles = mesh(100, 1.0f);
    auto const wanted = slowly({triangles}, 16);
    for (float const w : {0.25f, 0.5f, 4.0f}) {
        auto buffer = listed(16, w);
        trace(buffer, casters_of(triangles));
        EXPECT_EQ(masks_of(buffer), wanted) << w;
    }
}
