// SPDX-License-Identifier: MIT
#include "tests/laws/bounds.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;

namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST(Aabb, IsEmptyByDefault) {
    EXPECT_TRUE(is_empty(Aabb<float>{}));
    EXPECT_TRUE(is_empty(Aabb<double>{}));
    EXPECT_TRUE(all_finite(Aabb<float>{})) << "an empty box is no bad input";
}

TEST(Aabb, IsEmptyAsSoonAsOneAxisIsInvertedOrNaN) {
    for (int axis = 0; axis < 3; ++axis) {
        Aabb<float> inverted{glm::vec3(0), glm::vec3(1)};
        inverted.lo[axis] = 2;
        EXPECT_TRUE(is_empty(inverted)) << axis;
        Aabb<float> poisoned{glm::vec3(0), glm::vec3(1)};
        poisoned.hi[axis] = nan_value;
        EXPECT_TRUE(is_empty(poisoned)) << axis;
        EXPECT_FALSE(all_finite(poisoned));
    }
}

TEST(Aabb, APointIsNotEmpty) {
    Aabb<float> const point{glm::vec3(1, 2, 3), glm::vec3(1, 2, 3)};
    EXPECT_FALSE(is_empty(point));
    EXPECT_TRUE(contains(point, glm::vec3(1, 2, 3)));
    EXPECT_TRUE(laws::has_numbered_corners(point));
}

TEST(Aabb, MergesAndIntersects) {
    Aabb<double> const a{glm::dvec3(0), glm::dvec3(2)}, b{glm::dvec3(1), glm::dvec3(3)};
    EXPECT_TRUE(laws::same(merge(a, b), Aabb<double>{glm::dvec3(0), glm::dvec3(3)}));
    EXPECT_TRUE(laws::same(intersect(a, b), Aabb<double>{glm::dvec3(1), glm::dvec3(2)}));
    EXPECT_TRUE(is_empty(intersect(a, Aabb<double>{glm::dvec3(5), glm::dvec3(6)})));
    EXPECT_TRUE(is_empty(intersect(a, Aabb<double>{})));
    EXPECT_TRUE(laws::merging_with_nothing_changes_nothing(a));
}

TEST(BoxArrays, FromAPlaceOnHoldTheBoxesFromThere) {
    float const columns[6][3] = {{0, 1, 2}, {10, 11, 12}, {20, 21, 22}, {30, 31, 32}, {40, 41, 42}, {50, 51, 52}};
    BoxArrays<float> const all{columns[0], columns[1], columns[2], columns[3], columns[4], columns[5]};
    for (int begin = 0; begin < 3; ++begin)
        for (int i = 0; begin + i < 3; ++i) {
            auto const at = static_cast<float>(begin + i);
            EXPECT_TRUE(laws::same(box_at(boxes_from(all, begin), i),
                                   Aabb<float>{glm::vec3(0, 10, 20) + at, glm::vec3(30, 40, 50) + at}));
        }
}
