// SPDX-License-Identifier: MIT
#include "tests/laws/fit_box.hpp"
#include "tests/laws/shadow_map.hpp"
#include "tests/support/gen.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class FitBoxProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(FitBoxProperty, Scalars);

TYPED_TEST(FitBoxProperty, HoldsEveryCornerWithItsMarginAndNoMore) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const view = *view_volume<T>();
        auto const light = *sun<T>();
        auto const clip = *clip_space();
        auto const margin = *uniform<T>(T(0), T(8));
        int const size = 19 + static_cast<int>(*below(8000));
        auto const body = corners(view);
        auto const box = fit_box(light_basis(light.direction), body, size, margin);
        RC_ASSERT(laws::is_a_box(box));
        RC_ASSERT(laws::holds_corners_and_margin(box, body, size, margin));
        RC_ASSERT(laws::is_tight(box, body, size, margin));
        RC_ASSERT(laws::is_map_of(clip_from_world(box, clip), light, clip));
    }));
}

TYPED_TEST(FitBoxProperty, IsABoxForAnyNumbersAtAll) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const good = *box<T>(T(10));
        auto body = corners(good);
        std::uint64_t const spoiled = *below(8);
        auto const bad = *nasty_vec3<T>();
        body[spoiled] = bad;
        auto const light = *sun<T>();
        LightBasis<T> basis = light_basis(light.direction);
        bool const bad_axis = *one_in(4);
        if (bad_axis) basis.y = bad;
        auto const margin = *nasty<T>();
        int const size = static_cast<int>(*below(5000)) - 3;
        RC_ASSERT(laws::is_a_box(fit_box(basis, body, size, margin)));
    }));
}
