// SPDX-License-Identifier: MIT
#include "tests/laws/clipmap.hpp"

#include "tests/laws/shadow_map.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

using namespace shadowmath;

namespace {

using V3 = glm::dvec3;

LightBasis<double> const axes = light_basis(glm::normalize(V3(0.3, -0.9, 0.2)));

}  // namespace

TEST(Clipmap, DoublesItsTexelsFromLevelToLevel) {
    Clipmap<double> const map = clipmap(axes, V3(10, 20, 30), ClipmapOptions<double>{});
    ASSERT_EQ(map.count, 12);
    EXPECT_FALSE(map.faults.any());
    EXPECT_TRUE(laws::nests(map));
    EXPECT_EQ(map.level[0].texel_metres, 0x1p-8);
    EXPECT_EQ(map.level[11].texel_metres, 8.0);
}

TEST(Clipmap, MovesInWholePages) {
    ClipmapOptions<double> const options;
    Clipmap<double> const before = clipmap(axes, V3(0.0), options);
    // Half a metre is a page of 128 texels of level 0, and less than half of one from level 2 on.
    Clipmap<double> const after = clipmap(axes, axes.x * 0.5, options);
    EXPECT_EQ(after.level[0].x, before.level[0].x + 128);
    EXPECT_EQ(after.level[2].x, before.level[2].x);
    EXPECT_EQ(clip_from_world(after.level[3], 0.0, 9.0, gl_clip), clip_from_world(before.level[3], 0.0, 9.0, gl_clip));
}

TEST(Clipmap, NamesPagesWhereverTheCameraIs) {
    V3 const point(3.7, 1.2, -8.8);
    Clipmap<double> const here = clipmap(axes, V3(0.0), ClipmapOptions<double>{});
    Clipmap<double> const there = clipmap(axes, V3(900, 3, -70), ClipmapOptions<double>{});
    for (int level = 0; level < here.count; ++level)
        EXPECT_TRUE(page_at(here, level, point) == page_at(there, level, point));
}

TEST(Clipmap, GivesAMillionMetresAwayThePagesOfHere) {
    ClipmapOptions<double> options;
    V3 const far_away = axes.x * (0.5 * (1 << 21)) + axes.y * (-0.5 * (1 << 21));
    Page const here = page_at(clipmap(axes, V3(0.0), options), 0, V3(0.1, 0.2, 0.3));
    Page const there = page_at(clipmap(axes, far_away, options), 0, V3(0.1, 0.2, 0.3) + far_away);
    EXPECT_EQ(there.x - here.x, 1 << 21);
    EXPECT_EQ(there.y - here.y, -(1 << 21));
}

TEST(Page, IsAnotherOneAsSoonAsOneNumberDiffers) {
    Page const page{1, 2, 3};
    EXPECT_TRUE(page == (Page{1, 2, 3}));
    EXPECT_FALSE(page == (Page{2, 2, 3}));
    EXPECT_FALSE(page == (Page{1, 9, 3}));
    EXPECT_FALSE(page == (Page{1, 2, 9}));
}

TEST(PageAt, IsNoneOfALevelThatIsNotThereAndBeyondWhatCanBeCounted) {
    ClipmapOptions<double> options;
    options.levels = 3;
    Clipmap<double> const map = clipmap(LightBasis<double>{}, V3(0.0), options);
    for (int const level : {-1, 3, max_clip_levels}) {
        EXPECT_EQ(page_at(map, level, V3(0.0)).level, -1) << level;
        EXPECT_FALSE(holds(map, Page{level, 0, 0})) << level;
    }
    EXPECT_EQ(page_at(map, 0, V3(std::numeric_limits<double>::quiet_NaN())).level, -1);
    EXPECT_EQ(page_at(map, 0, V3(1e300, 0, 0)).level, -1);
    EXPECT_EQ(page_at(map, 0, V3(0, 0, 1e300)).level, -1);
}

TEST(PageFor, TakesTheTexelThatAPixelCanTell) {
    Clipmap<double> const map = clipmap(axes, V3(0.0), ClipmapOptions<double>{});
    EXPECT_EQ(page_for(map, V3(0.0), 0x1p-8).level, 0);
    EXPECT_EQ(page_for(map, V3(0.0), 0x1.ffp-8).level, 0);
    EXPECT_EQ(page_for(map, V3(0.0), 0x1p-7).level, 1);
    EXPECT_EQ(page_for(map, V3(0.0), 1.0).level, 8);
    // Level 0 reaches 8 m to either side.
    EXPECT_EQ(page_for(map, axes.x * 7.9, 1e-6).level, 0);
    EXPECT_EQ(page_for(map, axes.x * 8.1, 1e-6).level, 1);
    EXPECT_EQ(page_for(map, axes.x * 8.1, 1e-6, 17).level, -1);
    for (double const side : {-7.9, 7.9})
        for (V3 const& axis : {axes.x, axes.y}) EXPECT_EQ(page_for(map, axis * side, 1e-6, 1).level, 1) << side;
    EXPECT_EQ(page_for(map, axes.x * 1e9, 1.0).level, -1);
    EXPECT_EQ(page_for(map, V3(0.0), std::numeric_limits<double>::quiet_NaN()).level, -1);
    EXPECT_EQ(page_for(map, V3(std::numeric_limits<double>::infinity()), 1.0).level, -1);
}

TEST(PixelMetres, GrowWithDepthUnlessTheViewIsOrthographic) {
    ViewVolume<double> view = perspective_view(Pose<double>{}, 1.0, 1.6, 0.1, 100.0);
    EXPECT_NEAR(pixel_metres(view, 1000.0, 10.0), 20.0 * std::tan(0.5) / 1000.0, 1e-15);
    view.kind = ViewKind::orthographic;
    EXPECT_NEAR(pixel_metres(view, 1000.0, 10.0), 2.0 * std::tan(0.5) / 1000.0, 1e-15);
}

TEST(Clipmap, ClampsItsOptions) {
    ClipmapOptions<double> odd;
    odd.levels = 99;
    odd.map_size = 1000;
    Clipmap<double> const map = clipmap(axes, V3(0.0), odd);
    EXPECT_TRUE(map.faults.has(Fault::clamped_option));
    EXPECT_EQ(map.count, max_clip_levels);
    EXPECT_EQ(map.level[0].map_size, 896);
    for (auto const& [option, value] :
         {std::pair(&ClipmapOptions<double>::levels, 0), std::pair(&ClipmapOptions<double>::map_size, 1000),
          std::pair(&ClipmapOptions<double>::page_texels, 0)}) {
        ClipmapOptions<double> one;
        one.*option = value;
        EXPECT_TRUE(clipmap(axes, V3(0.0), one).faults.has(Fault::clamped_option)) << value;
    }
    odd.finest_metres = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(clipmap(axes, V3(0.0), odd).count, 0);
    odd.page_texels = 0;
    odd.map_size = 0;
    EXPECT_EQ(clipmap(axes, V3(0.0), odd).count, 0);
}

TEST(Clipmap, SaysInFloatWhenItsFinestLevelsCannotBeStill) {
    auto const axes_f = light_basis(glm::vec3(0, -1, 0));
    EXPECT_FALSE(clipmap(axes_f, glm::vec3(0.0f), ClipmapOptions<float>{}).faults.any());
    EXPECT_TRUE(clipmap(axes_f, glm::vec3(1e4f, 0, 0), ClipmapOptions<float>{}).faults.has(Fault::precision_lost));
}
