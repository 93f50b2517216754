// SPDX-License-Identifier: MIT
#include "tests/laws/region.hpp"
#include "tests/support/watched.hpp"
#include "tests/support/tolerance.hpp"

#include <shadowmath/region.hpp>
#include <shadowmath/view_volume.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <vector>

using namespace shadowmath;

namespace {

using V2 = glm::dvec2;
using V3 = glm::dvec3;
using V4 = glm::dvec4;

V3 ndc(glm::dmat4 const& m, V3 const& p) {
    V4 const at = m * V4(p, 1.0);
    return V3(at) / at.w;
}

}  // namespace

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
    EXPECT_FALSE(faults_of(Tile{56, 56, 8, 64, 64}).any());
    EXPECT_EQ(tile_matrix<float>(Tile{0, 0, 64, 64, 64}), glm::mat4(1.0f));
}

TEST(ProjectedBounds, AreThoseOfTheCornersWhenAllAreInFront) {
    ViewVolume<double> const view =
        perspective_view(pose_looking(V3(0.0), V3(0, 0, -1), V3(0, 1, 0)), 1.5707963267948966, 1.0, 1.0, 100.0);
    Aabb<double> const box{V3(-1, -2, -10), V3(3, 4, -5)};
    Aabb<double> const bounds = projected_bounds(clip_from_world(view, ClipSpace{}), corners(box), 1.0);
    EXPECT_NEAR(bounds.lo.x, -0.2, 1e-12);
    EXPECT_NEAR(bounds.hi.x, 0.6, 1e-12);
    EXPECT_NEAR(bounds.lo.y, -0.4, 1e-12);
    EXPECT_NEAR(bounds.hi.y, 0.8, 1e-12);
}

TEST(ProjectedBounds, CutTheBodyAtWMinBeforeTheyDivide) {
    ViewVolume<double> const view =
        perspective_view(pose_looking(V3(0.0), V3(0, 0, -1), V3(0, 1, 0)), 1.5707963267948966, 1.0, 1.0, 100.0);
    Aabb<double> const astride{V3(-1, -1, -10), V3(2, 1, 10)};
    Aabb<double> const bounds = projected_bounds(clip_from_world(view, ClipSpace{}), corners(astride), 0.5);
    EXPECT_NEAR(bounds.lo.x, -2.0, 1e-12);
    EXPECT_NEAR(bounds.hi.x, 4.0, 1e-12);
    Aabb<double> const behind{V3(-1, -1, 1), V3(1, 1, 10)};
    EXPECT_TRUE(is_empty(projected_bounds(clip_from_world(view, ClipSpace{}), corners(behind), 0.5)));
}

TEST(ProjectedBounds, OfABoxWithoutEndAreFinite) {
    ViewVolume<float> const view = perspective_view(
        pose_looking(glm::vec3(3, 2, 1), glm::vec3(1, 2, -1), glm::vec3(0, 1, 0)), 1.0f, 1.5f, 0.1f, 100.0f);
    float const most = std::numeric_limits<float>::max();
    Aabb<float> const all{glm::vec3(-most), glm::vec3(most)};
    for (float const w_min : {0.1f, 0.0f, -1.0f}) {
        Aabb<float> const bounds = projected_bounds(clip_from_world(view, ClipSpace{}), corners(all), w_min);
        EXPECT_TRUE(all_finite(bounds));
        EXPECT_FALSE(is_empty(bounds));
        EXPECT_LE(bounds.lo.x, -1.0f);
        EXPECT_GE(bounds.hi.y, 1.0f);
    }
}

TEST(ProjectedBounds, OfWhatIsNotFiniteAreEmpty) {
    float const nan = std::numeric_limits<float>::quiet_NaN();
    Aabb<float> const box{glm::vec3(-1.0f), glm::vec3(1.0f)};
    EXPECT_TRUE(is_empty(projected_bounds(glm::mat4(nan), corners(box), 0.1f)));
    EXPECT_TRUE(is_empty(projected_bounds(glm::mat4(0.0f), corners(box), 0.1f)));
    EXPECT_TRUE(is_empty(projected_bounds(glm::mat4(1.0f), corners(box), nan)));
    EXPECT_TRUE(is_empty(projected_bounds(glm::mat4(1.0f), corners(Aabb<float>{glm::vec3(nan), glm::vec3(1)}), 0.1f)));
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

TEST(ProjectedBounds, OfManyBoxesAreThoseOfEachMergedWhateverTheMatrix) {
    float const columns[6][3] = {{-1, 2, 5}, {-2, 0, 4}, {-9, -6, 7},
                                 {1, 3, 4},  {0, 1, 5},  {-5, -4, 8}};  // the last: none
    BoxArrays<float> const boxes{columns[0], columns[1], columns[2], columns[3], columns[4], columns[5]};
    glm::mat4 small(1.0f), perspective(1.0f), large(1.0f), behind(1.0f);
    perspective[2][3] = -1.0f;
    perspective[3][3] = 0.0f;
    large[0][0] = 1e16f;
    behind[3][3] = -1.0f;
    for (glm::mat4 const& matrix : {small, perspective, large, behind})
        for (float const w_min : {0.5f, 0.0f, 2.0f, -1.0f}) {
            Aabb<float> merged;
            for (int i = 0; i < 2; ++i) {
                auto const one = projected_bounds(matrix, corners(box_at(boxes, i)), w_min);
                if (!is_empty(one)) merged = merge(merged, one);
            }
            auto const all = projected_bounds(matrix, boxes, 3, w_min);
            ASSERT_EQ(is_empty(all), is_empty(merged)) << w_min;
            if (is_empty(all)) continue;
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_NEAR(all.lo[axis], merged.lo[axis], 1e-5f * std::abs(merged.lo[axis])) << w_min << ' ' << axis;
                EXPECT_NEAR(all.hi[axis], merged.hi[axis], 1e-5f * std::abs(merged.hi[axis])) << w_min << ' ' << axis;
            }
        }
    float const nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(is_empty(projected_bounds(glm::mat4(nan), boxes, 2, 0.5f)));
    EXPECT_TRUE(is_empty(projected_bounds(small, boxes, 2, nan)));
    EXPECT_TRUE(is_empty(projected_bounds(small, boxes, 0, 0.5f)));
    EXPECT_TRUE(is_empty(projected_bounds(small, boxes, -1, 0.5f)));
}

TEST(ProjectedBounds, OfBoxesWithCornersInTheEyesPlaneDivideNothingByZero) {
    // Some behind the eye up to its own plane, some astride of it, some in front.
    constexpr int count = 48;
    float columns[6][count];
    for (int i = 0; i < count; ++i) {
        float const lo[3] = {-1.0f, -2.0f, i % 3 == 0 ? 0.0f : -4.0f}, hi[3] = {1.0f, 2.0f, i % 3 == 2 ? -1.0f : 0.0f};
        for (int axis = 0; axis < 3; ++axis) columns[axis][i] = lo[axis], columns[axis + 3][i] = hi[axis];
        if (i % 3 == 0) columns[5][i] = 3.0f;
    }
    BoxArrays<float> const arrays{columns[0], columns[1], columns[2], columns[3], columns[4], columns[5]};
    glm::mat4 perspective(1.0f);
    perspective[2][3] = -1.0f;
    perspective[3][3] = 0.0f;
    auto const bounds = test::watched([&] { return projected_bounds(perspective, arrays, count, 0.5f); });
    EXPECT_TRUE(bounds.calm_in_range());
    EXPECT_EQ(bounds.result.hi.y, 4.0f);
}

TEST(ProjectedBounds, OfThousandsLeaveOutNoBoxThatReachesFartherThanThoseBefore) {
    // Around the axis of the view, every hundredth farther out than all before it; a few across the eye's plane.
    constexpr int count = 5003;
    std::vector<Aabb<float>> boxes;
    std::vector<float> columns[6];
    for (int i = 0; i < count; ++i) {
        float const turn = 0.7f * static_cast<float>(i), out = i % 100 == 99 ? 1e-3f * static_cast<float>(i) : 0.5f;
        glm::vec3 const centre(out * std::cos(turn), out * std::sin(turn), i % 997 == 996 ? 0.0f : -4.0f - out);
        glm::vec3 const half(0.01f, 0.02f, 0.3f);
        boxes.push_back({centre - half, centre + half});
        for (int axis = 0; axis < 3; ++axis) {
            columns[axis].push_back(boxes.back().lo[axis]);
            columns[axis + 3].push_back(boxes.back().hi[axis]);
        }
    }
    BoxArrays<float> const arrays{columns[0].data(), columns[1].data(), columns[2].data(),
                                  columns[3].data(), columns[4].data(), columns[5].data()};
    glm::mat4 perspective(1.0f);
    perspective[2][3] = -1.0f;
    perspective[3][3] = 0.0f;
    for (float const w_min : {0.1f, 1.0f, 4.5f})
        for (int const some : {1023, 1024, 1025, 2049, count}) {
            Aabb<float> const together = projected_bounds(perspective, arrays, some, w_min);
            EXPECT_TRUE(laws::are_the_merged_bounds(perspective, boxes.data(), some, w_min, together))
                << some << ' ' << w_min;
        }
}
