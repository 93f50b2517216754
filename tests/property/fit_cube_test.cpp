// SPDX-License-Identifier: MIT
#include "tests/laws/fit_crop.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/tolerance.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/fit_cube.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
class FitCubeProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(FitCubeProperty, Scalars);

TYPED_TEST(FitCubeProperty, ServesWhatIsSeenAroundTheLampInTheMapOfItsFace) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ViewVolume<T> view = *view_volume<T>();
        view.kind = ViewKind::perspective;
        view.left = view.bottom = T(-0.8);
        view.right = view.top = T(0.7);
        view.z_near = T(0.1);
        view.z_far = T(100);
        Vec3<T> const position = *point_within<T>(T(30));
        Vec3<T> const way = *direction<T>();
        T const range = *log_uniform<T>(T(1), T(50));
        T const share = *uniform<T>(T(0.05), T(0.95));
        Vec3<T> const receiver = position + way * (range * share);
        Vec3<T> const eye = receiver + *direction<T>() * *uniform<T>(T(1), T(60));
        Vec3<T> const aside = *point_within<T>(T(0.3));
        Vec3<T> const up = *direction<T>();
        view.pose = pose_looking(eye, safe_normalize(receiver - eye).direction + aside, up);
        Vec3<T> const half = glm::abs(*point_within<T>(T(20)));
        Aabb<T> const receivers{receiver - half, receiver + half};
        T const between = *uniform<T>(T(0.05), T(0.95));
        Vec3<T> const caster = position + (receiver - position) * between;
        Vec3<T> const spread = glm::abs(*point_within<T>(T(5)));
        Aabb<T> const casters{caster - spread, caster + spread};
        ClipSpace const clip = *clip_space();
        int const face = face_toward(position, receiver);
        Light<T> const light = face_light(position, range, face);
        RC_PRE(laws::is_seen(view, receiver));
        auto const maps = watched([&] { return fit_cube(view, position, range, casters, receivers, 512, T(2), clip); });
        RC_ASSERT(maps.calm_in_range());
        ShadowMap<T> const& map = maps.result.face[static_cast<std::size_t>(face)];
        RC_ASSERT(map.visible);
        RC_ASSERT(laws::is_map_of(map.clip_from_world, light, clip, 256));
        // The zoom is at most by map_size, and magnifies the rounding of coordinates of some 90 m over a depth of w.
        T const w = glm::dot(light.direction, receiver - position);
        RC_ASSERT(laws::serves(map, 512, T(2), receiver, tolerance(T(90) * T(512) / w, 16)));
        RC_ASSERT(laws::image_of(map.clip_from_world, Vec4<T>(caster, T(1))).w > map.w_min);
    }));
}

TYPED_TEST(FitCubeProperty, IsHarmlessAndCalmForAnyNumbersAtAll) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ViewVolume<T> const view = *any_view<T>();
        Vec3<T> const position = *nasty_vec3<T>();
        T const range = *nasty<T>();
        Aabb<T> const casters = *nasty_box<T>();
        Aabb<T> const receivers = *nasty_box<T>();
        T const odd_margin = *nasty<T>();
        T const margin = *one_in(2) ? odd_margin : T(2);
        int const size = static_cast<int>(*below(5000)) - 3;
        ClipSpace const clip = *clip_space();
        auto const maps =
            watched([&] { return fit_cube(view, position, range, casters, receivers, size, margin, clip); });
        RC_ASSERT(maps.allocations == 0u);
        int visible = 0;
        for (ShadowMap<T> const& map : maps.result.face) {
            RC_ASSERT(laws::harmless(map));
            visible += map.visible ? 1 : 0;
        }
        RC_ASSERT(visible == maps.result.visible_count);
        int const face = face_toward(position, view.pose.position);
        RC_ASSERT(face >= 0 && face < cube_faces);
    }));
}

}  // namespace
