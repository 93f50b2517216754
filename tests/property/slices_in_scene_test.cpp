// SPDX-License-Identifier: MIT
#include "tests/laws/slices_in_scene.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class SlicesInSceneProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SlicesInSceneProperty, Scalars);

namespace {

template <class T>
struct SceneCase {
    ViewVolume<T> view;
    LightBasis<T> basis;
    Splits<T> splits;
    Aabb<T> scene;
};

// A box about the view, most of them cut by it.
template <class T>
SceneCase<T> some_scene() {
    SceneCase<T> drawn;
    drawn.view = *view_volume<T>();
    Light<T> const light = *sun<T>();
    drawn.basis = light_basis(light.direction);
    auto const count = static_cast<int>(1 + *below(6));
    drawn.splits = practical_splits(drawn.view.z_near, drawn.view.z_far, count);
    T const reach = drawn.view.z_far;
    Vec3<T> const share = *point_within<T>(T(1)),
                  size(*uniform<T>(T(0), T(1)), *uniform<T>(T(0), T(1)), *uniform<T>(T(0), T(1)));
    Vec3<T> const centre = drawn.view.pose.position + (drawn.view.pose.forward + share) * (reach * T(0.5));
    drawn.scene = {centre - size * (reach * T(0.5)), centre + size * (reach * T(0.5))};
    return drawn;
}

}  // namespace

TYPED_TEST(SlicesInSceneProperty, BoundsAreThoseOfClippedPolygonsAndNeverLess) {
    using T = TypeParam;
    int seen = 0;
    EXPECT_TRUE(rc::check([&seen] {
        SceneCase<T> const drawn = some_scene<T>();
        Aabb<T> bounds[max_splits];
        bound_slices(drawn.view, drawn.basis, drawn.splits, drawn.scene, bounds);
        long double const rounding = laws::scene_rounding(drawn.view, drawn.splits.plane[drawn.splits.count]);
        for (int i = 0; i < drawn.splits.count; ++i) {
            ViewVolume<T> const part = slice(drawn.view, slice_range(drawn.splits, i));
            Aabb<long double> const exact = laws::clipped_bounds(part, drawn.basis, drawn.scene, 0.0L);
            RC_ASSERT(laws::holds(bounds[i], exact, 0.0L));
            Aabb<long double> const wider = laws::clipped_bounds(part, drawn.basis, drawn.scene, rounding);
            if (is_empty(bounds[i])) continue;
            Aabb<long double> const ours{Vec3<long double>(bounds[i].lo), Vec3<long double>(bounds[i].hi)};
            RC_ASSERT(laws::holds(wider, ours, rounding));
            ++seen;
        }
    }));
    EXPECT_GT(seen, 100);
}

TYPED_TEST(SlicesInSceneProperty, MapsHoldWhatTheySeeOfTheScene) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        SceneCase<T> const drawn = some_scene<T>();
        ClipSpace const clip = *clip_space();
        T const border = *uniform<T>(T(0), T(0.1));
        Aabb<T> bounds[max_splits];
        bound_slices(drawn.view, drawn.basis, drawn.splits, drawn.scene, bounds);
        Mat4<T> maps[max_splits];
        unsigned const visible =
            fit_slice_focus(drawn.view, drawn.basis, drawn.splits, drawn.scene, border, clip, maps);
        for (int i = 0; i < drawn.splits.count; ++i) {
            RC_ASSERT((visible >> i & 1u) == (is_empty(bounds[i]) ? 0u : 1u));
            if ((visible >> i & 1u) == 0) {
                RC_ASSERT(maps[i] == nowhere<T>());
                continue;
            }
            ViewVolume<T> const part = slice(drawn.view, slice_range(drawn.splits, i));
            using Real = long double;
            ViewVolume<Real> exact;
            exact.pose = {Vec3<Real>(part.pose.position), Vec3<Real>(part.pose.right), Vec3<Real>(part.pose.up),
                          Vec3<Real>(part.pose.forward)};
            exact.left = part.left, exact.right = part.right, exact.bottom = part.bottom, exact.top = part.top;
            exact.z_near = part.z_near, exact.z_far = part.z_far, exact.kind = part.kind;
            Aabb<Real> const box{Vec3<Real>(drawn.scene.lo), Vec3<Real>(drawn.scene.hi)};
            Mat4<Real> const canonical = canonical_from_clip<Real>(clip) * Mat4<Real>(maps[i]);
            for_each_vertex(visible_body(exact, box, Real(0)), [&](Vec3<Real> const& v) {
                Vec4<Real> const at = canonical * Vec4<Real>(v + exact.pose.position, Real(1));
                Real const side = 1 - 2 * static_cast<Real>(border);
                RC_ASSERT(std::abs(at.x) <= side && std::abs(at.y) <= side && at.z >= 0 && at.z <= 1);
            });
        }
    }));
}

TYPED_TEST(SlicesInSceneProperty, OfAnyNumbersAreFiniteAndCalm) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ViewVolume<T> const view = *nasty_view_volume<T>();
        Vec3<T> const travel = *nasty_vec3<T>();
        Splits<T> splits = practical_splits(T(0.1), T(100), 4);
        bool const odd = *one_in(4);
        if (odd) splits.plane[4] = *nasty<T>();
        T const border = *nasty<T>();
        LightBasis<T> const basis = light_basis(safe_normalize(travel).direction);
        Aabb<T> const scene = *nasty_box<T>();
        Mat4<T> maps[max_splits];
        maps[4] = Mat4<T>(T(7));
        auto const focus =
            watched([&] { return fit_slice_focus(view, basis, splits, scene, odd ? border : T(0), gl_clip, maps); });
        RC_ASSERT(focus.calm());
        for (int i = 0; i < 4; ++i)
            RC_ASSERT(all_finite(maps[i]) && ((focus.result >> i & 1u) != 0 || maps[i] == nowhere<T>()));
        RC_ASSERT(maps[4] == Mat4<T>(T(7)));
        Aabb<T> boxes[max_splits];
        boxes[4] = {Vec3<T>(T(7)), Vec3<T>(T(8))};
        bound_slices(view, basis, splits, scene, boxes);
        RC_ASSERT(boxes[4].lo == Vec3<T>(T(7)));
    }));
}
