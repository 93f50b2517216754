// SPDX-License-Identifier: MIT
#include "tests/laws/slices.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class SlicesProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SlicesProperty, Scalars);

namespace {

template <class T>
struct SlicesCase {
    ViewVolume<T> view;
    LightBasis<T> basis;
    Splits<T> splits;
    ClipSpace clip;
};

template <class T>
SlicesCase<T> some_slices() {
    SlicesCase<T> drawn;
    drawn.view = *view_volume<T>();
    Light<T> const light = *sun<T>();
    drawn.basis = light_basis(light.direction);
    auto const count = static_cast<int>(1 + *below(6));
    drawn.splits = practical_splits(drawn.view.z_near, drawn.view.z_far, count);
    drawn.clip = *clip_space();
    return drawn;
}

}  // namespace

TYPED_TEST(SlicesProperty, BoxesHoldEveryCornerInsideTheirBorderAndAreFilled) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        SlicesCase<T> const drawn = some_slices<T>();
        T const border = *uniform<T>(T(0), T(0.1));
        Mat4<T> maps[max_splits];
        RC_ASSERT(fit_slice_boxes(drawn.view, drawn.basis, drawn.splits, border, drawn.clip, maps));
        for (int i = 0; i < drawn.splits.count; ++i) {
            ViewVolume<T> const part = slice(drawn.view, slice_range(drawn.splits, i));
            RC_ASSERT(laws::holds_corners(maps[i], drawn.clip, part, 2 * static_cast<long double>(border)));
            RC_ASSERT(laws::is_filled(maps[i], drawn.clip, part, border));
        }
    }));
}

TYPED_TEST(SlicesProperty, SpheresHoldEveryCornerAndStandOnTheTexelGrid) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        SlicesCase<T> const drawn = some_slices<T>();
        auto const map_size = static_cast<int>(64 + *below(4096));
        Mat4<T> maps[max_splits];
        RC_ASSERT(fit_slice_spheres(drawn.view, drawn.basis, drawn.splits, map_size, T(2), drawn.clip, maps));
        for (int i = 0; i < drawn.splits.count; ++i) {
            ViewVolume<T> const part = slice(drawn.view, slice_range(drawn.splits, i));
            long double const rounding =
                laws::slice_rounding(part) * glm::length(Vec3<long double>(Vec4<long double>(row(maps[i], 0))));
            RC_ASSERT(laws::holds_corners(maps[i], drawn.clip, part, 2 * 2.0L / map_size - rounding));
            RC_ASSERT(laws::is_on_the_grid(maps[i], drawn.basis, part, map_size, T(2), drawn.clip));
        }
    }));
}

TYPED_TEST(SlicesProperty, OfAnyNumbersAreFiniteAndCalm) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ViewVolume<T> const view = *nasty_view_volume<T>();
        Vec3<T> const travel = *nasty_vec3<T>();
        Splits<T> splits = practical_splits(T(0.1), T(100), 4);
        bool const odd = *one_in(4);
        if (odd) splits.plane[4] = *nasty<T>();
        T const border = *nasty<T>();
        LightBasis<T> basis = light_basis(safe_normalize(travel).direction);
        bool const bent = *one_in(4);
        if (bent) basis.x = travel;
        Mat4<T> maps[max_splits];
        auto const boxes =
            watched([&] { return fit_slice_boxes(view, basis, splits, odd ? border : T(0), gl_clip, maps); });
        RC_ASSERT(boxes.calm());
        for (int i = 0; i < 4; ++i) RC_ASSERT(all_finite(maps[i]) && (boxes.result || maps[i] == nowhere<T>()));
        auto const spheres =
            watched([&] { return fit_slice_spheres(view, basis, splits, 1024, odd ? border : T(2), gl_clip, maps); });
        RC_ASSERT(spheres.calm());
        for (int i = 0; i < 4; ++i) RC_ASSERT(all_finite(maps[i]));
    }));
}
