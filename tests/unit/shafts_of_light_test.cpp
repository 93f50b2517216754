// SPDX-License-Identifier: MIT
#include "tests/support/seen_boxes.hpp"

#include <shadowmath/polytope.hpp>
#include <shadowmath/shafts_of_light.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace shadowmath;

namespace {

using Real = long double;

template <class T>
struct ShaftsOfLights : ::testing::Test {
    static constexpr Real eps = std::numeric_limits<T>::epsilon();
    static constexpr Real none = 1e30L;

    struct Shaft {
        T x_lo, x_hi, y_lo, y_hi, w_slope, w_offset;
    };
    test::SeenBoxes<T> some;

    // About a place in the box, or beside it.
    Shaft some_shaft(LightBasis<T> const& basis, Aabb<T> const& box) {
        Vec3<T> const share(some.from_to(-0.2, 1.2), some.from_to(-0.2, 1.2), some.from_to(-0.2, 1.2));
        Vec3<T> const at = box.lo + (box.hi - box.lo) * share;
        T const x = glm::dot(at, basis.x), y = glm::dot(at, basis.y), width = some.from_to(0.01, 1);
        Shaft shaft;
        shaft.y_lo = y - some.from_to(0.1, 20), shaft.y_hi = y + some.from_to(0.1, 20);
        shaft.w_slope = some.from_to(-0.1, 0.3);
        if (shaft.w_slope < T(0)) shaft.w_slope = T(0);
        shaft.w_offset = T(1) - shaft.y_lo * shaft.w_slope;
        T const w = shaft.w_slope * y + shaft.w_offset;
        shaft.x_lo = x / w - width * some.from_to(0.1, 20), shaft.x_hi = x / w + width * some.from_to(0.1, 20);
        return shaft;
    }

    // By clipping the box, each side of the shaft moved outward by what places in the box are rounded by, `times`.
    static Real clipped_first(Shaft const& shaft, LightBasis<T> const& basis, Aabb<T> const& box, Real times) {
        if (is_empty(box)) return none;
        Vec3<Real> const x(basis.x), y(basis.y), far_end(glm::max(glm::abs(box.lo), glm::abs(box.hi)));
        Real const rounding = times * 8 * eps * (far_end.x + far_end.y + far_end.z);
        Real const slope = shaft.w_slope, offset = shaft.w_offset;
        auto const side = [&](Real at, Real sign) {
            return Vec4<Real>(
                sign * (x - y * (at * slope)),
                rounding * (1 + std::abs(at * slope)) + times * 8 * eps * std::abs(at * offset) - sign * at * offset);
        };
        ConvexBody<Real> body = convex_body(Aabb<Real>{Vec3<Real>(box.lo), Vec3<Real>(box.hi)});
        body = clipped(body, Vec4<Real>(y, rounding - shaft.y_lo));
        body = clipped(body, Vec4<Real>(-y, rounding + shaft.y_hi));
        body = clipped(body, side(shaft.x_lo, 1));
        body = clipped(body, side(shaft.x_hi, -1));
        Real first = none;
        for_each_vertex(body,
                        [&](Vec3<Real> const& v) { first = std::min(first, glm::dot(v, Vec3<Real>(basis.depth))); });
        return first;
    }

    static detail::Lanes<T> first_met(Shaft const (&of)[4], LightBasis<T> const& basis, Aabb<T> const& box,
                                      T reach = T(1e6)) {
        using Four = detail::Lanes<T>;
        auto const four = [&of](T Shaft::*part) {
            return Four::of(of[0].*part, of[1].*part, of[2].*part, of[3].*part);
        };
        detail::ShaftsOfLight<T> const shafts{four(&Shaft::x_lo), four(&Shaft::x_hi),    four(&Shaft::y_lo),
                                              four(&Shaft::y_hi), four(&Shaft::w_slope), four(&Shaft::w_offset)};
        return detail::LightOnBox<T>(shafts, basis, box, detail::all_four(reach)).first_met(shafts);
    }

    // How many shafts meet the box.
    int expect_first_met(Shaft const (&shafts)[4], LightBasis<T> const& basis, Aabb<T> const& box) {
        detail::Lanes<T> const found = first_met(shafts, basis, box);
        Vec3<T> const far_end(glm::max(glm::abs(box.lo), glm::abs(box.hi)));
        Real const rounding = 64 * eps * (far_end.x + far_end.y + far_end.z);
        int met = 0;
        for (int i = 0; i < 4; ++i) {
            Real const exact = clipped_first(shafts[i], basis, box, 0);
            Real const wider = clipped_first(shafts[i], basis, box, 4);
            if (wider == none) {
                EXPECT_GE(found[i], T(1e36)) << i;
            }
            if (exact == none) continue;
            EXPECT_LE(found[i], exact) << i;
            EXPECT_GE(found[i], wider - rounding) << i;
            ++met;
        }
        return met;
    }
    int expect_first_met(LightBasis<T> const& basis, Aabb<T> const& box) {
        Shaft shafts[4];
        for (Shaft& shaft : shafts) shaft = some_shaft(basis, box);
        return expect_first_met(shafts, basis, box);
    }
    Aabb<T> some_box(double most) {
        Vec3<T> const centre = some.point(30),
                      half(some.from_to(0, most), some.from_to(0, most), some.from_to(0, most));
        return {centre - half, centre + half};
    }
};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ShaftsOfLights, Scalars);

}  // namespace

TYPED_TEST(ShaftsOfLights, FirstMeetABoxWhereClippingSaysSo) {
    int met = 0;
    for (int i = 0; i < 100; ++i) met += this->expect_first_met(this->some.light(), this->some_box(20));
    EXPECT_GT(met, 200);
}

TYPED_TEST(ShaftsOfLights, FirstMeetASmallBoxOrALargeOneWhereClippingSaysSo) {
    int met = 0;
    for (int i = 0; i < 60; ++i) met += this->expect_first_met(this->some.light(), this->some_box(i % 2 ? 1 : 200));
    EXPECT_GT(met, 100);
}

// So that their own edges, which lean the most, are where they enter it.
TYPED_TEST(ShaftsOfLights, NarrowAndSteepFirstMeetALargeBoxWhereClippingSaysSo) {
    using T = TypeParam;
    int met = 0;
    for (int i = 0; i < 150; ++i) {
        auto const basis = this->some.light();
        auto const box = this->some_box(200);
        typename TestFixture::Shaft shafts[4];
        for (auto& shaft : shafts) {
            shaft = this->some_shaft(basis, box);
            T const middle = (shaft.y_lo + shaft.y_hi) / T(2), x = (shaft.x_lo + shaft.x_hi) / T(2);
            T const w = shaft.w_slope * middle + shaft.w_offset;
            shaft.y_lo = middle - this->some.from_to(0.01, 1), shaft.y_hi = middle + this->some.from_to(0.01, 1);
            shaft.w_slope = this->some.from_to(0.5, 4);
            shaft.w_offset = T(1) - shaft.w_slope * shaft.y_lo;
            T const now = shaft.w_slope * middle + shaft.w_offset;
            shaft.x_lo = x * w / now - T(0.01), shaft.x_hi = x * w / now + T(0.01);
        }
        met += this->expect_first_met(shafts, basis, box);
    }
    EXPECT_GT(met, 200);
}

TYPED_TEST(ShaftsOfLights, FirstMeetABoxAlongItsAxesWhereClippingSaysSo) {
    using T = TypeParam;
    int met = 0;
    LightBasis<T> const up{Vec3<T>(1, 0, 0), Vec3<T>(0, 0, 1), Vec3<T>(0, 1, 0)};
    LightBasis<T> const aside{Vec3<T>(0, 1, 0), Vec3<T>(0, 0, 1), Vec3<T>(1, 0, 0)};
    for (LightBasis<T> const& basis : {LightBasis<T>{}, up, aside})
        for (int i = 0; i < 20; ++i) met += this->expect_first_met(basis, this->some_box(20));
    EXPECT_GT(met, 100);
}

// As wide as anything may be said to be.
TYPED_TEST(ShaftsOfLights, WithoutAnEndMeetAllOfABox) {
    using T = TypeParam;
    for (int i = 0; i < 20; ++i) {
        auto const basis = this->some.light();
        auto const box = this->some_box(20);
        typename TestFixture::Shaft shafts[4];
        for (auto& shaft : shafts) {
            shaft = this->some_shaft(basis, box);
            shaft.y_hi = T(1e37);
        }
        shafts[1].w_slope = T(0), shafts[1].w_offset = T(1);
        shafts[1].x_lo = T(-1000), shafts[1].x_hi = T(1000), shafts[1].y_lo = T(-1000);
        this->expect_first_met(shafts, basis, box);
    }
}

// Where a side only touches the box, what is less by a rounding may not be more by one.
TYPED_TEST(ShaftsOfLights, ThatTouchABoxMeetIt) {
    using T = TypeParam;
    int met = 0;
    for (int i = 0; i < 200; ++i) {
        auto const basis = this->some.light();
        auto const box = this->some_box(20);
        auto shaft = this->some_shaft(basis, box);
        shaft.y_lo = T(-100), shaft.y_hi = T(100);
        shaft.w_offset = T(1) + T(100) * shaft.w_slope;
        Real x_lo = 1e30L, x_hi = -1e30L, y_lo = 1e30L, y_hi = -1e30L, y_at_x_lo = 0, y_at_x_hi = 0;
        for (Vec3<T> const& corner : corners(box)) {
            Real const y = glm::dot(Vec3<Real>(corner), Vec3<Real>(basis.y));
            Real const x = glm::dot(Vec3<Real>(corner), Vec3<Real>(basis.x)) / (shaft.w_slope * y + shaft.w_offset);
            if (x < x_lo) x_lo = x, y_at_x_lo = y;
            if (x > x_hi) x_hi = x, y_at_x_hi = y;
            y_lo = std::min(y_lo, y), y_hi = std::max(y_hi, y);
        }
        auto const below = [](Real value) { return std::nextafter(T(value), T(-1e9)); };
        auto const above = [](Real value) { return std::nextafter(T(value), T(1e9)); };
        T const room = T(1e-3);
        typename TestFixture::Shaft shafts[4] = {shaft, shaft, shaft, shaft};
        shafts[0].x_lo = below(x_hi), shafts[0].x_hi = T(x_hi) + room;
        shafts[1].x_lo = T(x_lo) - room, shafts[1].x_hi = above(x_lo);
        if (i % 2 == 0) shafts[0].y_lo = below(y_at_x_hi), shafts[0].y_hi = above(y_at_x_hi);
        if (i % 2 == 0) shafts[1].y_lo = below(y_at_x_lo), shafts[1].y_hi = above(y_at_x_lo);
        shafts[2].x_lo = shafts[3].x_lo = T(x_lo) - room, shafts[2].x_hi = shafts[3].x_hi = T(x_hi) + room;
        shafts[2].y_lo = below(y_hi), shafts[3].y_hi = above(y_lo);
        met += this->expect_first_met(shafts, basis, box);
    }
    EXPECT_GT(met, 700);
}

TYPED_TEST(ShaftsOfLights, MeetNoBoxAndHaveNoBoxToMeetWhereTheirEndsAreCrossed) {
    using T = TypeParam;
    for (int i = 0; i < 20; ++i) {
        auto const basis = this->some.light();
        auto const box = this->some_box(20);
        typename TestFixture::Shaft shafts[4];
        for (auto& shaft : shafts) shaft = this->some_shaft(basis, box);
        for (int axis = 0; axis < 3; ++axis) {
            auto empty = box;
            empty.hi[axis] = empty.lo[axis] - T(1);
            auto const found = this->first_met(shafts, basis, empty);
            for (int k = 0; k < 4; ++k) EXPECT_GE(found[k], T(1e36)) << axis << ' ' << k;
        }
        for (auto& shaft : shafts) shaft.y_hi = shaft.y_lo - T(40);
        auto const found = this->first_met(shafts, basis, box);
        for (int k = 0; k < 4; ++k) EXPECT_GE(found[k], T(1e36)) << k;
    }
}

TYPED_TEST(ShaftsOfLights, MeetABoxNoFartherOutThanTheirReach) {
    using T = TypeParam;
    int met = 0;
    for (int i = 0; i < 40; ++i) {
        auto const basis = this->some.light();
        auto const box = this->some_box(20);
        typename TestFixture::Shaft shafts[4];
        for (auto& shaft : shafts) shaft = this->some_shaft(basis, box);
        Aabb<T> endless = box;
        for (int axis = 0; axis < 3; ++axis)
            (i >> axis & 1 ? endless.lo : endless.hi)[axis] = T(i >> axis & 1 ? -1e30 : 1e30);
        Aabb<T> const near_enough{glm::max(endless.lo, Vec3<T>(-100)), glm::min(endless.hi, Vec3<T>(100))};
        auto const found = this->first_met(shafts, basis, endless, T(100));
        auto const wanted = this->first_met(shafts, basis, near_enough, T(1000));
        for (int k = 0; k < 4; ++k) {
            EXPECT_EQ(found[k], wanted[k]) << k;
            met += wanted[k] < T(1e36);
        }
    }
    EXPECT_GT(met, 80);
}
