// SPDX-License-Identifier: MIT
#include "tests/laws/scroll.hpp"
#include "tests/support/gen.hpp"

#include <gtest/gtest.h>

#include <array>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
class ScrollProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ScrollProperty, Scalars);

TYPED_TEST(ScrollProperty, KeepsOrDrawsEachTexelExactlyOnce) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Light<T> const light = *sun<T>();
        int const size = static_cast<int>(1 + *below(24));
        auto const basis = light_basis(light.direction);
        Vec3<T> const start = *point_within<T>(T(100));
        Vec3<T> const step = *point_within<T>(T(2) * T(size));
        auto const before = grid_window(basis, start, T(1), size), after = grid_window(basis, start + step, T(1), size);
        Scroll const scroll = scroll_between(before, after);
        RC_ASSERT(laws::covers_once(before, after, scroll));
        for (int i = 0; i < scroll.fresh.count; ++i)
            RC_ASSERT(laws::wraps_once(after, scroll.fresh.at[static_cast<std::size_t>(i)]));
        // A texel that was kept has the same address, and its place in the world is the same.
        RC_ASSERT(wrapped(before.x + scroll.x, size) == wrapped(after.x, size) || !scroll.kept);
    }));
}

// Grids from anywhere, as after a load or a teleport.
TYPED_TEST(ScrollProperty, IsWholeOrNothingForAnyTwoGrids) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        auto const any = [] {
            TexelGrid<T> grid;
            std::array<std::int64_t, 5> const places{0, 7, -3, std::int64_t(1) << 51, -(std::int64_t(1) << 51)};
            grid.x = places[*below(5)];
            grid.y = places[*below(5)];
            grid.map_size = static_cast<int>(1 + *below(9));
            grid.texel_metres = *nasty<T>();
            grid.visible = !*one_in(4);
            return grid;
        };
        TexelGrid<T> const before = any();
        TexelGrid<T> const drawn = any();
        TexelGrid<T> after = *one_in(2) ? before : drawn;
        after.x += static_cast<std::int64_t>(*below(20)) - 10;
        Scroll const scroll = scroll_between(before, after);
        if (!after.visible) {
            RC_ASSERT(scroll.fresh.count == 0 && !scroll.kept);
            return;
        }
        RC_ASSERT(laws::covers_once(before, after, scroll));
    }));
}

}  // namespace
