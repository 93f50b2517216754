// SPDX-License-Identifier: MIT
#include "tests/laws/slices_in_scene.hpp"
#include "tests/support/seen_boxes.hpp"

#include <shadowmath/slice_edges.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;

namespace {

template <class T>
struct SliceEdges : ::testing::Test {
    test::SeenBoxes<T> some;

    struct Bounds {
        Aabb<T> box[4];  // along the axes of the light, relative to the eye
        T slack;
    };
    static Bounds bounds_of(ViewVolume<T> const& view, LightBasis<T> const& basis, Splits<T> const& splits,
                            Aabb<T> const& scene) {
        using namespace shadowmath::detail;
        ViewOfBox<T> seen{};
        seen.pose = &view.pose;
        EXPECT_TRUE(look(basis, view, seen.lit));
        EXPECT_TRUE(look_at_box(view, splits.plane[4], scene, seen));
        ExtentsOfSlices<T> of;
        bound_four_slices(seen, splits.plane, of);
        Bounds bounds;
        bounds.slack = seen.slack;
        for (int axis = 0; axis < 3; ++axis) {
            Lanes<T> const lo = least_of(of.lo[axis]), hi = largest_of(of.hi[axis]);
            for (int i = 0; i < 4; ++i) bounds.box[i].lo[axis] = lo[i], bounds.box[i].hi[axis] = hi[i];
        }
        return bounds;
    }

    // How many slices see some of the scene.
    static int expect_bounds(ViewVolume<T> const& view, LightBasis<T> const& basis, Aabb<T> const& scene) {
        using Real = long double;
        int met = 0;
        Splits<T> const splits = practical_splits(view.z_near, view.z_far, 4);
        Bounds const ours = bounds_of(view, basis, splits, scene);
        Aabb<Real> const box = laws::about_eye(view, scene);
        Real const rounding = laws::scene_rounding(view, view.z_far);
        for (int i = 0; i < 4; ++i) {
            ViewVolume<Real> const part = laws::about_eye(view, slice_range(splits, i));
            LightBasis<Real> const axes{Vec3<Real>(basis.x), Vec3<Real>(basis.y), Vec3<Real>(basis.depth)};
            Aabb<Real> const seen = laws::clipped_bounds(part, axes, box, Real(0));
            EXPECT_TRUE(laws::holds(ours.box[i], seen, ours.slack)) << i;
            bool const none = is_empty(ours.box[i]);
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_EQ(ours.box[i].lo[axis] > ours.box[i].hi[axis], none) << "nothing on one axis alone";
            if (none) continue;
            Aabb<Real> const found{Vec3<Real>(ours.box[i].lo), Vec3<Real>(ours.box[i].hi)};
            EXPECT_TRUE(laws::holds(laws::clipped_bounds(part, axes, box, rounding), found, Real(0))) << i;
            ++met;
        }
        return met;
    }
};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SliceEdges, Scalars);

}  // namespace

TYPED_TEST(SliceEdges, BoundWhatClippingLeavesOfASceneInPerspective) {
    int met = 0;
    for (int i = 0; i < 40; ++i) {
        auto const view = this->some.view(ViewKind::perspective);
        met += this->expect_bounds(view, this->some.light(), this->some.box(view));
    }
    EXPECT_GT(met, 60);
}

TYPED_TEST(SliceEdges, BoundWhatClippingLeavesOfASceneInParallel) {
    int met = 0;
    for (int i = 0; i < 40; ++i) {
        auto const view = this->some.view(ViewKind::orthographic);
        met += this->expect_bounds(view, this->some.light(), this->some.box(view));
    }
    EXPECT_GT(met, 60);
}

TYPED_TEST(SliceEdges, BoundWhatIsAlongTheAxesOfEverything) {
    int met = 0;
    for (int i = 0; i < 40; ++i) {
        auto const view = this->some.view(i % 2 == 0 ? ViewKind::perspective : ViewKind::orthographic, true);
        met += this->expect_bounds(view, this->some.light(i % 4 < 2), this->some.box(view));
    }
    EXPECT_GT(met, 60);
}

TYPED_TEST(SliceEdges, BoundAFloorAWallAndAPost) {
    int met = 0;
    for (int i = 0; i < 40; ++i) {
        auto const view = this->some.view(i % 2 == 0 ? ViewKind::perspective : ViewKind::orthographic);
        auto box = this->some.box(view, i % 3);
        if (i % 4 == 3) box.hi[(i + 1) % 3] = box.lo[(i + 1) % 3];
        met += this->expect_bounds(view, this->some.light(), box);
    }
    EXPECT_GT(met, 40);
}
