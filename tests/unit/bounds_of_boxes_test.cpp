// SPDX-License-Identifier: MIT
#include "tests/support/seen_boxes.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/projected_bounds.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

using namespace shadowmath;

namespace {

using Real = long double;

template <class T>
struct BoundsOfManyBoxes : ::testing::Test {
    static constexpr int block = detail::bodies_at_once;
    test::SeenBoxes<T> some;
    std::vector<Aabb<T>> boxes;
    Mat4<T> matrix{T(1)};
    T w_min = T(0.5);

    Aabb<T> bounds() const {
        std::vector<T> ends[6];
        for (Aabb<T> const& box : boxes)
            for (int axis = 0; axis < 3; ++axis) {
                ends[axis].push_back(box.lo[axis]);
                ends[axis + 3].push_back(box.hi[axis]);
            }
        BoxArrays<T> const arrays{ends[0].data(), ends[1].data(), ends[2].data(),
                                  ends[3].data(), ends[4].data(), ends[5].data()};
        auto const found =
            test::watched([&] { return projected_bounds(matrix, arrays, static_cast<int>(boxes.size()), w_min); });
        EXPECT_TRUE(found.calm());
        return found.result;
    }

    // Of the corners at w >= w_min, and where edges pass through it.
    static void add(Aabb<Real>& bounds, Mat4<T> const& m, Aabb<T> const& box, Real least_w) {
        if (is_empty(box) || !all_finite(box)) return;
        auto const corner = corners(Aabb<Real>{Vec3<Real>(box.lo), Vec3<Real>(box.hi)});
        Mat4<Real> const exact(m);
        auto const add_point = [&bounds](Vec4<Real> const& p) { bounds = merge(bounds, Vec3<Real>(p) / p.w); };
        for (unsigned i = 0; i < 8; ++i) {
            Vec4<Real> const a = exact * Vec4<Real>(corner[i], 1);
            if (a.w >= least_w) add_point(a);
            for (unsigned j : {i ^ 1u, i ^ 2u, i ^ 4u}) {
                Vec4<Real> const b = exact * Vec4<Real>(corner[j], 1);
                if (a.w < least_w && b.w > least_w) add_point(a + (b - a) * ((least_w - a.w) / (b.w - a.w)));
            }
        }
    }
    void expect_merged() const {
        Aabb<Real> wanted;
        for (Aabb<T> const& box : boxes) {
            if (all_finite(box) && !is_empty(box) && detail::largest_of(box) > T(0x1p60)) {
                // So far out that what is rounded is all that is left: as of the box by itself.
                Aabb<T> const alone = projected_bounds(matrix, corners(box), w_min);
                if (!is_empty(alone)) wanted = merge(wanted, Aabb<Real>{Vec3<Real>(alone.lo), Vec3<Real>(alone.hi)});
            } else {
                add(wanted, matrix, box, w_min);
            }
        }
        Aabb<T> const found = bounds();
        ASSERT_EQ(is_empty(found), is_empty(wanted));
        if (is_empty(wanted)) return;
        Real const close = sizeof(T) == 4 ? 1e-4L : 1e-12L;
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LE(std::abs(found.lo[axis] - wanted.lo[axis]), close * (1 + std::abs(wanted.lo[axis]))) << axis;
            EXPECT_LE(std::abs(found.hi[axis] - wanted.hi[axis]), close * (1 + std::abs(wanted.hi[axis]))) << axis;
        }
    }

    Vec4<T> some_row() { return {some.point(1), some.from_to(-5, 5)}; }
    void draw_affine() {
        matrix = from_rows(some_row(), some_row(), some_row(), Vec4<T>(0, 0, 0, some.from_to(0.6, 3)));
    }
    // w along some axis, or none.
    void draw_perspective() {
        Vec3<T> const ahead = safe_normalize(some.point(1)).direction;
        matrix = from_rows(some_row(), some_row(), some_row(), Vec4<T>(ahead, some.from_to(-1, 1)));
        w_min = some.from_to(0.5, 4);
    }
    Aabb<T> some_box(double out) {
        Vec3<T> const centre = some.point(out);
        Vec3<T> const half(some.from_to(0, 4), some.from_to(0, 4), some.from_to(0, 4));
        return {centre - half, centre + half};
    }
    void draw_boxes(int count, double out = 20) {
        boxes.clear();
        for (int i = 0; i < count; ++i) boxes.push_back(some_box(out));
    }
    // All at w >= w_min.
    void draw_boxes_in_front(int count) {
        boxes.clear();
        Vec4<T> const w = row(matrix, 3);
        while (static_cast<int>(boxes.size()) < count) {
            Aabb<T> box = some_box(10);
            T const up = T(30) - std::min(T(0), glm::dot(Vec3<T>(w), box.lo));
            box.lo += Vec3<T>(w) * up, box.hi += Vec3<T>(w) * up;
            boxes.push_back(box);
        }
    }
};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(BoundsOfManyBoxes, Scalars);

}  // namespace

TYPED_TEST(BoundsOfManyBoxes, OfAnAffineMatrixAreThoseOfEachMerged) {
    for (int i = 0; i < 60; ++i) {
        this->draw_affine();
        this->draw_boxes(1 + i);
        this->expect_merged();
    }
}

TYPED_TEST(BoundsOfManyBoxes, OfAPerspectiveAreThoseOfEachMerged) {
    for (int i = 0; i < 60; ++i) {
        this->draw_perspective();
        this->draw_boxes_in_front(1 + i);
        this->expect_merged();
    }
}

TYPED_TEST(BoundsOfManyBoxes, OfBoxesAstrideOfWMinAreThoseOfEachMerged) {
    for (int i = 0; i < 200; ++i) {
        this->draw_perspective();
        this->draw_boxes(1 + i % 40, 3);
        this->expect_merged();
    }
}

TYPED_TEST(BoundsOfManyBoxes, OfWAlongAnAxisAreThoseOfEachMerged) {
    using T = TypeParam;
    for (int i = 0; i < 24; ++i) {
        this->draw_perspective();
        for (int column = 0; column < 4; ++column) this->matrix[column][3] = column == i % 3 ? T(1) : T(0);
        if (i % 2 == 0) this->matrix[i % 3][3] = this->some.from_to(-2, 2);
        this->matrix[3][3] = T(4);
        this->draw_boxes(1 + i, 6);
        this->expect_merged();
    }
}

TYPED_TEST(BoundsOfManyBoxes, OfFloorsWallsAndPointsAreThoseOfEachMerged) {
    for (int i = 0; i < 60; ++i) {
        if (i % 2 == 0)
            this->draw_affine();
        else
            this->draw_perspective();
        this->draw_boxes_in_front(1 + i);
        for (auto& box : this->boxes)
            for (int axis = 0; axis < 3; ++axis)
                if (i % 4 == 3 || i / 4 % 3 == axis) box.hi[axis] = box.lo[axis];
        this->expect_merged();
    }
}

// Exactly: of w = -z every place is a number.
TYPED_TEST(BoundsOfManyBoxes, OfABoxThatEndsAtWMinAreThoseOfItsLastFace) {
    using T = TypeParam;
    this->matrix[2][3] = T(-1), this->matrix[3][3] = T(0);
    this->boxes = {{Vec3<T>(-2, -3, T(-0.5)), Vec3<T>(4, 5, 7)}};
    Aabb<T> const found = this->bounds();
    EXPECT_EQ(found.lo, Vec3<T>(-4, -6, -1));
    EXPECT_EQ(found.hi, Vec3<T>(8, 10, -1));
}

TYPED_TEST(BoundsOfManyBoxes, OfOneBoxAreItsOwn) {
    for (int i = 0; i < 200; ++i) {
        if (i % 2 == 0)
            this->draw_affine();
        else
            this->draw_perspective();
        this->draw_boxes(1, 4);
        this->expect_merged();
    }
}

TYPED_TEST(BoundsOfManyBoxes, LeaveOutWhatIsEmptyOrNoNumberAndHoldWhatIsFarAway) {
    using T = TypeParam;
    for (int i = 0; i < 120; ++i) {
        if (i % 2 == 0)
            this->draw_affine();
        else
            this->draw_perspective();
        this->draw_boxes(1 + i);
        for (int k = 0; k <= i; ++k) {
            auto& box = this->boxes[static_cast<std::size_t>(k)];
            int const axis = (i + k) % 3;
            if (k % 5 == 1) box.lo[axis] = box.hi[axis] + T(1);
            if (i % 3 == 1 && k % 7 == 3) box.hi[axis] = std::numeric_limits<T>::quiet_NaN();
            if (i % 3 == 1 && k % 7 == 5) box.lo[axis] = -std::numeric_limits<T>::infinity();
            if (i % 6 == 2 && k % 19 == 2) box.hi[axis] = T(0x1p62);
            if (i % 6 == 5 && k % 19 == 2) box.lo[axis] = T(-0x1p62);
            if (i % 8 == 7) std::swap(box.lo[axis], box.hi[axis]);
        }
        this->expect_merged();
    }
}

// In float the quotients of both would be infinite: of one because nothing of it is ahead, of the other because it is
// as far out as that.
TYPED_TEST(BoundsOfManyBoxes, OfWhatIsBeyondNumbersAreTheLargestNumberAndOfWhatIsBehindNone) {
    using T = TypeParam;
    this->matrix = from_rows(Vec4<T>(T(1e12), 0, 0, 0), Vec4<T>(0, 1, 0, 0), Vec4<T>(0, 0, 1, 0), Vec4<T>(0, 0, -1, 0));
    this->w_min = T(1e-15);
    Aabb<T> const ahead{Vec3<T>(-1, -1, -5), Vec3<T>(1, 1, -4)};
    this->boxes = {ahead, {Vec3<T>(T(-1e12), -1, 5), Vec3<T>(T(1e12), 1, 6)}};
    this->expect_merged();
    EXPECT_LE(this->bounds().hi.x, T(2.6e11));
    this->boxes = {ahead, {Vec3<T>(T(-1e12), -1, T(-2e-15)), Vec3<T>(T(1e12), 1, T(-1e-15))}};
    Aabb<T> const alone = projected_bounds(this->matrix, corners(this->boxes[1]), this->w_min), found = this->bounds();
    EXPECT_NEAR(double(found.lo.x / alone.lo.x), 1, 1e-6);
    EXPECT_NEAR(double(found.hi.x / alone.hi.x), 1, 1e-6);
    EXPECT_TRUE(all_finite(found));
    // Divided once at the end.
    this->matrix =
        from_rows(Vec4<T>(T(1e12), 0, 0, 0), Vec4<T>(0, 1, 0, 0), Vec4<T>(0, 0, 1, 0), Vec4<T>(0, 0, 0, T(1e-15)));
    Aabb<T> const flat = this->bounds();
    EXPECT_TRUE(all_finite(flat));
    EXPECT_GE(flat.hi.x, sizeof(T) == 4 ? std::numeric_limits<T>::max() : T(9.9e38));
}

// What comes after some hundred others is looked at only where it may reach farther.
TYPED_TEST(BoundsOfManyBoxes, HoldTheOneOfHundredsThatReachesFartherOnOneSide) {
    using T = TypeParam;
    for (int i = 0; i < 24; ++i) {
        this->draw_perspective();
        this->draw_boxes_in_front(20 * this->block + 5);
        Vec4<T> const w = row(this->matrix, 3), above = row(this->matrix, i % 3);
        // Along the row, and at the same depth.
        Vec3<T> const across = Vec3<T>(above) - Vec3<T>(w) * glm::dot(Vec3<T>(above), Vec3<T>(w));
        std::size_t const odd = static_cast<std::size_t>(this->block * (i % 2 == 0 ? 17 : 19) + i % 16 - i % 2 * 3);
        auto& box = this->boxes[odd];
        Vec3<T> const by = safe_normalize(across).direction * (i % 6 < 3 ? T(40) : T(-40));
        box.lo += by, box.hi += by;
        this->expect_merged();
    }
}

TYPED_TEST(BoundsOfManyBoxes, HoldTheOneOfHundredsThatIsAstrideOrFarAway) {
    using T = TypeParam;
    for (int i = 0; i < 12; ++i) {
        this->draw_perspective();
        this->draw_boxes_in_front(20 * this->block + 5);
        auto& box = this->boxes[static_cast<std::size_t>(this->block * 18 + i)];
        box = i % 2 == 0 ? Aabb<T>{Vec3<T>(-8), Vec3<T>(8)} : Aabb<T>{Vec3<T>(-0x1p61), Vec3<T>(0x1p61)};
        this->expect_merged();
    }
}

TYPED_TEST(BoundsOfManyBoxes, OfBoxesBehindAreEmpty) {
    for (int i = 0; i < 12; ++i) {
        this->draw_perspective();
        this->draw_boxes_in_front(1 + 3 * i);
        for (int column = 0; column < 4; ++column) this->matrix[column][3] *= -1;
        EXPECT_TRUE(is_empty(this->bounds()));
    }
}

// What is known of the bounds already; a box that is inside all of its sides is not looked at.
TYPED_TEST(BoundsOfManyBoxes, MayBeExtendedByABoxThatReachesBeyondASideAndByNoOther) {
    using T = TypeParam;
    constexpr std::size_t n = detail::bodies_at_once;
    using Bounds = detail::BoundsOfBoxes<T>;
    for (int i = 0; i < 60; ++i) {
        this->draw_perspective();
        this->draw_boxes_in_front(TestFixture::block);
        T ends[6][n], size[n];
        std::uint32_t taken[n];
        Aabb<Real> exact;
        for (std::size_t k = 0; k < n; ++k) {
            Aabb<T> const& box = this->boxes[k];
            for (int axis = 0; axis < 3; ++axis) ends[axis][k] = box.lo[axis], ends[axis + 3][k] = box.hi[axis];
            this->add(exact, this->matrix, box, this->w_min);
            taken[k] = ~0u;
        }
        BoxArrays<T> const arrays{ends[0], ends[1], ends[2], ends[3], ends[4], ends[5]};
        for (std::size_t k = 0; k < n; ++k) size[k] = Bounds::size_of(arrays, static_cast<int>(k));
        Vec4<T> const rows[4] = {row(this->matrix, 0), row(this->matrix, 1), row(this->matrix, 2),
                                 row(this->matrix, 3)};
        Aabb<T> unused;
        Bounds const of{this->matrix, rows, this->w_min, arrays, TestFixture::block, unused};
        auto const may = [&](Aabb<T> const& known) {
            typename Bounds::Side sides[6];
            EXPECT_TRUE(of.take_sides(known, sides));
            return of.may_extend(sides, 0, size, taken);
        };
        Vec3<T> const room = Vec3<T>(exact.hi - exact.lo) * T(1e-3);
        Aabb<T> const wider{Vec3<T>(exact.lo) - room, Vec3<T>(exact.hi) + room};
        EXPECT_FALSE(may(wider)) << i;
        for (int axis = 0; axis < 3; ++axis) {
            Aabb<T> shorter = wider;
            shorter.lo[axis] += T(2) * room[axis];
            EXPECT_TRUE(may(shorter)) << i << ' ' << axis;
            shorter = wider;
            shorter.hi[axis] -= T(2) * room[axis];
            EXPECT_TRUE(may(shorter)) << i << ' ' << axis;
            for (auto& one : taken) one = 0;
            EXPECT_FALSE(may(shorter)) << "by none that counts";
            for (auto& one : taken) one = ~0u;
        }
        typename Bounds::Side sides[6];
        EXPECT_FALSE(of.take_sides({}, sides));
    }
}
