// SPDX-License-Identifier: MIT
#include "tests/support/seen_boxes.hpp"

#include <shadowmath/view_of_box.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

using namespace shadowmath;

namespace {

template <class T>
struct ViewOfABox : ::testing::Test {
    using Real = long double;
    static constexpr Real eps = std::numeric_limits<T>::epsilon();
    static constexpr T nan = std::numeric_limits<T>::quiet_NaN();
    static constexpr T infinity = std::numeric_limits<T>::infinity();

    test::SeenBoxes<T> some;
    ViewVolume<T> view = perspective_view(
        pose_looking(Vec3<T>(T(3), T(-2), T(8)), Vec3<T>(T(0.1), T(-0.2), T(-1)), Vec3<T>(T(0.1), T(1), T(0))), T(1),
        T(1.5), T(0.1), T(60));
    LightBasis<T> basis = light_basis(directional(Vec3<T>(T(0.4), T(-1), T(0.3))).direction);
    Aabb<T> box{Vec3<T>(-10, -20, -30), Vec3<T>(10, 25, 12)};
    T farthest = T(50);

    static void expect_near(Real found, Real wanted, Real close) { EXPECT_LE(std::abs(found - wanted), close); }

    bool is_seen() const {
        detail::ViewOfBox<T> seen;
        return see(seen);
    }
    bool see(detail::ViewOfBox<T>& seen) const {
        seen.pose = &view.pose;
        EXPECT_TRUE(detail::look(basis, view, seen.lit));
        return detail::look_at_box(view, farthest, box, seen);
    }

    void make_flat() {
        view.kind = ViewKind::orthographic;
        view.left = T(-12), view.right = T(9), view.bottom = T(-7), view.top = T(5);
    }
    void expect_planes_a_little_farther_out() const {
        detail::ViewOfBox<T> seen;
        ASSERT_TRUE(see(seen));
        bool const flat = view.kind == ViewKind::orthographic;
        Real const sides = std::abs(view.left) + std::abs(view.right) + std::abs(view.bottom) + std::abs(view.top);
        Real const reach = flat ? farthest + sides : farthest * (1 + sides);
        Vec3<T> const& eye = view.pose.position;
        Real const slack = 16 * eps * (reach + std::abs(eye.x) + std::abs(eye.y) + std::abs(eye.z));
        expect_near(seen.slack, slack, 8 * eps * slack);
        Real const side[4] = {view.left, view.right, view.bottom, view.top};
        for (int i = 0; i < 4; ++i) {
            Real const outward = (i % 2 == 0 ? -slack : slack) * (flat ? 1 : 1 + std::abs(side[i]));
            EXPECT_EQ(seen.slope[i], flat ? T(0) : T(side[i])) << i;
            Real const wanted = flat ? side[i] + outward : outward;
            expect_near(seen.offset[i], wanted, 8 * eps * std::abs(wanted));
        }
        for (int axis = 0; axis < 3; ++axis) {
            auto const limited = [reach](Real value) { return std::clamp(value, -2 * reach, 2 * reach); };
            Real const lo = limited(Real(box.lo[axis]) - eye[axis] - slack);
            Real const hi = limited(Real(box.hi[axis]) - eye[axis] + slack);
            expect_near(seen.lo[axis], lo, 8 * eps * (std::abs(lo) + slack));
            expect_near(seen.hi[axis], hi, 8 * eps * (std::abs(hi) + slack));
        }
    }

    // Each of the twelve edges once, and of it what clipping leaves. How many are seen.
    int expect_edges() const {
        detail::ViewOfBox<T> seen;
        EXPECT_TRUE(see(seen));
        detail::EdgesOfBox<T> edges;
        detail::cut_box_edges(seen, edges);
        Vec3<Real> const lo(seen.lo[0], seen.lo[1], seen.lo[2]), hi(seen.hi[0], seen.hi[1], seen.hi[2]);
        Vec3<Real> const ahead(view.pose.forward);
        Real const size = glm::length(lo) + glm::length(hi), close = 16 * eps * size;
        int met = 0;
        for (int axis = 0; axis < 3; ++axis) {
            std::set<int> places;
            expect_near(edges.per_ahead[axis] * ahead[axis], 1, 4 * eps);
            for (int k = 4 * axis; k < 4 * axis + 4; ++k) {
                Vec3<Real> const at = Vec3<Real>(basis.x) * Real(edges.x[k]) + Vec3<Real>(basis.y) * Real(edges.y[k]) +
                                      Vec3<Real>(basis.depth) * Real(edges.z[k]);
                Vec3<Real> from;
                int place = 0;
                for (int i = 0; i < 3; ++i) {
                    bool const upper = std::abs(at[i] - hi[i]) < std::abs(at[i] - lo[i]);
                    from[i] = upper ? hi[i] : lo[i];
                    expect_near(at[i], from[i], close);
                    EXPECT_FALSE(upper && i == axis) << axis << ' ' << k;
                    place += upper ? 1 << i : 0;
                }
                EXPECT_TRUE(places.insert(place).second) << axis << ' ' << k;
                expect_near(edges.ahead[k] * ahead[axis], glm::dot(from, ahead), close);
                Real first = 0, last = hi[axis] - lo[axis], unsure = 0;
                for (int side = 0; side < 4; ++side) {
                    Vec3<Real> const across(side < 2 ? view.pose.right : view.pose.up);
                    Real const sign = side % 2 == 0 ? 1 : -1;
                    Vec3<Real> const inward = (across - ahead * Real(seen.slope[side])) * sign;
                    Real const inside = glm::dot(inward, from) - sign * seen.offset[side];
                    Real const met_at = -inside / inward[axis];
                    (inward[axis] > 0 ? first : last) =
                        inward[axis] > 0 ? std::max(first, met_at) : std::min(last, met_at);
                    unsure = std::max(unsure, 16 * eps * size / std::abs(inward[axis]));
                }
                if (std::abs(first - last) > 2 * unsure) {
                    EXPECT_EQ(edges.first[k] <= edges.last[k], first <= last) << axis << ' ' << k;
                }
                if (!(first <= last)) continue;
                expect_near(edges.first[k], first, unsure);
                expect_near(edges.last[k], last, unsure);
                ++met;
            }
        }
        return met;
    }
};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ViewOfABox, Scalars);

}  // namespace

TYPED_TEST(ViewOfABox, HasEveryPlaneALittleFartherOut) {
    this->expect_planes_a_little_farther_out();
    this->make_flat();
    this->expect_planes_a_little_farther_out();
}

TYPED_TEST(ViewOfABox, IsTakenNoFartherOutThanTwiceItsReach) {
    using T = TypeParam;
    this->box = {Vec3<T>(T(-1e30)), Vec3<T>(T(1e30))};
    this->expect_planes_a_little_farther_out();
    this->make_flat();
    this->expect_planes_a_little_farther_out();
    this->box = {Vec3<T>(T(1e29)), Vec3<T>(T(1e30))};
    this->expect_planes_a_little_farther_out();
}

TYPED_TEST(ViewOfABox, OfNumbersUpTo1e12IsSeen) {
    using T = TypeParam;
    T const most = T(1e12), more = std::nextafter(most, T(2e12));
    for (int axis = 0; axis < 3; ++axis)
        for (T const sign : {T(1), T(-1)}) {
            T const was = this->view.pose.position[axis];
            this->view.pose.position[axis] = sign * most;
            EXPECT_TRUE(this->is_seen()) << axis;
            this->view.pose.position[axis] = sign * more;
            EXPECT_FALSE(this->is_seen()) << axis;
            this->view.pose.position[axis] = was;
        }
    this->view.bottom = T(-1), this->view.top = T(1), this->view.right = T(1);
    this->view.left = T(3) - most, this->farthest = T(0.125);
    EXPECT_TRUE(this->is_seen()) << "slopes";
    this->view.left = T(0), this->farthest = T(2.5e11);
    EXPECT_TRUE(this->is_seen()) << "slopes times farthest";
    this->make_flat();
    this->farthest = T(9e11);
    EXPECT_TRUE(this->is_seen());
    this->view.left = T(-2e11);
    EXPECT_FALSE(this->is_seen()) << "sides and farthest together";
    this->farthest = T(50);
    this->view.left = -more;
    EXPECT_FALSE(this->is_seen()) << "sides";
    this->view.kind = ViewKind::perspective;
    this->farthest = T(1e-3);
    EXPECT_FALSE(this->is_seen()) << "slopes";
    this->view.left = T(-1e3);
    this->farthest = T(9e8);
    EXPECT_TRUE(this->is_seen());
    this->farthest = T(1.1e9);
    EXPECT_FALSE(this->is_seen()) << "sides times farthest";
}

TYPED_TEST(ViewOfABox, OfNoBoxIsNone) {
    using T = TypeParam;
    Aabb<T> const good = this->box;
    EXPECT_TRUE(this->is_seen());
    for (int axis = 0; axis < 3; ++axis) {
        for (T const bad : {this->nan, this->infinity, -this->infinity}) {
            this->box = good;
            this->box.lo[axis] = bad;
            EXPECT_FALSE(this->is_seen()) << axis;
            this->box = good;
            this->box.hi[axis] = bad;
            EXPECT_FALSE(this->is_seen()) << axis;
        }
        this->box = good;
        this->box.hi[axis] = this->box.lo[axis];
        EXPECT_TRUE(this->is_seen()) << axis;
        this->box.hi[axis] = this->box.lo[axis] - T(1);
        EXPECT_FALSE(this->is_seen()) << axis;
    }
}

TYPED_TEST(ViewOfABox, OfAxesLongerThanUnitVectorsIsNone) {
    using T = TypeParam;
    auto const pose = this->view.pose;
    auto const light = this->basis;
    for (Vec3<T> Pose<T>::*axis : {&Pose<T>::right, &Pose<T>::up, &Pose<T>::forward})
        for (T const longer : {T(8), T(-8)}) {
            this->view.pose = pose;
            this->view.pose.*axis *= longer;
            EXPECT_FALSE(this->is_seen());
        }
    this->view.pose = pose;
    EXPECT_TRUE(this->is_seen());
    for (Vec3<T> LightBasis<T>::*axis : {&LightBasis<T>::x, &LightBasis<T>::y, &LightBasis<T>::depth}) {
        this->basis = light;
        // As long as look() lets pass, all together.
        this->basis.*axis = Vec3<T>(T(1.9), T(-1.9), T(1.9));
        this->view.pose = pose;
        this->view.pose.right *= T(2.5);
        EXPECT_FALSE(this->is_seen());
    }
}

TYPED_TEST(ViewOfABox, HasItsTwelveEdgesCutByTheFourSides) {
    int met = this->expect_edges();
    for (int i = 0; i < 60; ++i) {
        this->view = this->some.view(i % 3 == 2 ? ViewKind::orthographic : ViewKind::perspective);
        this->basis = this->some.light();
        this->box = this->some.box(this->view);
        met += this->expect_edges();
    }
    EXPECT_GT(met, 100);
}
