// SPDX-License-Identifier: MIT
#include "tests/laws/slice.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace shadowmath;

namespace {

Splits<double> three_splits() {
    double const inner[] = {10, 30};
    return explicit_splits(2.0, 70.0, inner, 3);
}

void expect_range(SliceRange<double> const& range, double begin, double blend_begin, double end) {
    EXPECT_EQ(range.begin, begin);
    EXPECT_EQ(range.blend_begin, blend_begin);
    EXPECT_EQ(range.end, end);
}

}  // namespace

TEST(Slice, WithoutABlendIsItsSplit) {
    expect_range(slice_range(three_splits(), 0), 2, 10, 10);
    expect_range(slice_range(three_splits(), 1), 10, 30, 30);
    expect_range(slice_range(three_splits(), 2), 30, 70, 70);
}

TEST(Slice, WithABlendStartsInsideItsForerunner) {
    expect_range(slice_range(three_splits(), 0, 0.25), 2, 8, 10);
    expect_range(slice_range(three_splits(), 1, 0.25), 8, 25, 30);
    expect_range(slice_range(three_splits(), 2, 0.25), 25, 70, 70);
}

TEST(Slice, BlendsOutsideTheirRangeAreBroughtToTheNearerEnd) {
    expect_range(slice_range(three_splits(), 1, 7.0), 2, 10, 30);
    expect_range(slice_range(three_splits(), 1, -1.0), 10, 30, 30);
    expect_range(slice_range(three_splits(), 1, std::numeric_limits<double>::quiet_NaN()), 10, 30, 30);
}

TEST(Slice, OfAnEndlessViewIsFinite) {
    ViewVolume<double> view;
    view.z_far = std::numeric_limits<double>::infinity();
    ViewVolume<double> const part = slice(view, slice_range(three_splits(), 2));
    EXPECT_EQ(part.z_far, 70.0);
    for (glm::dvec3 const& corner : corners(part)) EXPECT_TRUE(all_finite(corner));
}

TEST(Slice, OfPlanesFartherApartThanTheirTypeReachesIsCalm) {
    float const most = std::numeric_limits<float>::max();
    Splits<float> splits = practical_splits(0.1f, 1e31f, 3);
    for (float const plane : {-most, most}) {
        splits.plane[1] = plane, splits.plane[2] = -plane;
        for (float const blend : {0.0f, 0.5f, 1.0f})
            for (int i = 0; i < 3; ++i) {
                auto const made = shadowmath::test::watched([&] { return slice_range(splits, i, blend); });
                EXPECT_TRUE(made.calm()) << plane << " " << blend << " " << i;
                EXPECT_TRUE(std::isfinite(made.result.begin) && std::isfinite(made.result.blend_begin));
            }
    }
}
