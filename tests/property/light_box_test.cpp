// SPDX-License-Identifier: MIT
#include "tests/laws/light_box.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
rc::Gen<LightBox<T>> light_box() {
    return rc::gen::exec([] {
        Vec3<T> const travel = *direction<T>();
        Vec3<T> const centre = *point_within<T>(world_radius<T>);
        LightBox<T> made;
        made.basis = light_basis(travel);
        T const half_x = *log_uniform<T>(T(0.1), T(1e4));
        T const half_y = *log_uniform<T>(T(0.1), T(1e4));
        T const half_depth = *log_uniform<T>(T(0.1), T(1e5));
        made.lo = Vec2<T>(centre.x - half_x, centre.y - half_y);
        made.hi = Vec2<T>(centre.x + half_x, centre.y + half_y);
        made.depth_lo = centre.z - half_depth;
        made.depth_hi = centre.z + half_depth;
        return made;
    });
}

}  // namespace

template <class T>
class LightBoxProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(LightBoxProperty, Scalars);

TYPED_TEST(LightBoxProperty, FillsTheMapOfItsLightInEveryConvention) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        LightBox<T> const made = *light_box<T>();
        ClipSpace const clip = *clip_space();
        auto const map = watched([&] { return clip_from_world(made, clip); });
        RC_ASSERT(map.calm_in_range());
        RC_ASSERT(laws::fills_the_map(made, clip));
        RC_ASSERT(laws::is_map_of(map.result, directional(made.basis.depth), clip));
    }));
}

TYPED_TEST(LightBoxProperty, RebasingMovesTheOriginAndNothingElse) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        LightBox<T> const made = *light_box<T>();
        Vec3<T> const origin = *point_within<T>(world_radius<T>);
        Vec3<T> const relative = *point_within<T>(T(100));
        RC_ASSERT(laws::is_rebased(clip_from_world(made, vulkan_clip), origin, relative));
    }));
}

TYPED_TEST(LightBoxProperty, AnyNumbersAtAllGiveAFiniteMatrix) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        LightBox<T> made = *light_box<T>();
        Vec3<T> const lo = *nasty_vec3<T>();
        Vec3<T> const hi = *nasty_vec3<T>();
        ClipSpace const clip = *clip_space();
        made.lo = Vec2<T>(lo);
        made.hi = Vec2<T>(hi);
        made.depth_lo = lo.z;
        made.depth_hi = hi.z;
        RC_ASSERT(laws::finite(clip_from_world(made, clip)));
    }));
}
