// SPDX-License-Identifier: MIT
#include "tests/laws/region.hpp"
#include "tests/support/tolerance.hpp"
#include "tests/support/town.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/region.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace shadowmath;
using namespace shadowmath::test;

TEST(Region, OfTheWholeMapIsTheIdentity) {
    EXPECT_EQ(region_matrix(Region<float>{}), glm::mat4(1.0f));
    EXPECT_EQ(region_matrix(Region<double>{}), glm::dmat4(1.0));
}

TEST(Region, FillsTheMapAndLeavesDepthAndWAlone) {
    EXPECT_TRUE(laws::fills_the_map(Region<double>{V2(-0.25, 0.5), V2(0.75, 0.625)}));
    EXPECT_TRUE(laws::fills_the_map(Region<float>{{-7.0f, -3.0f}, {-6.0f, 11.0f}}));
    glm::dmat4 const m = region_matrix(Region<double>{V2(-0.25, 0.5), V2(0.75, 0.625)});
    EXPECT_EQ(m * V4(0.3, 0.6, 0.4, 2.0), V4((0.3 - 0.25 * 2) * 2, (0.6 - 0.5625 * 2) * 16, 0.4, 2.0));
}

TEST(Region, ScalesYByItsOwnHeightUnlikeTheThesisPrintsIt) {
    glm::dmat4 const m = region_matrix(Region<double>{V2(0.0, -1.0), V2(0.5, 1.0)});
    EXPECT_EQ(ndc(m, V3(0.5, 1.0, 0.0)), V3(1.0, 1.0, 0.0));
}

TEST(Region, OfARegionIsTheirProduct) {
    Region<double> const outer{V2(-0.5, -0.5), V2(0.5, 1.0)}, inner{V2(0.0, -1.0), V2(1.0, 0.0)};
    // `inner` counts in the NDC that `outer` made.
    Region<double> const both{V2(0.0, -0.5), V2(0.5, 0.25)};
    glm::dmat4 const product = region_matrix(inner) * region_matrix(outer), direct = region_matrix(both);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) EXPECT_NEAR(product[c][r], direct[c][r], test::tolerance(4.0, 8));
}

TEST(Region, WhoseScaleWouldNotBeFiniteIsTheIdentity) {
    constexpr float least = std::numeric_limits<float>::denorm_min(), most = std::numeric_limits<float>::max();
    EXPECT_EQ(region_matrix(Region<float>{glm::vec2(0), glm::vec2(least)}), glm::mat4(1.0f));
    EXPECT_EQ(region_matrix(Region<float>{glm::vec2(-most), glm::vec2(most)}), glm::mat4(1.0f));
    EXPECT_EQ(region_matrix(Region<float>{glm::vec2(most * 0.9f), glm::vec2(most)}), glm::mat4(1.0f));
}

TEST(Region, WithoutAreaOrNotFiniteIsTheIdentity) {
    double const nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    for (Region<double> const& bad : {Region<double>{V2(0.5, 0.0), V2(0.5, 1.0)}, Region<double>{V2(1.0), V2(-1.0)},
                                      Region<double>{V2(nan, 0.0), V2(1.0)}, Region<double>{V2(-inf), V2(inf)}})
        EXPECT_EQ(region_matrix(bad), glm::dmat4(1.0));
}

TEST(Region, ThatIsNotFiniteOnOneSideAloneRaisesNoFlag) {
    double const inf = std::numeric_limits<double>::infinity();
    for (Region<double> const& bad : {Region<double>{V2(-inf, 0.0), V2(1.0)}, Region<double>{V2(0.0), V2(1.0, inf)}}) {
        auto const run = test::watched([&] { return region_matrix(bad); });
        EXPECT_EQ(run.result, glm::dmat4(1.0));
        EXPECT_TRUE(run.calm_in_range());
    }
}

TEST(Region, OfTwoRegionsIsWhatLiesInBoth) {
    Region<double> const both = intersect(Region<double>{V2(-1, 0), V2(3, 2)}, Region<double>{V2(0, -1), V2(4, 1)});
    EXPECT_EQ(both.lo, V2(0, 0));
    EXPECT_EQ(both.hi, V2(3, 1));
    EXPECT_TRUE(is_empty(intersect(Region<double>{V2(0), V2(1)}, Region<double>{V2(2), V2(3)})));
}

TEST(Region, IsWidenedAboutItsCentreAndOnlyWhereItIsThin) {
    Region<double> const thin = widened(Region<double>{V2(0.25, -1.0), V2(0.25, 1.0)}, 2.0 / 1024.0);
    EXPECT_DOUBLE_EQ(thin.hi.x - thin.lo.x, 2.0 / 1024.0);
    EXPECT_DOUBLE_EQ(thin.hi.x + thin.lo.x, 0.5);
    EXPECT_EQ(thin.lo.y, -1.0);
    EXPECT_EQ(thin.hi.y, 1.0);
}

TEST(Region, KeepsItsMarginInTexelsOfTheMap) {
    Region<double> const used{V2(-0.5, 0.0), V2(0.25, 0.125)};
    glm::dmat4 const m = region_matrix(with_margin(used, 64, 3.0));
    // The used part ends three texels of 2 / 64 before the border.
    EXPECT_NEAR(ndc(m, V3(used.lo, 0.0)).x, -1.0 + 3 * 2.0 / 64.0, test::tolerance(4.0, 8));
    EXPECT_NEAR(ndc(m, V3(used.hi, 0.0)).y, 1.0 - 3 * 2.0 / 64.0, test::tolerance(4.0, 8));
}

TEST(Tile, TakesTheMapToItsTexelsOfTheAtlasInEveryConvention) {
    Tile const tile{512, 256, 256, 1024, 2048};
    for (ClipSpace const clip : {gl_clip, gl_zero_to_one_clip, vulkan_clip, d3d_clip, reversed(d3d_clip)}) {
        glm::dmat4 const texture = texture_from_clip<double>(clip) * tile_matrix<double>(tile, clip);
        glm::dmat4 const alone = texture_from_clip<double>(clip);
        for (V3 const& corner : {V3(-1, -1, 0.5), V3(1, -1, 0.5), V3(-1, 1, 0.5), V3(1, 1, 0.5), V3(0.5, 0.25, 0)}) {
            V3 const in_map = ndc(alone, corner), in_atlas = ndc(texture, corner);
            EXPECT_DOUBLE_EQ(in_atlas.x * 1024, 512 + 256 * in_map.x);
            EXPECT_DOUBLE_EQ(in_atlas.y * 2048, 256 + 256 * in_map.y);
            EXPECT_EQ(in_atlas.z, in_map.z);
        }
    }
}

TEST(Tile, WithoutAreaOrOutsideItsAtlasIsBadRegionAndTheIdentity) {
    int const most = std::numeric_limits<int>::max(), least = std::numeric_limits<int>::lowest();
    for (Tile const& bad : {Tile{}, Tile{0, 0, 0, 64, 64}, Tile{0, 0, -1, 64, 64}, Tile{-1, 0, 8, 64, 64},
                            Tile{60, 0, 8, 64, 64}, Tile{0, 57, 8, 64, 64}, Tile{most, 0, most, most, most},
                            Tile{0, 0, most, 64, 64}, Tile{0, 0, 8, 0, 64}, Tile{least, least, least, least, least}}) {
        EXPECT_TRUE(faults_of(bad).has(Fault::bad_region));
        EXPECT_EQ(tile_matrix<float>(bad), glm::mat4(1.0f));
    }
    for (Tile const& good :
         {Tile{56, 56, 8, 64, 64}, Tile{0, 0, 64, 64, 64}, Tile{0, 3, 8, 64, 64}, Tile{3, 0, 8, 64, 64}})
        EXPECT_FALSE(faults_of(good).any());
    EXPECT_EQ(tile_matrix<float>(Tile{0, 0, 64, 64, 64}), glm::mat4(1.0f));
}

TEST(Region, OfBoundsIsTheirTwoSides) {
    Region<double> const region = region_of(Aabb<double>{Vec3<double>(-0.5, 0.25, -9.0), Vec3<double>(0.75, 1.0, 9.0)});
    EXPECT_EQ(region.lo, Vec2<double>(-0.5, 0.25));
    EXPECT_EQ(region.hi, Vec2<double>(0.75, 1.0));
}

TEST(Region, IsEmptyAsSoonAsOneAxisHasNoLength) {
    EXPECT_FALSE(is_empty(Region<double>{Vec2<double>(0.0), Vec2<double>(1.0)}));
    EXPECT_TRUE(is_empty(Region<double>{Vec2<double>(0.0), Vec2<double>(0.0, 1.0)}));
    EXPECT_TRUE(is_empty(Region<double>{Vec2<double>(0.0), Vec2<double>(1.0, 0.0)}));
    for (int end = 0; end < 2; ++end) {
        Region<double> bad{Vec2<double>(0.0), Vec2<double>(1.0)};
        (end == 0 ? bad.lo : bad.hi).y = std::numeric_limits<double>::quiet_NaN();
        EXPECT_EQ(region_matrix(bad), Mat4<double>(1.0));
    }
}

TEST(Tile, IsBadWhicheverOfItsNumbersIs) {
    Tile const good{4, 4, 8, 32, 16};
    EXPECT_FALSE(faults_of(good).any());
    for (int Tile::*number : {&Tile::x, &Tile::y, &Tile::size, &Tile::atlas_width, &Tile::atlas_height}) {
        Tile bad = good;
        bad.*number = -1;
        EXPECT_TRUE(faults_of(bad).has(Fault::bad_region));
    }
    for (int Tile::*place : {&Tile::x, &Tile::y}) {
        Tile beyond = good;
        beyond.*place = 25;
        EXPECT_TRUE(faults_of(beyond).has(Fault::bad_region));
    }
}
