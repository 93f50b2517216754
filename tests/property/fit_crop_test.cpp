// SPDX-License-Identifier: MIT
#include "tests/laws/fit_crop.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/tolerance.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class FitCropProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(FitCropProperty, Scalars);

namespace {

// Inside the canonical volume, each extent at least a hundredth.
template <class T>
rc::Gen<Aabb<T>> ndc_box() {
    return rc::gen::exec([] {
        Aabb<T> box{Vec3<T>(-1, -1, 0), Vec3<T>(1)};
        for (int axis = 0; axis < 3; ++axis) {
            T const share = *uniform<T>(T(0), T(0.99));
            T const lo = box.lo[axis] + (box.hi[axis] - box.lo[axis]) * share;
            T const extent = *uniform<T>(T(0.01), T(1) - share);
            box.hi[axis] = lo + (box.hi[axis] - box.lo[axis]) * extent;
            box.lo[axis] = lo;
        }
        return box;
    });
}

}  // namespace

TYPED_TEST(FitCropProperty, FillsTheMapAndComposes) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const outer = *ndc_box<T>();
        auto const inner = *ndc_box<T>();
        RC_ASSERT(laws::fills_the_map(outer));
        // Extents of a hundredth each magnify a rounding ten thousandfold.
        RC_ASSERT(laws::composes(outer, inner, 4e5L * std::numeric_limits<T>::epsilon()));
    }));
}

// A lamp and an eye in one room, so that most cases see something; receivers drawn around a point that is seen and lit.
TYPED_TEST(FitCropProperty, ASpotServesWhatIsSeenAndLit) {
    int visible = 0;
    EXPECT_TRUE(rc::check([&visible] {
        using T = TypeParam;
        auto view = *view_volume<T>();
        auto const eye = *point_within<T>(T(10));
        view.pose.position = eye;
        auto const position = *point_within<T>(T(10));
        auto const axis = *direction<T>();
        auto const angle = *uniform<T>(T(0.05), T(1.4));
        auto const range = *uniform<T>(T(1), T(50));
        auto const light = spot(position, axis, angle, range);
        auto const clip = *clip_space();
        int const size = 64 + static_cast<int>(*below(4000));
        auto const aim = *uniform<T>(T(0.01), T(0.9));
        auto const scatter = *point_within<T>(T(1));
        // Somewhere in the cone; the eye is turned to it.
        Vec3<T> const receiver = position + (light.direction + scatter * (angle * T(0.2))) * (aim * range);
        auto const up = *direction<T>();
        view.pose = pose_looking(eye, receiver - eye, up);
        RC_PRE(laws::is_seen_and_lit(view, light, receiver));
        auto const extent = *point_within<T>(T(5));
        Aabb<T> const receivers{receiver - glm::abs(extent), receiver + glm::abs(extent)};
        auto const spread = *point_within<T>(T(5));
        auto const between = *uniform<T>(T(0.05), T(0.95));
        Vec3<T> const caster = position + (receiver - position) * between;
        Aabb<T> const casters{caster - glm::abs(spread), caster + glm::abs(spread)};
        auto const map = fit_spot(view, light, casters, receivers, size, T(2), clip);
        RC_ASSERT(laws::harmless(map));
        RC_ASSERT(!map.faults.any());
        // Casters within the nearest 4096th of the range are lost by contract.
        T const caster_depth = glm::dot(light.direction, caster - position);
        RC_PRE(caster_depth > range / T(2048));
        RC_ASSERT(map.visible);
        ++visible;
        RC_ASSERT(laws::is_map_of(map.clip_from_world, light, clip, 256));
        // The zoom is at most by map_size, and magnifies the rounding of coordinates of some 60 m over a depth of w.
        T const w = glm::dot(light.direction, receiver - position);
        T const slack = tolerance(T(64) * T(size) / w, 16);
        RC_ASSERT(laws::serves(map, size, T(2), receiver, slack));
        RC_ASSERT(laws::image_of(map.clip_from_world, Vec4<T>(caster, T(1))).w > map.w_min);
    }));
    EXPECT_GT(visible, 100);
}

TYPED_TEST(FitCropProperty, ASpotIsHarmlessForAnyNumbersAtAll) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const view = *nasty_view_volume<T>();
        auto const position = *nasty_vec3<T>();
        auto const axis = *nasty_vec3<T>();
        auto const angle = *nasty<T>();
        auto const range = *nasty<T>();
        auto const good_light = *spot_light<T>();
        bool const good = *one_in(2);
        Light<T> light = good ? good_light : spot(position, axis, angle, range);
        bool const by_hand = *one_in(3);
        if (by_hand) light.half_angle_radians = angle;
        auto const casters = *nasty_box<T>();
        auto const receivers = *nasty_box<T>();
        auto const margin = *nasty<T>();
        bool const plain_margin = *one_in(2);
        auto const clip = *clip_space();
        int const size = static_cast<int>(*below(5000)) - 3;
        RC_ASSERT(laws::harmless(fit_spot(view, light, casters, receivers, size, plain_margin ? T(1) : margin, clip)));
        RC_ASSERT(laws::finite(spot_clip_from_world(light, margin, clip)));
        RC_ASSERT(laws::finite(crop_matrix(casters)));
        RC_ASSERT(laws::finite(crop_matrix(scene_dependent_box(casters, receivers, casters))));
    }));
}
