// SPDX-License-Identifier: MIT
#include "tests/laws/fit_rectangle.hpp"
#include "tests/laws/shadow_map.hpp"
#include "tests/support/gen.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
class FitRectangleProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(FitRectangleProperty, Scalars);

TYPED_TEST(FitRectangleProperty, HoldsTheBodyInNoMoreAreaThanTheBox) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const view = *view_volume<T>();
        auto const light = *sun<T>();
        auto const clip = *clip_space();
        auto const margin = *uniform<T>(T(0), T(8));
        auto const last = *direction<T>();
        auto const hysteresis = *uniform<T>(T(0), T(1));
        int const size = 19 + static_cast<int>(*below(8000));
        auto const basis = light_basis(light.direction);
        auto const body = convex_body(corners(view));
        auto const box = fit_rectangle(basis, body, size, margin, last, hysteresis);
        RC_ASSERT(laws::is_a_box(box));
        RC_ASSERT(laws::holds_body_and_margin(box, body, size, margin));
        RC_ASSERT(area(box) <= area(fit_box(basis, corners(view), size, margin)));
        RC_ASSERT(laws::is_rolled(box.basis, basis));
        RC_ASSERT(laws::is_map_of(clip_from_world(box, clip), light, clip));
    }));
}

// In double, near the origin: what is compared is the choice of the angle, not the rounding of the body. Cut at random,
// so that the best side has no parallel elsewhere on the body.
TEST(FitRectangleInDouble, NoAngleNeedsLess) {
    EXPECT_TRUE(rc::check([] {
        auto const start = *box<double>(10.0);
        auto const light = *sun<double>();
        auto body = convex_body(start);
        std::uint64_t const cuts = *below(10);
        for (std::uint64_t i = 0; i < cuts; ++i) {
            auto const normal = *direction<double>();
            auto const share = *uniform<double>(0.0, 0.5);
            auto const extent = glm::dot(glm::abs(normal), start.hi - start.lo) * share;
            body = clipped(body, Vec4<double>(normal, extent - glm::dot(normal, start.lo + start.hi) * 0.5));
        }
        auto const basis = light_basis(light.direction);
        auto const box = fit_rectangle(basis, body, 1 << 24, 0.0);
        long double const least = laws::least_area_of_many(basis, body, 720);
        long double const extent = box.hi.x - box.lo.x + box.hi.y - box.lo.y + box.depth_hi - box.depth_lo;
        // Thin ones are as wide as a texel of their largest extent, 2^-24, and never thinner than a micrometre.
        long double const widened = extent * (extent * 1e-7L + 1.000001e-6L);
        RC_ASSERT(static_cast<long double>(area(box)) <= least * (1 + 1e-9L) + widened);
    }));
}

TYPED_TEST(FitRectangleProperty, HasTheSameAreaInWhateverAxes) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const start = *box<T>(T(10));
        auto const normal = *direction<T>();
        auto const light = *sun<T>();
        auto const angle = *uniform<T>(T(0), T(6.3));
        auto const body = clipped(convex_body(start), Vec4<T>(normal, -glm::dot(normal, start.lo + start.hi) * T(0.4)));
        RC_PRE(body.edge_count > 0);
        auto const basis = light_basis(light.direction);
        T const here = area(fit_rectangle(basis, body, 4096, T(0)));
        T const there = area(fit_rectangle(rolled(basis, std::cos(angle), std::sin(angle)), body, 4096, T(0)));
        // The sides carry some roundings of the farthest corner; the thin ones are widened to a texel of the long ones.
        T const noise = T(200) * std::numeric_limits<T>::epsilon() * T(35) * T(70) + T(70 * 70) / T(4096);
        RC_ASSERT(std::abs(here - there) <= noise);
    }));
}

TYPED_TEST(FitRectangleProperty, IsABoxForAnyNumbersAtAll) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const good = *box<T>(T(10));
        auto body = convex_body(good);
        auto const bad = *nasty_vec3<T>();
        body.edges[*below(12)].a = bad;
        auto const light = *sun<T>();
        auto const last = *nasty_vec3<T>();
        auto const margin = *nasty<T>();
        auto const hysteresis = *nasty<T>();
        int const size = static_cast<int>(*below(5000)) - 3;
        RC_ASSERT(laws::is_a_box(fit_rectangle(light_basis(light.direction), body, size, margin, last, hysteresis)));
    }));
}

}  // namespace
