// SPDX-License-Identifier: MIT
//
// The judge's arithmetic on pictures of a few pixels, where every figure can be counted by hand.
#include "examples/gallery/measure.hpp"

#include <gtest/gtest.h>

namespace shadowmath::gallery {
namespace {

using oracle::Truth;

// A row of pixels on the ground, seen from above by an eye whose picture is as fine as the one map, texel by pixel.
struct Row {
    ViewTruth truth;
    backend::Frame frame;
    MapSet maps;

    explicit Row(int width) {
        backend::Extent const extent{width, 1};
        truth.state = backend::Image<Truth>(extent, Truth::lit);
        truth.question = backend::Image<Question>(extent, Question::off_edge);
        truth.position = backend::Image<backend::Texel4>(extent);
        truth.picture = backend::Image<backend::Rgba8>(extent);
        frame.colour = backend::Image<backend::Rgba8>(extent);
        frame.normal = backend::Image<backend::Texel4>(extent, {0.0f, 1.0f, 0.0f, 1.0f});
        for (int x = 0; x < width; ++x)
            truth.position.at(x, 0) = {2.0f * (static_cast<float>(x) + 0.5f) / static_cast<float>(width) - 1.0f, 0.0f,
                                       0.0f, 0.0f};
        frame.position = truth.position;
        // World x and z become NDC x and y, for the eye and for the map.
        glm::mat4 const from_above(1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.5f, 1);
        maps.frame.clip_from_world = from_above;
        maps.frame.eye_position = glm::vec4(0, 10, 0, 1);
        maps.map_size = width;
        maps.maps.push_back({glm::dmat4(from_above), {}});
    }

    [[nodiscard]] Record record() const { return measure(truth, maps, frame).record; }
    void darken(int x) { frame.normal.at(x, 0).w = 0.0f; }
};

TEST(Measure, FindsNothingWrongWithTheTruthItself) {
    Row row(8);
    row.truth.state.at(3, 0) = Truth::shadowed;
    row.darken(3);
    Record const record = row.record();
    EXPECT_EQ(record.lit_facing_pixels, 8);
    EXPECT_EQ(record.off_edge_pixels, 8);
    EXPECT_EQ(record.mis_shadowed_fraction, 0.0);
    EXPECT_EQ(record.mis_shadowed_fraction_off_edge, 0.0);
}

TEST(Measure, CountsFalseShadowAndFalseLightAlike) {
    Row row(8);
    row.darken(0);
    row.truth.state.at(5, 0) = Truth::shadowed;
    Measurement const measured = measure(row.truth, row.maps, row.frame);
    EXPECT_EQ(measured.outcome.at(0, 0), Outcome::false_shadow);
    EXPECT_EQ(measured.outcome.at(5, 0), Outcome::false_light);
    EXPECT_EQ(measured.outcome.at(1, 0), Outcome::right);
    EXPECT_DOUBLE_EQ(measured.record.mis_shadowed_fraction_off_edge, 2.0 / 8.0);
}

TEST(Measure, TakesHalfVisibilityForLight) {
    Row row(4);
    row.frame.normal.at(0, 0).w = 0.5f;
    row.frame.normal.at(1, 0).w = 0.49f;
    EXPECT_DOUBLE_EQ(row.record().mis_shadowed_fraction, 1.0 / 4.0);
}

TEST(Measure, ForgivesAtTrueEdgesOnlyInTheOffEdgeFigure) {
    Row row(8);
    row.truth.question.at(2, 0) = Question::near_edge;
    row.darken(2);
    Record const record = row.record();
    EXPECT_DOUBLE_EQ(record.mis_shadowed_fraction, 1.0 / 8.0);
    EXPECT_EQ(record.mis_shadowed_fraction_off_edge, 0.0);
    EXPECT_EQ(record.off_edge_pixels, 7);
}

TEST(Measure, LeavesOutWhatIsNotAsked) {
    Row row(8);
    row.truth.question.at(0, 0) = Question::none;
    row.truth.question.at(1, 0) = Question::beyond;
    row.darken(0);
    row.darken(1);
    Record const record = row.record();
    EXPECT_EQ(record.lit_facing_pixels, 6);
    EXPECT_EQ(record.beyond_pixels, 1);
    EXPECT_EQ(record.mis_shadowed_fraction, 0.0);
}

TEST(Measure, JudgesPixelsThatNoMapServesAsTheyWereDrawn) {
    Row row(8);
    row.frame.position.at(4, 0).w = -1.0f;
    row.truth.state.at(4, 0) = Truth::shadowed;
    Record const record = row.record();
    EXPECT_EQ(record.unmapped_pixels, 1);
    EXPECT_DOUBLE_EQ(record.mis_shadowed_fraction_off_edge, 1.0 / 8.0);
}

TEST(Measure, DoesNotJudgeOffEdgeASurfaceOtherThanTheTruths) {
    Row row(8);
    row.frame.position.at(6, 0).y = -3.0f;
    row.darken(6);
    Record const record = row.record();
    EXPECT_EQ(record.off_edge_pixels, 7);
    EXPECT_EQ(record.mis_shadowed_fraction_off_edge, 0.0);
}

TEST(Measure, GivesAFootprintOfOneWhereTexelsAndPixelsCoincide) {
    Row row(8);
    row.truth.position.pixels.front().w = 0.0f;
    Record const record = row.record();
    // The picture is 8 x 1: a texel is one pixel long and an eighth of one high.
    EXPECT_NEAR(record.footprint_max, 1.0, 1e-6);
    EXPECT_NEAR(record.footprint_mean, 1.0, 1e-6);
    EXPECT_NEAR(record.footprint_p95, 1.0, 1e-6);
}

TEST(Measure, CountsTheTexelsThatLookupsTouch) {
    Row row(8);
    // All pixels lie on z = 0, between rows 3 and 4: the kernel about row 4 touches filter_radius rows to either side.
    double const rows = 2.0 * filter_radius + 1.0;
    EXPECT_DOUBLE_EQ(row.record().map_used_fraction, rows / 8.0);
}

TEST(Measure, OfAViewWithNothingToJudgeIsZeroEverywhere) {
    Row row(4);
    for (Question& question : row.truth.question.pixels) question = Question::none;
    row.maps.maps.clear();
    Record const record = row.record();
    EXPECT_EQ(record.lit_facing_pixels, 0);
    EXPECT_EQ(record.mis_shadowed_fraction, 0.0);
    EXPECT_EQ(record.mis_shadowed_fraction_off_edge, 0.0);
    EXPECT_EQ(record.footprint_max, 0.0);
    EXPECT_EQ(record.map_used_fraction, 0.0);
}

TEST(UnlikeFraction, CountsPixelsOfAnotherColour) {
    backend::Image<backend::Rgba8> a({4, 1}), b({4, 1}), smaller({2, 1});
    EXPECT_EQ(unlike_fraction(a, b), 0.0);
    b.at(2, 0).g = 1;
    EXPECT_DOUBLE_EQ(unlike_fraction(a, b), 0.25);
    EXPECT_EQ(unlike_fraction(a, smaller), 1.0);
}

}  // namespace
}  // namespace shadowmath::gallery
