// SPDX-License-Identifier: MIT
//
// Misuse asserts: what only a wrong program can do, and no data. A program of its own, since the assertion is replaced.
// House.EveryAssertionIsSeenToFail finds the assertions that no test here breaks.
#include <cstdio>
#include <cstdlib>

#define SHADOWMATH_ASSERT(condition, sentence) \
    static_cast<void>((condition) || (std::fprintf(stderr, "%s\n", sentence), std::abort(), false))

#include <shadowmath/shadowmath.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;

namespace {

using MisuseDeathTest = ::testing::Test;

ConvexBody<double> cut_as_often_as_possible() {
    ConvexBody<double> body = convex_body(corners(Aabb<double>{glm::dvec3(-1), glm::dvec3(1)}));
    body.face_count = max_body_faces;
    return body;
}

}  // namespace

TEST_F(MisuseDeathTest, ExplicitSplitsWithoutPlanesAssert) {
    double const* const none = nullptr;
    EXPECT_DEATH((void)explicit_splits(1.0, 10.0, none, 3), "explicit_splits needs count - 1 planes");
    EXPECT_EQ(explicit_splits(1.0, 10.0, none, 1).count, 1) << "one split has no inner plane";
}

TEST_F(MisuseDeathTest, ASliceThatIsNotAmongTheSplitsAsserts) {
    Splits<float> const splits = practical_splits(1.0f, 10.0f, 3);
    for (int const index : {-1, 3, 16})
        EXPECT_DEATH((void)slice_range(splits, index), "slice index outside the splits") << index;
    EXPECT_EQ(slice_range(splits, 2).end, 10.0f);
}

TEST_F(MisuseDeathTest, ALookUpWithoutRangesOrMapsAsserts) {
    SliceRange<float> const* const no_ranges = nullptr;
    ShadowMap<float> const* const no_maps = nullptr;
    EXPECT_DEATH((void)by_depth(no_ranges, 2, 1.0f), "no ranges to choose from");
    EXPECT_DEATH((void)by_map(no_maps, 2, 512, 1.0f, glm::vec3(0)), "no maps to choose from");
    EXPECT_EQ(by_depth(no_ranges, 0, 1.0f).first, -1) << "none of none is no misuse";
    EXPECT_EQ(by_map(no_maps, 0, 512, 1.0f, glm::vec3(0)).first, -1);
}

TEST_F(MisuseDeathTest, ABodyThatIsCutTooOftenAsserts) {
    ConvexBody<double> const body = cut_as_often_as_possible();
    EXPECT_DEATH((void)clipped(body, glm::dvec4(1, 0, 0, 0)), "a convex body was cut too often");
}

TEST_F(MisuseDeathTest, MoreMapsThanAMaskHasBitsAssert) {
    CasterMaps<float> maps;
    for (int i = 0; i < max_caster_maps; ++i) add_map(maps, ShadowMap<float>{});
    EXPECT_DEATH(add_map(maps, ShadowMap<float>{}), "more maps than a mask has bits");
}

TEST_F(MisuseDeathTest, CullingWithoutMapsOrArraysAsserts) {
    ShadowMap<float> const* const no_maps = nullptr;
    EXPECT_DEATH((void)caster_maps(no_maps, 1), "caster_maps needs maps");
    EXPECT_DEATH(caster_masks(CasterMaps<float>{}, BoxArrays<float>{}, 1, nullptr),
                 "caster_masks needs six arrays of boxes and one of masks");
    caster_masks(CasterMaps<float>{}, BoxArrays<float>{}, 0, nullptr);
}
