// SPDX-License-Identifier: MIT
#include "tests/laws/projected_bounds.hpp"
#include "tests/support/tolerance.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/view_volume.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace shadowmath;

namespace {

using V3 = glm::dvec3;

}  // namespace

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

// A thousand boxes, and behind them one that reaches farther on one side alone, by little, for a view from anywhere.
TEST(ProjectedBounds, OfThousandsHoldTheOneThatReachesFartherOnOneSide) {
    constexpr int count = 1100, odd_one = 1080;
    for (V3 const& forward : {V3(0, 0, -1), V3(1, -0.4, 0.3), V3(-0.3, 0.9, -0.2), V3(-0.5, -0.5, 0.8)}) {
        Pose<double> const pose = pose_looking(V3(40, -25, 60), forward, V3(0.1, 1, 0.2));
        glm::dmat4 const matrix = clip_from_world(perspective_view(pose, 1.2, 1.3, 1.0, 100.0), ClipSpace{});
        auto const box_at_view = [&](V3 const& at) {
            V3 const middle = pose.position + pose.right * at.x + pose.up * at.y + pose.forward * at.z;
            return Aabb<double>{middle - V3(0.01, 0.02, 0.03), middle + V3(0.01, 0.02, 0.03)};
        };
        for (V3 const& side : {V3(-1, 0, 0), V3(1, 0, 0), V3(0, -1, 0), V3(0, 1, 0), V3(0, 0, -1), V3(0, 0, 1)}) {
            std::vector<Aabb<double>> boxes;
            std::vector<double> columns[6];
            for (int i = 0; i < count; ++i) {
                double const turn = 0.7 * i, lift = std::sin(1.3 * i);
                V3 at(std::cos(turn), std::sin(turn), 10.0 + lift);
                if (i == odd_one) at = V3(0, 0, 10) + side * 1.3;
                boxes.push_back(box_at_view(at));
                for (int axis = 0; axis < 3; ++axis) {
                    columns[axis].push_back(boxes.back().lo[axis]);
                    columns[axis + 3].push_back(boxes.back().hi[axis]);
                }
            }
            BoxArrays<double> const arrays{columns[0].data(), columns[1].data(), columns[2].data(),
                                           columns[3].data(), columns[4].data(), columns[5].data()};
            Aabb<double> const together = projected_bounds(matrix, arrays, count, 1.0);
            EXPECT_TRUE(laws::are_the_merged_bounds(matrix, boxes.data(), count, 1.0, together));
            Aabb<double> const others = projected_bounds(matrix, arrays, odd_one, 1.0);
            EXPECT_NE(together.lo + together.hi, others.lo + others.hi) << "or nothing was tried";
        }
    }
}

TEST(ProjectedBounds, OfThousandsFindWhatIsInFrontAfterAThousandThatAreNot) {
    int const behind = 1100, count = 2000;
    glm::vec3 const forward = glm::normalize(glm::vec3(1, 0.3f, -1));
    ViewVolume<float> const view =
        perspective_view(pose_looking(glm::vec3(0), forward, glm::vec3(0, 1, 0)), 1.2f, 1.3f, 0.1f, 1000.0f);
    glm::mat4 const matrix = clip_from_world(view, ClipSpace{});
    std::vector<Aabb<float>> boxes;
    std::vector<float> columns[6];
    for (int i = 0; i < count; ++i) {
        glm::vec3 const at = i < behind ? glm::vec3(-500, -10, 500) : glm::vec3(i % 7 - 60, 3, -250 - i % 11);
        boxes.push_back({at, at + 1.0f});
        for (int axis = 0; axis < 3; ++axis) {
            columns[axis].push_back(boxes.back().lo[axis]);
            columns[axis + 3].push_back(boxes.back().hi[axis]);
        }
    }
    BoxArrays<float> const arrays{columns[0].data(), columns[1].data(), columns[2].data(),
                                  columns[3].data(), columns[4].data(), columns[5].data()};
    EXPECT_TRUE(is_empty(projected_bounds(matrix, arrays, behind, 0.1f)));
    Aabb<float> const together = projected_bounds(matrix, arrays, count, 0.1f);
    EXPECT_FALSE(is_empty(together));
    EXPECT_TRUE(laws::are_the_merged_bounds(matrix, boxes.data(), count, 0.1f, together));
}

TEST(ProjectedBounds, AreTheSameForAnyMultipleOfTheMatrix) {
    glm::dmat4 const clip = clip_from_world(
        perspective_view(pose_looking(V3(1, 2, 3), V3(0.3, -0.2, -1), V3(0, 1, 0)), 1.2, 1.3, 1.0, 100.0), ClipSpace{});
    Aabb<double> const box{V3(-3, -2, -9), V3(4, 5, 6)};  // from behind the eye to before it
    for (double const w_min : {1.0, 0.25}) {
        Aabb<double> const once = projected_bounds(clip, corners(box), w_min);
        for (double const scale : {0x1p80, 0x1p-20}) {
            Aabb<double> const scaled = projected_bounds(clip * scale, corners(box), w_min * scale);
            EXPECT_LT(glm::length(scaled.lo - once.lo), 1e-12 * glm::length(once.lo));
            EXPECT_LT(glm::length(scaled.hi - once.hi), 1e-12 * glm::length(once.hi));
        }
    }
}

TEST(ProjectedBounds, OfABoxWithoutAnEndAlongOneAxisAreThatOfItsSidesOnTheOthers) {
    float const most = std::numeric_limits<float>::max();
    glm::mat4 perspective(1.0f);
    perspective[2][3] = -1.0f;
    perspective[3][3] = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        Aabb<float> box{glm::vec3(-1, -1, -10), glm::vec3(1, 1, -5)};
        box.lo[axis] = -most;
        if (axis < 2) box.hi[axis] = most;
        Aabb<float> const bounds = projected_bounds(perspective, corners(box), 1.0f);
        for (int other = 0; other < 2; ++other) {
            if (other == axis) continue;
            EXPECT_NEAR(bounds.lo[other], -0.2f, 1e-6f) << axis;
            EXPECT_NEAR(bounds.hi[other], 0.2f, 1e-6f) << axis;
        }
    }
}
