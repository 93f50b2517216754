// SPDX-License-Identifier: MIT
#include "tests/laws/depth_range.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/tolerance.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class DepthRangeProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(DepthRangeProperty, Scalars);

// Volumes of ordinary shape: the oracle solves for corners of planes, and needs them not to be parallel.
TYPED_TEST(DepthRangeProperty, FindsTheDepthsThatBoxAndVolumeHaveInCommon) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ViewVolume<T> volume;
        volume.pose = *pose<T>(T(10));
        bool const flat = *one_in(2);
        volume.kind = flat ? ViewKind::orthographic : ViewKind::perspective;
        volume.z_near = *uniform<T>(T(0.1), T(5));
        T const length = *uniform<T>(T(0.5), T(30));
        volume.z_far = volume.z_near + length;
        volume.left = -*uniform<T>(T(0.2), T(3));
        volume.right = *uniform<T>(T(0.2), T(3));
        volume.bottom = -*uniform<T>(T(0.2), T(3));
        volume.top = *uniform<T>(T(0.2), T(3));
        auto body = *box<T>(T(10));
        if (*one_in(2)) {
            // Around a point of the volume.
            T const across = *uniform<T>(T(0), T(1));
            T const upward = *uniform<T>(T(0), T(1));
            T const ahead = *uniform<T>(T(0), T(1));
            Vec3<T> const middle =
                point_at(volume, glm::mix(volume.left, volume.right, across),
                         glm::mix(volume.bottom, volume.top, upward), volume.z_near + length * ahead);
            Vec3<T> const half = body.hi - body.lo;
            body = {middle - half, middle + half};
        }
        // Coordinates up to some 150 m; where faces meet at a grazing angle a rounding counts a hundredfold.
        auto const slack = static_cast<laws::Long>(tolerance(T(150), 1000));
        RC_ASSERT(laws::finds_the_common_depths(body, volume, slack));
    }));
}

TYPED_TEST(DepthRangeProperty, HoldsEveryReceiverAndEveryCasterAboveIt) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const light = *sun<T>();
        auto const casters = *box<T>(T(50));
        auto const receivers = *box<T>(T(50));
        auto const slice_body = *box<T>(T(20));
        auto const sides = fit_box(light_basis(light.direction), corners(slice_body), 256, T(2));
        DepthRange<T> const slice{sides.depth_lo, sides.depth_hi, true};
        bool const pancake = *one_in(2);
        auto const range = depth_range(sides, slice, casters, receivers, pancake);
        RC_ASSERT(laws::is_a_range(range));
        for (int i = 0; i < 50; ++i) {
            T const u = *uniform<T>(T(0), T(1));
            T const v = *uniform<T>(T(0), T(1));
            T const w = *uniform<T>(T(0), T(1));
            Vec3<T> const share(u, v, w);
            auto const inside = [&](Aabb<T> const& b) { return b.lo * (Vec3<T>(T(1)) - share) + b.hi * share; };
            RC_ASSERT(laws::reaches(range, sides, slice, inside(receivers)));
            RC_ASSERT(pancake || laws::starts_before(range, sides, inside(casters)));
        }
    }));
}

TYPED_TEST(DepthRangeProperty, IsARangeForAnyNumbersAtAll) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const light = *sun<T>();
        auto const good = *box<T>(T(50));
        auto sides = fit_box(light_basis(light.direction), corners(good), 256, T(2));
        DepthRange<T> slice{sides.depth_lo, sides.depth_hi, true};
        int const spoiled = static_cast<int>(*below(6));
        auto const bad = *nasty<T>();
        if (spoiled == 0) sides.lo.x = bad;
        if (spoiled == 1) sides.hi.y = bad;
        if (spoiled == 2) slice.lo = bad;
        if (spoiled == 3) slice.hi = bad;
        if (spoiled == 4) sides.basis.depth.y = bad;
        auto const casters = *nasty_box<T>();
        auto const receivers = *nasty_box<T>();
        bool const pancake = *one_in(2);
        auto const range = depth_range(sides, slice, casters, receivers, pancake);
        RC_ASSERT(laws::is_a_range(range));
        auto const step = *nasty<T>();
        RC_ASSERT(laws::is_a_range(in_steps(range, step)));
    }));
}
