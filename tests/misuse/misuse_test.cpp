// SPDX-License-Identifier: MIT
//
// Misuse asserts: what only a wrong program can do, and no data. A program of its own, since the assertion is replaced.
// House.EveryAssertionIsSeenToFail finds the assertions that no test here breaks.
#include <cstdio>
#include <cstdlib>

#define SHADOWMATH_ASSERT(condition, sentence) \
    static_cast<void>((condition) || (std::fprintf(stderr, "%s\n", sentence), std::abort(), false))

#include <shadowmath/irregular.hpp>
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

TEST_F(MisuseDeathTest, SamplesThatAreNotThereAssert) {
    ViewVolume<double> const view;
    SurfacePoint<double> const* const none = nullptr;
    EXPECT_DEATH((void)judge(Cascades<double>{}, 512, view, glm::dvec2(640, 480), none, 4), "judge needs its samples");
    EXPECT_DEATH((void)least_squares_plane(view, none, 4), "a plane needs its samples");
    EXPECT_DEATH((void)median_plane(glm::dvec3(0, 1, 0), none, 4), "a plane needs its samples");
    EXPECT_DEATH((void)plane_distortion(ShadowPlane<double>{}, view, Light<double>{}, none, 4),
                 "a plane needs its samples");
    Aabb<double> const* const no_boxes = nullptr;
    EXPECT_DEATH((void)samples_in_boxes(view, Light<double>{}, no_boxes, 4), "samples need their boxes");
    EXPECT_EQ(samples_in_boxes(view, Light<double>{}, no_boxes, 0).count, 0) << "none of none is no misuse";
}

TEST_F(MisuseDeathTest, PointsThatAreNotThereAssert) {
    glm::vec3 const point(0);
    EXPECT_DEATH(clip_points<float>(glm::mat4(1.0f), &point, 1, nullptr), "clip_points needs two arrays");
    clip_points<float>(glm::mat4(1.0f), nullptr, 0, nullptr);
}

TEST_F(MisuseDeathTest, ASeventhFaceOfACubeAsserts) {
    for (int const face : {-1, 6})
        EXPECT_DEATH((void)face_light(glm::vec3(0), 10.0f, face), "a cube has six faces") << face;
}

TEST_F(MisuseDeathTest, IrregularListsWithoutTheirArraysAssert) {
    EXPECT_DEATH((void)list_receivers(PixelFrame<float>{}, Receivers<float>{}, Light<float>{}, ShadowMap<float>{}, 64,
                                      Storage<float>{}),
                 "receivers need a normal, and a position or a depth");
    IrregularBuffer<float> buffer;
    buffer.levels_used = 1;
    Casters<float> casters;
    casters.triangle_count = casters.vertex_count = 3;
    EXPECT_DEATH(trace(buffer, casters), "casters need positions");
}

TEST_F(MisuseDeathTest, AChoiceOfMapsWithoutItsSamplesTilesOrReceiversAsserts) {
    static MapSearch<float> work;
    ViewVolume<float> const view;
    Light<float> const light;
    Aabb<float> const casters{glm::vec3(-1), glm::vec3(1)};
    MapLimits<float> const limits;
    SurfacePoint<float> const* const no_samples = nullptr;
    Aabb<float> const* const no_receivers = nullptr;
    float const depth = 1.0f;
    auto const from_tiles = [&](int sample_count, DepthTiles<float> const& tiles) {
        return choose_maps(view, light, casters, no_samples, sample_count, tiles, limits, work).count;
    };
    EXPECT_DEATH((void)from_tiles(4, {&depth, &depth, 1, 1}), "a choice needs its samples");
    EXPECT_DEATH((void)from_tiles(0, {&depth, nullptr, 1, 1}), "tiles need both depths");
    EXPECT_DEATH((void)from_tiles(0, {nullptr, &depth, 1, 1}), "tiles need both depths");
    EXPECT_DEATH((void)choose_maps(view, light, casters, no_receivers, 2, limits, work),
                 "a choice needs its receivers");
    EXPECT_EQ(from_tiles(0, {nullptr, nullptr, 0, 1}), 0) << "none of none is no misuse";
    EXPECT_EQ(choose_maps(view, light, casters, no_receivers, 0, limits, work).count, 0);
}

TEST_F(MisuseDeathTest, SlicesOfViewsWithoutArraysOrWithTooManySplitsAssert) {
    ViewVolume<float> const view;
    LightBasis<float> const basis;
    glm::mat4 maps[max_splits];
    ViewVolume<float> const* const no_views = nullptr;
    auto const fit = [&](ViewVolume<float> const* views, int count, int splits, glm::mat4* into) {
        return fit_slice_boxes_of(views, count, basis, splits, 0.5f, 0.0f, gl_clip, into);
    };
    EXPECT_DEATH((void)fit(no_views, 1, 4, maps), "fit_slice_boxes_of needs views, and room for their maps");
    EXPECT_DEATH((void)fit(&view, 1, 4, nullptr), "fit_slice_boxes_of needs views, and room for their maps");
    for (int const splits : {-1, 0, max_splits + 1})
        EXPECT_DEATH((void)fit(&view, 1, splits, maps), "fit_slice_boxes_of makes one to max_splits maps a view")
            << splits;
    EXPECT_EQ(fit(no_views, 0, 4, nullptr), 0) << "none of none is no misuse";
    EXPECT_EQ(fit(&view, 1, max_splits, maps), 1);
}
