// SPDX-License-Identifier: MIT
#include "tests/laws/slices.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/slices_of_views.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

using namespace shadowmath;

namespace {

template <class T>
class SlicesOfViews : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SlicesOfViews, Scalars);

constexpr int block = detail::views_at_once;

template <class T>
std::vector<ViewVolume<T>> cameras(int count) {
    std::vector<ViewVolume<T>> views;
    for (int i = 0; i < count; ++i) {
        T const turn = T(0.37) * T(i);
        Pose<T> const pose = pose_looking(Vec3<T>(T(3 * i), T(2), T(-i)),
                                          Vec3<T>(std::cos(turn), T(-0.2), std::sin(turn)), Vec3<T>(0, 1, 0));
        views.push_back(perspective_view(pose, T(0.6) + T(0.01) * T(i % 40), T(1.5), T(0.1), T(60 + i)));
    }
    return views;
}

template <class T>
LightBasis<T> some_basis() {
    return light_basis(directional(Vec3<T>(T(0.4), T(-1), T(0.3))).direction);
}

// The maps of many views, and one matrix more that must stay as it was.
template <class T>
struct Fitted {
    std::vector<Mat4<T>> maps;
    int splits;
    int count = -1;

    Fitted(std::vector<ViewVolume<T>> const& views, int of_each, LightBasis<T> const& basis = some_basis<T>(),
           T lambda = T(0.5), T border = T(0.01), ClipSpace clip = gl_clip)
        : maps(views.size() * static_cast<std::size_t>(of_each) + 1, Mat4<T>(T(7))), splits(of_each) {
        count = fit_slice_boxes_of(views.data(), static_cast<int>(views.size()), basis, splits, lambda, border, clip,
                                   maps.data());
        EXPECT_EQ(maps.back(), Mat4<T>(T(7))) << "nothing beyond the last map is written";
    }
    [[nodiscard]] Mat4<T> const& map(std::size_t view, int slice) const {
        return maps[view * static_cast<std::size_t>(splits) + static_cast<std::size_t>(slice)];
    }
    [[nodiscard]] bool is_nowhere(std::size_t view) const {
        for (int k = 0; k < splits; ++k)
            if (map(view, k) != nowhere<T>()) return false;
        return true;
    }
};

// Of one view, by itself.
template <class T>
std::vector<Mat4<T>> twin_of(ViewVolume<T> const& view, int splits, LightBasis<T> const& basis = some_basis<T>(),
                             T lambda = T(0.5), T border = T(0.01), ClipSpace clip = gl_clip) {
    std::vector<Mat4<T>> maps(max_splits, nowhere<T>());
    (void)fit_slice_boxes(view, basis, practical_splits(view.z_near, view.z_far, splits, lambda), border, clip,
                          maps.data());
    maps.resize(static_cast<std::size_t>(splits));
    return maps;
}

// A block at once; no maps where not all of its views are ordinary.
template <class T>
std::vector<Mat4<T>> made_at_once(std::vector<ViewVolume<T>> const& views, T lambda = T(0.5), T border = T(0.01),
                                  ClipSpace clip = gl_clip) {
    std::vector<Mat4<T>> maps(4 * block, Mat4<T>(T(7)));
    auto const basis = some_basis<T>();
    detail::MapInLanes<T> const map = detail::map_in_lanes(clip, T(2) - T(4) * border);
    bool ordinary = false;
    detail::SlicesOfViews<T>{views.data(), basis, lambda, map, maps.data(), ordinary}();
    if (ordinary) return maps;
    for (Mat4<T> const& untouched : maps) EXPECT_EQ(untouched, Mat4<T>(T(7)));
    return {};
}

}  // namespace

TYPED_TEST(SlicesOfViews, AreThoseOfEachViewHoweverManyThereAre) {
    using T = TypeParam;
    for (int const count : {1, 3, block - 1, block, block + 1, 2 * block, 3 * block + 7})
        for (ClipSpace const clip : {gl_clip, vulkan_clip, reversed(d3d_clip)}) {
            auto const views = cameras<T>(count);
            Fitted<T> const fitted(views, 4, some_basis<T>(), T(0.7), T(0.02), clip);
            EXPECT_EQ(fitted.count, count);
            for (std::size_t i = 0; i < views.size(); ++i) {
                auto const twin = twin_of(views[i], 4, some_basis<T>(), T(0.7), T(0.02), clip);
                for (int k = 0; k < 4; ++k)
                    EXPECT_TRUE(laws::is_nearly(fitted.map(i, k), twin[static_cast<std::size_t>(k)]))
                        << count << ": " << i << ' ' << k;
            }
        }
}

TYPED_TEST(SlicesOfViews, HoldEveryCornerOfTheirSlices) {
    using T = TypeParam;
    auto const views = cameras<T>(block + 5);
    Fitted<T> const fitted(views, 4);
    for (std::size_t i = 0; i < views.size(); ++i) {
        Splits<T> const splits = practical_splits(views[i].z_near, views[i].z_far, 4, T(0.5));
        for (int k = 0; k < 4; ++k) {
            ViewVolume<T> const part = slice(views[i], slice_range(splits, k));
            EXPECT_TRUE(laws::holds_corners(fitted.map(i, k), gl_clip, part, 0.02L)) << i << ' ' << k;
            EXPECT_TRUE(laws::is_filled(fitted.map(i, k), gl_clip, part, T(0.01))) << i << ' ' << k;
        }
    }
}

TYPED_TEST(SlicesOfViews, OfABlockOfOrdinaryViewsAreMadeAtOnce) {
    using T = TypeParam;
    auto const views = cameras<T>(block);
    for (T const lambda : {T(0.1), T(0.7), T(1)})
        for (T const border : {T(0), T(0.02), T(0.49)}) {
            auto const at_once = made_at_once(views, lambda, border);
            ASSERT_FALSE(at_once.empty()) << lambda << ' ' << border;
            for (std::size_t i = 0; i < views.size(); ++i) {
                auto const twin = twin_of(views[i], 4, some_basis<T>(), lambda, border);
                for (std::size_t k = 0; k < 4; ++k)
                    EXPECT_TRUE(laws::is_nearly(at_once[4 * i + k], twin[k])) << i << ' ' << k;
            }
        }
}

TYPED_TEST(SlicesOfViews, OfABlockWithOneOddViewAreNotMadeAtOnce) {
    using T = TypeParam;
    auto const good = cameras<T>(block);
    auto const expect_refused = [&](auto const& spoil) {
        for (std::size_t at = 4; at < 8; ++at) {
            auto views = good;
            spoil(views[at]);
            EXPECT_TRUE(made_at_once(views).empty()) << at;
        }
    };
    expect_refused([](ViewVolume<T>& view) { view.kind = ViewKind::orthographic; });
    expect_refused([](ViewVolume<T>& view) { view.left = view.right; });
    expect_refused([](ViewVolume<T>& view) { view.bottom = view.top; });
    expect_refused([](ViewVolume<T>& view) { view.z_near = view.z_far; });
    expect_refused([](ViewVolume<T>& view) { view.z_far = T(0x1p61); });
    expect_refused([](ViewVolume<T>& view) { view.z_near = T(1e-5), view.z_far = T(1e17); });
    for (T const bad : {T(0x1p61), T(-0x1p61), std::numeric_limits<T>::infinity()}) {
        for (Vec3<T> Pose<T>::*part : {&Pose<T>::position, &Pose<T>::right, &Pose<T>::up, &Pose<T>::forward})
            for (int axis = 0; axis < 3; ++axis)
                expect_refused([&](ViewVolume<T>& view) { (view.pose.*part)[axis] = bad; });
        for (T ViewVolume<T>::*side :
             {&ViewVolume<T>::left, &ViewVolume<T>::right, &ViewVolume<T>::bottom, &ViewVolume<T>::top})
            expect_refused([&](ViewVolume<T>& view) { view.*side = bad; });
    }
}

TYPED_TEST(SlicesOfViews, OfABlockWithASliceOfNoLengthAreNotMadeAtOnce) {
    using T = TypeParam;
    int refused = 0;
    for (T const lambda : {T(0.25), T(0.5), T(1)})
        for (T const z_near : {T(1), T(1.3), T(1.9)}) {
            auto views = cameras<T>(block);
            T z_far = z_near;
            for (int ulps = 1; ulps < 12; ++ulps) {
                z_far = std::nextafter(z_far, T(2) * z_far);
                views[9].z_near = z_near, views[9].z_far = z_far;
                if (practical_splits(z_near, z_far, 4, lambda).count == 4) continue;
                EXPECT_TRUE(made_at_once(views, lambda).empty()) << lambda << ' ' << z_near << ' ' << ulps;
                ++refused;
            }
        }
    EXPECT_GT(refused, 20);
}

TYPED_TEST(SlicesOfViews, OfFewerThanABlockAreTheOnesOfOneViewBitForBit) {
    using T = TypeParam;
    for (int const count : {1, block - 1, block + 3}) {
        auto const views = cameras<T>(count);
        Fitted<T> const fitted(views, 4);
        for (std::size_t i = static_cast<std::size_t>(count / block * block); i < views.size(); ++i) {
            auto const twin = twin_of(views[i], 4);
            for (int k = 0; k < 4; ++k) EXPECT_EQ(fitted.map(i, k), twin[static_cast<std::size_t>(k)]) << i;
        }
    }
}

TYPED_TEST(SlicesOfViews, OfAnyNumberOfSplitsAreThoseOfOneView) {
    using T = TypeParam;
    auto const views = cameras<T>(block + 1);
    for (int const splits : {1, 2, 3, 5, max_splits}) {
        Fitted<T> const fitted(views, splits);
        EXPECT_EQ(fitted.count, block + 1);
        for (std::size_t i = 0; i < views.size(); ++i) {
            auto const twin = twin_of(views[i], splits);
            for (int k = 0; k < splits; ++k) EXPECT_EQ(fitted.map(i, k), twin[static_cast<std::size_t>(k)]) << i;
        }
    }
}

TYPED_TEST(SlicesOfViews, AreOfTheViewsFromTheFirstThatIsGivenOn) {
    using T = TypeParam;
    auto const views = cameras<T>(4 * block);
    std::vector<Mat4<T>> maps(8 * block);
    EXPECT_EQ(fit_slice_boxes_of(views.data() + 2 * block, 2 * block, some_basis<T>(), 4, T(0.5), T(0.01), gl_clip,
                                 maps.data()),
              2 * block);
    for (std::size_t i = 0; i < 2 * block; ++i) {
        auto const twin = twin_of(views[2 * block + i], 4);
        for (std::size_t k = 0; k < 4; ++k) EXPECT_TRUE(laws::is_nearly(maps[4 * i + k], twin[k])) << i << ' ' << k;
    }
}

TYPED_TEST(SlicesOfViews, OfNoViewsAreNone) {
    using T = TypeParam;
    Mat4<T> untouched(T(7));
    ViewVolume<T> const* const no_views = nullptr;
    for (int const count : {0, -1, -block})
        EXPECT_EQ(fit_slice_boxes_of(no_views, count, some_basis<T>(), 4, T(0.5), T(0), gl_clip, &untouched), 0);
    EXPECT_EQ(untouched, Mat4<T>(T(7)));
}

TYPED_TEST(SlicesOfViews, AViewThatNoneCanBeMadeForIsNowhereAndSpoilsNoOther) {
    using T = TypeParam;
    T const no_number = std::numeric_limits<T>::quiet_NaN(), endless = std::numeric_limits<T>::infinity();
    auto const good = cameras<T>(block + 2);
    auto const spoilt = [&](std::size_t at, auto const& spoil) {
        auto views = good;
        spoil(views[at]);
        Fitted<T> const fitted(views, 4);
        EXPECT_EQ(fitted.count, block + 1);
        for (std::size_t i = 0; i < views.size(); ++i) {
            auto const twin = twin_of(good[i], 4);
            for (int k = 0; k < 4 && i != at; ++k)
                EXPECT_TRUE(laws::is_nearly(fitted.map(i, k), twin[static_cast<std::size_t>(k)])) << i << ' ' << k;
        }
        EXPECT_TRUE(fitted.is_nowhere(at)) << at;
    };
    for (std::size_t const at : {0u, 17u, unsigned(block) - 1, unsigned(block) + 1}) {
        for (T const bad : {no_number, endless, T(0x1p61)}) {
            spoilt(at, [&](ViewVolume<T>& view) { view.pose.position.y = bad; });
            spoilt(at, [&](ViewVolume<T>& view) { view.pose.forward.x = bad; });
            spoilt(at, [&](ViewVolume<T>& view) { view.right = bad; });
            spoilt(at, [&](ViewVolume<T>& view) { view.z_far = bad; });
        }
        spoilt(at, [&](ViewVolume<T>& view) { view.z_near = no_number; });
        spoilt(at, [&](ViewVolume<T>& view) { view.z_near = -1; });
        spoilt(at, [&](ViewVolume<T>& view) { view.z_near = view.z_far; });
        spoilt(at, [&](ViewVolume<T>& view) { std::swap(view.left, view.right); });
        spoilt(at, [&](ViewVolume<T>& view) { view.top = view.bottom; });
    }
}

TYPED_TEST(SlicesOfViews, OrthographicViewsAmongThemAreMadeToo) {
    using T = TypeParam;
    auto views = cameras<T>(2 * block);
    views[5] = orthographic_view(views[5].pose, T(-20), T(20), T(-9), T(9), T(0.5), T(80));
    Fitted<T> const fitted(views, 4);
    EXPECT_EQ(fitted.count, 2 * block);
    for (std::size_t i = 0; i < std::size_t(block); ++i) {
        auto const twin = twin_of(views[i], 4);
        for (int k = 0; k < 4; ++k) EXPECT_EQ(fitted.map(i, k), twin[static_cast<std::size_t>(k)]) << i;
    }
}

TYPED_TEST(SlicesOfViews, SplitsThatThereAreNotAreNowhereAndTheViewDoesNotCount) {
    using T = TypeParam;
    auto views = cameras<T>(block);
    views[3].z_near = T(1);
    views[3].z_far = std::nextafter(std::nextafter(T(1), T(2)), T(2));
    Splits<T> const splits = practical_splits(views[3].z_near, views[3].z_far, 4, T(0.5));
    ASSERT_LT(splits.count, 4);
    Fitted<T> const fitted(views, 4);
    EXPECT_EQ(fitted.count, block - 1);
    auto const twin = twin_of(views[3], 4);
    for (int k = 0; k < splits.count; ++k) EXPECT_EQ(fitted.map(3, k), twin[static_cast<std::size_t>(k)]);
    for (int k = splits.count; k < 4; ++k) EXPECT_EQ(fitted.map(3, k), nowhere<T>());
}

TYPED_TEST(SlicesOfViews, OfALightWithoutUnitAxesOrWithoutRoomAreNowhere) {
    using T = TypeParam;
    T const no_number = std::numeric_limits<T>::quiet_NaN();
    auto const views = cameras<T>(block + 1);
    auto const expect_nowhere = [&](LightBasis<T> const& basis, T border) {
        Fitted<T> const fitted(views, 4, basis, T(0.5), border);
        EXPECT_EQ(fitted.count, 0);
        for (std::size_t i = 0; i < views.size(); ++i) EXPECT_TRUE(fitted.is_nowhere(i)) << i;
    };
    for (T const bad : {no_number, std::numeric_limits<T>::infinity(), T(0x1p61), T(3), T(2), T(-2)})
        for (int axis = 0; axis < 9; ++axis) {
            LightBasis<T> basis = some_basis<T>();
            (axis < 3 ? basis.x : axis < 6 ? basis.y : basis.depth)[axis % 3] = bad;
            expect_nowhere(basis, T(0));
        }
    for (T const border : {T(-0.01), T(0.5), no_number}) expect_nowhere(some_basis<T>(), border);
}

TYPED_TEST(SlicesOfViews, AWeightOutsideItsRangeIsClampedAsForOneView) {
    using T = TypeParam;
    auto const views = cameras<T>(block);
    for (T const lambda : {T(-1), T(0), T(1), T(2), std::numeric_limits<T>::quiet_NaN()}) {
        Fitted<T> const fitted(views, 4, some_basis<T>(), lambda);
        EXPECT_EQ(fitted.count, block);
        for (std::size_t i = 0; i < views.size(); ++i) {
            auto const twin = twin_of(views[i], 4, some_basis<T>(), lambda);
            for (int k = 0; k < 4; ++k)
                EXPECT_TRUE(laws::is_nearly(fitted.map(i, k), twin[static_cast<std::size_t>(k)])) << i << ' ' << k;
        }
    }
}

TYPED_TEST(SlicesOfViews, AreTheSameEachTimeWithoutTheHeap) {
    using T = TypeParam;
    auto const views = cameras<T>(2 * block + 9);
    Fitted<T> once(views, 4);
    auto const again = test::watched([&] {
        return fit_slice_boxes_of(views.data(), static_cast<int>(views.size()), some_basis<T>(), 4, T(0.5), T(0.01),
                                  gl_clip, once.maps.data());
    });
    EXPECT_TRUE(again.calm_in_range());
    EXPECT_EQ(again.result, 2 * block + 9);
    EXPECT_EQ(once.maps, Fitted<T>(views, 4).maps);
}
