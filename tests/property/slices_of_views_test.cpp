// SPDX-License-Identifier: MIT
#include "tests/laws/slices.hpp"
#include "tests/support/gen.hpp"

#include <shadowmath/slices_of_views.hpp>

#include <gtest/gtest.h>

#include <vector>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class SlicesOfViewsProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SlicesOfViewsProperty, Scalars);

namespace {

// Ordinary perspective views but for every `odd`-th, if that is positive.
template <class T>
std::vector<ViewVolume<T>> some_views(std::size_t count, std::size_t odd) {
    std::vector<ViewVolume<T>> views;
    while (views.size() < count) {
        bool const any = odd > 0 && views.size() % odd == 0;
        ViewVolume<T> view = any ? *nasty_view_volume<T>() : *view_volume<T>();
        if (!any) view.kind = ViewKind::perspective;
        views.push_back(view);
    }
    return views;
}

}  // namespace

TYPED_TEST(SlicesOfViewsProperty, AreThoseOfTheViewsOneByOne) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        // Less than a block, whole ones, and what is left of one.
        auto const views = some_views<T>(*below(3 * detail::views_at_once), 0);
        LightBasis<T> const basis = light_basis((*sun<T>()).direction);
        ClipSpace const clip = *clip_space();
        auto const splits = static_cast<int>(*one_in(4) ? 1 + *below(6) : 4);
        T const lambda = *uniform<T>(T(0), T(1)), border = *uniform<T>(T(0), T(0.1));
        std::size_t const each = static_cast<std::size_t>(splits);
        std::vector<Mat4<T>> maps(each * views.size());
        int const fitted = fit_slice_boxes_of(views.data(), static_cast<int>(views.size()), basis, splits, lambda,
                                              border, clip, maps.data());
        RC_ASSERT(fitted == static_cast<int>(views.size()));
        for (std::size_t i = 0; i < views.size(); ++i) {
            Splits<T> const planes = practical_splits(views[i].z_near, views[i].z_far, splits, lambda);
            Mat4<T> twin[max_splits];
            RC_ASSERT(fit_slice_boxes(views[i], basis, planes, border, clip, twin));
            for (std::size_t k = 0; k < each; ++k) {
                RC_ASSERT(laws::is_nearly(maps[each * i + k], twin[k]));
                ViewVolume<T> const part = slice(views[i], slice_range(planes, static_cast<int>(k)));
                RC_ASSERT(laws::holds_corners(maps[each * i + k], clip, part, 2 * static_cast<long double>(border)));
            }
        }
    }));
}

TYPED_TEST(SlicesOfViewsProperty, OfAnyNumbersAreFiniteAndDisturbNoOther) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        auto const views = some_views<T>(2 * detail::views_at_once, 5);
        LightBasis<T> const basis = light_basis((*sun<T>()).direction);
        std::vector<Mat4<T>> maps(4 * views.size());
        (void)fit_slice_boxes_of(views.data(), static_cast<int>(views.size()), basis, 4, T(0.5), T(0), gl_clip,
                                 maps.data());
        for (std::size_t i = 0; i < views.size(); ++i) {
            Splits<T> const planes = practical_splits(views[i].z_near, views[i].z_far, 4, T(0.5));
            Mat4<T> twin[max_splits];
            (void)fit_slice_boxes(views[i], basis, planes, T(0), gl_clip, twin);
            for (std::size_t k = 0; k < 4; ++k) {
                RC_ASSERT(all_finite(maps[4 * i + k]));
                RC_ASSERT(maps[4 * i + k] == (static_cast<int>(k) < planes.count ? twin[k] : nowhere<T>()));
            }
        }
    }));
}
