// SPDX-License-Identifier: MIT
#include <shadowmath/bounds_of_body.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace shadowmath;

namespace {

template <class T>
Mat4<T> seen_along(int axis) {
    Vec4<T> w(0, 0, 0, T(0.25));
    w[axis] = T(1);
    return from_rows(Vec4<T>(2, T(0.5), 0, 1), Vec4<T>(T(-0.25), 3, T(0.5), -1), Vec4<T>(1, T(0.5), -2, T(0.5)), w);
}

}  // namespace

template <class T>
class BoundsOfBody : public ::testing::Test {
public:
    using Body = std::array<Vec3<T>, 8>;

    Aabb<T> box{Vec3<T>(-1, -2, -3), Vec3<T>(4, 3, 2)};

    static void expect_close(Aabb<T> const& found, Aabb<T> const& wanted) {
        T const close = T(64) * std::numeric_limits<T>::epsilon();
        for (int k = 0; k < 3; ++k) {
            EXPECT_LE(std::abs(found.lo[k] - wanted.lo[k]), close * (T(1) + std::abs(wanted.lo[k]))) << k;
            EXPECT_LE(std::abs(found.hi[k] - wanted.hi[k]), close * (T(1) + std::abs(wanted.hi[k]))) << k;
        }
    }
    // Of the corners at w >= w_min, and where the edges pass through it.
    static Aabb<T> wanted(Mat4<T> const& m, Body const& corners, T w_min) {
        Aabb<T> all;
        auto const add = [&](Vec4<T> const& p) { all = merge(all, Vec3<T>(p) / p.w); };
        for (unsigned i = 0; i < 8; ++i) {
            Vec4<T> const a = m * Vec4<T>(corners[i], 1);
            if (a.w >= w_min) add(a);
            for (unsigned j : {i ^ 1u, i ^ 2u, i ^ 4u}) {
                Vec4<T> const b = m * Vec4<T>(corners[j], 1);
                if (a.w < w_min && b.w > w_min) add(a + (b - a) * ((w_min - a.w) / (b.w - a.w)));
            }
        }
        return all;
    }
};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(BoundsOfBody, Scalars);

TYPED_TEST(BoundsOfBody, AreThoseOfWhatIsInFrontOfWMinWhicheverEdgesItCuts) {
    using T = TypeParam;
    auto const body = corners(this->box);
    for (int axis = 0; axis < 3; ++axis)
        for (T const w_min : {T(0.125), T(0.25), T(1), T(2)})
            for (T const sign : {T(1), T(-1)}) {
                auto m = seen_along<T>(axis);
                for (int column = 0; column < 3; ++column) m[column][3] *= sign;
                this->expect_close(detail::bounds_of_body(m, body, w_min), this->wanted(m, body, w_min));
            }
}

TYPED_TEST(BoundsOfBody, AreTheSameForAMatrixOfNumbersTooLargeToBeMultiplied) {
    using T = TypeParam;
    T const large = std::numeric_limits<T>::max() / T(8);
    auto const body = corners(this->box);
    auto const m = seen_along<T>(2);
    this->expect_close(detail::bounds_of_body(m * large, body, T(0.5) * large), this->wanted(m, body, T(0.5)));
}

TYPED_TEST(BoundsOfBody, AreTheSameForABodyTooLargeToBeMultiplied) {
    using T = TypeParam;
    T const large = std::numeric_limits<T>::max() / T(8);
    auto const m = seen_along<T>(2);
    auto flat = m;
    flat[3] = Vec4<T>(0);
    auto body = corners(this->box);
    auto const wanted = this->wanted(flat, body, T(0.5));
    for (auto& corner : body) corner *= large;
    this->expect_close(detail::bounds_of_body(m, body, T(0.5) * large), wanted);
}

// A corner nearby and one without an end share an edge, and it is cut where it is.
TYPED_TEST(BoundsOfBody, CutAnEdgeWithoutAnEndWhereItIs) {
    using T = TypeParam;
    T const endless = std::numeric_limits<T>::max();
    Mat4<T> const m = from_rows(Vec4<T>(1, 0, 0, 0), Vec4<T>(0, 1, 0, 0), Vec4<T>(0, 0, 0, 1), Vec4<T>(0, 0, 1, 0));
    auto const found =
        detail::bounds_of_body(m, corners(Aabb<T>{Vec3<T>(-10, -20, 1), Vec3<T>(30, 40, endless)}), T(5));
    this->expect_close(found, {Vec3<T>(-2, -4, 0), Vec3<T>(6, 8, T(1) / T(5))});
}

// As if it ended where nothing is told apart from there on.
TYPED_TEST(BoundsOfBody, OfABodyWithoutAnEndAlongOneAxisAreThoseOfOneThatEndsFarOut) {
    using T = TypeParam;
    for (int axis = 0; axis < 3; ++axis) {
        auto const m = seen_along<T>(axis);
        Aabb<T> endless = this->box, far_out = this->box;
        endless.hi[axis] = std::numeric_limits<T>::max();
        far_out.hi[axis] = T(1e24L);
        this->expect_close(detail::bounds_of_body(m, corners(endless), T(0.5)),
                           this->wanted(m, corners(far_out), T(0.5)));
    }
}

TYPED_TEST(BoundsOfBody, WithoutAWMinEndWhereWIsWhatRoundingLeavesOfItsLargest) {
    using T = TypeParam;
    Mat4<T> const m = from_rows(Vec4<T>(1, 0, 0, 0), Vec4<T>(0, 1, 0, 0), Vec4<T>(0, 0, 0, 1), Vec4<T>(0, 0, 1, 0));
    auto const body = corners(Aabb<T>{Vec3<T>(-1), Vec3<T>(4)});
    T const least = T(4) * std::numeric_limits<T>::epsilon();
    for (T const none : {T(0), T(-1)}) {
        auto const found = detail::bounds_of_body(m, body, none);
        EXPECT_NEAR(double(found.hi.x * least), 4.0, 1e-4);
        EXPECT_NEAR(double(found.lo.y * least), -1.0, 1e-4);
        EXPECT_NEAR(double(found.hi.z * least), 1.0, 1e-4);
    }
}

TYPED_TEST(BoundsOfBody, EndAtTheLargestNumberWhereAQuotientWouldGoBeyond) {
    using T = TypeParam;
    T const largest = std::numeric_limits<T>::max();
    Mat4<T> const m = from_rows(Vec4<T>(1, 0, 0, 0), Vec4<T>(0, 1, 0, 0), Vec4<T>(0, 0, 0, 1), Vec4<T>(0, 0, 1, 0));
    auto const found = detail::bounds_of_body(m, corners(Aabb<T>{Vec3<T>(-1e9f, -1e9f, -1), Vec3<T>(1e9f, 1e9f, 1)}),
                                              std::numeric_limits<T>::min());
    for (int k = 0; k < 2; ++k) {
        EXPECT_EQ(found.lo[k], -largest);
        EXPECT_EQ(found.hi[k], largest);
    }
}

TYPED_TEST(BoundsOfBody, OfWhatIsNoNumberOrNothingAreEmpty) {
    using T = TypeParam;
    T const nan = std::numeric_limits<T>::quiet_NaN();
    auto const body = corners(this->box);
    auto const m = seen_along<T>(2);
    EXPECT_FALSE(is_empty(detail::bounds_of_body(m, body, T(1))));
    EXPECT_TRUE(is_empty(detail::bounds_of_body(m, body, nan)));
    EXPECT_TRUE(is_empty(detail::bounds_of_body(Mat4<T>(T(0)), body, T(1))));
    EXPECT_TRUE(is_empty(detail::bounds_of_body(m, body, T(100))));
    for (int k = 0; k < 16; ++k) {
        auto spoiled = m;
        spoiled[k / 4][k % 4] = nan;
        EXPECT_TRUE(is_empty(detail::bounds_of_body(spoiled, body, T(1)))) << k;
    }
    for (unsigned i = 0; i < 8; ++i) {
        auto spoiled = body;
        spoiled[i].y = nan;
        EXPECT_TRUE(is_empty(detail::bounds_of_body(m, spoiled, T(1)))) << i;
    }
}
