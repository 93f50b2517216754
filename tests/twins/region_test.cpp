// SPDX-License-Identifier: MIT
#include "tests/twins/twin.hpp"

#include <shadowmath/region.hpp>

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class RegionTwins : public Twins {};
INSTANTIATE_TEST_SUITE_P(Drivers, RegionTwins, twin_drivers, driver_name);

constexpr auto& shader = shaders::region_comp;

// One in eight has no length on an axis, one in eight is crossed.
Region<float> region(Draw& draw) {
    Region<float> drawn;
    for (int axis = 0; axis < 2; ++axis) {
        float const lo = draw.uniform(-1.5f, 1.0f), length = draw.uniform(0.0f, 1.0f);
        drawn.lo[axis] = draw.spoilt(lo);
        drawn.hi[axis] = draw.one_in(8) ? drawn.lo[axis] : draw.spoilt(draw.one_in(8) ? lo - length : lo + length);
    }
    return drawn;
}
void give(Words& words, Region<float> const& region) {
    words(region.lo)(region.hi);
}

TEST_P(RegionTwins, IsEmpty) {
    prove({"is_empty", shader, 0, 2}, [](Draw& draw, Words& given, Words& expected) {
        auto const drawn = region(draw);
        give(given, drawn);
        expected(is_empty(drawn));
    });
}

// Of numbers: which of a number and NaN is the less, no two drivers agree on.
TEST_P(RegionTwins, Intersect) {
    prove({"intersect", shader, 1}, [](Draw& draw, Words& given, Words& expected) {
        auto a = region(draw), b = region(draw);
        for (float* number : {&a.lo.x, &a.lo.y, &a.hi.x, &a.hi.y, &b.lo.x, &b.lo.y, &b.hi.x, &b.hi.y})
            if (std::isnan(*number)) *number = 0.5f;
        give(given, a);
        give(given, b);
        give(expected, intersect(a, b));
    });
}

TEST_P(RegionTwins, Widened) {
    prove({"widened", shader, 2}, [](Draw& draw, Words& given, Words& expected) {
        auto const drawn = region(draw);
        float const least = draw.spoilt(draw.log_uniform(1e-4f, 1.0f));
        give(given, drawn);
        given(least);
        give(expected, widened(drawn, least));
    });
}

TEST_P(RegionTwins, WithMargin) {
    prove({"with_margin", shader, 3}, [](Draw& draw, Words& given, Words& expected) {
        auto const drawn = region(draw);
        int const size = 1 << draw.whole(3, 13);
        float const margin = draw.spoilt(draw.uniform(0.0f, 3.9f));
        give(given, drawn);
        given(size)(margin);
        give(expected, with_margin(drawn, size, margin));
    });
}

TEST_P(RegionTwins, RegionMatrix) {
    prove({"region_matrix", shader, 4}, [](Draw& draw, Words& given, Words& expected) {
        auto const drawn = region(draw);
        give(given, drawn);
        expected(region_matrix(drawn));
    });
}

TEST_P(RegionTwins, TileMatrix) {
    prove({"tile_matrix", shader, 5}, [](Draw& draw, Words& given, Words& expected) {
        constexpr int most = std::numeric_limits<int>::max();
        auto const whole = [&draw](int lo, int hi) {
            return draw.one_in(24) ? (draw.one_in(2) ? most : -most - 1) : draw.whole(lo, hi);
        };
        int const size = whole(0, 1024), width = whole(1024, 8192), height = whole(1024, 8192);
        Tile const tile{whole(-50, 6000), whole(-50, 6000), size, width, height};
        ClipSpace const clip = draw.clip_space();
        given(tile.x)(tile.y)(tile.size)(tile.atlas_width)(tile.atlas_height)(clip.ndc_y != clip.texture_v);
        expected(!faults_of(tile).any())(tile_matrix<float>(tile, clip));
    });
}

TEST_P(RegionTwins, ScaleAndMove) {
    prove({"scale_and_move", shader, 6}, [](Draw& draw, Words& given, Words& expected) {
        Vec2<float> const scale(draw.number(10.0f), draw.number(10.0f)), offset(draw.number(10.0f), draw.number(10.0f));
        given(scale)(offset);
        expected(from_rows(Vec4<float>(scale.x, 0.0f, 0.0f, offset.x), Vec4<float>(0.0f, scale.y, 0.0f, offset.y),
                           Vec4<float>(0.0f, 0.0f, 1.0f, 0.0f), Vec4<float>(0.0f, 0.0f, 0.0f, 1.0f)));
    });
}

}  // namespace
