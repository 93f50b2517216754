// SPDX-License-Identifier: MIT
#include "tests/laws/culling.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/culling.hpp>
#include <shadowmath/light_box.hpp>

#include <gtest/gtest.h>

#include <vector>

using namespace shadowmath;

namespace {

using V3 = glm::dvec3;

// The sun overhead; world x is the map's x, world -z its y, world -y its depth: from 20 m above the ground to it.
ShadowMap<double> square(double half, ClipSpace clip = gl_clip) {
    LightBox<double> box;
    box.lo = glm::dvec2(-half);
    box.hi = glm::dvec2(half);
    box.depth_lo = -20;
    box.depth_hi = 0;
    ShadowMap<double> map;
    map.clip_from_world = clip_from_world(box, clip);
    map.clip = clip;
    map.visible = true;
    return map;
}

CasterMaps<double> three_squares(ClipSpace clip = gl_clip) {
    ShadowMap<double> const maps[] = {square(1, clip), square(4, clip), square(16, clip)};
    return caster_maps(maps, 3);
}

Aabb<double> cube(V3 const& centre, double half = 0.5) {
    return {centre - half, centre + half};
}

}  // namespace

TEST(CasterMask, HasTheBitsOfTheMapsThatTheBoxReachesInto) {
    for (ClipSpace const clip : {gl_clip, gl_zero_to_one_clip, vulkan_clip, d3d_clip, reversed(d3d_clip)}) {
        CasterMaps<double> const maps = three_squares(clip);
        EXPECT_EQ(caster_mask(maps, cube(V3(0, 5, 0))), 0b111);
        EXPECT_EQ(caster_mask(maps, cube(V3(2, 5, 0))), 0b110);
        EXPECT_EQ(caster_mask(maps, cube(V3(2, 5, -10))), 0b100);
        EXPECT_EQ(caster_mask(maps, cube(V3(2, 5, 17))), 0);
        EXPECT_EQ(caster_mask(maps, cube(V3(1.4999, 5, 0))), 0b111);
        EXPECT_EQ(caster_mask(maps, cube(V3(1.5001, 5, 0))), 0b110);
    }
}

TEST(CasterMask, CountsWhatStandsAboveTheNearEndAndNotWhatLiesBehindTheFarOne) {
    for (ClipSpace const clip : {gl_clip, d3d_clip, reversed(d3d_clip)}) {
        EXPECT_EQ(caster_mask(three_squares(clip), cube(V3(0, 1e6, 0))), 0b111);
        EXPECT_EQ(caster_mask(three_squares(clip), cube(V3(0, -0.4999, 0))), 0b111);
        EXPECT_EQ(caster_mask(three_squares(clip), cube(V3(0, -0.5001, 0))), 0);
    }
}

TEST(CasterMask, OfASphereIsThatOfTheBall) {
    CasterMaps<double> const maps = three_squares();
    EXPECT_EQ(caster_mask(maps, Sphere<double>{V3(1.4999, 5, 0), 0.5}), 0b111);
    EXPECT_EQ(caster_mask(maps, Sphere<double>{V3(1.5001, 5, 0), 0.5}), 0b110);
    EXPECT_EQ(caster_mask(maps, Sphere<double>{V3(0, -0.5001, 0), 0.5}), 0);
    EXPECT_EQ(caster_mask(maps, Sphere<double>{V3(0, 5, 0), 0.0}), 0b111);
    EXPECT_EQ(caster_mask(maps, Sphere<double>{V3(0, 5, 0), -1.0}), 0);
    double const nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(caster_mask(maps, Sphere<double>{V3(nan, 5, 900), 0.5}), 0b111);
    EXPECT_EQ(caster_mask(maps, Sphere<double>{V3(900, 5, 0), nan}), 0b111);
}

TEST(CasterMask, OfASphereIsThatOfTheBallUnderAnyLight) {
    for (V3 const& travel : {V3(1, -1, 1), V3(0.3, -1, 0.2), V3(-1, -0.2, 0.5), V3(0.1, 0.9, -0.7)}) {
        LightBox<double> box;
        box.basis = light_basis(glm::normalize(travel));
        box.lo = glm::dvec2(-4), box.hi = glm::dvec2(4);
        box.depth_lo = -20, box.depth_hi = 0;
        ShadowMap<double> map;
        map.clip_from_world = clip_from_world(box, gl_clip);
        map.visible = true;
        CasterMaps<double> const maps = caster_maps(&map, 1);
        V3 const middle = box.basis.depth * -10.0;
        for (V3 const& aside : {box.basis.x, -box.basis.x, box.basis.y, -box.basis.y}) {
            EXPECT_EQ(caster_mask(maps, Sphere<double>{middle + aside * 6.999, 3.0}), 1);
            EXPECT_EQ(caster_mask(maps, Sphere<double>{middle + aside * 7.001, 3.0}), 0);
        }
        EXPECT_EQ(caster_mask(maps, Sphere<double>{box.basis.depth * 2.999, 3.0}), 1);
        EXPECT_EQ(caster_mask(maps, Sphere<double>{box.basis.depth * 3.001, 3.0}), 0);
    }
}

TEST(CasterMask, OfASpotKnowsTheConeAndThePlaneThroughTheLamp) {
    // At (0, 10, 0), looking down, 90 degrees wide.
    ViewVolume<double> const view =
        perspective_view(pose_looking(V3(0, 10, 0), V3(0, -1, 0), V3(0, 0, -1)), 1.5707963267948966, 1.0, 1.0, 10.0);
    ShadowMap<double> map;
    map.clip_from_world = clip_from_world(view, gl_clip);
    map.visible = true;
    map.clip = gl_clip;
    CasterMaps<double> const maps = caster_maps(&map, 1);
    EXPECT_EQ(caster_mask(maps, cube(V3(4, 5, 0))), 1);
    EXPECT_EQ(caster_mask(maps, cube(V3(6.1, 5, 0))), 0);
    EXPECT_EQ(caster_mask(maps, cube(V3(0, 9.5, 0), 0.1)), 1) << "between the lamp and the near plane";
    EXPECT_EQ(caster_mask(maps, cube(V3(0, 12, 0))), 0) << "behind the lamp";
    EXPECT_EQ(caster_mask(maps, cube(V3(0, 11, 0), 2)), 1) << "around the lamp";
    EXPECT_EQ(caster_mask(maps, cube(V3(0, -1, 0))), 0) << "behind the far end";
}

TEST(CasterMask, OfAnEmptyBoxIsNothingAndOfABrokenOneEverything) {
    CasterMaps<double> const maps = three_squares();
    double const nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    double const most = std::numeric_limits<double>::max();
    EXPECT_EQ(caster_mask(maps, Aabb<double>{}), 0);
    EXPECT_EQ(caster_mask(maps, Aabb<double>{V3(inf), V3(-inf)}), 0);
    EXPECT_EQ(caster_mask(maps, Aabb<double>{V3(1), V3(1, -1, 1)}), 0);
    EXPECT_EQ(caster_mask(maps, Aabb<double>{V3(900, nan, 900), V3(901)}), 0b111);
    EXPECT_EQ(caster_mask(maps, Aabb<double>{V3(900), V3(901, 901, inf)}), 0b111);
    EXPECT_EQ(caster_mask(maps, Aabb<double>{V3(-most), V3(most)}), 0b111);
    EXPECT_EQ(caster_mask(maps, cube(V3(0), 1e17)), 0b111);
    // Reach ends before 2^60 m.
    EXPECT_EQ(caster_mask(maps, cube(V3(0x1p60, 0, 0), 0)), 0b111);
    EXPECT_EQ(caster_mask(maps, cube(V3(0x1.fp59, 0, 0), 0)), 0);
}

TEST(CasterMask, OfAMapThatIsNotVisibleOrNotFiniteIsClearAndKeepsItsPlace) {
    ShadowMap<double> maps[4] = {square(1), square(4), square(16), square(16)};
    maps[0].visible = false;
    maps[2].clip_from_world[3][1] = std::numeric_limits<double>::quiet_NaN();
    CasterMaps<double> const some = caster_maps(maps, 4);
    EXPECT_EQ(caster_mask(some, cube(V3(0, 5, 0))), 0b1010);
    EXPECT_EQ(caster_mask(some, cube(V3(0, std::numeric_limits<double>::infinity(), 0))), 0b1010);
    EXPECT_EQ(caster_mask(CasterMaps<double>{}, cube(V3(0, 5, 0))), 0);
}

TEST(CasterMask, OfAMapWhoseSideIsNoPlaneIsThatOfTheOtherSides) {
    // Everything lands in the middle of the first map, and beside the second.
    ShadowMap<double> maps[2] = {square(4), square(4)};
    for (ShadowMap<double>& map : maps)
        for (int column = 0; column < 4; ++column) map.clip_from_world[column][0] = 0.0;
    maps[1].clip_from_world[3][0] = 2.0;
    CasterMaps<double> const both = caster_maps(maps, 2);
    EXPECT_EQ(caster_mask(both, cube(V3(900, 5, 0))), 0b01);
    EXPECT_EQ(caster_mask(both, cube(V3(0, 5, 900))), 0);
}

TEST(CasterMask, TakesMapsThatLookDifferentWays) {
    ShadowMap<double> maps[max_caster_maps];
    for (int i = 0; i < max_caster_maps; ++i) {
        maps[i] = square(1 + i, i % 2 == 0 ? gl_clip : vulkan_clip);
        if (i % 3 == 0) maps[i].clip_from_world[2][3] = 0.001;
    }
    CasterMaps<double> const all = caster_maps(maps, max_caster_maps);
    EXPECT_EQ(all.map_count, max_caster_maps);
    EXPECT_EQ(caster_mask(all, cube(V3(0, 5, 0))), 0xffff);
    EXPECT_EQ(caster_mask(all, cube(V3(8.75, 5, 0))), 0xff00);
}

#if defined(NDEBUG)
TEST(CasterMaps, HoldNoMoreThanAMaskHasBits) {
    CasterMaps<double> maps;
    for (int i = 0; i < max_caster_maps + 3; ++i) add_map(maps, square(1));
    EXPECT_EQ(maps.map_count, max_caster_maps);
    EXPECT_EQ(caster_mask(maps, cube(V3(0, 5, 0))), 0xffff);
}
#endif

TEST(CasterMaps, OfCascadesShareTheirNormals) {
    ViewVolume<float> const view = perspective_view(
        pose_looking(glm::vec3(3, 2, 1), glm::vec3(1, -0.2f, -1), glm::vec3(0, 1, 0)), 1.0f, 1.5f, 0.1f, 200.0f);
    Aabb<float> const scene{glm::vec3(-100, -1, -100), glm::vec3(100, 30, 100)};
    for (CascadeFit const fit : {CascadeFit::stable, CascadeFit::tight})
        for (ClipSpace const clip : {gl_clip, vulkan_clip, reversed(d3d_clip)}) {
            CascadeOptions<float> options;
            options.fit = fit;
            options.clip = clip;
            auto const cascades = fit_cascades(view, directional(glm::vec3(0.4f, -0.8f, 0.3f)), scene, scene, options);
            CasterMaps<float> const maps = caster_maps(cascades);
            EXPECT_EQ(maps.map_count, 4);
            EXPECT_EQ(maps.bundle_count, 1);
        }
}

TEST(CasterMasks, AreThoseOfTheBoxesOneByOneForAnyLengthAndAnyStart) {
    ShadowMap<float> maps[5];
    for (int i = 0; i < 5; ++i) {
        ShadowMap<double> const map = square(1 << i);
        maps[i].clip_from_world = glm::mat4(map.clip_from_world);
        maps[i].clip = map.clip;
        maps[i].visible = i != 1;
    }
    CasterMaps<float> const casters = caster_maps(maps, 5);
    constexpr int most = 200;
    std::vector<float> columns[6];
    std::uint32_t state = 1;
    auto const draw = [&state] {
        state = state * 1664525u + 1013904223u;
        return static_cast<float>(state >> 8) * 0x1p-24f;
    };
    for (int i = 0; i < most; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            float const lo = (draw() - 0.5f) * 40;
            columns[axis].push_back(lo);
            columns[axis + 3].push_back(i % 17 == 3 ? lo - 1 : lo + 3 * draw());
        }
    columns[4][130] = std::numeric_limits<float>::quiet_NaN();
    columns[5][190] = std::numeric_limits<float>::infinity();
    for (int start = 0; start < 5; ++start)
        for (int count : {0, 1, 3, 63, 64, 65, 127, 128, 129, most - 5}) {
            std::vector<MapMask> masks(static_cast<std::size_t>(count) + 1, MapMask(0xabcd));
            caster_masks(casters,
                         BoxArrays<float>{&columns[0][0] + start, &columns[1][0] + start, &columns[2][0] + start,
                                          &columns[3][0] + start, &columns[4][0] + start, &columns[5][0] + start},
                         count, masks.data());
            EXPECT_EQ(masks.back(), 0xabcd);
            for (int i = 0; i < count; ++i) {
                auto const at = static_cast<std::size_t>(start + i);
                Aabb<float> const box{glm::vec3(columns[0][at], columns[1][at], columns[2][at]),
                                      glm::vec3(columns[3][at], columns[4][at], columns[5][at])};
                EXPECT_EQ(masks[static_cast<std::size_t>(i)], caster_mask(casters, box)) << start << ' ' << i;
            }
        }
}

TEST(CasterMasks, OfNoMapsAreNothingAndOfABoxBeyondReachEverything) {
    constexpr int count = detail::boxes_at_once;
    std::vector<double> lo(count, -1.0), hi(count, 1.0);
    BoxArrays<double> const boxes{lo.data(), lo.data(), lo.data(), hi.data(), hi.data(), hi.data()};
    std::vector<MapMask> masks(count, MapMask(0xffff));
    caster_masks(CasterMaps<double>{}, boxes, count, masks.data());
    for (MapMask const mask : masks) EXPECT_EQ(mask, 0);
    lo[5] = 1e30, hi[5] = 2e30;
    caster_masks(three_squares(), boxes, count, masks.data());
    for (int i = 0; i < count; ++i) EXPECT_EQ(masks[std::size_t(i)], 0b111) << i;
}

TEST(MapRange, SpansTheBitsOfTheMask) {
    static_assert(map_range(0b0110).first == 1 && map_range(0b0110).last == 2);
    for (unsigned mask = 0; mask < 0x10000; ++mask)
        ASSERT_TRUE(laws::spans(map_range(static_cast<MapMask>(mask)), static_cast<MapMask>(mask))) << mask;
}
