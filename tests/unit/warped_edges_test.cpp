// SPDX-License-Identifier: MIT
#include "tests/laws/slices_in_scene.hpp"
#include "tests/support/seen_boxes.hpp"

#include <shadowmath/warped_edges.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace shadowmath;

namespace {

using Real = long double;

struct Extents {
    Real lo = 1e30L, hi = -1e30L;
    void add(Real value) { lo = std::min(lo, value), hi = std::max(hi, value); }
};

// What a slice comes to behind a warp.
struct Behind {
    Extents x, depth;  // x / w, depth / w
    Real nearest = 1e30L;
};

template <class T>
struct WarpedEdges : ::testing::Test {
    test::SeenBoxes<T> some;

    static Behind behind(ViewVolume<Real> const& part, LightBasis<T> const& basis, Aabb<Real> const& box, Real slack,
                         Real slope, Real offset, Real first) {
        Behind found;
        for_each_vertex(visible_body(part, box, slack), [&](Vec3<Real> const& v) {
            Real const w = slope * glm::dot(Vec3<Real>(basis.y), v) + offset;
            found.x.add(glm::dot(Vec3<Real>(basis.x), v) / w);
            found.depth.add((glm::dot(Vec3<Real>(basis.depth), v) - first) / w);
            found.nearest = std::min(found.nearest, glm::dot(Vec3<Real>(part.pose.forward), v));
        });
        return found;
    }

    int expect_warped(ViewVolume<T> const& view, LightBasis<T> const& basis, Aabb<T> const& scene) {
        using namespace shadowmath::detail;
        Splits<T> const splits = practical_splits(view.z_near, view.z_far, 4);
        ViewOfBox<T> seen;
        seen.pose = &view.pose;
        EXPECT_TRUE(look(basis, view, seen.lit));
        EXPECT_TRUE(look_at_box(view, splits.plane[4], scene, seen));
        Lanes<T> const begin = four_at(splits.plane), end = four_at(splits.plane + 1);
        EdgesInLight<T> const edges(seen, begin, end);
        KeptEdges<T> kept;
        ExtentsOfSlices<T> of, same;
        T ahead[16];
        kept.keep_all(seen, edges, of, ahead);
        bound_four_slices(seen, splits.plane, same);
        Lanes<T> const nearest = least_of(ahead);

        T slope[4], offset[4], first[4];
        for (int i = 0; i < 4; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_EQ(least_of(of.lo[axis])[i], least_of(same.lo[axis])[i]) << axis << ' ' << i;
                EXPECT_EQ(largest_of(of.hi[axis])[i], largest_of(same.hi[axis])[i]) << axis << ' ' << i;
            }
            T const lo = least_of(of.lo[1])[i], hi = largest_of(of.hi[1])[i];
            bool const any = lo <= hi;
            slope[i] = any && i != 1 ? some.from_to(0.1, 3) / (hi - lo) : T(0);
            offset[i] = any ? T(1) - lo * slope[i] : T(1);
            first[i] = any ? least_of(of.lo[2])[i] - some.from_to(0, 30) : T(0);
        }
        WarpedEnds<T> const ends(edges, kept, four_at(slope), four_at(offset));
        Lanes<T> const lo = least_of(ends.lo), hi = largest_of(ends.hi), deepest = ends.deepest(four_at(first));

        int met = 0;
        Aabb<Real> const box = laws::about_eye(view, scene);
        Real const rounding = laws::scene_rounding(view, view.z_far);
        for (int i = 0; i < 4; ++i) {
            ViewVolume<Real> const part = laws::about_eye(view, slice_range(splits, i));
            auto const of_slack = [&](Real slack) {
                return behind(part, basis, box, slack, slope[i], offset[i], first[i]);
            };
            Behind const exact = of_slack(0), wider = of_slack(rounding);
            if (wider.x.lo > wider.x.hi) {
                EXPECT_GE(lo[i], T(1e36));
                EXPECT_LE(hi[i], T(-1e36));
                EXPECT_GE(nearest[i], T(1e36));
                EXPECT_LE(deepest[i], T(0));
            }
            if (exact.x.lo > exact.x.hi) continue;
            // Of a place that is off by d, x / w is off by d (1 + |x / w| slope), w being no less than 1.
            auto const off = [&](Real value) { return rounding * (1 + std::abs(value) * slope[i]); };
            EXPECT_LE(lo[i], exact.x.lo + off(exact.x.lo)) << i;
            EXPECT_GE(lo[i], wider.x.lo - off(wider.x.lo)) << i;
            EXPECT_GE(hi[i], exact.x.hi - off(exact.x.hi)) << i;
            EXPECT_LE(hi[i], wider.x.hi + off(wider.x.hi)) << i;
            EXPECT_LE(nearest[i], exact.nearest + rounding) << i;
            EXPECT_GE(nearest[i], wider.nearest - rounding) << i;
            EXPECT_GE(deepest[i], exact.depth.hi - off(exact.depth.hi)) << i;
            EXPECT_LE(deepest[i], wider.depth.hi + off(wider.depth.hi)) << i;
            ++met;
        }
        return met;
    }
};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(WarpedEdges, Scalars);

}  // namespace

TYPED_TEST(WarpedEdges, BoundWhatAWarpMakesOfAPerspective) {
    int met = 0;
    for (int i = 0; i < 40; ++i) {
        auto const view = this->some.view(ViewKind::perspective);
        met += this->expect_warped(view, this->some.light(), this->some.box(view));
    }
    EXPECT_GT(met, 60);
}

TYPED_TEST(WarpedEdges, BoundWhatAWarpMakesOfAnOrthographicView) {
    int met = 0;
    for (int i = 0; i < 40; ++i) {
        auto const view = this->some.view(ViewKind::orthographic);
        met += this->expect_warped(view, this->some.light(), this->some.box(view));
    }
    EXPECT_GT(met, 60);
}

TYPED_TEST(WarpedEdges, BoundWhatAWarpMakesOfAFloor) {
    int met = 0;
    for (int i = 0; i < 40; ++i) {
        auto const view = this->some.view(i % 2 == 0 ? ViewKind::perspective : ViewKind::orthographic);
        met += this->expect_warped(view, this->some.light(), this->some.box(view, i % 3));
    }
    EXPECT_GT(met, 40);
}
