// SPDX-License-Identifier: MIT
#include "tests/laws/depth_range.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

using namespace shadowmath;

template <class T>
class DepthRangeOf : public ::testing::Test {
public:
    // Light along -y, depth = -y: sides of 10 m around the origin, a slice from y = 5 down to y = -5.
    LightBox<T> sides{{}, Vec2<T>(T(-5)), Vec2<T>(T(5)), T(0), T(1)};
    DepthRange<T> slice{T(-5), T(5), true};
    Aabb<T> ground{Vec3<T>(-100, -3, -100), Vec3<T>(100, -1, 100)};
    Aabb<T> tower{Vec3<T>(-1, -1, -1), Vec3<T>(1, 40, 1)};

    DepthRange<T> range(Aabb<T> const& casters, Aabb<T> const& receivers, bool pancake = false) const {
        return depth_range(sides, slice, casters, receivers, pancake);
    }
    // The range is widened by 8 eps of the largest coordinate, and its planes by 8 eps of that times sqrt(3) at most,
    // which a slope of 45 degrees can double.
    static bool close(T value, long double wanted, long double largest = 100) {
        return std::abs(value - wanted) <= largest * 40 * std::numeric_limits<T>::epsilon();
    }
};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(DepthRangeOf, Scalars);

TYPED_TEST(DepthRangeOf, ATowerOnTheGroundIsFromItsTopToTheGroundsBottom) {
    auto const range = this->range(this->tower, this->ground);
    EXPECT_TRUE(range.visible);
    EXPECT_TRUE(this->close(range.lo, -40));
    EXPECT_TRUE(this->close(range.hi, 3));
}

// A wall without visible edges is as deep as the corner edges of the volume are, where they go in and come out.
TYPED_TEST(DepthRangeOf, AWallBeginsAndEndsWhereTheCornerEdgesPierceIt) {
    using T = TypeParam;
    using Long = long double;
    Aabb<T> const wall{Vec3<T>(-500, -500, -10), Vec3<T>(500, 500, -9)};
    Pose<T> const pose = pose_looking(Vec3<T>(1, 2, 0), Vec3<T>(T(0.6), T(0.4), T(-1)), Vec3<T>(T(0.2), 1, 0));
    ViewVolume<T> seen = perspective_view(pose, T(1), T(1), T(0.1), T(100));
    seen.left = T(-0.2), seen.right = T(0.5), seen.bottom = T(-0.6), seen.top = T(0.1);
    ViewVolume<T> const flat = orthographic_view(pose, T(-1), T(3), T(-4), T(0.5), T(0.1), T(100));
    for (ViewVolume<T> const& volume : {seen, flat}) {
        bool const spreads = volume.kind == ViewKind::perspective;
        Long lo = 1e9L, hi = -1e9L;
        for (T const x : {volume.left, volume.right})
            for (T const y : {volume.bottom, volume.top}) {
                Long const aside = Long(pose.right.z) * x + Long(pose.up.z) * y;
                Long const from = Long(pose.position.z) + (spreads ? 0 : aside);
                Long const step = Long(pose.forward.z) + (spreads ? aside : 0);
                lo = std::min(lo, (-9 - from) / step);
                hi = std::max(hi, (-10 - from) / step);
            }
        DepthRange<T> const range = depths_inside(wall, volume);
        EXPECT_TRUE(this->close(range.lo, lo)) << spreads;
        EXPECT_TRUE(this->close(range.hi, hi)) << spreads;
    }
}

TYPED_TEST(DepthRangeOf, DepthsAreTheSameInAnyUnit) {
    using T = TypeParam;
    auto const of = [](T unit) {
        Pose<T> const pose =
            pose_looking(Vec3<T>(1, 2, 0) * unit, Vec3<T>(T(0.6), T(0.4), T(-1)), Vec3<T>(T(0.2), 1, 0));
        Aabb<T> const wall{Vec3<T>(-500, -500, -10) * unit, Vec3<T>(500, 500, -9) * unit};
        return depths_inside(wall, perspective_view(pose, T(1), T(1), T(0.1) * unit, T(100) * unit));
    };
    DepthRange<T> const metres = of(T(1));
    for (T const unit : {T(1) / 4096, T(4096)}) {
        DepthRange<T> const scaled = of(unit);
        ASSERT_TRUE(scaled.visible);
        EXPECT_TRUE(this->close(scaled.lo / unit, metres.lo));
        EXPECT_TRUE(this->close(scaled.hi / unit, metres.hi));
    }
}

TYPED_TEST(DepthRangeOf, APlateThroughTheEyeIsSeenFromTheNearEndToItsOwn) {
    using T = TypeParam;
    ViewVolume<T> const view = perspective_view(Pose<T>{}, T(1), T(1), T(0.05), T(100));
    Aabb<T> const plate{Vec3<T>(T(-0.2), T(0), T(-0.2)), Vec3<T>(T(0.2), T(0), T(0.2))};
    DepthRange<T> const range = depths_inside(plate, view);
    ASSERT_TRUE(range.visible);
    EXPECT_EQ(range.lo, view.z_near);
    EXPECT_TRUE(this->close(range.hi, T(0.2), 1));
}

TYPED_TEST(DepthRangeOf, InAxesThatAreNoneNothingIsSeen) {
    using T = TypeParam;
    this->sides.basis.x = Vec3<T>(0);
    EXPECT_FALSE(this->range(this->tower, this->ground).visible);
}

TYPED_TEST(DepthRangeOf, PancakeStartsAtTheFirstReceiver) {
    auto const range = this->range(this->tower, this->ground, true);
    EXPECT_TRUE(this->close(range.lo, 1));
    EXPECT_TRUE(this->close(range.hi, 3));
}

TYPED_TEST(DepthRangeOf, ReceiversBelowTheSliceDoNotDeepenIt) {
    using T = TypeParam;
    auto const range = this->range(this->tower, {Vec3<T>(-100, -1000, -100), Vec3<T>(100, -1, 100)});
    EXPECT_TRUE(this->close(range.hi, 5));
}

TYPED_TEST(DepthRangeOf, CastersBesideTheSidesAreLeftOut) {
    using T = TypeParam;
    EXPECT_FALSE(this->range({Vec3<T>(6, -1, -1), Vec3<T>(9, 40, 1)}, this->ground).visible);
    EXPECT_TRUE(this->range({Vec3<T>(4, -1, -1), Vec3<T>(9, 40, 1)}, this->ground).visible);
}

TYPED_TEST(DepthRangeOf, CastersBelowTheLastReceiverAreLeftOut) {
    using T = TypeParam;
    EXPECT_FALSE(this->range({Vec3<T>(-1, -9, -1), Vec3<T>(1, -4, 1)}, this->ground).visible);
}

TYPED_TEST(DepthRangeOf, ABoxThatLeansIntoTheShaftCountsFromWhereItIsInside) {
    using T = TypeParam;
    // Light slants by 45 degrees in x: x_light = (x + y) / sqrt 2 up to sign, depth = (x - y) / sqrt 2.
    // A box of 200 m up and down, 2 m around x = 0: inside |x_light| <= 5 only for |y| <= 5 sqrt 2 + 1.
    this->sides.basis = light_basis(directional(Vec3<T>(1, -1, 0)).direction);
    Aabb<T> const pole{Vec3<T>(-1, -200, -1), Vec3<T>(1, 200, 1)};
    auto const range = this->range(pole, this->ground);
    ASSERT_TRUE(range.visible);
    // The nearest point: x = -1, x + y = 5 sqrt 2, depth = (-1 - (5 sqrt 2 + 1)) / sqrt 2 = -5 - sqrt 2.
    EXPECT_TRUE(this->close(range.lo, -5 - std::sqrt(2.0L), 200));
}

TYPED_TEST(DepthRangeOf, BoxesWithoutAnEndAreCutBeforeTheyAreComputedWith) {
    using T = TypeParam;
    T const huge = std::numeric_limits<T>::max();
    Aabb<T> const everything{Vec3<T>(-huge), Vec3<T>(huge)};
    auto const range = this->range(everything, everything);
    EXPECT_TRUE(range.visible);
    EXPECT_TRUE(laws::is_a_range(range));
    EXPECT_TRUE(this->close(range.hi, 5));
    // 65536 * (10 + 10 + 10) m above the slice.
    EXPECT_NEAR(double(range.lo), -5 - 65536 * 30.0, 4.0);
    EXPECT_TRUE(this->close(this->range(everything, everything, true).lo, -5));
    EXPECT_TRUE(this->close(this->range(this->tower, everything).lo, -40));
    auto const below = this->range(everything, this->ground);
    EXPECT_TRUE(this->close(below.hi, 3));
}

TYPED_TEST(DepthRangeOf, AVolumeInsideTheBoxHasItsOwnDepths) {
    using T = TypeParam;
    auto const view = perspective_view(pose_looking(Vec3<T>(1, 2, 3), Vec3<T>(1, -2, T(1.5)), Vec3<T>(0, 1, 0)), T(0.2),
                                       T(1), T(5), T(20));
    auto const range = depths_inside(Aabb<T>{Vec3<T>(-1000), Vec3<T>(1000)}, view);
    EXPECT_TRUE(range.visible);
    EXPECT_TRUE(this->close(range.lo, 5));
    EXPECT_TRUE(this->close(range.hi, 20));
}

// No corner of either is inside the other but those far behind: what counts is where the view's edges pierce the face.
TYPED_TEST(DepthRangeOf, AFacePiercedInItsMiddleIsTheNearestWhicheverAxisItIsOf) {
    using T = TypeParam;
    Aabb<T> const room{Vec3<T>(-30), Vec3<T>(30)};
    for (int axis = 0; axis < 3; ++axis)
        for (T const side : {T(-1), T(1)}) {
            Vec3<T> eye(1, 2, 3), forward(0), up(0);
            eye[axis] = T(-50) * side;
            forward[axis] = side;
            forward[(axis + 1) % 3] = T(0.1);
            forward[(axis + 2) % 3] = T(-0.2);
            up[(axis + 1) % 3] = T(1);
            auto const view = perspective_view(pose_looking(eye, forward, up), T(0.1), T(1), T(1), T(60));
            auto const range = depths_inside(room, view);
            ASSERT_TRUE(range.visible);
            T nearest = T(60);
            for (T const x : {view.left, view.right})
                for (T const y : {view.bottom, view.top}) {
                    Vec3<T> const edge = view.pose.forward + view.pose.right * x + view.pose.up * y;
                    nearest = std::min(nearest, T(20) / (edge[axis] * side));
                }
            EXPECT_TRUE(this->close(range.lo, nearest)) << axis << ' ' << double(side) << ' ' << double(range.lo);
            EXPECT_TRUE(this->close(range.hi, 60));
        }
}

TYPED_TEST(DepthRangeOf, AFlatBoxThroughTheEyeIsSeenFromTheNearEndOn) {
    using T = TypeParam;
    Vec3<T> const eye(T(-3.1764705898240208626L));
    ViewVolume<T> view;
    view.pose = pose_looking(eye, Vec3<T>(-1), Vec3<T>(1, 0, 0));
    view.right = view.top = T(1.1552941174246371681L);
    view.left = view.bottom = -view.right;
    view.z_near = T(1.75), view.z_far = T(12);
    Aabb<T> const box{Vec3<T>(eye.x, T(-6.3629411796480415L), T(-6.3629411796480415L)),
                      Vec3<T>(eye.x, T(0.00999999999999978684L), T(0.00999999999999978684L))};
    EXPECT_EQ(depths_inside(box, view).lo, view.z_near);
    auto const eps = static_cast<long double>(std::numeric_limits<T>::epsilon());
    EXPECT_TRUE(laws::finds_the_common_depths(box, view, 1000.0L * 150.0L * eps));
}

TYPED_TEST(DepthRangeOf, NothingToSeeIsNotVisible) {
    using T = TypeParam;
    T const nan = std::numeric_limits<T>::quiet_NaN(), infinity = std::numeric_limits<T>::infinity();
    EXPECT_FALSE(this->range({}, this->ground).visible);
    EXPECT_FALSE(this->range(this->tower, {}).visible);
    EXPECT_FALSE(this->range({Vec3<T>(nan), Vec3<T>(1)}, this->ground).visible);
    EXPECT_FALSE(this->range(this->tower, {Vec3<T>(-1), Vec3<T>(infinity)}).visible);
    EXPECT_FALSE(this->range(this->tower, {Vec3<T>(50), Vec3<T>(60)}).visible);
    for (T const bad : {nan, infinity, std::numeric_limits<T>::max(), T(4e18L)}) {
        LightBox<T> spoiled = this->sides;
        spoiled.hi.x = bad;
        EXPECT_FALSE(depth_range(spoiled, this->slice, this->tower, this->ground, false).visible);
        EXPECT_FALSE(depth_range(this->sides, {T(0), bad, true}, this->tower, this->ground, false).visible);
    }
    EXPECT_FALSE(depth_range(this->sides, {T(1), T(0), true}, this->tower, this->ground, false).visible);
    EXPECT_FALSE(depth_range(this->sides, {T(-5), T(5), false}, this->tower, this->ground, false).visible);
    EXPECT_TRUE(laws::is_a_range(this->range({}, {})));
}

TYPED_TEST(DepthRangeOf, PointsAndPlanesHaveAnExtentToo) {
    using T = TypeParam;
    Aabb<T> const point{Vec3<T>(1, 0, 2), Vec3<T>(1, 0, 2)};
    EXPECT_TRUE(this->range(point, point).visible);
    EXPECT_TRUE(laws::is_a_range(this->range(point, point)));
    Aabb<T> const floor{Vec3<T>(-100, 0, -100), Vec3<T>(100, 0, 100)};
    EXPECT_TRUE(this->range(floor, floor).visible);
    EXPECT_TRUE(laws::is_a_range(this->range(floor, floor)));
    EXPECT_GE(this->range(floor, floor).hi - this->range(floor, floor).lo, T(0.99e-6L)) << "a micrometre at least";
    EXPECT_TRUE(this->close(this->range(point, this->ground).lo, 0));
}

TYPED_TEST(DepthRangeOf, OfASliceOfOneDepthFarOutIsARangeToo) {
    using T = TypeParam;
    T const depth = std::min(T(1) / std::numeric_limits<T>::epsilon(), T(1e18L));
    Aabb<T> const box{Vec3<T>(-3, -depth - 9, -3), Vec3<T>(3, -depth + 9, 3)};
    auto const range = depth_range(this->sides, DepthRange<T>{depth, depth, true}, box, box, true);
    ASSERT_TRUE(range.visible);
    EXPECT_LT(range.lo, depth);
    EXPECT_GT(range.hi, depth);
}

TYPED_TEST(DepthRangeOf, SidesOrASliceThatAreNoNumbersHaveNone) {
    using T = TypeParam;
    T const nan = std::numeric_limits<T>::quiet_NaN();
    EXPECT_TRUE(this->range(this->tower, this->ground).visible);
    for (T* const number : {&this->sides.lo.x, &this->sides.lo.y, &this->sides.hi.x, &this->sides.hi.y, &this->slice.lo,
                            &this->slice.hi}) {
        T const kept = *number;
        *number = nan;
        EXPECT_FALSE(this->range(this->tower, this->ground).visible);
        *number = kept;
    }
}

TYPED_TEST(DepthRangeOf, StepsWidenOutwardToWholeMultiples) {
    using T = TypeParam;
    auto const range = in_steps(DepthRange<T>{T(-41.3), T(7.1), true}, T(4));
    EXPECT_EQ(range.lo, T(-44));
    EXPECT_EQ(range.hi, T(8));
    EXPECT_TRUE(range.visible);
    EXPECT_EQ(in_steps(DepthRange<T>{T(-41.3), T(7.1), true}, T(0.5)).lo, T(-41.5));
    DepthRange<T> const plain{T(-41.3), T(7.1), true};
    for (T const step : {T(0), T(-1), std::numeric_limits<T>::quiet_NaN(), T(1e-30L)})
        EXPECT_EQ(in_steps(plain, step).lo, plain.lo);
}

// The depth that an unmoving point is stored at does not change while the camera moves within a step.
TEST(DepthRange, StepsKeepStoredDepthFromFrameToFrame) {
    int changes = 0;
    double last = 0;
    for (int frame = 0; frame < 1000; ++frame) {
        auto const range = in_steps(DepthRange<double>{-100 + 0.01 * frame, 50 + 0.01 * frame, true}, 16.0);
        double const stored = (3.0 - range.lo) / (range.hi - range.lo);
        changes += frame > 0 && stored != last;
        last = stored;
    }
    EXPECT_LE(changes, 2);  // ten metres of motion cross at most one multiple of 16 at either end
}

TEST(DepthRange, OfASliceOfOneDepthIsARange) {
    LightBox<double> sides;
    sides.lo = Vec2<double>(-5);
    sides.hi = Vec2<double>(5);
    Aabb<double> const box{Vec3<double>(-3), Vec3<double>(3)};
    auto const range = depth_range(sides, DepthRange<double>{1.0, 1.0, true}, box, box, false);
    EXPECT_TRUE(range.visible);
    EXPECT_LE(range.lo, -3.0);
    EXPECT_GE(range.hi, 1.0);
    EXPECT_FALSE(depth_range(sides, DepthRange<double>{1.0, 0.9, true}, box, box, false).visible);
}

TEST(InSteps, LeavesARangeAloneOfWhichEitherEndIsBeyondWholeNumbers) {
    for (auto const& [lo, hi] : {std::pair(-1e18, 0.5), std::pair(0.5, 1e18)}) {
        auto const range = in_steps(DepthRange<double>{lo, hi, true}, 1.0);
        EXPECT_EQ(range.lo, lo);
        EXPECT_EQ(range.hi, hi);
    }
}
